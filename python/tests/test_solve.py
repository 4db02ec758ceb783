"""A solved case, held against closed forms and published or independent numbers."""

from __future__ import annotations

import json
import pickle
from typing import Any

import numpy as np
import pytest

import percoat
from conftest import Program, wave

# One level of paraboloids on the triangular lattice, uncoated: E* = 1, R = 0.8 l, l = 1 (ANCHORS 1.5). Mean
# pressure, peak pressure and approach as an independent solver and the lattice sums give them, radius of
# contact as the sums do.
PARABOLOIDS = [
    (0.002, 0.08074, 0.010519, 0.10121),
    (0.010, 0.13897, 0.026131, 0.17249),
    (0.030, 0.20383, 0.044710, 0.24664),
]

# The parameters printed for the figures of Goryacheva & Torskaya (2019), on 756 points along 3 l: peak
# pressures, load shares, additional displacement (ANCHORS 4.3).
FIGURES: dict[str, tuple[list[float], list[float], float]] = {
    "fig2": ([0.42169, 0.39448, 0.36528], [0.41085, 0.33067, 0.25848], 0.055395),
    "fig3a": ([0.11677, 0.10094, 0.08326], [0.49490, 0.32258, 0.18252], 0.037197),
    "fig3b": ([0.08908, 0.07927, 0.06860], [0.46069, 0.32652, 0.21279], 0.043233),
}


def paraboloids(**sections: Any) -> dict[str, Any]:
    return {
        "lattice": {"kind": "hexagonal", "period": 1.0},
        "levels": [{"shape": "paraboloid", "radius": 0.8}],
        "substrate": {"young": 0.91, "poisson": 0.3},
        "load": {"mean_pressure": [row[0] for row in PARABOLOIDS]},
        "grid": {"points": 128},
        **sections,
    }


def test_paraboloids_are_those_of_the_lattice_sums() -> None:
    result = percoat.solve(paraboloids())
    for step, (mean_pressure, peak, approach, radius) in zip(result, PARABOLOIDS):
        (level,) = step.levels
        # Every number lies within its stated error of the anchor, whose last digit is rounded; and the stated
        # errors are small: a sample is 1/13 of the smallest radius, its hundredth is what the boundary is
        # known to.
        assert abs(step.max_pressure - peak) <= level.errors.max_pressure + 5e-6
        assert abs(step.additional_displacement - approach) <= step.errors.penetration + 5e-7
        assert abs(level.contact_radius - radius) <= level.errors.contact_radius + 5e-6
        assert level.errors.max_pressure < 5e-3 * peak and level.errors.contact_radius < 1e-2 * radius
        assert level.max_pressure == step.max_pressure
        # All of the load is on the one indenter of a cell of area √3/2: only sums are rounded.
        assert level.load == pytest.approx(mean_pressure * np.sqrt(3.0) / 2.0, rel=1e-13)
        assert level.load_share == pytest.approx(1.0, rel=1e-13)


def test_a_light_load_is_the_one_of_hertz() -> None:
    # Hertz (1882): p₀ = (6 P E*²/(π³ R²))^(1/3). The neighbours change it by a factor of which the lattice
    # sums give 1 + S₃ a³/(3π)·(…) < 1 + S₃ a³ (ANCHORS 1.5, S₃ = 11.03), 1.1e-3 at a = 0.0463.
    step = percoat.solve(paraboloids(load={"mean_pressure": 2e-4}, grid={"points": 210})).steps[0]
    load = 2e-4 * np.sqrt(3.0) / 2.0
    radius = (3.0 * load * 0.8 / 4.0) ** (1.0 / 3.0)
    peak = (6.0 * load / (np.pi**3 * 0.8**2)) ** (1.0 / 3.0)
    neighbours = 11.03 * radius**3
    assert abs(step.max_pressure - peak) <= step.levels[0].errors.max_pressure + neighbours * peak
    (level,) = step.levels
    assert abs(level.contact_radius - radius) <= level.errors.contact_radius + neighbours * radius


@pytest.mark.parametrize("name", list(FIGURES))
def test_figures_of_the_paper(name: str) -> None:
    peaks, shares, displacement = FIGURES[name]
    step = percoat.solve(name, set={"grid.points": 128}).steps[0]
    for level, peak, share in zip(step.levels, peaks, shares):
        assert abs(level.max_pressure - peak) <= level.errors.max_pressure + 5e-6
        assert abs(level.load_share - share) <= level.errors.load_share + 5e-6
        assert level.errors.max_pressure < 5e-3 * peak and level.errors.load_share < 5e-3
    assert abs(step.additional_displacement - displacement) <= step.errors.penetration + 5e-7
    assert [level.level for level in step.levels] == [1, 2, 3]


def test_a_wave_in_complete_contact_has_the_pressure_of_westergaard(flat_wave: percoat.Result) -> None:
    # p = p̄ + (E* k Δ/2) cos(kx), exact on any grid that has the wave; what is left is the solver's
    # tolerance, 1e-12 of the energy, hence its root of the pressures at worst. It converges at once:
    # roundings of 1e-15.
    amplitude = np.pi * 0.01 / (2.0 * 0.91)
    for step in flat_wave:
        exact = step.mean_pressure + amplitude * np.cos(np.pi * flat_wave.x)
        assert np.abs(step.pressure - exact).max() < 1e-13
        assert np.abs(step.displacement - 0.01 * np.cos(np.pi * flat_wave.x)).max() < 1e-14
        # In contact the gap is zero as far as the solver goes: ten tolerances of the penetration.
        assert step.contact_fraction == 1.0 and np.abs(step.gap).max() < 10.0 * 1e-12 * step.penetration
        # From first touch at the crest to the mean plane.
        assert step.penetration == pytest.approx(0.01, rel=1e-12)


def test_a_coated_wave_has_the_pressure_of_its_transfer_function() -> None:
    layers = [{"thickness": 0.3, "young": 4.0, "poisson": 0.2}]
    step = percoat.solve(wave(layers=layers, load={"mean_pressure": 0.1})).steps[0]
    body = percoat.HalfSpace(layers, {"young": 1.0, "poisson": 0.3})
    exact = 0.1 + 0.01 / body.compliance(np.pi) * np.cos(np.pi * step.x)
    assert step.contact_fraction == 1.0 and np.abs(step.pressure - exact).max() < 1e-13


def test_a_prescribed_penetration_is_that_of_its_load(three_levels: percoat.Result) -> None:
    depths = [step.penetration for step in three_levels]
    case = {**three_levels.case, "load": {"penetration": depths}}
    again = percoat.solve(case)
    for step, repeated in zip(three_levels, again):
        assert repeated.penetration == pytest.approx(step.penetration, rel=1e-9)
        # Both are known to 1e-8 of the energy, which its root bounds the pressures by.
        assert repeated.mean_pressure == pytest.approx(step.mean_pressure, rel=1e-4)
    assert len(again) == 2


def test_the_mean_of_the_pressure_is_the_load(three_levels: percoat.Result) -> None:
    for step, asked in zip(three_levels, (0.03, 0.06)):
        # Sums of 96² numbers of like size, in doubles.
        assert step.pressure.mean() == pytest.approx(asked, rel=1e-13)
        assert step.mean_pressure == pytest.approx(asked, rel=1e-13)
        assert sum(level.load_share for level in step.levels) == pytest.approx(1.0, rel=1e-13)


def test_pressure_and_gap_exclude_each_other(three_levels: percoat.Result) -> None:
    for step in three_levels:
        # Bodies may overlap by ten tolerances of the penetration, and in contact they touch as closely.
        touches = 10.0 * 1e-8 * step.penetration
        assert step.pressure.min() == 0.0 and step.gap.min() >= -touches
        assert np.abs(step.gap[step.pressure > 0.0]).max() <= touches < np.median(step.gap)
        # Counting samples is off by half a sample along the boundaries, at most; cell of side √3 and area
        # 3√3/2.
        boundaries = sum(2.0 * np.pi * level.contact_radius for level in step.levels)
        counting = 0.5 * (np.sqrt(3.0) / 96) * boundaries / (1.5 * np.sqrt(3.0))
        assert np.mean(step.pressure > 0.0) == pytest.approx(step.contact_fraction, abs=counting)
        # The mean of the displacement is the mode q = 0, which is left out.
        assert abs(step.displacement.mean()) < 1e-16


def test_gap_displacement_and_heights_add_up() -> None:
    case = wave(load={"mean_pressure": 0.005})
    result = percoat.solve(case)
    (step,) = result
    assert 0.0 < step.contact_fraction < 1.0
    # Body at u, counterbody at its height over a plane: their distance is the gap but for that plane. In
    # contact, the solver's ten tolerances of the penetration are allowed: 10 · 1e-12 · 0.01.
    plane = step.gap - step.displacement + case["surface"]["heights"]
    assert np.ptp(plane) < 1e-13


def test_the_grid_is_that_of_the_cell(three_levels: percoat.Result) -> None:
    result = three_levels
    i, j = np.meshgrid(np.arange(96) / 96, np.arange(96) / 96, indexing="ij")
    assert np.allclose(result.x, i * result.a1[0] + j * result.a2[0], rtol=0.0, atol=1e-15)
    assert np.allclose(result.y, i * result.a1[1] + j * result.a2[1], rtol=0.0, atol=1e-15)
    # Three levels on the lattice of period 1: a cell of side √3, a third of it each.
    assert np.hypot(*result.a1) == pytest.approx(np.sqrt(3.0))
    assert np.hypot(*result.a2) == pytest.approx(np.sqrt(3.0))
    assert set(np.unique(result.owner)) == {1, 2, 3}


def test_the_owner_of_a_sample_is_the_level_that_faces_it() -> None:
    sites = [[(0.0, 0.0), (0.1, 0.5)], [(0.5, 0.4)]]
    radii, heights = (0.8, 0.5), (0.01, 0.0)
    levels = [
        {"shape": "paraboloid", "radius": radius, "height": height, "sites": level_sites}
        for radius, height, level_sites in zip(radii, heights, sites)
    ]
    cell = {"kind": "oblique", "a1": [1.0, 0.1], "a2": [0.3, 0.9]}
    result = percoat.solve(paraboloids(lattice=cell, levels=levels, grid={"points": [45, 50]}))
    # Every indenter of the cell and its copies all around, one by one.
    nearest = []
    for radius, height, level_sites in zip(radii, heights, sites):
        places = [s1 * result.a1 + s2 * result.a2 for s1, s2 in level_sites]
        copies = [m * result.a1 + n * result.a2 for m in range(-2, 3) for n in range(-2, 3)]
        squares = [
            (result.x - place[0] - copy[0]) ** 2 + (result.y - place[1] - copy[1]) ** 2
            for place in places
            for copy in copies
        ]
        nearest.append(np.min(squares, axis=0) / (2.0 * radius) - height)
    clear = np.abs(nearest[0] - nearest[1]) > 1e-12
    assert np.array_equal(result.owner[clear], np.argmin(nearest, axis=0)[clear] + 1)
    assert clear.mean() > 0.99


def test_a_step_has_what_its_summary_has(three_levels: percoat.Result) -> None:
    for step, entries in zip(three_levels, three_levels.to_dict()["steps"]):
        assert step.to_dict() == entries
        for name, value in entries.items():
            attribute = getattr(step, name)
            assert (attribute.to_dict() if isinstance(attribute, percoat.Record) else attribute) == value
            assert name in dir(step)
        assert step.levels[1].errors.load == entries["levels"][1]["errors"]["load"]
        assert step.x is three_levels.x and step.y is three_levels.y
        with pytest.raises(AttributeError, match="no 'pressures' here; there are mean_pressure, "):
            step.pressures


def test_a_result_is_a_sequence_of_steps(three_levels: percoat.Result) -> None:
    assert len(three_levels) == 2 and list(three_levels) == three_levels.steps
    assert three_levels[-1] is three_levels.steps[1] and three_levels[:1] == three_levels.steps[:1]
    with pytest.raises(IndexError):
        three_levels[2]


def test_results_print_what_they_are(three_levels: percoat.Result) -> None:
    assert repr(three_levels).endswith("2 steps, 96 × 96 samples, converged>")
    assert repr(three_levels[0]).startswith("<percoat.Step: mean pressure 0.03, penetration 0.0425")
    # The table of a step has its load and not that of the other.
    assert "0.030000" in str(three_levels[0]) and "0.060000" not in str(three_levels[0])
    assert str(three_levels).startswith(three_levels.title)
    assert "2 of 2 load steps converged" in str(three_levels)


def test_what_a_result_says_of_itself(three_levels: percoat.Result) -> None:
    assert three_levels.title == percoat.cases()["fig2"] == three_levels.case["title"]
    assert three_levels.units == {"length": None, "pressure": None}
    assert three_levels.converged and three_levels.accuracy is None and three_levels.warnings == []
    assert three_levels.case["grid"]["points"] == [96, 96]
    assert three_levels.summary.percoat == percoat.__version__
    assert percoat.solve("dlc-on-steel", set={"grid.points": 48}).units == {"length": "µm", "pressure": "GPa"}


def test_an_accuracy_is_reached_and_said() -> None:
    result = percoat.solve("fig2", set={"grid": {"accuracy": 0.01}})
    assert result.accuracy is not None and result.accuracy < 0.01 and result.converged
    assert result.x.shape == tuple(result[0].points) == result[0].pressure.shape


def test_an_accuracy_that_is_not_reached_is_told() -> None:
    # Changes of a grid fall no faster than its spacing, and there are grids up to 4096 points: never to 1e-9.
    with pytest.warns(percoat.PercoatWarning) as caught:
        result = percoat.solve("fig2", set={"grid": {"accuracy": 1e-9}, "solver.tolerance": 1e-6})
    told = {warning.category: str(warning.message) for warning in caught}
    assert told[percoat.PercoatWarning].startswith("grid.accuracy is not reached: the last change was ")
    assert told[percoat.NotConverged] == "not converged: the accuracy is not reached"
    assert not result.converged and all(step.converged for step in result)
    assert result.accuracy is not None and result.accuracy > 1e-9
    assert repr(result).endswith("not converged>") and not pickle.loads(pickle.dumps(result)).converged


def test_what_has_not_converged_warns_at_the_line_of_the_user() -> None:
    with pytest.warns(percoat.NotConverged, match="not converged: step 1: .*iteration") as caught:
        result = percoat.solve("fig2", set={"grid.points": 96, "solver.max_iterations": 2})
    (warning,) = [warning for warning in caught if warning.category is percoat.NotConverged]
    assert warning.filename == __file__
    assert not result.converged and not result[0].converged and repr(result).endswith("not converged>")
    assert issubclass(percoat.NotConverged, percoat.PercoatWarning)


def test_what_is_doubtful_warns_at_the_line_of_the_user() -> None:
    with pytest.warns(percoat.PercoatWarning, match="fewer than 10 samples") as caught:
        result = percoat.solve("fig2", set={"grid.points": 48})
    assert [str(warning.message) for warning in caught] == result.warnings
    assert [warning.filename for warning in caught] == [__file__]


def test_a_step_without_contact() -> None:
    result = percoat.solve("fig2", set={"grid.points": 48, "load.mean_pressure": [0.0, 0.01]})
    assert not result[0].pressure.any() and result[0].contact_fraction == 0.0
    assert result[0].maxima() is None and result[1].maxima() is not None
    assert not result[0].stress([0.0, 0.0, 0.3]).any() and not result[0].plane(0.3).mises.any()


SAME = {"grid.points": 48, "load.mean_pressure": [0.01, 0.02], "layers.0.thickness": 0.25}


@pytest.mark.parametrize(
    "settings",
    [
        [f"{key}={value}" for key, value in SAME.items()],
        tuple(f"{key}={value}" for key, value in SAME.items()),
        {"grid": {"points": 48}, "load": {"mean_pressure": (0.01, 0.02)}, "layers.0.thickness": 0.25},
        {
            "grid.points": np.int64(48),
            "load.mean_pressure": np.array([0.01, 0.02]),
            "layers.0.thickness": np.float32(0.25),
        },
        {
            "grid.points": np.array([48, 48]),
            "load.mean_pressure": [np.float64(0.01), 0.02],
            "layers.0.thickness": 0.25,
        },
    ],
    ids=["list of texts", "tuple of texts", "dicts", "numbers of NumPy", "arrays of NumPy"],
)
def test_settings_in_every_form(settings: Any) -> None:
    result = percoat.solve("fig2", set=settings)
    expected = percoat.solve("fig2", set=SAME)
    assert result.case == expected.case and len(result) == 2
    assert all(np.array_equal(ours.pressure, theirs.pressure) for ours, theirs in zip(result, expected))


def test_a_dict_may_have_numbers_and_arrays_of_numpy() -> None:
    case = percoat.case("fig2", set=SAME)
    for level in case["levels"]:
        level["radius"] = np.float64(level["radius"])
    case["grid"]["points"] = np.array(case["grid"]["points"], dtype=np.int16)
    case["load"]["mean_pressure"] = np.array(case["load"]["mean_pressure"])
    case["friction"] = {
        "coefficient": np.float32(0.25), "coupling": np.bool_(False), "direction": np.array([0, 1])
    }
    case["localized"] = None  # what is None is left out
    result = percoat.solve(case)
    plain = {"coefficient": 0.25, "coupling": False, "direction": [0.0, 1.0]}
    assert result.case == percoat.case("fig2", set={**SAME, "friction": plain})


def test_a_case_of_an_array_can_be_looked_at_changed_and_solved() -> None:
    # `percoat.case` says so, and `result.case` is "the case as run".
    given = wave()
    first = percoat.solve(given)
    for case in (percoat.case(given), first.case):
        again = percoat.solve(case)
        assert np.array_equal(first[0].pressure, again[0].pressure)


def test_heights_of_any_kind_are_the_same_surface() -> None:
    heights = wave()["surface"]["heights"]
    forms = [
        heights.tolist(),
        np.asfortranarray(heights),
        np.repeat(np.repeat(heights, 2, axis=0), 3, axis=1)[::2, ::3],
        heights.astype(">f8"),
    ]
    expected = percoat.solve(wave())[0].pressure
    for form in forms:
        result = percoat.solve(wave(surface={"heights": form, "period": [2.0, 0.5]}))
        assert np.array_equal(result[0].pressure, expected)


def test_heights_of_other_libraries_are_the_same_surface() -> None:
    heights = wave()["surface"]["heights"]
    expected = percoat.solve(wave())[0].pressure
    for library, kind in (("pandas", "DataFrame"), ("xarray", "DataArray")):
        table = getattr(pytest.importorskip(library), kind)(heights)
        result = percoat.solve(wave(surface={"heights": table, "period": [2.0, 0.5]}))
        assert np.array_equal(result[0].pressure, expected), library


def test_the_case_is_not_changed_by_solving_it() -> None:
    case = wave()
    heights = case["surface"]["heights"]
    kept = heights.copy()
    percoat.solve(case, set={"load.mean_pressure": 0.1})
    assert case["surface"]["heights"] is heights and np.array_equal(heights, kept)
    assert case["load"] == {"mean_pressure": [0.02, 0.05]}


def test_what_is_set_is_that_of_the_changed_case() -> None:
    assert percoat.case("fig2", set={"layers.0.thickness": 0.2})["layers"][0]["thickness"] == 0.2
    changed = percoat.case("fig2")
    changed["layers"][0]["thickness"] = 0.2
    assert percoat.case(changed) == percoat.case("fig2", set={"layers.0.thickness": 0.2})
    # The whole dict again, complete with defaults.
    assert percoat.case(percoat.case("dlc-on-steel")) == percoat.case("dlc-on-steel")


def test_a_check_tells_first_touches_memory_and_load() -> None:
    told = percoat.check("fig2", set={"grid.points": 192})
    assert told.title == percoat.cases()["fig2"] and told.points == [192, 192] and told.accuracy is None
    assert told.load == {"mean_pressure": [0.06]}
    # Levels 2 and 3 touch at .00094 and .00365 (ANCHORS 4.2), with the last digit rounded.
    assert told.first_touch is not None and told.first_touch[0] == 0.0
    assert told.first_touch[1:] == pytest.approx([0.00094, 0.00365], abs=1e-5)
    assert told.first_touch_quantity == "mean_pressure"
    # Eight bytes a sample in ten fields at least, and no more than is there.
    assert 10 * 8 * 192 * 192 < told.memory < told.memory_available
    assert told.surface is None and told.warnings == [] and told.sublayer_error is None
    assert repr(told).endswith("192 × 192 samples>") and str(told) == told.text


def test_a_check_tells_what_a_surface_is_like() -> None:
    told = percoat.check(wave())
    # A wave of amplitude Δ: Δ/√2, k Δ/√2, and flatter than normal: 3/2.
    assert told.surface is not None and told.first_touch is None and told.first_touch_quantity is None
    assert told.surface.rms_height == pytest.approx(0.01 / np.sqrt(2.0), rel=1e-12)
    assert told.surface.rms_slope == pytest.approx(np.pi * 0.01 / np.sqrt(2.0), rel=1e-12)
    assert told.surface.kurtosis == pytest.approx(1.5, rel=1e-12)
    assert told.surface.range == pytest.approx(0.02)


def test_both_methods_agree() -> None:
    both = percoat.compare("fig2", set={"grid.points": 96, "localized": {"indenters": [37], "elements": 24}})
    (circle,) = both.localized
    # 30 to 36 neighbours leave 1 % of the approach (ANCHORS 1.5, the table of the localisation principle).
    assert circle.indenters == 37 and abs(circle.difference.penetration) < 0.01
    assert both.converged and "circles of [37]" in repr(both)
    assert both.spectral.levels[0].max_pressure == pytest.approx(circle.levels[0].max_pressure, rel=0.01)


def test_doubts_about_a_comparison_are_told_at_the_line_of_the_user() -> None:
    settings = {"grid.points": 48, "localized": {"indenters": [7], "elements": 12}}
    with pytest.warns(percoat.PercoatWarning, match="samples in the spectral solution") as caught:
        both = percoat.compare("fig2", set=settings)
    assert [str(warning.message) for warning in caught] == both.warnings
    assert {warning.filename for warning in caught} == {__file__}


def test_a_record_is_a_dict_with_attributes() -> None:
    record = percoat.Record(load=0.5, errors={"load": 1e-3}, levels=[{"level": 1}])
    assert record.errors.load == record["errors"]["load"] == 1e-3 and record.levels[0].level == 1
    assert {"load", "errors", "levels"} <= set(dir(record))
    plain = record.to_dict()
    assert type(plain) is dict and type(plain["errors"]) is dict and type(plain["levels"][0]) is dict
    with pytest.raises(AttributeError, match="no 'loads' here; there are load, errors, levels"):
        record.loads


def test_the_schema_is_that_of_the_command_line(program: Program) -> None:
    schema = percoat.schema()
    assert schema == json.loads(program("explain", "--schema").stdout)
    assert set(percoat.case("fig2")) <= set(schema["properties"])


def test_what_was_solved_cannot_be_set(three_levels: percoat.Result) -> None:
    step = three_levels[0]
    for name in ("pressure", "mean_pressure", "penetraton"):
        with pytest.raises(AttributeError):
            setattr(step, name, 0.0)
    for name in ("x", "converged", "title"):
        with pytest.raises(AttributeError):
            setattr(three_levels, name, 0.0)
    record = percoat.Record(load=0.5)
    record.load = 0.25
    assert record["load"] == record.load == 0.25


def test_everything_public_is_there_and_explained() -> None:
    for name in percoat.__all__:
        exported = getattr(percoat, name)
        if name not in ("COMPONENTS", "STRAINS", "__version__"):
            assert exported.__doc__ and exported.__doc__[0].isupper(), name
    assert len(percoat.__all__) == len(set(percoat.__all__)) >= 25
