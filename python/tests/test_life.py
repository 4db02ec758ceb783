"""Lives from Python: those of the command line."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import percoat
import pytest

COARSE = {"grid.points": 48, "life.passes": 1e6}


def test_a_life_is_that_of_the_command_line(tmp_path: Path) -> None:
    life = percoat.life("tin-fatigue", set=COARSE)
    typed = ["life", "tin-fatigue", "-o", str(tmp_path / "out"), "--no-pictures", "-q"]
    typed += [word for key, value in COARSE.items() for word in ("--set", f"{key}={value}")]
    assert percoat._core.main(typed) == 0
    written = json.loads((tmp_path / "out" / "life.json").read_text())
    for key in ("first", "criteria", "events", "wear", "distance", "end", "solved"):
        assert life.to_dict()[key] == written[key], key
    assert life.first.interface == 1 and life.events[0].what == "delamination"
    assert "first damage at" in str(life) and "passes" in repr(life)
    assert pickle.loads(pickle.dumps(life)).first == life.first


def test_a_case_that_lasts_for_ever_is_refused() -> None:
    with pytest.raises(percoat.CaseError, match="nothing tires or wears"):
        percoat.life("fig2")
