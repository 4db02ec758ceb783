"""Quantities of a load step: their kinds, where their errors stand, and the names of their units."""

from __future__ import annotations

from typing import Optional

from percoat import _core

QUANTITIES = {key: (kind, error) for key, _, kind, error in _core.quantities()}
"""Kind of each quantity of a step, and the key of its error; keys have dots where they lead deeper."""


def unit_name(kind: Optional[str], length: Optional[str], pressure: Optional[str]) -> Optional[str]:
    """Name of the unit of a kind of quantity, from those of lengths and pressures; ``None`` where it has none."""
    if kind == "pressure":
        return pressure
    if kind in ("length", "area", "volume"):
        return length and length + {"length": "", "area": "²", "volume": "³"}[kind]
    of_both = {"force": " {}²", "energy": " {}³", "force per length": " {}", "pressure per length": "/{}"}
    return pressure + of_both[kind].format(length) if kind in of_both and length and pressure else None
