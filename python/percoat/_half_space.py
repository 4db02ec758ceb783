"""The layered half-space alone."""

from __future__ import annotations

from os import PathLike, fspath
from typing import Any, Mapping, Optional, Sequence, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from percoat import _core
from percoat._case import CaseLike, Settings
from percoat._record import Record


class HalfSpace:
    """Layers on a substrate, for who needs the transfer function alone.

    Parameters
    ----------
    layers
        Dicts with the keys of ``[[layers]]``, from the surface down; none: uncoated.
    substrate
        A dict with the keys of ``[substrate]``.
    units
        A dict with the keys of ``[units]``: where a ``material`` is given, ``{"pressure": "GPa"}`` or another unit.
    materials
        A file of one's own materials.

    Examples
    --------
    >>> import percoat
    >>> coated = percoat.HalfSpace(
    ...     layers=[{"thickness": 0.5, "shear_ratio": 2.0, "poisson": 0.2}],
    ...     substrate={"young": 1.0, "poisson": 0.3},
    ... )
    >>> float(coated.compliance(2.0))  # doctest: +ELLIPSIS
    0.7338...
    >>> coated.compliance([1.0, 2.0, 4.0]).shape
    (3,)
    """

    def __init__(
        self,
        layers: Sequence[Mapping[str, Any]] = (),
        substrate: Optional[Mapping[str, Any]] = None,
        *,
        units: Optional[Mapping[str, Any]] = None,
        materials: Union[None, str, PathLike[str]] = None,
    ) -> None:
        sections: dict[str, Any] = {"layers": list(layers)} if len(layers) > 0 else {}
        if substrate is not None:
            sections["substrate"] = substrate
        if units is not None:
            sections["units"] = units
        if materials is not None:
            sections["materials"] = fspath(materials)
        self._core = _core.HalfSpace(sections)

    @classmethod
    def of(cls, case: CaseLike, *, set: Settings = None) -> HalfSpace:
        """The half-space of a case.

        >>> import percoat
        >>> float(percoat.HalfSpace.of("fig2").correction(1e3))  # short waves feel the coating alone
        1.0
        """
        half_space = cls.__new__(cls)
        half_space._core = _core.HalfSpace(_core.Case(case, set))
        return half_space

    def compliance(self, wavenumber: ArrayLike) -> Any:
        """ŵ/p̂: displacement of the surface over a harmonic pressure, a length over a pressure.

        ``wavenumber`` q > 0 is angular, 1/length, of any shape; the result has the same.
        """
        return self._of(wavenumber, self._core.compliance)

    def correction(self, wavenumber: ArrayLike) -> Any:
        """T(q): the compliance over that of a half-space of the surface's material, 2/(E* q); T → 1 for short waves."""
        return self._of(wavenumber, self._core.correction)

    def kernel(
        self, wavenumber: ArrayLike, depth: Optional[ArrayLike] = None, traction: str = "normal"
    ) -> Record:
        """Response to a harmonic traction, see :func:`percoat.kernel`."""
        q = np.asarray(wavenumber, dtype=float)
        depths = [] if depth is None else np.atleast_1d(np.asarray(depth, dtype=float)).ravel().tolist()
        lines = self._core.kernel(q.ravel(), depths, traction)

        def column(name: str) -> Any:
            return _shaped(np.array([line[name] for line in lines], dtype=float), q.shape)

        names = ["wavenumber", "compliance", "correction"] + ([] if traction == "across" else ["coupling"])
        record = Record({name: column(name) for name in names})
        if depths:
            rows = self._core.kernel(np.ones(1), depths, traction)[0]["depths"]
            record["z"] = np.array([row["z"] for row in rows])
            record["side"] = np.array([row["side"] for row in rows])
            for name in rows[0]:
                if name not in ("z", "side"):
                    values = np.array([[row[name] for row in line["depths"]] for line in lines], dtype=float)
                    record[name] = values.reshape(*q.shape, len(rows))
        return record

    def _of(self, wavenumber: ArrayLike, values: Any) -> Any:
        q = np.asarray(wavenumber, dtype=float)
        return _shaped(values(np.ascontiguousarray(q.ravel())), q.shape)

    def __str__(self) -> str:
        return str(self._core)

    def __repr__(self) -> str:
        return f"<percoat.HalfSpace: {str(self).splitlines()[0]}>"


def _shaped(values: NDArray[np.float64], shape: tuple[int, ...]) -> Any:
    return values.reshape(shape)[()]


def kernel(
    case: CaseLike,
    wavenumber: ArrayLike,
    depth: Optional[ArrayLike] = None,
    traction: str = "normal",
    *,
    set: Settings = None,
) -> Record:
    """The layered half-space's response to a harmonic traction.

    Parameters
    ----------
    case
        A path, the name of an embedded case, or a dict of the same shape as the TOML.
    wavenumber
        q > 0, angular, 1/length; any shape.
    depth
        z ≥ 0, lengths; one on an interface gives both sides.
    traction
        ``"normal"`` for the pressure cos(qx), ``"along"`` or ``"across"`` for a shear traction along or across the
        wavevector.

    Returns
    -------
    Record
        ``wavenumber``, ``compliance`` (length/pressure), ``correction`` (T) and, but for ``"across"``, ``coupling``, of
        the shape of ``wavenumber``. With depths ``z`` and ``side`` (1-based material), one a row, and amplitudes of that
        shape and a last axis of rows: ``szz``, ``sqz``, ``sqq``, ``stt``, ``uz``, ``uq``; under ``"across"`` ``stz``,
        ``sqt``, ``ut``.

    Examples
    --------
    >>> import percoat
    >>> response = percoat.kernel("fig2", [1.0, 10.0], depth=[0.0, 0.5])
    >>> response.compliance.shape, response.szz.shape  # the interface has two sides
    ((2,), (2, 3))
    >>> response.szz[:, 0]
    array([-1., -1.])
    """
    return HalfSpace.of(case, set=set).kernel(wavenumber, depth, traction)
