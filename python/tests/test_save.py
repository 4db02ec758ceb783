"""Results in folders of the command line: nothing of a user is lost, and the command line goes on with them."""

from __future__ import annotations

import json
import os
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import percoat
from conftest import Program, wave


def test_a_folder_with_a_file_of_somebody_else_is_refused(three_levels: percoat.Result, tmp_path: Path) -> None:
    file = tmp_path / "curve.csv"
    file.write_text("mine", "utf-8")
    with pytest.raises(percoat.CaseError, match="curve.csv .*choose another folder, or move it away"):
        three_levels.save(tmp_path)
    assert file.read_text("utf-8") == "mine"
    # Beside other names it is written, and replaced by a later one.
    file.rename(tmp_path / "mine.csv")
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
    for step, other in zip(again, flat_wave):
        assert step.pressure.tobytes() == other.pressure.tobytes()
    program("report", tmp_path / "out")
    assert "A wave pressed flat" in (tmp_path / "out" / "report.html").read_text("utf-8")


@pytest.mark.parametrize("file", ["h.npy", "h.CSV"])
def test_heights_of_a_file_that_is_gone_are_saved_and_solved_again(tmp_path: Path, file: str) -> None:
    case, heights = wave(), tmp_path / file
    if file == "h.npy":
        np.save(heights, case["surface"]["heights"])
    else:
        np.savetxt(heights, case["surface"]["heights"], delimiter=",")
    case["surface"]["heights"] = str(heights)
    result = percoat.solve(case)
    kept, bytes = pickle.dumps(result), heights.read_bytes()
    heights.unlink()
    again, name = pickle.loads(kept), f"heights{heights.suffix}"
    again.save(tmp_path / "out")
    assert (tmp_path / "out" / name).read_bytes() == bytes
    solved = percoat.solve(tmp_path / "out" / "case.toml")
    assert [step.pressure.tobytes() for step in solved] == [step.pressure.tobytes() for step in result]
    # A user's file of that name is kept.
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / name).write_text("mine", "utf-8")
    with pytest.raises(percoat.CaseError, match=name):
        again.save(tmp_path / "other")
    assert (tmp_path / "other" / name).read_text("utf-8") == "mine"


def test_pressures_of_a_file_that_is_gone_are_saved_and_solved_again(tmp_path: Path) -> None:
    np.save(tmp_path / "p.npy", np.where(np.arange(1024).reshape(32, 32) % 32 < 8, 0.01, 0.0))
    case = {
        "lattice": {"kind": "square", "period": 1.0},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"pressure": str(tmp_path / "p.npy")},
        "grid": {"points": 32},
    }
    result = percoat.solve(case)
    kept = pickle.dumps(result)
    (tmp_path / "p.npy").unlink()
    again = pickle.loads(kept)
    assert again[0].pressure.tobytes() == result[0].pressure.tobytes()
    again.save(tmp_path / "out")
    solved = percoat.solve(tmp_path / "out" / "case.toml")
    assert solved[0].pressure.tobytes() == result[0].pressure.tobytes()


def test_a_saved_sweep_has_the_case_that_was_solved(tmp_path: Path) -> None:
    def description(name: str) -> Any:
        return json.loads((tmp_path / name / "sweep.json").read_text("utf-8"))

    values = {"substrate.poisson": [0.2, 0.3]}
    heights, case = tmp_path / "h.npy", wave()
    np.save(heights, case["surface"]["heights"])
    case["surface"]["heights"] = str(heights)
    table = percoat.sweep(case, values)
    table.save(tmp_path / "before")
    np.save(heights, np.zeros((4, 4)))
    table.save(tmp_path / "changed")
    heights.unlink()
    table.save(tmp_path / "gone")
    pickle.loads(pickle.dumps(table)).save(tmp_path / "pickled")
    assert "h.npy" in description("before")["case"]
    for name in ("changed", "gone", "pickled"):
        assert description(name) == description("before"), name
    # Without the keys that vary this case is refused, and stands as it was given.
    case = wave()
    percoat.sweep(case, {"load": [case.pop("load")]}).save(tmp_path / "load")
    assert "poisson = 0.3" in description("load")["case"]


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
