"""Cases, and questions about them before anything is solved."""

from __future__ import annotations

from os import PathLike
from typing import Any, List, Mapping, Optional, Union

from percoat import _core, _html
from percoat._record import Record

CaseLike = Union[str, "PathLike[str]", Mapping[str, Any], _core.Case]
"""A path, the name of an embedded case, a dict of the same shape as the TOML, or what :func:`case` gave.

In a dict ``surface.heights`` may be an array ``heights[i, j]``, i along a₁ and j along a₂, NaN or masked where there is no measurement, or
a topography with ``heights()``, ``physical_sizes`` and perhaps ``unit``, as those of SurfaceTopography: then its sizes are the period
and its unit is that of the sizes and heights."""

Settings = Union[None, Mapping[str, Any], List[str]]
"""``{"layers.0.thickness": 0.2}``, or ``["layers.0.thickness=0.2"]`` as the command line has it."""


class Check(Record):
    """Meaning of a case. It prints as ``percoat check`` does."""

    title: str
    points: list[int]
    accuracy: Optional[float]
    memory: int
    memory_available: int
    disk: int
    load: Record
    first_touch: Optional[list[Optional[float]]]
    first_touch_error: Optional[list[Optional[float]]]
    first_touch_quantity: Optional[str]
    sublayer_error: Optional[float]
    library_strengths: list[Record]
    surface: Optional[Record]
    warnings: list[str]
    text: str

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return _html.text(self.text)

    def __repr__(self) -> str:
        return f"<percoat.Check {self.title!r}: {self.points[0]} × {self.points[1]} samples>"


def case(case: CaseLike, *, set: Settings = None) -> dict[str, Any]:
    """A case as a dict, complete with its defaults: to be looked at, changed and solved.

    Parameters
    ----------
    case
        A path, the name of an embedded case, or a dict of the same shape as the TOML.
    set
        Values to change first, ``{"layers.0.thickness": 0.2}``.

    Examples
    --------
    >>> import percoat
    >>> fig2 = percoat.case("fig2")
    >>> fig2["layers"][0]["thickness"]
    0.5
    >>> fig2["layers"][0]["thickness"] = 0.2
    >>> percoat.case(fig2)["layers"][0]["thickness"]
    0.2
    """
    return _core.Case(case, set).as_dict()


def check(case: CaseLike, *, set: Settings = None, threads: Optional[int] = None) -> Check:
    """Meaning of a case: cell, materials, memory, first touches. Nothing is solved.

    Lengths, pressures and forces are in the units of the case, memory and disk in bytes. Loads of first touch are mean pressures, or
    forces where the case gives forces or an isolated contact: ``first_touch_quantity`` says which.

    Examples
    --------
    >>> import percoat
    >>> told = percoat.check("fig2")
    >>> told.points, len(told.first_touch)
    ([512, 512], 3)
    >>> print(told)  # doctest: +ELLIPSIS
    Fig. 2: relatively hard coating, three levels in contact
    ...
    """
    return Check(_core.Case(case, set).check(threads))


def cases() -> dict[str, str]:
    """Names and titles of the embedded cases.

    Examples
    --------
    >>> import percoat
    >>> percoat.cases()["fig2"]
    'Fig. 2: relatively hard coating, three levels in contact'
    """
    return dict(_core.cases())


def explain(key: Optional[str] = None) -> None:
    """Say what a key of a case is: type, unit, range, default and an example; without a key, the sections.

    Examples
    --------
    >>> import percoat
    >>> percoat.explain("layers.thickness")  # doctest: +ELLIPSIS
    layers.thickness...
    """
    print(_core.explain(key), end="")


def materials(file: Union[None, str, PathLike[str]] = None) -> dict[str, dict[str, Any]]:
    """The library of materials by their names, those of a file of one's own before them; moduli and strengths in GPa. The other names that a
    case may use stand under ``aliases``.

    Parameters
    ----------
    file
        A file of ``[[material]]`` entries, as ``percoat materials NAME`` prints them.

    Examples
    --------
    >>> import percoat
    >>> tin = percoat.materials()["TiN"]
    >>> tin["young"]["value"], tin["young"]["range"], tin["young"]["certainty"]
    (430.0, [300.0, 600.0], 'sourced')
    >>> case = percoat.case("tin-on-steel", set={"layers.0.material": "CrN"})  # in its unit, Pa
    >>> case["layers"][0]["young"]
    375000000000.0
    """
    named: dict[str, dict[str, Any]] = {}
    for material in _core.materials(file):
        named.setdefault(material["name"], material)
    return named


def schema() -> dict[str, Any]:
    """The JSON schema of a case.

    Examples
    --------
    >>> import percoat
    >>> percoat.schema()["properties"]["title"]["type"]
    'string'
    """
    return _core.schema()
