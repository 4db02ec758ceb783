"""Numbers of a case from measured indentation curves."""

from __future__ import annotations

import os
import shutil
from os import PathLike
from typing import Any, Iterable, List, Mapping, Optional, Protocol, Sequence, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from percoat import _core
from percoat._case import CaseLike, Settings
from percoat._record import Record
from percoat._solve import Array, Listener, listener
from percoat._warnings import warn


class Table(Protocol):
    """Columns under their names: a dict, a :class:`pandas.DataFrame`."""

    def keys(self) -> Iterable[Any]:
        """Names of the columns."""

    def __getitem__(self, name: Any, /) -> Any:
        """A column."""


Curve = Union[str, "PathLike[str]", Table, NDArray[Any], Sequence[ArrayLike]]
"""The path of a table, named columns, or forces and penetrations, with their standard deviations where they are known."""

Curves = Union[Curve, Sequence[Curve]]
"""A curve, or several."""

NAMES = ("force", "penetration", "penetration_error")
"""How the columns of a curve begin; a unit may follow, ``force_mN``."""


class Identification:
    """Numbers of a case found from measured curves, and the fit. It prints the table of the command line.

    Attributes
    ----------
    values, errors, intervals
        By the names of what was free: the value found, its standard error, and the interval (low, high) that holds it with
        a probability of 95 %.
    correlation
        Array (k, k), in the order of ``values``.
    sensitivities
        By the names of what was taken as known, its derivatives: ``sensitivities["substrate.poisson"]["substrate.young"]`` is the
        change of the modulus found over that of Poisson's ratio. A number that cannot be varied is missing, and a warning says why.
    force, penetration, penetration_error
        The measured points (n,) in the units of the case; ``penetration_error`` is ``None`` where deviations are unknown. Of unloading
        those that were fitted by a power law.
    curve
        Index of the curve of each point (n,).
    fitted, fitted_error
        Penetrations of the fit (n,), and their standard errors by those of the parameters alone: a measured point scatters by
        its own deviation besides. Of unloading those of the power laws, with errors of NaN.
    unloading
        ``None`` of loading. Of unloading ``unloading.tests``, each with ``force``, ``penetration``, ``stiffness``,
        ``contact_radius``, ``epsilon``, ``hardness``, ``bare_modulus`` and their errors, as ``identification.json`` has them.
    case
        The case with the values found, to be looked at and solved.
    summary
        All scalars, as ``identification.json`` has them; each is an attribute as well: ``title``, ``parameters``, ``points``,
        ``degrees_of_freedom``, ``rms_residual``, ``reduced_chi_square``, ``model_error``, ``contact_radii``, ``steps``, ….
    warnings
        What a reader should know before trusting the numbers.
    """

    title: str
    parameters: List[Record]
    points: int
    degrees_of_freedom: int
    rms_residual: float
    reduced_chi_square: Optional[float]
    model_error: Optional[float]
    contact_radii: List[float]
    curves: List[Record]
    unloading: Optional[Record]
    steps: int
    units: Record

    def __init__(
        self, summary: dict[str, Any], arrays: dict[str, Optional[Array]], text: str, warnings: list[str]
    ) -> None:
        self.summary = Record(summary)
        self.values = {parameter.name: float(parameter.value) for parameter in self.summary.parameters}
        self.errors = {parameter.name: float(parameter.standard_error) for parameter in self.summary.parameters}
        self.intervals: dict[str, Tuple[float, float]] = {
            parameter.name: (parameter.interval_95[0], parameter.interval_95[1])
            for parameter in self.summary.parameters
        }
        self.sensitivities: dict[str, dict[str, float]] = {
            sensitivity.name: dict(zip(self.values, map(float, sensitivity.derivatives)))
            for sensitivity in self.summary.sensitivities
        }
        self.correlation: Array = np.array(self.summary.correlation, dtype=float)
        self.force, self.penetration = _known(arrays["force"]), _known(arrays["penetration"])
        self.penetration_error = arrays["penetration_error"]
        self.fitted, self.fitted_error = _known(arrays["fitted"]), _known(arrays["fitted_error"])
        self.curve: NDArray[np.int64] = _known(arrays["curve"]).astype(np.int64)
        self.warnings = warnings
        self._arrays, self._text = arrays, text

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or name == "summary":
            raise AttributeError(name)
        return getattr(self.summary, name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.summary]

    @property
    def case(self) -> dict[str, Any]:
        """The case with the values found, complete with its defaults."""
        as_run: dict[str, Any] = self.summary.case.to_dict()
        return as_run

    def to_dict(self) -> dict[str, Any]:
        """All scalars as plain dicts and lists, as ``identification.json`` has them."""
        return self.summary.to_dict()

    def __str__(self) -> str:
        return self._text.rstrip()

    def __repr__(self) -> str:
        values = (f"{name} = {value:.5g} ± {self.errors[name]:.2g}" for name, value in self.values.items())
        return f"<percoat.Identification {self.title!r}: {', '.join(values)}>"

    def __reduce__(self) -> tuple[Any, ...]:
        return Identification, (self.to_dict(), self._arrays, self._text, self.warnings)


def _known(array: Optional[Array]) -> Array:
    assert array is not None, "every curve has it"
    return array


def _curves(data: Any) -> list[Any]:
    """Each of the curves: a list of what is a curve by itself, a path, named columns or arrays, is several."""

    def is_curve(one: Any) -> bool:
        if isinstance(one, (str, os.PathLike)) or hasattr(one, "keys"):
            return True
        if isinstance(one, np.ndarray):
            return one.dtype.names is not None or one.ndim == 2
        return isinstance(one, (tuple, list)) and len(one) > 0 and np.ndim(one[0]) > 0

    several = isinstance(data, (tuple, list)) and len(data) > 0 and all(is_curve(one) for one in data)
    return [_columns(one) for one in data] if several else [_columns(data)]


def _columns(data: Any) -> Any:
    """A path as it is; of anything else the columns of a curve, each a name with an array."""
    if isinstance(data, (str, os.PathLike)):
        return data
    if isinstance(data, np.ndarray) and data.dtype.names is None:
        if data.ndim != 2 or data.shape[1] not in (2, 3):
            raise _core.CaseError(
                f"an array of a curve has a row a point, with two or three columns {', '.join(NAMES)}, not {data.shape}"
            )
        data = tuple(data.T)
    names: Any = data.dtype.names if isinstance(data, np.ndarray) else getattr(data, "keys", lambda: None)()
    if names is None:
        if not isinstance(data, (tuple, list)) or len(data) not in (2, 3):
            raise TypeError(
                "a curve is the path of a table, a table with columns force and penetration, or (force, penetration)"
            )
        names, data = NAMES[: len(data)], dict(zip(NAMES, data))
    columns = []
    for name in names:
        # Columns of times or words are no columns of a curve.
        is_named = str(name).startswith(NAMES[:2])
        try:
            column = np.asarray(data[name], dtype=float)
        except (TypeError, ValueError):
            if is_named:
                raise
            continue
        if column.ndim == 1:
            columns.append((str(name), column))
        elif is_named:
            raise _core.CaseError(f"{name} of a curve has a number for each point, not the shape {column.shape}")
    return columns


def identify(
    case: CaseLike,
    data: Curves,
    free: Union[str, Sequence[str]],
    *,
    known: Optional[Mapping[str, float]] = None,
    segment: Optional[str] = None,
    part: Optional[Tuple[float, float]] = None,
    set: Settings = None,
    threads: Optional[int] = None,
    progress: Listener = None,
) -> Identification:
    """Find numbers of a case of one isolated indenter that fit measured indentation curves best.

    Parameters
    ----------
    case
        As for :func:`percoat.solve`; its values are those from which the search begins.
    data
        The curve: the path of a table; a dict, a :class:`pandas.DataFrame` or a structured array with the columns ``force``
        and ``penetration``, in the units of the case or with their own as in ``force_mN``, and ``penetration_error`` where
        the standard deviations of the points are known; ``(force, penetration)`` or ``(force, penetration,
        penetration_error)``; or an array with these columns. Tables are read as instruments export them. A list of such curves
        is fitted together. Elastic contact: loading without plastic depth, or ``segment="unloading"``.
    free
        What is to be found: keys of the case, ``["layers.0.young", "substrate.young"]``; ``"offset"``, a zero of the
        penetration that was missed, of each loading curve; ``"frame_compliance"``, that of the frame, a length per force.
    known
        What the instrument is known to add to the penetration, in the units of the case: ``{"offset": 0.002}``, a zero that was
        missed, and ``"frame_compliance"``, that of the frame. What is free as well begins from there. ``"beta"``: the factor of the
        stiffness of unloading of tips that are not round, 1 where it is not said, 1.034 of a triangle by King.
    segment
        ``"loading"`` takes the points up to nearly the largest force, without hold and unloading; ``None`` all of them, which
        have to be loading. Points before contact are left out. ``"unloading"`` takes the stiffness at the largest force, by Oliver and Pharr's method on
        the layered body. ``"retraction"`` takes the curve of drawing off surfaces that adhere, from the largest penetration to the
        least force; ``fitted`` and ``fitted_error`` are then forces.
    part
        Parts of the largest force between which unloading is fitted, (0.25, 0.95) where it is not said.
    set, threads, progress
        As for :func:`percoat.solve`.

    Returns
    -------
    Identification

    Raises
    ------
    CaseError
        The case or the curve is refused, the search does not converge, or the curve does not determine what is free.

    Examples
    --------
    >>> import numpy as np, percoat
    >>> case = {
    ...     "lattice": {"kind": "isolated", "size": 4.0},
    ...     "levels": [{"shape": "paraboloid", "radius": 10.0}],
    ...     "substrate": {"young": 100.0, "poisson": 0.3},
    ...     "load": {"force": 1.0},
    ...     "grid": {"points": 48},
    ... }
    >>> penetration = np.linspace(0.01, 0.1, 10)
    >>> force = 4 / 3 * 70 / (1 - 0.3**2) * np.sqrt(10.0) * penetration**1.5  # Hertz
    >>> found = percoat.identify(case, (force, penetration), ["substrate.young"])
    >>> round(found.values["substrate.young"]), found.fitted.shape
    (70, (10,))
    """
    names = [free] if isinstance(free, str) else list(free)
    width = shutil.get_terminal_size().columns
    stated = [f"{name}={float(value)!r}" for name, value in (known or {}).items()]
    asked = (names, stated, segment, None if part is None else [float(bound) for bound in part])
    found = _core.identify(_core.Case(case, set), _curves(data), asked, width, threads, listener(progress))
    identification = Identification(*found)
    warn(identification.warnings)
    return identification
