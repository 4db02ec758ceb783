"""The package gives what the command line writes, bit for bit."""

from __future__ import annotations

import csv
import json
import pickle
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Sequence

import numpy as np
import pytest

import percoat
from conftest import Program

OBLIQUE = """
title = "Two shapes on an oblique cell, sliding, on springs"
[lattice]
kind = "oblique"
a1 = [1.0, 0.1]
a2 = [0.3, 0.9]
[[levels]]
shape = "paraboloid"
radius = 0.8
height = 0.01
sites = [[0.0, 0.0], [0.1, 0.5]]
[[levels]]
shape = "sphere"
radius = 0.7
sites = [[0.5, 0.4]]
[[layers]]
thickness = 0.2
young = 3.0
poisson = 0.25
interface = { tangential_stiffness = 4.0, normal_stiffness = 10.0 }
[substrate]
young = 1.0
poisson = 0.3
[load]
mean_pressure = [0.01, 0.03]
[grid]
points = [45, 50]
[friction]
coefficient = 0.3
direction = [1.0, 2.0]
[stress]
planes = [0.0, 0.2, 0.35]
section = { from = "level 1", toward = "level 2", length = 0.8, depth = 0.5, behind = 0.1 }
points = [[0.1, 0.2, 0.3], [0.4, 0.5, 0.0], [-7.3, 0.5, 0.2]]
"""

INCOMPRESSIBLE = """
title = "Cones and a blunt power on incompressible layers, by penetration"
[lattice]
kind = "square"
period = 2.0
[[levels]]
shape = "cone"
slope = 0.1
height = 0.01
[[levels]]
shape = "power"
coefficient = 0.5
exponent = 4.0
[[layers]]
thickness = 0.3
shear_ratio = 0.2
poisson = 0.5
[[layers]]
thickness = 0.4
shear_ratio = 3.0
poisson = 0.5
interface = { normal_stiffness = 5.0 }
[substrate]
young = 1.0
poisson = 0.5
[load]
penetration = [0.0, 0.02, 0.06]
[grid]
points = 72
[units]
length = "mm"
pressure = "MPa"
[stress]
planes = [0.0, 0.3, 0.7]
mean = "half-space"
section = { from = [0.1, 0.2], toward = [1.0, 1.0], length = 1.5, depth = 1.0 }
points = [[0.0, 0.0, 0.7]]
"""


@dataclass(frozen=True)
class Regime:
    """A case, the name of an embedded one or a text, and settings that both sides are given."""

    case: str
    settings: Sequence[str] = ()
    code: int = 0


REGIMES = {
    "three levels": Regime(
        "fig2",
        (
            "grid.points=64",
            "load.mean_pressure=[0.0005, 0.01, 0.06]",
            "stress.planes=[0.0, 0.5, 0.7]",
            'stress.section={ from = "level 1", toward = "level 2", length = 1.0, depth = 1.0 }',
            "stress.points=[[0.1, 0.2, 0.3], [0.0, 0.0, 0.5]]",
        ),
    ),
    "oblique cell, odd grid, coupled friction, springs": Regime(OBLIQUE),
    "incompressible, by penetration, with a spring": Regime(INCOMPRESSIBLE),
    "frictionless interface, rings": Regime(
        "ring",
        (
            "grid.points=96",
            "stress.planes=[0.05, 0.2]",
            'stress.section={ from = "level 1", toward = [0.0, 1.0], length = 0.5, depth = 0.2 }',
        ),
    ),
    "uncoupled friction, strengths, residual stress": Regime(
        "dlc-on-steel",
        (
            "grid.points=64",
            "friction.coupling=false",
            "load.mean_pressure=[0.1, 0.3]",
            "stress.planes=[0.0, 2.0, 3.0]",
            "stress.points=[[0.0, 0.0, 1.0], [5.0, 2.0, 2.5]]",
        ),
    ),
    "a rough surface from a seed": Regime(
        "rough",
        (
            "grid.points=64",
            "surface.random.shortest=5.0",
            "load.mean_pressure=[0.05, 0.2]",
            "stress.planes=[0.0, 1.0]",
            "stress.section={ from = [0.0, 0.0], toward = [1.0, 0.5], length = 20.0, depth = 5.0 }",
        ),
    ),
    "refined to an accuracy": Regime("fig2", ("grid={ accuracy = 0.01 }", "stress.planes=[0.25]")),
    "not converged": Regime("fig2", ("grid.points=64", "solver.max_iterations=2"), code=3),
}


class Both:
    """A case solved by the package, and the folder that the command line wrote of it."""

    def __init__(self, result: percoat.Result, folder: Path, told: str) -> None:
        self.result, self.folder, self.told = result, folder, told
        self.summary: dict[str, Any] = json.loads((folder / "summary.json").read_text("utf-8"))
        self.contact = dict(np.load(folder / "contact.npz"))
        self.stress = dict(np.load(folder / "stress.npz")) if (folder / "stress.npz").exists() else {}


@pytest.fixture(scope="module", params=list(REGIMES))
def both(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory, program: Program) -> Both:
    regime = REGIMES[request.param]
    folder = tmp_path_factory.mktemp("run")
    case = regime.case
    if "\n" in case:
        case = str(folder / "case.toml")
        Path(case).write_text(regime.case, "utf-8")
    settings = [word for setting in regime.settings for word in ("--set", setting)]
    out = folder / "out"
    ended = program("solve", case, "-o", out, "--no-pictures", *settings, code=regime.code)
    if regime.code == 0:
        result = percoat.solve(case, set=list(regime.settings))
    else:
        with pytest.warns(percoat.NotConverged):
            result = percoat.solve(case, set=list(regime.settings))
    return Both(result, out, ended.stdout)


def same(ours: Any, theirs: Any) -> bool:
    """Whether arrays agree in type, shape and every bit, signs of zeros included."""
    ours, theirs = np.asarray(ours), np.asarray(theirs)
    return ours.dtype == theirs.dtype and ours.shape == theirs.shape and ours.tobytes() == theirs.tobytes()


def timeless(summary: dict[str, Any]) -> dict[str, Any]:
    """A summary without what takes another time every time."""
    kept = {key: value for key, value in summary.items() if key not in ("timing", "seconds")}
    if "steps" in kept:
        kept["steps"] = [timeless(step) for step in kept["steps"]]
    return kept


def test_fields_of_the_contact(both: Both) -> None:
    for name in ("x", "y", "a1", "a2", "owner"):
        assert same(getattr(both.result, name), both.contact[name]), name
    for name in ("pressure", "displacement", "gap"):
        assert len(both.contact[name]) == len(both.result) > 0
        for step, written in zip(both.result, both.contact[name]):
            assert same(getattr(step, name), written), name
    for name in ("mean_pressure", "penetration"):
        assert [getattr(step, name) for step in both.result] == both.contact[name].tolist()


def test_summary(both: Both) -> None:
    ours = both.result.to_dict()
    assert timeless(ours) == timeless(both.summary)
    assert set(ours) == set(both.summary) and set(ours["timing"]) == set(both.summary["timing"])
    # As text, too: no number has changed its type, no key its place.
    assert json.dumps(timeless(ours)) == json.dumps(timeless(both.summary))


def test_planes(both: Both) -> None:
    if "planes_z" not in both.stress:
        assert not both.summary["case"].get("stress", {}).get("planes")
        return
    for index, step in enumerate(both.result):
        for row, (z, material) in enumerate(zip(both.stress["planes_z"], both.stress["planes_side"])):
            plane = step.plane(z, material=int(material))
            assert (plane.z, plane.material) == (z, material)
            for name in percoat.COMPONENTS:
                assert same(plane[name], both.stress[f"planes_{name}"][index, row]), (name, z, material)


def test_section(both: Both) -> None:
    if "section_z" not in both.stress:
        assert not both.summary["case"].get("stress", {}).get("section")
        return
    for index, step in enumerate(both.result):
        section = step.section()
        for name in ("s", "x", "y", "z"):
            assert same(section[name], both.stress[f"section_{name}"]), name
        assert same(section.material, both.stress["section_side"])
        for name in percoat.COMPONENTS:
            assert same(section[name], both.stress[f"section_{name}"][index]), name


def test_a_section_that_is_said_is_that_of_the_case(both: Both) -> None:
    if "section_z" not in both.stress:
        assert not both.summary["case"].get("stress", {}).get("section")
        return
    cut = both.summary["case"]["stress"]["section"]
    more = {name: cut[name] for name in ("length", "depth", "behind") if name in cut}
    step = both.result[-1]
    said, default = step.section(cut["from"], cut.get("toward"), **more), step.section()
    assert all(same(said[name], default[name]) for name in default)


def test_points(both: Both) -> None:
    if "points_xyz" not in both.stress:
        assert not both.summary["case"].get("stress", {}).get("points")
        return
    xyz, sides = both.stress["points_xyz"], both.stress["points_side"]
    for index, step in enumerate(both.result):
        for row, (point, side) in enumerate(zip(xyz, sides)):
            stress = step.stress(point, material=int(side))
            written = [both.stress[f"points_{name}"][index, row] for name in percoat.COMPONENTS[:6]]
            assert same(stress, written), (point, side)


def test_table(both: Both, as_piped: None) -> None:
    # What follows in the output of the command is its time and folder.
    assert both.told.startswith(str(both.result))
    assert len(str(both.result)) > 300


def files(folder: Path) -> dict[str, Path]:
    """The files of a result by their names, without percoat's own list of them."""
    return {path.name: path for path in folder.iterdir() if path.is_file()}


def test_a_saved_result_is_the_folder_of_the_command_line(both: Both, tmp_path: Path) -> None:
    both.result.save(tmp_path)
    ours, theirs = files(tmp_path), files(both.folder)
    assert set(ours) == set(theirs)
    for name in set(ours) - {"summary.json", "curve.csv"}:
        assert ours[name].read_bytes() == theirs[name].read_bytes(), name
    again = json.loads(ours["summary.json"].read_text("utf-8"))
    assert json.dumps(timeless(again)) == json.dumps(timeless(both.summary))
    table, other = read(ours["curve.csv"]), read(theirs["curve.csv"])
    assert list(table) == list(other) and all(table[name] == other[name] for name in table if name != "seconds")
    # So is one that has been pickled, in the place of the first.
    pickle.loads(pickle.dumps(both.result)).save(tmp_path)
    assert ours["contact.npz"].read_bytes() == theirs["contact.npz"].read_bytes()


def test_a_dict_gives_what_its_file_gives(both: Both, tmp_path: Path) -> None:
    again = percoat.case(both.folder / "case.toml")
    assert again == both.result.case == both.summary["case"]
    if both.result.converged:
        result = percoat.solve(again)
        assert result.summary.fingerprint == both.result.summary.fingerprint
        assert all(same(ours.pressure, theirs.pressure) for ours, theirs in zip(result, both.result))


@pytest.mark.parametrize("order", ["C", "F"])
@pytest.mark.parametrize("kind", ["<f8", "<f4", "<i2"])
def test_heights_of_an_array_are_those_of_a_file(
    tmp_path: Path, program: Program, kind: str, order: Any
) -> None:
    random = np.random.default_rng(7)
    heights = np.asarray(random.integers(-50, 50, (20, 28)), kind, order=order)
    sections: dict[str, Any] = {
        "layers": [{"thickness": 1.0, "young": 5.0, "poisson": 0.25}],
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": [0.01, 0.1]},
        "grid": {"points": [40, 56]},
    }
    surface = {"scale": 1e-3, "level": True, "period": [10.0, 14.0]}
    np.save(tmp_path / "own.npy", heights)
    text = """
        surface = { heights = "own.npy", scale = 1e-3, level = true, period = [10.0, 14.0] }
        layers = [{ thickness = 1.0, young = 5.0, poisson = 0.25 }]
        substrate = { young = 1.0, poisson = 0.3 }
        load = { mean_pressure = [0.01, 0.1] }
        grid = { points = [40, 56] }
    """
    (tmp_path / "case.toml").write_text(text, "utf-8")
    program("solve", tmp_path / "case.toml", "-o", tmp_path / "out", "--no-pictures")
    contact = np.load(tmp_path / "out" / "contact.npz")
    summary = json.loads((tmp_path / "out" / "summary.json").read_text("utf-8"))

    from_file = percoat.solve(tmp_path / "case.toml")
    from_array = percoat.solve({"surface": {"heights": heights, **surface}, **sections})
    for result in (from_file, from_array):
        for name in ("pressure", "displacement", "gap"):
            assert all(same(getattr(step, name), field) for step, field in zip(result, contact[name]))
        assert timeless(result.to_dict())["steps"] == timeless(summary)["steps"]


def test_limit(tmp_path: Path, program: Program, as_piped: None) -> None:
    settings = ["grid.points=48", "load.mean_pressure=[0.05, 0.2]"]
    words = [word for setting in settings for word in ("--set", setting)]
    ended = program("limit", "dlc-on-steel", "-o", tmp_path / "out", *words)
    written = json.loads((tmp_path / "out" / "limit.json").read_text("utf-8"))
    limits = percoat.limit("dlc-on-steel", set=settings)
    ours = limits.to_dict()
    assert ours.pop("converged") is True
    assert timeless(ours) == timeless(written)
    assert len(ours["limits"]) == 6
    # The command line says in a line of its own what comes first.
    lines = ended.stdout.splitlines()
    assert [line for line in str(limits).splitlines() if line not in lines] == []
    assert len(str(limits).splitlines()) >= 9


def test_compare(tmp_path: Path, program: Program, as_piped: None) -> None:
    settings = ["grid.points=48", "localized={ indenters = [7], elements = 12 }"]
    words = [word for setting in settings for word in ("--set", setting)]
    told = program("compare", "fig2", "-o", tmp_path / "out", "--no-pictures", *words).stdout
    written = json.loads((tmp_path / "out" / "compare.json").read_text("utf-8"))
    both = percoat.compare("fig2", set=settings)
    # What is told beside the file.
    ours = {
        key: value for key, value in both.to_dict().items() if key not in ("text", "warnings", "converged")
    }
    assert timeless(ours) == timeless(written)
    assert both.converged and [circle.indenters for circle in both.localized] == [7]
    assert str(both) in told and len(str(both)) > 1000


@pytest.mark.parametrize("traction", ["normal", "along", "across"])
def test_kernel(program: Program, traction: str) -> None:
    waves, depths = [0.01, 1.0, 7.5, 300.0], [0.0, 0.2, 0.5, 3.0]
    ended = program(
        "kernel",
        "fig2",
        "--wavenumber",
        ",".join(map(str, waves)),
        "--depth",
        ",".join(map(str, depths)),
        "--traction",
        traction,
    )
    lines = [json.loads(line) for line in ended.stdout.splitlines()]
    response = percoat.kernel("fig2", waves, depths, traction)
    names = [name for name in lines[0] if name != "depths"]
    assert {"wavenumber", "compliance", "correction"} <= set(names) and len(lines) == len(waves)
    for name in names:
        assert same(response[name], [line[name] for line in lines]), name
    rows = lines[0]["depths"]
    assert [row["z"] for row in rows] == [0.0, 0.2, 0.5, 0.5, 3.0]
    assert set(response) == set(names) | set(rows[0])
    assert same(response.z, [row["z"] for row in rows])
    assert response.side.tolist() == [row["side"] for row in rows]
    for name in set(rows[0]) - {"z", "side"}:
        assert same(response[name], [[row[name] for row in line["depths"]] for line in lines]), name


def read(table: Path) -> dict[str, list[str]]:
    with table.open(encoding="utf-8", newline="") as lines:
        head, *rows = csv.reader(lines)
    return {name: [row[index] for row in rows] for index, name in enumerate(head)}


def same_cells(column: Any, cells: list[str]) -> bool:
    """Whether a column has what stands in the cells: numbers to the last bit, NaN for none."""
    if column.dtype == bool:
        return [str(bool(value)).lower() for value in column] == cells
    if column.dtype.kind in "if":
        return same(column.astype(float), [float(cell) if cell else np.nan for cell in cells])
    # A cell of the table holds no comma.
    return ["" if value is None else str(value).replace(",", ";") for value in column] == cells


SWEEPS: list[tuple[list[str], dict[str, Any], dict[str, bool]]] = [
    (
        ["--set", "layers.0.thickness=0.1:1:3:log", "--set", "substrate.poisson=0.2,0.45"],
        {"layers.0.thickness": "0.1:1:3:log", "substrate.poisson": [0.2, 0.45]},
        {},
    ),
    (
        ["--set", "layers.0.thickness=0.1,0.2", "--set", "substrate.poisson=0.2,0.45", "--zip"],
        {"layers.0.thickness": np.array([0.1, 0.2]), "substrate.poisson": (0.2, 0.45)},
        {"zip": True},
    ),
    (
        [
            "--set",
            "load.mean_pressure=[0.01, 0.03],[0.05]",
            "--set",
            "layers.0.interface=bonded,frictionless",
        ],
        {"load.mean_pressure": [[0.01, 0.03], [0.05]], "layers.0.interface": ["bonded", "frictionless"]},
        {},
    ),
    (
        ["--set", "substrate.yield_strength=0.1,0.2", "--limit"],
        {"substrate.yield_strength": [0.1, 0.2]},
        {"limit": True},
    ),
]


@pytest.mark.parametrize("typed, values, options", SWEEPS, ids=["product", "zip", "lists and words", "limit"])
def test_sweep(
    tmp_path: Path, program: Program, typed: list[str], values: dict[str, Any], options: dict[str, bool]
) -> None:
    program("sweep", "fig2", "--set", "grid.points=48", *typed, "-o", tmp_path / "out")
    written = read(tmp_path / "out" / "sweep.csv")
    table = percoat.sweep("fig2", {"grid.points": 48, **values}, **options)
    assert list(table) == list(written) and table.rows == len(written["combination"]) >= 2
    for name, column in table.items():
        assert same_cells(column, written[name]), (name, column, written[name])


def test_check(program: Program) -> None:
    told = program("check", "fig5").stdout.splitlines()
    ours = str(percoat.check("fig5")).splitlines()
    # How much memory there is differs from one moment to the next, and the disk is of the command line alone.
    fixed = [line for line in ours if "memory" not in line and "disk" not in line]
    assert len(fixed) > 10 and [line for line in fixed if line not in told] == []


def test_cases(program: Program) -> None:
    told = program("cases").stdout
    assert len(percoat.cases()) == len(told.splitlines())
    for name, title in percoat.cases().items():
        assert f"{name} " in told and title in told
        assert percoat.case(name)["title"] == title


def test_cases_with_settings(program: Program, tmp_path: Path) -> None:
    (tmp_path / "own.toml").write_text(program("cases", "fig5", "--set", "grid.points=256").stdout, "utf-8")
    assert percoat.case(tmp_path / "own.toml") == percoat.case("fig5", set={"grid.points": 256})


@pytest.mark.parametrize("key", [None, "layers", "layers.poisson", "points"])
def test_explain(program: Program, capsys: pytest.CaptureFixture[str], key: "str | None") -> None:
    percoat.explain(key)
    assert capsys.readouterr().out == program("explain", *([] if key is None else [key])).stdout
