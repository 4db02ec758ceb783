"""Contact of coated bodies.

Which pressures, contact spots, penetrations and internal stresses arise when a ball, asperities at several heights or a rough
surface, rigid or elastic, is pressed into a coated elastic half-space, and at which load or after how many passes something fails.

>>> import percoat
>>> result = percoat.solve("fig2", set={"grid.points": 96})
>>> result.steps[0].pressure.shape
(96, 96)

A case is a path, the name of an embedded case (:func:`cases`), or a dict of the same shape as the file
(:func:`case` gives one, :func:`explain` says what its keys are). Units are those of the case, any consistent ones; z
points into the body, pressures are positive, stresses positive in tension.
"""

from __future__ import annotations

from percoat._case import Check, case, cases, check, explain, materials, schema
from percoat._compare import Comparison, compare
from percoat._core import CaseError, Progress, __version__
from percoat._half_space import HalfSpace, kernel
from percoat._identify import Identification, identify
from percoat._life import Life, life
from percoat._limit import Limits, limit
from percoat._record import Record
from percoat._solve import COMPONENTS, STRAINS, Plane, Result, Section, Step, solve
from percoat._stress import mises, principal, s1, tau1
from percoat._sweep import Columns, sweep
from percoat._warnings import NotConverged, PercoatWarning

__all__ = [
    "COMPONENTS",
    "CaseError",
    "Check",
    "Columns",
    "Comparison",
    "HalfSpace",
    "Identification",
    "Limits",
    "NotConverged",
    "PercoatWarning",
    "Plane",
    "Progress",
    "Record",
    "Result",
    "STRAINS",
    "Section",
    "Step",
    "__version__",
    "case",
    "cases",
    "check",
    "compare",
    "explain",
    "identify",
    "kernel",
    "life",
    "limit",
    "materials",
    "mises",
    "principal",
    "s1",
    "schema",
    "solve",
    "sweep",
    "tau1",
]
