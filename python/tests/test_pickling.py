"""Pickled values are the same again, bit for bit, wherever they are read."""

from __future__ import annotations

import copy
import pickle
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import percoat
from conftest import Program, wave
from test_command_line import INCOMPRESSIBLE, OBLIQUE
from test_topographies import SIZES, Topography, heights
from test_topographies import case as topography

CASES: dict[str, Callable[[], percoat.Result]] = {
    "three levels": lambda: percoat.solve(
        "fig2", set={"grid.points": 64, "load.mean_pressure": [0.0, 0.01, 0.06]}
    ),
    "accuracy": lambda: percoat.solve("fig2", set={"grid": {"accuracy": 0.01}}),
    "coupled friction": lambda: percoat.solve(
        "dlc-on-steel", set={"grid.points": 64, "load.mean_pressure": [0.1, 0.2]}
    ),
    "a surface from a seed": lambda: percoat.solve(
        "rough", set={"grid.points": 64, "surface.random.shortest": 5.0, "load.mean_pressure": [0.1]}
    ),
    "a surface from an array": lambda: percoat.solve(wave()),
    "a surface with sizes of its own": lambda: percoat.solve(topography(Topography(heights(), SIZES, "µm"), cutoff=2e3)),
    "a ring": lambda: percoat.solve("ring", set={"grid.points": 64}),
}


@pytest.fixture(scope="module", params=list(CASES))
def result(request: pytest.FixtureRequest) -> percoat.Result:
    return CASES[request.param]()


def same_step(ours: percoat.Step, theirs: percoat.Step) -> None:
    for name in ("x", "y", "pressure", "gap", "displacement"):
        array, other = getattr(ours, name), getattr(theirs, name)
        assert array.tobytes() == other.tobytes() and array.shape == other.shape, name
        assert not array.flags.writeable, name
    assert ours.to_dict() == theirs.to_dict() and repr(ours) == repr(theirs) and str(ours) == str(theirs)
    assert [type(level) for level in ours.levels] == [type(level) for level in theirs.levels]
    points = [[0.1, 0.2, 0.3], [0.0, 0.0, 0.05]]
    assert ours.stress(points).tobytes() == theirs.stress(points).tobytes()
    same_record(ours.plane(0.05), theirs.plane(0.05))


def same_record(ours: percoat.Record, theirs: percoat.Record) -> None:
    assert type(ours) is type(theirs) and list(ours) == list(theirs)
    for name in ours:
        assert np.asarray(ours[name]).tobytes() == np.asarray(theirs[name]).tobytes(), name


def without_heights(result: percoat.Result) -> "dict[str, Any]":
    """The case: heights that are kept are an array in it, and a path where they stand in a file."""
    case = result.case
    case.get("surface", {}).pop("heights", None)
    return case


def same(ours: percoat.Result, theirs: percoat.Result) -> None:
    assert type(ours) is percoat.Result and ours is not theirs
    assert ours.to_dict() == theirs.to_dict() and without_heights(ours) == without_heights(theirs)
    assert repr(ours) == repr(theirs) and str(ours) == str(theirs)
    assert ours.warnings == theirs.warnings and ours.accuracy == theirs.accuracy
    assert ours.units == theirs.units
    for name in ("x", "y", "a1", "a2", "owner"):
        array, other = getattr(ours, name), getattr(theirs, name)
        assert array.tobytes() == other.tobytes(), name
        assert array.dtype == other.dtype and array.shape == other.shape, name
        assert array.flags.writeable == other.flags.writeable, name
    assert len(ours) == len(theirs)
    for step, other in zip(ours, theirs):
        same_step(step, other)


@pytest.mark.parametrize("protocol", [2, pickle.HIGHEST_PROTOCOL])
def test_results_pickle(result: percoat.Result, protocol: int) -> None:
    again = pickle.loads(pickle.dumps(result, protocol))
    same(again, result)
    # And once more, of what was read and of what was read but never looked at.
    same(pickle.loads(pickle.dumps(again)), result)
    same(pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(result)))), result)


def test_sections_and_maxima_of_a_read_result(result: percoat.Result) -> None:
    step, other = pickle.loads(pickle.dumps(result))[-1], result[-1]
    cut: dict[str, Any] = {"start": (0.1, 0.0), "toward": (1, 0), "length": 0.5, "depth": 0.1}
    same_record(step.section(**cut), other.section(**cut))
    assert step.maxima() == other.maxima() != None  # noqa: E711


def test_results_are_copied(result: percoat.Result) -> None:
    same(copy.deepcopy(result), result)
    same(copy.copy(result), result)


def test_steps_pickle_alone(result: percoat.Result) -> None:
    for step in result:
        for again in (pickle.loads(pickle.dumps(step)), copy.deepcopy(step), copy.copy(step)):
            assert type(again) is percoat.Step and again is not step
            same_step(again, step)
            if len(result) > 1:
                # A pickled step has not all steps in it.
                assert len(pickle.dumps(step)) < len(pickle.dumps(result))


def test_a_result_of_some_steps_keeps_their_loads() -> None:
    result = CASES["three levels"]()
    steps = pickle.loads(pickle.dumps([result[2], result[1]]))
    assert [step.mean_pressure for step in steps] == [result[2].mean_pressure, result[1].mean_pressure]
    for step, other in zip(steps, (result[2], result[1])):
        same_step(step, other)


def test_a_read_result_becomes_a_dataset(result: percoat.Result) -> None:
    pytest.importorskip("xarray")
    again = pickle.loads(pickle.dumps(result))
    assert again.to_xarray().identical(result.to_xarray())
    assert again[0].to_xarray().identical(result[0].to_xarray())


@pytest.mark.parametrize("text", [OBLIQUE, INCOMPRESSIBLE], ids=["oblique", "incompressible"])
def test_results_of_files_pickle_without_their_file(tmp_path: Path, text: str) -> None:
    file = tmp_path / "own.toml"
    file.write_text(text, "utf-8")
    result = percoat.solve(file)
    kept = pickle.dumps(result)
    file.unlink()
    same(pickle.loads(kept), result)
    same(pickle.loads(pickle.dumps(result)), result)


@pytest.fixture
def surface(tmp_path: Path) -> Path:
    """A case with its heights in a file."""
    np.save(tmp_path / "heights.npy", wave()["surface"]["heights"])
    text = """
        surface = { heights = "heights.npy", period = [2.0, 0.5] }
        substrate = { young = 1.0, poisson = 0.3 }
        load = { mean_pressure = [0.005, 0.02] }
    """
    (tmp_path / "own.toml").write_text(text, "utf-8")
    return tmp_path / "own.toml"


def test_a_surface_of_a_file_is_kept_with_the_result(surface: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    result = percoat.solve(surface)
    kept, alone = pickle.dumps(result), pickle.dumps(result[1])
    surface.with_name("heights.npy").unlink()
    surface.unlink()
    same(pickle.loads(kept), result)
    same_step(pickle.loads(alone), result[1])
    # What was read is kept again.
    same(pickle.loads(pickle.dumps(pickle.loads(kept))), result)


def test_a_surface_of_a_file_is_kept_for_another_process(
    surface: Path, python: Program, tmp_path: Path
) -> None:
    result = percoat.solve(surface)
    (tmp_path / "kept").write_bytes(pickle.dumps(result))
    surface.with_name("heights.npy").unlink()
    text = """
import os, pickle, sys
result = pickle.load(open(os.environ["KEPT"], "rb"))
print(result[1].stress([0.1, 0.2, 0.3]).tobytes().hex(), result[1].pressure.tobytes().hex())
"""
    stress, pressure = python(text, KEPT=str(tmp_path / "kept")).stdout.split()
    assert stress == result[1].stress([0.1, 0.2, 0.3]).tobytes().hex()
    assert pressure == result[1].pressure.tobytes().hex()


def test_a_surface_that_has_changed_is_not_kept(surface: Path) -> None:
    result = percoat.solve(surface)
    heights = surface.with_name("heights.npy")
    np.save(heights, 2.0 * wave()["surface"]["heights"])
    for answer in (result, result[0]):
        with pytest.raises(percoat.CaseError, match="heights.npy has changed since it was read"):
            pickle.dumps(answer)
    # The numbers of the step are there still.
    assert result[0].stress([0.0, 0.0, 0.1]).shape == (6,)
    np.save(heights, wave()["surface"]["heights"])
    same(pickle.loads(pickle.dumps(result)), result)


def test_a_surface_that_is_gone_is_not_kept(surface: Path) -> None:
    result = percoat.solve(surface)
    surface.with_name("heights.npy").unlink()
    with pytest.raises(FileNotFoundError):
        pickle.dumps(result)


def test_the_working_folder_does_not_matter(
    surface: Path, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.chdir(surface.parent)
    result = percoat.solve("own.toml")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    same(pickle.loads(pickle.dumps(result)), result)


def test_a_surface_of_an_array_is_that_of_its_time() -> None:
    case = wave()
    result = percoat.solve(case)
    pressure = result[0].pressure.copy()
    case["surface"]["heights"][:] = 0.0
    again = pickle.loads(pickle.dumps(result))
    assert np.array_equal(again[0].pressure, pressure)


def test_records_and_checks_pickle() -> None:
    told = percoat.check("fig2", set={"grid.points": 96})
    for again in (pickle.loads(pickle.dumps(told)), copy.deepcopy(told), copy.copy(told)):
        assert type(again) is percoat.Check and again == told and str(again) == str(told)
        assert again.points == [96, 96]
    both = percoat.compare("fig2", set={"grid.points": 48, "localized": {"indenters": [7], "elements": 12}})
    again = pickle.loads(pickle.dumps(both))
    assert type(again) is type(both) and again == both and str(again) == str(both)
    response = percoat.kernel("fig2", [1.0, 2.0], depth=[0.5])
    again = pickle.loads(pickle.dumps(response))
    assert type(again) is percoat.Record
    assert all(np.array_equal(again[name], response[name]) for name in response)
    table = percoat.sweep("fig2", {"grid.points": 48, "layers.0.thickness": [0.1, 0.2]})
    again = pickle.loads(pickle.dumps(table))
    assert type(again) is percoat.Columns and repr(again) == repr(table)
    assert all(
        np.array_equal(again[name], table[name], equal_nan=table[name].dtype.kind == "f") for name in table
    )


def test_slices_and_sections_pickle(three_levels: percoat.Result) -> None:
    for cut in (three_levels[0].plane(0.3), three_levels[0].section("level 1", "level 2")):
        again = pickle.loads(pickle.dumps(cut))
        assert type(again) is type(cut) and repr(again) == repr(cut)
        assert all(np.array_equal(again[name], cut[name]) for name in cut)


def test_errors_pickle() -> None:
    with pytest.raises(percoat.CaseError) as caught:
        percoat.solve("none")
    again = pickle.loads(pickle.dumps(caught.value))
    assert type(again) is percoat.CaseError and str(again) == str(caught.value)


def test_a_result_that_is_damaged_is_refused(three_levels: percoat.Result) -> None:
    made, (common, kept) = three_levels.__reduce__()
    index, entries, saved = kept[0]
    kept[0] = (index, entries, saved[: len(saved) // 2])
    damaged = made(common, kept)
    with pytest.raises(percoat.CaseError):
        damaged[0].pressure
    # The other is whole.
    assert np.array_equal(damaged[1].pressure, three_levels[1].pressure)
