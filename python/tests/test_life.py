"""Lives from Python: those of the command line."""

from __future__ import annotations

import json
import pickle
from pathlib import Path

import pytest

import percoat
from conftest import Program

COARSE = {"grid.points": 48, "life.passes": 1e6}


def test_a_life_is_that_of_the_command_line(tmp_path: Path, program: Program) -> None:
    life = percoat.life("tin-fatigue", set=COARSE)
    settings = [word for key, value in COARSE.items() for word in ("--set", f"{key}={value}")]
    program("life", "tin-fatigue", "-o", tmp_path / "out", "--no-pictures", "-q", *settings)
    written = json.loads((tmp_path / "out" / "life.json").read_text())
    for key in ("first", "criteria", "events", "wear", "distance", "end", "solved"):
        assert life.to_dict()[key] == written[key], key
    assert life.first.interface == 1 and life.events[0].what == "delamination"
    assert "first damage at" in str(life) and "passes" in repr(life)
    assert pickle.loads(pickle.dumps(life)).first == life.first


def test_progress_hears_of_every_load_and_may_end_the_life() -> None:
    heard: list[percoat.Progress] = []
    life = percoat.life("tin-fatigue", set=COARSE, progress=heard.append)
    first, *loads = heard
    assert first.done == 0 and first.points is None
    assert [progress.done for progress in loads] == list(range(1, life["solved"] + 1)) and len(loads) > 1
    assert {progress.unit for progress in loads} == {"load"} and {progress.points for progress in loads} == {(48, 48)}
    assert f"{len(life.events)} events" in loads[-1].phase and "passes" in str(loads[-1])

    class Enough(Exception):
        pass

    told: list[int] = []

    def listen(progress: percoat.Progress) -> None:
        told.append(progress.done)
        if progress.done == 2:
            raise Enough

    with pytest.raises(Enough):
        percoat.life("running-in", set={"grid.points": 32}, progress=listen)
    assert told == [0, 1, 2]


def test_what_follows_without_a_solution_has_not_converged() -> None:
    settings = {**COARSE, "solver.max_iterations": 1}
    with pytest.warns(percoat.NotConverged, match="a contact or the accuracy did not converge"):
        life = percoat.life("tin-fatigue", set=settings)
    assert not life.converged


def test_a_case_that_lasts_for_ever_is_refused() -> None:
    with pytest.raises(percoat.CaseError, match="neither a fatigue law nor wear is given"):
        percoat.life("fig2")
