"""Sweeps: a case, solved for many settings of its keys."""

from __future__ import annotations

import re
from typing import Any, Dict, Iterable, Mapping, Optional

import numpy as np
from numpy.typing import NDArray

from percoat import _core
from percoat._case import CaseLike
from percoat._solve import Listener, listener
from percoat._warnings import NotConverged, warn


TEXTS = ("status", "reason", "warnings", "route", "criterion", "reached", "state", "rivals", "name")
"""How the columns of texts end; what they do not have is an empty one."""


class Columns(Dict[str, NDArray[Any]]):
    """The table of a sweep: arrays of equal length under their names, ready for ``pandas.DataFrame(columns)``."""

    @property
    def rows(self) -> int:
        """How many rows it has."""
        return len(next(iter(self.values()), ()))

    def __repr__(self) -> str:
        return f"<percoat.Columns: {self.rows} rows of {', '.join(list(self)[:8])}{', …' if len(self) > 8 else ''}>"


def sweep(
    case: CaseLike,
    set: Mapping[str, Any],
    *,
    zip: bool = False,
    limit: bool = False,
    threads: Optional[int] = None,
    progress: Listener = None,
) -> Columns:
    """Solve a case for every combination of values.

    Parameters
    ----------
    case
        As for :func:`percoat.solve`.
    set
        Keys and their values: ``{"layers.0.thickness": [0.1, 0.2], "friction.coefficient": np.linspace(0, 0.5, 6)}``; a
        value that is no list holds for all, and ``"0.1:1:5:log"`` gives five geometric ones, as on the command line.
    zip
        Pair the values of the keys, instead of all their combinations.
    limit
        Look for the limit loads of each combination instead of solving its load steps.
    threads, progress
        As for :func:`percoat.solve`.

    Returns
    -------
    Columns
        One row a combination and load step: ``combination``, ``set_<key>`` of what was set, ``status``, ``step``, and the
        scalars of ``curve.csv``. Numbers that are not there are NaN, truths ``None``; whole numbers of which one is not
        there are floats.

    Warns
    -----
    NotConverged
        Of each combination that did not; of one that failed, and of doubts, a :class:`percoat.PercoatWarning`.

    Examples
    --------
    >>> import percoat
    >>> table = percoat.sweep("fig2", {"layers.0.thickness": [0.2, 0.5], "grid.points": 96})
    >>> table["set_layers_0_thickness"], table["status"].tolist()
    (array([0.2, 0.5]), ['done', 'done'])
    """
    if not isinstance(set, Mapping):
        raise TypeError("what is swept over is a dict of keys and their values, {'layers.0.thickness': [0.1, 0.2]}")
    columns, told = _core.sweep(case, dict(set), zip, limit, threads, listener(progress))
    warn(_merged(told))
    warn((f"{name}: failed: {reason}" for name, status, reason, _ in told if status == "failed"))
    unsettled = (f"{name}: not converged: {reason}" for name, status, reason, _ in told if status == "not_converged")
    warn(unsettled, NotConverged)
    return Columns({name: _column(name, cells) for name, cells in columns})


def _merged(told: list[tuple[str, str, str, list[str]]]) -> Iterable[str]:
    """Each doubt once, whatever its numbers, with the number of combinations that have it."""
    found: dict[str, tuple[str, list[str]]] = {}
    for name, _, _, doubts in told:
        for doubt in doubts:
            _, names = found.setdefault(re.sub(r"[\s0-9.,e+-]+", " ", doubt), (doubt, []))
            if name not in names:
                names.append(name)
    for doubt, names in found.values():
        others = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
        yield f"{names[0]}{others}: {doubt}"


def _column(name: str, cells: list[Any]) -> NDArray[Any]:
    """Cells as whole numbers, numbers, truths, or texts, whatever all of them are."""
    if name.startswith("set_"):
        numbers = [_number(cell) for cell in cells]
        cells = cells if any(isinstance(own, str) for own in numbers) else numbers
    there = [cell for cell in cells if cell is not None]
    if name.endswith(TEXTS) or any(isinstance(cell, str) for cell in there):
        return np.array(["" if cell is None else str(cell) for cell in cells], dtype=object)
    if there and all(isinstance(cell, bool) for cell in there):
        return np.array(cells, dtype=bool if len(there) == len(cells) else object)
    if len(there) == len(cells) and all(isinstance(cell, int) for cell in there):
        return np.array(cells)
    return np.array([np.nan if cell is None else cell for cell in cells], dtype=float)


def _number(text: str) -> Any:
    """A value as it was typed: a truth or a number where it is one."""
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text
