"""Pictures show the right number at the right place."""

from __future__ import annotations

import io
import pickle
from typing import Any, Iterator

import numpy as np
import pytest

import percoat
from conftest import Program, wave
from test_command_line import OBLIQUE

matplotlib = pytest.importorskip("matplotlib")
matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import LineCollection, PolyCollection, QuadMesh  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402

from percoat import plot  # noqa: E402


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    plt.close("all")


@pytest.fixture(scope="module")
def oblique(tmp_path_factory: pytest.TempPathFactory) -> percoat.Result:
    file = tmp_path_factory.mktemp("case") / "own.toml"
    file.write_text(OBLIQUE, "utf-8")
    return percoat.solve(file, set={"units": {"length": "mm", "pressure": "MPa"}})


def meshes(ax: Any) -> list[QuadMesh]:
    return [collection for collection in ax.collections if isinstance(collection, QuadMesh)]


def drawn(ax: Any, x: float, y: float) -> list[Any]:
    """Values of all quadrilaterals, parallelograms of equal size, that cover a place."""
    values = []
    for mesh in meshes(ax):
        corners = mesh.get_coordinates()
        edges = np.array([corners[1, 0] - corners[0, 0], corners[0, 1] - corners[0, 0]]).T
        i, j = np.floor(np.linalg.solve(edges, np.array([x, y]) - corners[0, 0])).astype(int)
        n1, n2 = corners.shape[0] - 1, corners.shape[1] - 1
        if 0 <= i < n1 and 0 <= j < n2:
            values.append(np.ma.asarray(mesh.get_array()).reshape(n1, n2)[i, j])
    return values


def sample(result: percoat.Result, x: float, y: float, shape: tuple[int, ...]) -> tuple[int, int]:
    """Index of the sample that is nearest along a₁ and a₂, in whatever copy of the cell."""
    fractions = np.linalg.solve(np.array([result.a1, result.a2]).T, [x, y])
    i, j = np.rint(fractions * shape).astype(int) % shape
    return int(i), int(j)


WINDOWS = [None, (-1.7, 2.3, -0.4, 1.1), (0.31, 0.36, 0.2, 0.21), (-3.0, 3.0, 5.0, 5.5)]


@pytest.mark.parametrize("window", WINDOWS)
def test_every_place_of_the_window_shows_its_sample_once(oblique: percoat.Result, window: Any) -> None:
    slice_ = oblique[1].plane(0.2)
    ax = plot.plane(slice_, "xx", window=window)
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    assert window is None or (x0, x1, y0, y1) == window
    random = np.random.default_rng(2)
    for x, y in random.uniform([x0, y0], [x1, y1], (400, 2)):
        assert drawn(ax, x, y) == [slice_.xx[sample(oblique, x, y, slice_.xx.shape)]], (x, y)


@pytest.mark.parametrize("name", ["fig2", "rough", "dlc-on-steel"])
def test_windows_of_other_cells_are_filled(name: str) -> None:
    settings = {"rough": {"grid.points": 64, "surface.random.shortest": 5.0, "load.mean_pressure": [0.1]}}
    result = percoat.solve(name, set=settings.get(name, {"grid.points": [48, 64]}))
    ax = plot.pressure(result[0])
    random = np.random.default_rng(4)
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    # At least the whole cell.
    (a, b), (c, d) = result.a1, result.a2
    assert (x1 - x0) * (y1 - y0) >= abs(a * d - b * c)
    for x, y in random.uniform([x0, y0], [x1, y1], (200, 2)):
        pressure = result[0].pressure[sample(result, x, y, result.x.shape)]
        (shown,) = drawn(ax, x, y)
        assert (shown is np.ma.masked) if pressure == 0.0 else (shown == pressure)


def test_windows_are_those_of_the_pictures_of_the_command_line() -> None:
    root = np.sqrt(3.0)
    hexagonal = percoat.solve("fig2", set={"grid.points": 96})[0]
    square = percoat.solve("dlc-on-steel", set={"grid.points": 48, "load.mean_pressure": [0.3]})[0]
    # Two by two cells around the middle of the unit cell, of contacts and of stresses alike.
    for step, middle, half in (
        (hexagonal, (0.75 * root, 0.75), (root, 1.5)),
        (square, (10.0, 10.0), (20.0, 20.0)),
    ):
        expected = [middle[0] - half[0], middle[0] + half[0], middle[1] - half[1], middle[1] + half[1]]
        for ax in (plot.pressure(step), plot.contact(step), plot.plane(step.plane(0.5, points=24))):
            assert [*ax.get_xlim(), *ax.get_ylim()] == pytest.approx(expected, abs=1e-9)
    # One cell of a topography.
    topography = percoat.solve(wave(load={"mean_pressure": 0.005}))[0]
    ax = plot.pressure(topography)
    assert ax.get_xlim()[0] == ax.get_ylim()[0] == 0.0
    assert ax.get_xlim()[1] == pytest.approx(topography.x.shape[0] * (topography.x[1, 0] - topography.x[0, 0]))


def test_an_isolated_contact_fills_its_window() -> None:
    step = percoat.solve("scratch", set={"grid.points": 64, "load.force": [2000.0]})[0]
    radius = step.levels[0].contact_radius
    for ax in (plot.pressure(step), plot.contact(step)):
        (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
        assert 2.0 * radius < x1 - x0 < 4.0 * radius < 120.0 and y1 - y0 == pytest.approx(x1 - x0, rel=0.2)
    # Stresses reach further than the contact.
    assert plot.plane(step.plane(5.0, points=24)).get_xlim() == (-60.0, 60.0)


def test_no_pixel_of_the_window_is_blank(oblique: percoat.Result) -> None:
    # The background is a colour that the map has not.
    figure, ax = plt.subplots(figsize=(4, 3), dpi=100)
    ax.set_facecolor("#00ff00")
    plot.plane(oblique[1].plane(0.35), "zz", ax=ax, window=(-1.3, 1.9, -1.0, 1.2), cmap="gray")
    ax.set_axis_on()
    figure.canvas.draw()
    pixels = np.asarray(figure.canvas.buffer_rgba()).astype(int)
    box = ax.get_window_extent()
    height = pixels.shape[0]
    inner = pixels[height - int(box.y1) + 2 : height - int(box.y0) - 2, int(box.x0) + 2 : int(box.x1) - 2]
    # Grey, up to what antialiasing mixes of the green between tiles.
    assert inner.size > 10_000 and np.abs(inner[..., 1] - inner[..., 0]).max() <= 8


def test_pressure_is_blank_where_nothing_touches(oblique: percoat.Result) -> None:
    step = oblique[1]
    ax = plot.pressure(step)
    assert {float(mesh.norm.vmin) for mesh in meshes(ax)} == {0.0}
    assert {float(mesh.norm.vmax) for mesh in meshes(ax)} == {float(step.pressure.max())}
    masked = [np.ma.getmaskarray(np.ma.asarray(mesh.get_array())) for mesh in meshes(ax)]
    assert any(mask.any() for mask in masked) and not all(mask.all() for mask in masked)
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("x (mm)", "y (mm)")
    assert ax.get_aspect() == 1.0


def test_contact_has_the_colours_of_the_levels(oblique: percoat.Result) -> None:
    step = oblique[1]
    ax = plot.contact(step, window=(-0.2, 1.2, -0.2, 1.2))
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["level 1", "level 2"]
    colours = [patch.get_facecolor() for patch in ax.get_legend().get_patches()]
    assert len(set(colours)) == 2
    random = np.random.default_rng(6)
    touching = 0
    for x, y in random.uniform(-0.2, 1.2, (300, 2)):
        index = sample(oblique, x, y, oblique.x.shape)
        (shown,) = drawn(ax, x, y)
        if step.pressure[index] == 0.0:
            assert shown is np.ma.masked
        else:
            touching += 1
            assert shown == oblique.owner[index]
            assert meshes(ax)[0].to_rgba(shown) == colours[int(shown) - 1]
    assert touching > 10


def test_only_levels_that_touch_are_in_the_legend() -> None:
    result = percoat.solve("fig2", set={"grid.points": 96, "load.mean_pressure": [0.0, 0.0005, 0.002]})
    told = [[text.get_text() for text in plot.contact(step).get_legend().get_texts()] for step in result]
    assert told == [[], ["level 1"], ["level 1", "level 2"]]


def test_contact_of_a_topography_has_one_colour() -> None:
    step = percoat.solve(wave(load={"mean_pressure": 0.005}))[0]
    ax = plot.contact(step)
    assert ax.get_legend() is None
    shown = np.ma.concatenate([np.ma.asarray(mesh.get_array()).ravel() for mesh in meshes(ax)])
    assert set(shown.compressed()) == {1}


def test_a_step_without_contact_is_drawn_blank() -> None:
    step = percoat.solve("fig2", set={"grid.points": 48, "load.mean_pressure": [0.0]})[0]
    for ax in (plot.pressure(step), plot.contact(step)):
        ax.figure.canvas.draw()
        assert all(np.ma.getmaskarray(np.ma.asarray(mesh.get_array())).all() for mesh in meshes(ax))


@pytest.mark.parametrize("quantity", percoat.COMPONENTS + percoat.STRAINS)
def test_every_quantity_of_a_plane_and_a_section(oblique: percoat.Result, quantity: str) -> None:
    slice_, section = oblique[1].plane(0.35, points=24, strain=True), oblique[1].section(strain=True)
    ax = plot.plane(slice_, quantity, units=oblique.units)
    assert ax.get_title() == "z = 0.35 mm, material 2"
    values = [np.ma.asarray(mesh.get_array()) for mesh in meshes(ax)]
    assert all(np.isin(value, slice_[quantity]).all() for value in values)
    bars = ax.child_axes
    unit = "(mm)" if quantity.startswith("u") else "$" if quantity in percoat.STRAINS else "(MPa)"
    assert len(bars) == 1 and bars[0].get_ylabel().endswith(unit)
    cut = plot.section(section, quantity, units=oblique.units)
    assert (cut.get_xlabel(), cut.get_ylabel()) == ("s (mm)", "z (mm)")
    # Where there are both signs, zero is in the middle of the colours.
    for mesh, whole in ((meshes(ax)[0], slice_[quantity]), (meshes(cut)[0], section[quantity])):
        if whole.min() < 0.0 < whole.max():
            assert mesh.norm.vmin == -mesh.norm.vmax
        assert mesh.norm.vmin <= whole.min() and whole.max() <= mesh.norm.vmax


def test_a_section_jumps_at_the_interface(three_levels: percoat.Result) -> None:
    section = three_levels[1].section("level 1", "level 2", length=1.0, depth=1.0)
    ax = plot.section(section, "xx")
    upper, lower = meshes(ax)
    for mesh, material in ((upper, 1), (lower, 2)):
        rows = section.material == material
        corners = mesh.get_coordinates()
        assert np.array_equal(corners[..., 0], np.broadcast_to(section.s, corners.shape[:2]))
        assert np.array_equal(corners[:, 0, 1], section.z[rows])
        assert np.array_equal(np.ma.asarray(mesh.get_array()).reshape(rows.sum(), -1), section.xx[rows])
    # Both have the interface, where the stress along it jumps: a coating twice as stiff bears more.
    assert upper.get_coordinates()[-1, 0, 1] == lower.get_coordinates()[0, 0, 1] == 0.5
    assert np.ptp(section.xx[section.z == 0.5], axis=0).max() > 1e-3
    assert (
        upper.norm is lower.norm
        or (upper.norm.vmin, upper.norm.vmax) == (lower.norm.vmin, lower.norm.vmax)
    )
    assert [line.get_ydata()[0] for line in ax.lines] == [0.5]
    # z grows downward.
    assert ax.get_xlim() == (0.0, 1.0) and ax.get_ylim() == (1.0, 0.0)


def test_a_curve_has_the_numbers_of_the_steps() -> None:
    result = percoat.solve("dlc-on-steel", set={"grid.points": 48, "load.mean_pressure": [0.0, 0.1, 0.2]})
    ax = plot.curve(result)
    (line,) = ax.lines
    assert line.get_xdata().tolist() == [step.penetration for step in result]
    assert line.get_ydata().tolist() == [step.mean_pressure for step in result]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("penetration (µm)", "mean pressure (GPa)")
    deep = plot.curve(result, "mean_pressure", "certificate.energy_gap")
    assert deep.lines[0].get_ydata().tolist() == [step.certificate.energy_gap for step in result]
    # What is not there is a gap of the line.
    gaps = plot.curve(result, "mean_pressure", "levels.radius_max")
    assert np.isnan(gaps.lines[0].get_ydata()[0]) and np.isfinite(gaps.lines[0].get_ydata()[1:]).all()


def test_a_curve_has_the_errors_that_stand_beside_its_numbers() -> None:
    result = percoat.solve("ball-on-disc", set={"grid.points": 64})
    ax = plot.curve(result, "force", "contact_stiffness")
    assert ax.get_ylabel() == "contact stiffness (GPa µm)"
    (bars,) = ax.containers[0][2]
    for (low, high), step in zip((bar[:, 1] for bar in bars.get_segments()), result):
        assert high - low == pytest.approx(2.0 * step.contact_stiffness_error, rel=1e-9)


def test_a_curve_has_a_line_for_each_level(three_levels: percoat.Result) -> None:
    ax = plot.curve(three_levels, "mean_pressure", "levels.load", linestyle="--", color="black")
    assert [line.get_label() for line in ax.lines] == ["level 1", "level 2", "level 3"]
    for level, line in enumerate(ax.lines):
        assert line.get_ydata().tolist() == [step.levels[level].load for step in three_levels]
        assert (line.get_linestyle(), line.get_color()) == ("--", "black")
    assert [text.get_text() for text in ax.get_legend().get_texts()] == ["level 1", "level 2", "level 3"]
    both = plot.curve(three_levels, "levels.contact_radius", "levels.max_pressure")
    assert both.lines[2].get_xdata().tolist() == [step.levels[2].contact_radius for step in three_levels]


def test_a_curve_has_error_bars_and_no_line_through_noise() -> None:
    settings = {"grid.points": 48, "load.mean_pressure": [0.05, 0.1, 0.2]}
    result = percoat.solve("dlc-on-steel", set=settings)
    ax = plot.curve(result, "mean_pressure", "strength.utilisation")
    strengths = [step.strength for step in result]
    assert ax.lines[0].get_label() == "yield of DLC" and len(ax.lines) == len(strengths[0])
    (bars,) = ax.containers[1][2]  # of the second criterion, yield of the chromium
    for (low, high), record in zip((bar[:, 1] for bar in bars.get_segments()), (step[1] for step in strengths)):
        assert (low, high) == (record.utilisation - record.error, record.utilisation + record.error)
    across, up = plot._interrupted(
        np.arange(5.0), np.array([1.0, 2.0, 1.5, 1.9, 1.0]), np.array([0.2, 0.3, 0.3, 0.1, np.nan])
    )
    # Up by 1, down by 0.5 and up by 0.4 with less of errors, and down by 0.9.
    assert not np.isnan(up).any() and not np.isnan(across).any()
    across, up = plot._interrupted(np.arange(5.0), np.array([1.0, 2.0, 1.5, 1.9, 1.0]), np.array([0.2, 0.3, 0.6, 0.1, np.nan]))
    # Down by 0.5 and up by 0.4 with 0.6 is a zigzag within the errors.
    assert np.isnan(up).tolist() == [False, False, True, False, True, False, False] == np.isnan(across).tolist()
    # A rise that several points make together is none.
    assert not np.isnan(plot._interrupted(np.arange(4.0), np.array([1.0, 1.1, 1.2, 1.3]), np.full(4, 0.2))[1]).any()


def test_a_curve_crosses_out_what_has_not_converged() -> None:
    settings = {"grid.points": 96, "load.mean_pressure": [0.0, 0.03, 0.06], "solver.max_iterations": 2}
    with pytest.warns(percoat.NotConverged):
        result = percoat.solve("fig2", set=settings)
    failed = [step for step in result if not step.converged]
    assert 0 < len(failed) < 3
    ax = plot.curve(result)
    (cross,) = [line for line in ax.lines if line.get_label() == "not converged"]
    assert cross.get_xdata().tolist() == [step.penetration for step in failed]
    assert cross.get_ydata().tolist() == [step.mean_pressure for step in failed]


def test_a_fit_has_its_points_and_the_band_of_its_parameters() -> None:
    force, penetration = np.array([3.0, 1.0, 2.0]), np.array([0.0291, 0.0141, 0.0221])
    case = {
        "lattice": {"kind": "isolated", "size": 4.0},
        "levels": [{"shape": "paraboloid", "radius": 10.0}],
        "substrate": {"young": 100.0, "poisson": 0.3},
        "load": {"force": 1.0},
        "units": {"length": "µm", "pressure": "GPa"},
        "grid": {"points": 32},
    }
    curve = (force, penetration, np.full(3, 1e-4))
    found = percoat.identify(case, curve, ["substrate.young"])
    order = [1, 2, 0]
    for difference in (False, True):
        ax = plot.fit(found, difference=difference, color="black")
        below = found.fitted[order] if difference else np.zeros(3)
        measured, fitted = ax.lines[0], ax.lines[-1]
        assert measured.get_color() == "black" and measured.get_xdata().tolist() == [1.0, 2.0, 3.0]
        assert measured.get_ydata() == pytest.approx(penetration[order] - below, abs=1e-15)
        assert fitted.get_ydata() == pytest.approx(found.fitted[order] - below, abs=1e-15)
        (band,) = [collection for collection in ax.collections if isinstance(collection, PolyCollection)]
        reach = band.get_paths()[0].vertices[:, 1]
        widest = 2.0 * found.fitted_error[0]
        assert np.max(reach) == pytest.approx(fitted.get_ydata()[-1] + widest, rel=1e-12)
        name = "measured − fit" if difference else "penetration"
        assert (ax.get_xlabel(), ax.get_ylabel()) == ("force (GPa µm²)", f"{name} (µm)")
        # Deviations that are known are the bars of the points.
        (bars,) = [collection for collection in ax.collections if isinstance(collection, LineCollection)]
        assert bars.get_segments()[0][:, 1] == pytest.approx(measured.get_ydata()[0] + 1e-4 * np.array([-1, 1]), abs=1e-15)


def test_everything_is_drawn_where_it_is_said(oblique: percoat.Result) -> None:
    step = oblique[1]
    calls = [
        lambda ax: plot.pressure(step, ax=ax),
        lambda ax: plot.contact(step, ax=ax),
        lambda ax: plot.plane(step.plane(0.1), ax=ax),
        lambda ax: plot.section(step.section(), ax=ax),
        lambda ax: plot.curve(oblique, ax=ax),
    ]
    figure, axes = plt.subplots(1, len(calls))
    for call, ax in zip(calls, axes):
        assert call(ax) is ax
        fresh = call(None)
        assert fresh is not ax and fresh.figure is not figure
    for kind in ("png", "svg", "pdf"):
        kept = io.BytesIO()
        figure.savefig(kept, format=kind)
        assert len(kept.getvalue()) > 5_000


def test_arguments_go_to_the_artist(oblique: percoat.Result) -> None:
    step = oblique[1]
    ax = plot.pressure(step, cmap="magma", vmax=1.0)
    assert {(mesh.cmap.name, mesh.norm.vmax) for mesh in meshes(ax)} == {("magma", 1.0)}
    norm = LogNorm(1e-3, 1.0)
    assert all(mesh.norm is norm for mesh in meshes(plot.pressure(step, norm=norm)))
    ax = plot.plane(step.plane(0.2), "zz", vmin=-2.0, vmax=2.0, alpha=0.5)
    assert {(mesh.norm.vmin, mesh.norm.vmax, mesh.get_alpha()) for mesh in meshes(ax)} == {(-2.0, 2.0, 0.5)}
    assert {mesh.cmap.name for mesh in meshes(plot.section(step.section(), "mises", cmap="gray"))} == {"gray"}


def test_large_grids_are_thinned_without_moving_anything() -> None:
    result = percoat.solve("fig2", set={"grid.points": 720, "solver.tolerance": 1e-4})
    slice_ = result[0].plane(0.3)
    ax = plot.plane(slice_, "zz")
    shown = sum(np.ma.asarray(mesh.get_array()).size for mesh in meshes(ax))
    assert shown < 2 * plot.DRAWN
    # What is drawn is a sample that is less than one of the parallelograms away.
    random = np.random.default_rng(8)
    (x0, x1), (y0, y1) = ax.get_xlim(), ax.get_ylim()
    corners = meshes(ax)[0].get_coordinates()
    reach = np.linalg.norm(corners[1, 0] - corners[0, 0]) + np.linalg.norm(corners[0, 1] - corners[0, 0])
    slope = max(np.abs(np.diff(slice_.zz, axis=axis, append=0)[:-1, :-1]).max() for axis in (0, 1)) / (
        np.sqrt(3.0) / 720
    )
    for x, y in random.uniform([x0, y0], [x1, y1], (200, 2)):
        (value,) = drawn(ax, x, y)
        assert abs(value - slice_.zz[sample(result, x, y, slice_.zz.shape)]) <= 2.0 * slope * reach


def test_what_is_no_quantity_is_refused(oblique: percoat.Result) -> None:
    for call in (
        lambda: plot.plane(oblique[1].plane(0.1), "von mises"),
        lambda: plot.section(oblique[1].section(), "x"),
    ):
        with pytest.raises(ValueError, match="there are xx, yy, zz, "):
            call()
    with pytest.raises(ValueError, match="'stop_reason' is no number of a step"):
        plot.curve(oblique, "mean_pressure", "stop_reason")
    with pytest.raises(AttributeError, match="no 'loads' here; there are "):
        plot.curve(oblique, "mean_pressure", "loads")


def test_pictures_of_a_read_result(oblique: percoat.Result) -> None:
    again = pickle.loads(pickle.dumps(oblique))
    for ours, theirs in zip(meshes(plot.pressure(again[1])), meshes(plot.pressure(oblique[1]))):
        assert np.array_equal(ours.get_coordinates(), theirs.get_coordinates())
        assert np.ma.allequal(ours.get_array(), theirs.get_array())


def test_without_matplotlib_it_is_asked_for(python: Program) -> None:
    text = """
import sys
sys.modules["matplotlib"] = None
import percoat
assert percoat.solve("fig2", set={"grid.points": 96}).converged
try:
    import percoat.plot
except ImportError as error:
    print(error)
"""
    assert python(text).stdout.strip() == 'percoat.plot needs Matplotlib: pip install "percoat[plot]"'


def test_the_package_does_not_load_matplotlib(python: Program) -> None:
    text = "import sys, percoat; print({'matplotlib', 'xarray', 'pandas'} & set(sys.modules))"
    assert python(text).stdout.strip() == "set()"
