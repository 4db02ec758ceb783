"""Moduli are found from curves whose moduli are known."""

from __future__ import annotations

import copy
import json
import pickle
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import percoat
from conftest import Program

CASE = {
    "title": "A ball on a half-space",
    "lattice": {"kind": "isolated", "size": 4.0},
    "levels": [{"shape": "paraboloid", "radius": 10.0}],
    "substrate": {"young": 100.0, "poisson": 0.3},
    "load": {"force": 10.0},
    "units": {"length": "µm", "pressure": "GPa"},
    "grid": {"points": 48},
}
YOUNG = 70.0
NOISE = 2e-4


def hertz(penetration: Any, young: float = YOUNG) -> Any:
    """P = 4/3 E* √R δ^{3/2} with R = 10 µm and ν = 0.3, in mN."""
    return 4.0 / 3.0 * young / 0.91 * np.sqrt(10.0) * penetration**1.5


@pytest.fixture(scope="module")
def curve() -> tuple[Any, Any]:
    """Force in mN and penetration in µm, with a noise that sums to nothing."""
    exact = np.linspace(0.02, 0.2, 12)
    return hertz(exact), exact + NOISE * np.array([1, -1] * 6)


@pytest.fixture(scope="module")
def found(curve: tuple[Any, Any]) -> percoat.Identification:
    return percoat.identify(CASE, curve, ["substrate.young"])


def test_the_modulus_of_hertz_is_found_with_its_standard_error(
    found: percoat.Identification, curve: tuple[Any, Any]
) -> None:
    force, penetration = curve
    # δ ~ E^{−2/3}: the standard error of ln E is s over 2/3 of the root of Σδ².
    residual = penetration - found.fitted
    deviation = np.sqrt(np.sum(residual**2) / 11)
    expected = YOUNG * deviation / (2.0 / 3.0 * np.sqrt(np.sum(found.fitted**2)))
    # Grid and interpolation leave some 1e-3.
    assert found.values["substrate.young"] == pytest.approx(YOUNG, rel=2e-3)
    assert found.errors["substrate.young"] == pytest.approx(expected, rel=0.02)
    low, high = found.intervals["substrate.young"]
    # Student's quantile of 11 degrees of freedom.
    assert (high - low) / 2.0 == pytest.approx(2.201 * expected, rel=0.02)
    assert found.degrees_of_freedom == 11 and found.points == 12 and found.reduced_chi_square is None
    assert found.rms_residual == pytest.approx(np.sqrt(np.mean(residual**2)), rel=1e-12)
    # The band of one parameter is in proportion to the penetration; derivatives on 48 samples are right to a percent or so.
    share = found.errors["substrate.young"] / found.values["substrate.young"]
    assert found.fitted_error == pytest.approx(2.0 / 3.0 * share * found.fitted, rel=0.02)
    assert found.correlation.tolist() == [[1.0]] and found.penetration_error is None
    assert np.array_equal(found.force, force) and np.array_equal(found.penetration, penetration)


def test_the_case_of_the_result_has_the_values_found(found: percoat.Identification) -> None:
    assert found.case["substrate"]["young"] == found.values["substrate.young"]
    assert percoat.case(found.case) == found.case
    (parameter,) = found.parameters
    assert (parameter.name, parameter.start) == ("substrate.young", 100.0)
    assert parameter.value == found.values["substrate.young"]
    step = percoat.solve(found.case, set={"load.force": float(found.force[6])})[0]
    assert step.penetration == pytest.approx(found.fitted[6], rel=2e-3)


def test_derivatives_by_what_is_known_are_those_of_hertz(found: percoat.Identification) -> None:
    # E is in proportion to (1 − ν²)/√R; derivatives on 48 samples are right to a percent or so.
    young, sensitivities = found.values["substrate.young"], found.sensitivities
    assert sensitivities["substrate.poisson"]["substrate.young"] == pytest.approx(-0.6 * young / 0.91, rel=0.02)
    assert sensitivities["levels.0.radius"]["substrate.young"] == pytest.approx(-young / 20.0, rel=0.02)
    assert list(sensitivities) == ["levels.0.radius", "substrate.poisson", "offset", "frame_compliance"]


def test_a_zero_that_was_missed_is_told_and_can_be_stated(curve: tuple[Any, Any]) -> None:
    force, penetration = curve
    with pytest.warns(UserWarning, match="zero of the penetration seems to be off by .*free `offset`"):
        percoat.identify(CASE, (force, penetration + 5e-3), "substrate.young")
    fit = percoat.identify(CASE, (force, penetration + 5e-3), "substrate.young", known={"offset": 5e-3})
    assert fit.warnings == [] and fit.values["substrate.young"] == pytest.approx(YOUNG, rel=3e-3)
    with pytest.raises(percoat.CaseError, match="known: `zero=1.0` is no `offset=LENGTH`"):
        percoat.identify(CASE, curve, "substrate.young", known={"zero": 1})


Given = Callable[[Any, Any], Any]


def structured(force: Any, penetration: Any) -> Any:
    return np.rec.fromarrays([penetration, force], names="penetration,force").view(np.ndarray)


@pytest.mark.parametrize(
    "given",
    [
        lambda force, penetration: {"force_µN": 1e3 * force, "penetration_nm": 1e3 * penetration, "time": ["x"]},
        lambda force, penetration: [list(force), list(penetration)],
        lambda force, penetration: np.column_stack([force, penetration]),
        structured,
    ],
)
def test_a_curve_has_many_forms(given: Given, curve: tuple[Any, Any], found: percoat.Identification) -> None:
    again = percoat.identify(CASE, given(*curve), "substrate.young")
    assert again.values["substrate.young"] == pytest.approx(found.values["substrate.young"], rel=1e-9)
    assert again.penetration == pytest.approx(found.penetration, rel=1e-14)


def test_a_curve_is_a_frame_or_the_path_of_a_table(
    tmp_path: Path, curve: tuple[Any, Any], found: percoat.Identification
) -> None:
    pandas = pytest.importorskip("pandas")
    force, penetration = curve
    frame = pandas.DataFrame({"force_mN": force, "penetration": penetration, "penetration_error_nm": 1e3 * NOISE})
    fit = percoat.identify(CASE, frame, ["substrate.young", "offset"])
    assert fit.penetration_error == pytest.approx(np.full(12, NOISE), rel=1e-14)
    assert fit.reduced_chi_square == pytest.approx(1.2, rel=0.1)  # twelve points, ten degrees of freedom
    assert abs(fit.values["offset"]) < 3.0 * fit.errors["offset"] and list(fit.values) == ["substrate.young", "offset"]
    assert fit.correlation.shape == (2, 2) and fit.correlation == pytest.approx(fit.correlation.T, abs=1e-12)
    # A stiffer body and a zero that lies deeper make one another up.
    assert fit.correlation[0, 1] > 0.5
    assert "correlation of substrate.young and offset" in str(fit)
    path = tmp_path / "curve.csv"
    frame[["force_mN", "penetration"]].to_csv(path, index=False)
    for data in (path, str(path)):
        again = percoat.identify(CASE, data, ["substrate.young"])
        # A file gives its curve its name.
        (of_file,), (of_arrays,) = again.to_dict()["curves"], found.to_dict()["curves"]
        assert of_file == {**of_arrays, "name": str(path)}
        assert {**again.to_dict(), "curves": [of_arrays]} == found.to_dict() and np.array_equal(again.fitted, found.fitted)


def test_poissons_ratio_stays_within_its_bounds(curve: tuple[Any, Any]) -> None:
    # E is known, and 1 − ν² is 0.91 · 70/E.
    for young, near in ((71.0, 4e-3), (76.0, 0.01)):
        fit = percoat.identify(CASE, curve, ["substrate.poisson"], set={"substrate.young": young})
        low, high = fit.intervals["substrate.poisson"]
        assert fit.values["substrate.poisson"] == pytest.approx(np.sqrt(1.0 - 0.91 * young / YOUNG), abs=near)
        assert 0.0 <= low < fit.values["substrate.poisson"] < high <= 0.5
    # With E = 40 no ratio does.
    with pytest.raises(percoat.CaseError, match="does not converge.*bounds 0 and 0.5|does not determine"):
        percoat.identify(CASE, curve, ["substrate.poisson"], set={"substrate.young": 40.0})


@pytest.mark.parametrize(
    ("data", "free", "error", "words"),
    [
        (([1.0, 2.0], [0.1, 0.2]), [], percoat.CaseError, "nothing is to be found"),
        (([1.0, 2.0], [0.1, 0.2]), ["substrate.yuong"], percoat.CaseError, "free: the case has no number.*yuong"),
        (([1.0, 2.0], [0.1, 0.2]), ["offset", "offset"], percoat.CaseError, "`offset` is there twice"),
        (([1.0, 2.0], [0.1]), ["substrate.young"], percoat.CaseError, "2 forces, but 1 penetrations"),
        (([1.0, 0.0], [0.1, 0.2]), ["substrate.young"], percoat.CaseError, "point 2: the force must be above 0"),
        (
            ([*range(1, 11), 8, 6, 4], [0.1 * k for k in [*range(1, 11), 9, 8, 7]]),
            ["substrate.young"],
            percoat.CaseError,
            "points 10 to 13: the force falls",
        ),
        (([1.0, 2.0], [0.1, np.nan]), ["substrate.young"], percoat.CaseError, "point 2: the penetration must be finite"),
        (([1.0], [0.1]), ["substrate.young"], percoat.CaseError, "more points than parameters"),
        (([[1.0]], [0.1]), ["substrate.young"], percoat.CaseError, "a number for each point"),
        ({"force": [1.0], "deep": [0.1]}, ["offset"], percoat.CaseError, "^no column `penetration` among force"),
        ({"force_lb": [1.0], "penetration": [0.1]}, ["offset"], percoat.CaseError, "`lb` is no unit of force"),
        (np.zeros((3, 4)), ["offset"], percoat.CaseError, "two or three columns"),
        (3.0, ["offset"], TypeError, "a curve is the path of a table"),
        (Path("none.csv"), ["offset"], FileNotFoundError, "none.csv"),
    ],
)
def test_what_is_no_curve_or_not_free_is_refused(
    data: Any, free: list[str], error: type[Exception], words: str
) -> None:
    with pytest.raises(error, match=words):
        percoat.identify(CASE, data, free)


def test_it_is_that_of_the_command_line(
    tmp_path: Path, program: Program, as_piped: None, curve: tuple[Any, Any]
) -> None:
    case = tmp_path / "case.toml"
    case.write_text(
        'title = "A ball on a half-space"\n[lattice]\nkind = "isolated"\nsize = 4.0\n[[levels]]\nshape = "paraboloid"\n'
        "radius = 10.0\n[substrate]\nyoung = 100.0\npoisson = 0.3\n[load]\nforce = 10.0\n[grid]\npoints = 48\n"
        '[units]\nlength = "µm"\npressure = "GPa"\n',
        "utf-8",
    )
    data = tmp_path / "curve.csv"
    np.savetxt(data, np.column_stack(curve), delimiter=",", header="force,penetration", comments="", fmt="%.17g")
    out = tmp_path / "out"
    told = program("identify", data, case, "--free", "substrate.young", "--no-pictures", "-o", out)
    fit = percoat.identify(case, data, ["substrate.young"])
    assert fit.to_dict() == json.loads((out / "identification.json").read_text("utf-8"))
    assert str(fit) in told.stdout
    table = np.genfromtxt(out / "identification.csv", delimiter=",", names=True)
    assert np.array_equal(fit.fitted, table["fitted"]) and np.array_equal(fit.fitted_error, table["fitted_error"])


def test_it_prints_pickles_and_reports_progress(found: percoat.Identification, curve: tuple[Any, Any]) -> None:
    assert repr(found).startswith("<percoat.Identification 'A ball on a half-space': substrate.young = ")
    assert " ± " in repr(found) and "95 % interval" in str(found) and "contact radii" in str(found)
    assert "rms_residual" in dir(found) and found.title == CASE["title"]
    with pytest.raises(AttributeError, match="no 'residuals' here"):
        found.residuals
    for again in (pickle.loads(pickle.dumps(found)), copy.deepcopy(found)):
        assert type(again) is percoat.Identification and again.to_dict() == found.to_dict()
        assert np.array_equal(again.fitted, found.fitted) and str(again) == str(found) and again.values == found.values
    heard: list[percoat.Progress] = []
    percoat.identify(CASE, curve, ["substrate.young"], threads=1, progress=heard.append)
    assert [progress.done for progress in heard] == list(range(1, len(heard) + 1)) and len(heard) > 2
    assert all((progress.unit, progress.of, progress.points) == ("trial", 0, None) for progress in heard)
    assert "residual" in str(heard[-1])


def test_a_listener_that_raises_ends_the_search(curve: tuple[Any, Any]) -> None:
    heard: list[percoat.Progress] = []

    def stop(progress: percoat.Progress) -> None:
        heard.append(progress)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        percoat.identify(CASE, curve, ["substrate.young"], progress=stop)
    assert len(heard) == 1


def test_columns_of_an_instrument_are_taken() -> None:
    case = {
        "lattice": {"kind": "isolated", "size": 4.0},
        "levels": [{"shape": "paraboloid", "radius": 10.0}],
        "substrate": {"young": 100.0, "poisson": 0.3},
        "load": {"force": "1 mN"},
        "grid": {"points": 48},
        "units": {"length": "µm", "pressure": "GPa"},
    }
    depth = np.linspace(10.0, 100.0, 10)
    load = 4 / 3 * 70 / (1 - 0.3**2) * np.sqrt(10.0) * (depth / 1e3) ** 1.5  # Hertz
    table = {
        "operator": ["x"] * 12,
        "Load (mN)": [0.0, *load, 0.5 * load[-1]],
        "Depth (nm)": [0.0, *depth, 60.0],
        "Depth (V)": [0.0] * 12,
    }
    with pytest.warns(Warning, match="left out"):
        found = percoat.identify(case, table, ["substrate.young"], segment="loading")
    assert round(found.values["substrate.young"]) == 70 and found.fitted.shape == (10,)
    with pytest.raises(percoat.CaseError, match="segment must be"):
        percoat.identify(case, table, ["substrate.young"], segment="creep")


def unloading(force: float, depth: float, stiffness: float) -> dict[str, Any]:
    """Loading, and an unloading by a power law of m = 1.5; mN and µm."""
    part = np.linspace(1.0, 0.0, 81)
    loose = depth + 1.5 * force / stiffness * (part ** (1.0 / 1.5) - 1.0)
    up = np.linspace(0.05, 0.95, 19)
    return {"force": force * np.concatenate([up, part]), "depth": np.concatenate([depth * np.sqrt(up), loose])}


def test_unloading_of_a_bare_body_has_the_modulus_of_oliver_and_pharr() -> None:
    # E_r = S/(2βa) with a² = 2R h_c and h_c = h − 3P/(4S), R = 10 µm.
    force, depth, beta = 40.0, 0.3, 1.02
    young, tests = [], []
    for stiffness in (300.0, 330.0):
        radius = np.sqrt(2.0 * 10.0 * (depth - 0.75 * force / stiffness))
        young.append(0.91 * stiffness / (2.0 * beta * radius))
        tests.append(unloading(force, depth, stiffness))
    settings: dict[str, Any] = {"segment": "unloading", "known": {"beta": beta}}
    one = percoat.identify(CASE, tests[0], "substrate.young", **settings)
    assert one.values["substrate.young"] == pytest.approx(young[0], rel=1e-5)
    assert one.unloading is not None
    test = one.unloading.tests[0]
    assert (test.bare_young, test.epsilon) == (pytest.approx(young[0], rel=1e-5), 0.75)
    assert test.stiffness == pytest.approx(300.0, rel=1e-5) and one.unloading.beta == beta
    assert test.hardness == pytest.approx(force / (np.pi * test.contact_radius**2), rel=1e-12)
    assert one.fitted == pytest.approx(one.penetration, rel=1e-6) and 0.25 * force <= one.force.min()
    with pytest.warns(Warning, match="differ by more than their errors"):
        both = percoat.identify(CASE, tests, "substrate.young", part=(0.4, 0.9), **settings)
    assert young[0] < both.values["substrate.young"] < young[1] and len(both.unloading.tests) == 2
    assert sorted(set(both.curve)) == [0, 1] and both.force.min() >= 0.4 * force
    with pytest.raises(percoat.CaseError, match="curve 2: there is no unloading"):
        percoat.identify(CASE, [tests[0], {key: column[:19] for key, column in tests[1].items()}], "offset", segment="unloading")
    with pytest.raises(percoat.CaseError, match="fitted part is that of unloading"):
        percoat.identify(CASE, tests[0], "substrate.young", segment="loading", part=(0.4, 0.9))


def test_curves_of_loading_have_a_zero_each(curve: tuple[Any, Any]) -> None:
    force, penetration = curve
    free = ["substrate.young", "offset"]
    both = percoat.identify(CASE, [(force, penetration + 0.01), (force, penetration - 0.01)], free)
    alone = percoat.identify(CASE, curve, free)
    assert both.values["substrate.young"] == pytest.approx(alone.values["substrate.young"], rel=1e-4)
    assert both.values["offset.0"] - both.values["offset.1"] == pytest.approx(0.02, rel=1e-4)
    assert [record.points for record in both.curves] == [12, 12] and both.unloading is None
