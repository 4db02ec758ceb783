"""Both methods side by side."""

from __future__ import annotations

import shutil
from typing import Any, Optional, Sequence

from percoat import _core, _html
from percoat._case import CaseLike, Settings
from percoat._record import Record
from percoat._solve import Listener, listener
from percoat._warnings import warn_of


class Comparison(Record):
    """The spectral and the localized solution of the last load, as ``compare.json`` has them.

    ``spectral`` is a step; ``localized`` has an entry a circle, with ``indenters``, ``radius``, ``penetration``,
    ``levels`` and the largest relative ``difference``.
    """

    title: str
    spectral: Record
    localized: list[Record]
    text: str
    warnings: list[str]
    converged: bool

    def __init__(self, entries: Any, tables: Sequence[_html.Table] = ()) -> None:
        super().__init__(entries)
        self.__dict__["_tables"] = tables

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return _html.page(self.title, self.__dict__["_tables"])

    def __reduce__(self) -> tuple[Any, ...]:
        return Comparison, (dict(self), self.__dict__["_tables"])

    def __repr__(self) -> str:
        return f"<percoat.Comparison {self.title!r}: circles of {[solution.indenters for solution in self.localized]}>"


def compare(
    case: CaseLike, *, set: Settings = None, threads: Optional[int] = None, progress: Listener = None
) -> Comparison:
    """The spectral solution and the paper's localized boundary elements side by side, under the last load of a case.

    Parameters are those of :func:`percoat.solve`; the case needs levels of indenters.

    Examples
    --------
    >>> import percoat
    >>> both = percoat.compare("fig2", set={"grid.points": 96, "localized.indenters": [13]})
    >>> both.localized[0].difference.penetration < 0.03
    True
    """
    width = shutil.get_terminal_size().columns
    found, text, tables, warnings, converged = _core.compare(_core.Case(case, set), width, threads, listener(progress))
    comparison = Comparison({**found, "text": text.rstrip(), "warnings": warnings, "converged": converged}, tables)
    warn_of(comparison, "a solution or the accuracy did not converge")
    return comparison
