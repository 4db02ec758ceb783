"""Limit loads, and what they share with lives: the first failure of a case."""

from __future__ import annotations

import shutil
from typing import Any, Callable, ClassVar, Optional, Sequence, Tuple, Union

from percoat import _core, _html
from percoat._case import CaseLike, Settings
from percoat._record import Record
from percoat._solve import Listener, listener
from percoat._warnings import warn_of


def criterion_name(entry: Record) -> str:
    """What fails, as the command line prints it: "yield of TiN", or "yield of material 2" where the case gives no name."""
    number = f"material {entry.material}" if "material" in entry else f"interface {entry.interface}"
    return f"{entry.criterion} of {entry.get('name', number)}"


class FirstFailure(Record):
    """The first failure of a case, as ``limit.json`` or ``life.json`` has it. It prints what the command line prints."""

    title: str
    first: Optional[Record]
    warnings: list[str]
    converged: bool

    _shown: ClassVar[Tuple[Callable[..., str], Callable[..., Sequence[_html.Table]]]]
    """Functions that write its text and its tables."""

    def __init__(self, entries: Any, case: Optional[_core.Case] = None) -> None:
        super().__init__(entries)
        self.__dict__["_case"] = case

    def __str__(self) -> str:
        width = shutil.get_terminal_size().columns
        return self._shown[0](self.__dict__["_case"], self.to_dict(), width).rstrip()

    def _repr_html_(self) -> str:
        return _html.page(self.title, self._shown[1](self.__dict__["_case"], self.to_dict()))

    def __reduce__(self) -> tuple[Any, ...]:
        return type(self), (dict(self), self.__dict__["_case"])


class Limits(FirstFailure):
    """Limit loads, as ``limit.json`` has them. They print the table of the command line.

    ``first`` is the one that is reached first, ``None`` where nothing fails; ``limits`` has all of them, each with
    ``criterion``, ``material`` or ``interface``, ``mean_pressure`` (where the case gives forces, and of an isolated
    contact, ``force``) and its ``error``, ``x``, ``y``, ``z``. ``window`` has the sides of the largest window in which loads were
    solved where an isolated contact outgrew its own, else ``None``; ``steps`` have ``stress`` at the first limits only. ``title``
    and ``warnings`` are as in ``limit.json``; ``converged`` says whether every load was solved.
    """

    limits: list[Record]
    steps: list[Record]
    window: Optional[list[float]]

    _shown = _core.limit_text, _core.limit_tables

    def __repr__(self) -> str:
        if self.first is None:
            return f"<percoat.Limits {self.title!r}: nothing fails>"
        of, load = ("force", self.first.force) if "force" in self.first else ("mean pressure", self.first.mean_pressure)
        return f"<percoat.Limits {self.title!r}: {criterion_name(self.first)} at {of} {load}>"


def limit(
    case: CaseLike,
    *,
    up_to: Union[float, str, None] = None,
    set: Settings = None,
    threads: Optional[int] = None,
    progress: Listener = None,
) -> Limits:
    """The mean pressure or force at which something first fails, and what: each criterion's own limit load too.

    Parameters
    ----------
    case, set, threads, progress
        As of :func:`percoat.solve`; the case needs strengths.
    up_to : float or str, optional
        The load up to which limits are searched, a number in the units of the case or a text such as ``"20 N"``.

    Examples
    --------
    >>> import percoat
    >>> limits = percoat.limit("dlc-on-steel", set={"grid.points": 64})  # coarse, and it warns
    >>> limits.first.criterion, limits.first.material, len(limits.limits)
    ('yield', 2, 6)
    """
    checked = _core.Case(case, set)
    found, converged = _core.limit(checked, None if up_to is None else str(up_to), threads, listener(progress))
    limits = Limits({**found, "converged": converged}, checked)
    warn_of(limits, "a load or the accuracy did not converge")
    return limits
