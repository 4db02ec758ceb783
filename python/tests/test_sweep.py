"""Sweeps: each row is the case of its combination, solved."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Any

import numpy as np
import pytest

import percoat

SMALL: dict[str, Any] = {"grid.points": 48}


def test_rows_are_the_steps_of_their_cases() -> None:
    thicknesses, ratios = [0.1, 0.4], [0.5, 2.0, 8.0]
    values = {
        **SMALL,
        "load.mean_pressure": [[0.02, 0.05]],
        "layers.0.thickness": thicknesses,
        "layers.0.shear_ratio": ratios,
    }
    table = percoat.sweep("fig2", values)
    assert table.rows == 12 and table["combination"].tolist() == sorted([1, 2, 3, 4, 5, 6] * 2)
    assert table["step"].tolist() == [1, 2] * 6 and set(table["status"]) == {"done"}
    # The last key turns fastest, as on the command line.
    assert table["set_layers_0_thickness"].tolist() == [0.1] * 6 + [0.4] * 6
    assert table["set_layers_0_shear_ratio"].tolist() == [0.5, 0.5, 2.0, 2.0, 8.0, 8.0] * 2
    for row in range(12):
        settings = {
            key: table[f"set_{key.replace('.', '_')}"][row]
            for key in ("layers.0.thickness", "layers.0.shear_ratio")
        }
        result = percoat.solve("fig2", set={**SMALL, "load.mean_pressure": [0.02, 0.05], **settings})
        step = result[int(table["step"][row]) - 1]
        assert table["penetration"][row] == step.penetration
        assert table["mean_pressure"][row] == step.mean_pressure
        assert table["levels_2_max_pressure"][row] == step.levels[1].max_pressure
        assert table["levels_1_errors_load"][row] == step.levels[0].errors.load
        assert table["points_1"][row] == 48 and bool(table["converged"][row]) == step.converged


def test_swept_truths_are_a_column_of_truths() -> None:
    table = percoat.sweep("fig2", {**SMALL, "localized.mutual_effect": [True, False]})
    column = table["set_localized_mutual_effect"]
    assert column.dtype == bool and column.tolist() == [True, False]


def test_values_are_set_in_their_order_texts_among_them() -> None:
    table = percoat.sweep("fig2", {"grid": "{ points = 48 }", "grid.points": 64, "layers.0.thickness": [0.1, 0.4]})
    assert table["points_1"].tolist() == [64, 64]


def test_pairs_are_zipped() -> None:
    table = percoat.sweep(
        "fig2", {**SMALL, "layers.0.thickness": [0.1, 0.4], "substrate.poisson": [0.2, 0.45]}, zip=True
    )
    assert table["set_layers_0_thickness"].tolist() == [0.1, 0.4]
    assert table["set_substrate_poisson"].tolist() == [0.2, 0.45]
    for row, (thickness, poisson) in enumerate([(0.1, 0.2), (0.4, 0.45)]):
        settings = {**SMALL, "layers.0.thickness": thickness, "substrate.poisson": poisson}
        assert table["penetration"][row] == percoat.solve("fig2", set=settings)[0].penetration


@pytest.mark.parametrize(
    "values, expected",
    [
        ([0.1, 0.2], [0.1, 0.2]),
        ((0.1, 0.2), [0.1, 0.2]),
        (np.linspace(0.1, 0.3, 3), np.linspace(0.1, 0.3, 3)),
        (np.array([1, 2], np.int8), [1, 2]),
        (np.array([0.5, 0.25], np.float32), [0.5, 0.25]),
        ("0.1:0.4:3", [0.1, 0.25, 0.4]),
        ("0.1:0.4:3:log", [0.1, 0.2, 0.4]),
        ("0.1,0.2", [0.1, 0.2]),
        (iter([0.1, 0.2]), [0.1, 0.2]),
        ([1.0 / 3.0, 1e-2 / 3.0], [1.0 / 3.0, 1e-2 / 3.0]),
    ],
    ids=lambda value: type(value).__name__ if not isinstance(value, str) else value,
)
def test_values_in_every_form(values: Any, expected: Any) -> None:
    table = percoat.sweep("fig2", {**SMALL, "layers.0.thickness": values})
    column = table["set_layers_0_thickness"]
    assert column.dtype.kind in "if"
    # A geometric value is that of a power, known to roundings.
    exact = np.array_equal(column, expected)
    assert exact or (isinstance(values, str) and np.allclose(column, expected, rtol=1e-15, atol=0.0))


@pytest.mark.parametrize(
    "values",
    [
        {"layers.0.thickness": [0.1, 0.2, 0.1]},
        {"layers.0.thickness": [0.1, 0.2], "layers[0].thickness": [0.3, 0.4]},
    ],
)
def test_what_is_given_twice_is_refused(values: dict[str, Any]) -> None:
    with pytest.raises(percoat.CaseError, match="twice"):
        percoat.sweep("fig2", {**SMALL, **values})


def test_columns_have_the_types_of_their_numbers() -> None:
    values = {
        **SMALL,
        "load.mean_pressure": [[0.0, 0.0005], [0.05]],
        "layers.0.interface": ["bonded", "frictionless"],
    }
    table = percoat.sweep("fig2", values)
    kinds = {
        "combination": "i",
        "step": "i",
        "points_1": "i",
        "penetration": "f",
        "converged": "b",
        "levels_1_merged": "b",
    }
    for name, kind in kinds.items():
        assert table[name].dtype.kind == kind, name
    assert set(table["set_layers_0_interface"]) == {"bonded", "frictionless"}
    # Samples out of contact have no boundary: not a number.
    untouched = np.isnan(table["levels_3_radius_min"])
    assert np.array_equal(untouched, table["mean_pressure"] < 0.003) and untouched.any()
    assert not untouched.all()


def test_a_column_of_no_numbers_is_not_a_number() -> None:
    # No contact here is a ring: "numbers that are not there are NaN", whether or not others of the column
    # are.
    table = percoat.sweep("fig2", {**SMALL, "layers.0.thickness": [0.1, 0.2]})
    column = table["levels_1_radius_inner"]
    assert column.dtype.kind == "f" and np.isnan(column).all()


def test_what_a_sweep_gives_is_a_dict_of_columns() -> None:
    table = percoat.sweep("fig2", {**SMALL, "layers.0.thickness": [0.1, 0.2]})
    assert isinstance(table, dict) and isinstance(table, percoat.Columns)
    assert all(isinstance(column, np.ndarray) and column.shape == (2,) for column in table.values())
    assert len(table) == len(list(table)) > 20 and table.rows == 2
    assert repr(table).startswith(
        "<percoat.Columns: 2 rows of combination, set_layers_0_thickness, status, step, "
    )


def test_a_combination_that_fails_has_a_row_and_a_warning() -> None:
    with pytest.warns(percoat.PercoatWarning, match="failed: .*grid.points") as caught:
        table = percoat.sweep("fig2", {"grid.points": [48, 11]})
    assert table["status"].tolist() == ["done", "failed"] and np.isnan(table["penetration"][1])
    assert [warning.filename for warning in caught if "failed" in str(warning.message)] == [__file__]
    with pytest.warns(percoat.NotConverged, match="not converged"):
        table = percoat.sweep("fig2", {**SMALL, "solver.max_iterations": [2, 1000]})
    assert table["status"].tolist() == ["not_converged", "done"]
    assert table["converged"].tolist() == [False, True]


def test_doubts_about_a_combination_are_told() -> None:
    # As `percoat sweep` says on standard error, and `percoat.solve` warns of the same case.
    with pytest.warns(percoat.PercoatWarning, match="fewer than 10 samples") as caught:
        percoat.sweep("fig2", {**SMALL, "layers.0.thickness": [0.1, 0.2, 0.3]})
    # Each doubt once, and how many others have it.
    assert len(caught) == 1 and "2 more" in str(caught[0].message) and caught[0].filename == __file__


def test_limits_are_swept() -> None:
    case = percoat.case("fig2", set=SMALL)
    table = percoat.sweep(case, {"substrate.yield_strength": [0.1, 0.2]}, limit=True)
    for row, strength in enumerate([0.1, 0.2]):
        limits = percoat.limit(case, set={"substrate.yield_strength": strength})
        assert limits.first is not None
        names = [
            name
            for name in table
            if "mean_pressure" in name and table[name][row] == limits.first.mean_pressure
        ]
        assert names, list(table)


def test_a_surface_is_swept() -> None:
    heights = np.outer(np.cos(2.0 * np.pi * np.arange(16) / 16), np.ones(16)) * 0.01
    case = {
        "surface": {"heights": heights, "period": [2.0, 2.0]},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": 0.02},
    }
    table = percoat.sweep(case, {"substrate.poisson": [0.3, 0.4]})
    # Pressed flat: p̄ + E* k Δ/2.
    peaks = [0.02 + np.pi * 0.01 / (2.0 * (1.0 - poisson**2)) for poisson in (0.3, 0.4)]
    assert table["max_pressure"] == pytest.approx(peaks, rel=1e-6)


def test_the_order_of_rows_does_not_depend_on_threads() -> None:
    values = {**SMALL, "layers.0.thickness": "0.1:1:12:log"}
    one, three = (percoat.sweep("fig2", values, threads=threads) for threads in (1, 3))
    assert list(one) == list(three)
    for name in one:
        assert one[name].tolist() == three[name].tolist() or np.array_equal(
            one[name], three[name], equal_nan=True
        ), name
    assert one["combination"].tolist() == list(range(1, 13))


def test_combinations_are_named_by_their_values() -> None:
    heard: list[percoat.Progress] = []
    values: dict[str, Any] = {
        **SMALL,
        "load": {"mean_pressure": 0.02},
        "solver.tolerance": np.array([2e-7]),
        "layers.0.interface": ["bonded"],
        "title": ["a b"],
        "lattice": [{"kind": "hexagonal", "period": 1.5}],
    }
    table = percoat.sweep("fig2", values, progress=heard.append)
    # Settings that hold for all are no part of a name.
    name = (
        'combination 1 (solver.tolerance=2e-7, layers.0.interface=bonded, title="a b", '
        'lattice={ kind = "hexagonal", period = 1.5 })'
    )
    assert [progress.phase for progress in heard] == [f"{name} done"]
    assert table["set_solver_tolerance"].tolist() == [2e-7]
    assert table["mean_pressure"] == pytest.approx([0.02], rel=1e-12)
    assert [key for key in table if key.startswith("set_")] == [
        "set_solver_tolerance", "set_layers_0_interface", "set_title", "set_lattice",
    ]


def test_progress_of_a_sweep() -> None:
    heard: list[percoat.Progress] = []
    percoat.sweep("fig2", {**SMALL, "layers.0.thickness": "0.1:1:7"}, progress=heard.append)
    assert [(progress.unit, progress.done, progress.of) for progress in heard] == [
        ("combination", done, 7)
        for done in range(1, 8)
    ]
    assert all(progress.points is None and "done" in progress.phase for progress in heard)


def test_uncertain_keys_have_quantiles_and_indices() -> None:
    vary: dict[str, Any] = {"layers.0.thickness": (0.4, 0.6), "levels.0.radius": "5%"}
    table = percoat.sweep("fig2", SMALL, vary=vary, samples=8, seed=3)
    assert table.rows == 8 * 4 and set(table["status"]) == {"done"}
    found = table.uncertainty
    row = found["result"].tolist().index("penetration")
    draws = np.concatenate([table["penetration"][0::4], table["penetration"][1::4]])
    assert found["known"][row] == 16 and found["unknown"][row] == 0
    assert found["mean"][row] == pytest.approx(draws.mean(), rel=1e-12)
    assert found["deviation"][row] == pytest.approx(draws.std(), rel=1e-9)
    assert [found[name][row] for name in ("q05", "median", "q95")] == pytest.approx(np.quantile(draws, [0.05, 0.5, 0.95]))
    for key, column in (("layers_0_thickness", 2), ("levels_0_radius", 3)):
        # Jansen's estimator, and that of Saltelli et al. (2010).
        [a, b, ab] = [table["penetration"][place::4] - draws.mean() for place in (0, 1, column)]
        assert found[f"total_{key}"][row] == pytest.approx(((a - ab) ** 2).mean() / (2.0 * draws.var()))
        assert found[f"first_{key}"][row] == pytest.approx((b * (ab - a)).mean() / draws.var())
        assert found[f"total_{key}_low"][row] <= found[f"total_{key}"][row] <= found[f"total_{key}_high"][row]
    assert percoat.sweep("fig2", {**SMALL, "layers.0.thickness": [0.4, 0.6]}).uncertainty.rows == 0
    with pytest.raises(percoat.CaseError, match="below the second one"):
        percoat.sweep("fig2", SMALL, vary={"layers.0.thickness": (0.6, 0.4)})
    with pytest.raises(percoat.CaseError, match="one value of each other key"):
        percoat.sweep("fig2", {"grid.points": [48, 64]}, vary=vary)


def test_the_uncertainty_is_the_same_on_an_executor() -> None:
    vary = {"layers.0.thickness": "10%"}
    here = percoat.sweep("fig2", SMALL, vary=vary, samples=8).uncertainty
    with ThreadPoolExecutor(2) as executor:
        there = percoat.sweep("fig2", SMALL, vary=vary, samples=8, executor=executor).uncertainty
    assert list(here) == list(there)
    for name in here:
        np.testing.assert_array_equal(here[name], there[name])
