"""Results in folders of the command line: nothing of a user is lost, and the command line goes on with them."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import percoat
from conftest import Program, wave


def test_a_folder_with_a_file_of_somebody_else_is_refused(three_levels: percoat.Result, tmp_path: Path) -> None:
    own = tmp_path / "curve.csv"
    own.write_text("mine", "utf-8")
    with pytest.raises(percoat.CaseError, match="curve.csv .*choose another folder, or move it away"):
        three_levels.save(tmp_path)
    assert own.read_text("utf-8") == "mine"
    # Beside other names it is written, and replaced by a later one.
    own.rename(tmp_path / "mine.csv")
    three_levels.save(tmp_path)
    percoat.solve("fig2", set={"grid.points": 48}).save(str(tmp_path))
    assert json.loads((tmp_path / "summary.json").read_text("utf-8"))["steps"][0]["points"] == [48, 48]
    assert (tmp_path / "mine.csv").exists()


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="who is root may write anywhere")
def test_a_folder_that_cannot_be_written_is_an_error_of_the_system(
    three_levels: percoat.Result, tmp_path: Path
) -> None:
    tmp_path.chmod(0o500)
    with pytest.raises(PermissionError):
        three_levels.save(tmp_path / "out")


def test_a_file_in_the_place_of_a_folder_is_an_error_of_the_system(
    three_levels: percoat.Result, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("mine", "utf-8")
    with pytest.raises(OSError):
        three_levels.save(tmp_path / "file" / "out")
    assert (tmp_path / "file").read_text("utf-8") == "mine"


def test_heights_of_an_array_are_saved_and_solved_again(
    flat_wave: percoat.Result, tmp_path: Path, program: Program
) -> None:
    flat_wave.save(tmp_path / "out")
    assert np.array_equal(np.load(tmp_path / "out" / "heights.npy"), wave()["surface"]["heights"])
    again = percoat.solve(tmp_path / "out" / "case.toml")
    for own, other in zip(again, flat_wave):
        assert own.pressure.tobytes() == other.pressure.tobytes()
    program("report", tmp_path / "out")
    assert "A wave pressed flat" in (tmp_path / "out" / "report.html").read_text("utf-8")


def test_a_saved_sweep_is_the_folder_of_the_command_line(tmp_path: Path, program: Program) -> None:
    typed = ["--set", "grid.points=32", "--set", "layers.0.thickness=0.1,0.4", "--no-pictures"]
    program("sweep", "fig2", *typed, "-o", tmp_path / "theirs")
    # Texts are values as they are typed.
    table = percoat.sweep("fig2", {"grid.points": "32", "layers.0.thickness": "0.1,0.4"})
    table["own"] = np.zeros(2)
    table.save(tmp_path / "ours")
    ours, theirs = tmp_path / "ours", tmp_path / "theirs"
    names = {path.name for path in theirs.iterdir() if path.is_file()}
    assert {path.name for path in ours.iterdir() if path.is_file()} == names
    assert (ours / "sweep.csv").read_bytes() == (theirs / "sweep.csv").read_bytes()

    def timeless(folder: Path) -> Any:
        description = json.loads((folder / "sweep.json").read_text("utf-8"))
        return {**description, "timing": None}

    assert timeless(ours) == timeless(theirs)
    # The command line goes on with it, and with nothing to solve.
    before = (ours / "sweep.csv").read_bytes()
    told = program("sweep", "fig2", *typed, "--resume", "-o", ours).stderr
    assert "2 of 2 combinations are done already" in told and (ours / "sweep.csv").read_bytes() == before
    program("report", ours)
    with pytest.raises(TypeError, match="not those that a sweep returned"):
        percoat.Columns(table).save(tmp_path / "other")
