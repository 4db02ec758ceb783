"""Lives: passes until something fails, and what is left after that."""

from __future__ import annotations

from typing import Optional

from percoat import _core
from percoat._case import CaseLike, Settings
from percoat._limit import FirstFailure
from percoat._record import Record
from percoat._solve import Listener, listener
from percoat._warnings import warn_of


class Life(FirstFailure):
    """A life, as ``life.json`` has it. It prints the text of the command line.

    ``first`` is the first event of any kind, ``None`` where nothing tires and nothing is worn through: with ``kind`` (``"fatigue"``,
    ``"delamination"``, ``"worn_through"``), ``material`` or ``interface``, ``passes``, the ``distance`` slid by then and a relative
    ``error``, of fatigue ``range`` of the shear stress and ``x``, ``y``, ``z``; ``criteria`` has all lives. With ``life.passes`` in the case
    ``events`` have what comes off, each with ``passes``, ``what``, ``depth``, ``thickness`` and ``removed``, and ``wear`` the course. A pass of
    a contact that sticks and slips (``tangential``) is its closed cycle; cracks begin, and nothing comes off.
    ``title`` and ``warnings`` are as in ``life.json``; ``converged`` says whether every contact was solved.
    """

    criteria: list[Record]
    events: list[Record]
    wear: list[Record]
    distance: Optional[float]

    _shown = _core.life_text, _core.life_tables

    def __repr__(self) -> str:
        if self.first is None:
            return f"<percoat.Life {self.title!r}: nothing fails>"
        return f"<percoat.Life {self.title!r}: {self.first.passes:.4g} passes, {len(self.events)} events>"


def life(
    case: CaseLike, *, set: Settings = None, threads: Optional[int] = None, progress: Listener = None
) -> Life:
    """Passes until damage first reaches 1, where, and of what; with ``life.passes`` what happens up to there.

    Parameters are those of :func:`percoat.solve`; the case needs ``fatigue``, ``interface_fatigue``, or ``wear`` with ``life.passes``,
    and one load. ``progress`` is called at the beginning and with every load that is solved. Ctrl-C raises at once; the work ends within the
    load that is being solved.

    Examples
    --------
    >>> import percoat
    >>> life = percoat.life("tin-fatigue", set={"grid.points": 64, "life.passes": 1e6})  # coarse
    >>> life.first.passes > 0, len(life.criteria)
    (True, 3)
    """
    checked = _core.Case(case, set)
    found, converged = _core.life(checked, threads, listener(progress))
    followed = Life({**found, "converged": converged}, checked)
    warn_of(followed, "a contact or the accuracy did not converge")
    return followed
