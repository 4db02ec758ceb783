"""The layered half-space alone, held against closed forms and amplitudes of 120-digit arithmetic."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import percoat

# ANCHORS 2.6: G₂ = 1, k = 1, p = cos x. χ, ν₁, ν₂, thickness, interface; T, p₁ = −σ_zz and t₁ = τ_xz at the
# interface, and σ_xx at the surface, at the interface in the coating and in the substrate. Twelve digits are
# printed.
SPRING = {"tangential_stiffness": 1.0, "normal_stiffness": 1.0}
AMPLITUDES: list[tuple[float, float, float, float, Any, tuple[float, ...]]] = [
    (2.0, 0.20, 0.30, 0.1, "bonded",
     (1.72526660632, 0.994521630277, -0.10408421515, -1.20795861687, -0.878857284822, -0.786353199977)),
    (2.0, 0.20, 0.30, 0.5, "frictionless",
     (1.93268354951, 0.964109124424, 0.0, -0.888918130799, 0.848340643292, -0.964109124424)),
    (2.0, 0.20, 0.30, 1.0, SPRING,
     (2.59718000953, 0.556183567644, -0.265305050982, -2.30555518188, 1.55986347379, -0.025573465681)),
    (2.0, 0.20, 0.30, 4.0, "bonded",
     (1.00660669173, 0.0695381015879, -0.0567218173584, -1.01032271961, 0.111603733769, 0.0439055331289)),
    (0.5, 0.45, 0.30, 0.5, "bonded",
     (0.606912178864, 0.904820692404, -0.35648007741, -0.909294892284, -0.615631628865, -0.191860537585)),
    (0.5, 0.45, 0.30, 1.0, "frictionless",
     (1.03780023197, 0.889505549462, 0.0, -0.762013960396, 0.60982407165, -0.889505549462)),
    (0.5, 0.45, 0.30, 1.0, SPRING,
     (1.30443285527, 0.697369907691, -0.357952074601, -1.25592820044, 0.282232885132, 0.0185342415112)),
]  # fmt: skip


def body(chi: float, upper: float, lower: float, thickness: float, interface: Any) -> percoat.HalfSpace:
    layer = {"thickness": thickness, "shear_ratio": chi, "poisson": upper, "interface": interface}
    return percoat.HalfSpace([layer], {"young": 2.0 * (1.0 + lower), "poisson": lower})


@pytest.mark.parametrize("poisson", [0.0, 0.3, 0.5])
def test_a_bare_half_space_yields_by_two_over_modulus_and_wavenumber(poisson: float) -> None:
    bare = percoat.HalfSpace(substrate={"young": 3.0, "poisson": poisson})
    q = np.geomspace(1e-6, 1e6, 25)
    exact = 2.0 * (1.0 - poisson**2) / (3.0 * q)
    assert np.allclose(bare.compliance(q), exact, rtol=1e-14, atol=0.0)
    assert np.allclose(bare.correction(q), 1.0, rtol=1e-14, atol=0.0)


@pytest.mark.parametrize("chi, upper, lower, thickness, interface, amplitudes", AMPLITUDES)
def test_a_layer_has_the_amplitudes_of_many_digits(
    chi: float, upper: float, lower: float, thickness: float, interface: Any, amplitudes: tuple[float, ...]
) -> None:
    layered = body(chi, upper, lower, thickness, interface)
    response = layered.kernel(1.0, [0.0, thickness])
    assert response.z.tolist() == [0.0, thickness, thickness] and response.side.tolist() == [1, 1, 2]
    found = [
        response.correction, -response.szz[1], response.sqz[1],
        response.sqq[0], response.sqq[1], response.sqq[2],
    ]
    # Twelve digits of numbers of the order of one.
    assert np.allclose(found, amplitudes, rtol=1e-11, atol=1e-12)
    assert response.szz[0] == -1.0 and response.sqz[0] == 0.0
    # The interface hands on what it bears.
    assert np.allclose(
        [response.szz[1], response.sqz[1]], [response.szz[2], response.sqz[2]], rtol=1e-12, atol=1e-14
    )
    assert layered.correction(1.0) == response.correction and layered.compliance(1.0) == response.compliance


def test_the_compliance_is_the_correction_of_the_coating_alone() -> None:
    layered = body(2.0, 0.2, 0.3, 0.5, "bonded")
    q = np.geomspace(0.01, 100.0, 13)
    # G₁ = 2: 2/(E₁* q) = (1 − ν₁)/(G₁ q).
    assert np.allclose(layered.compliance(q), 0.8 / (2.0 * q) * layered.correction(q), rtol=1e-14, atol=0.0)
    # Long waves feel the substrate, T → E₁*/E₂* = χ (1 − ν₂)/(1 − ν₁), short ones the coating.
    assert layered.correction(1e-9) == pytest.approx(2.0 * 0.7 / 0.8, rel=1e-8)
    assert layered.correction(1e3) == 1.0


def test_the_surface_moves_as_its_displacement_says() -> None:
    response = percoat.kernel("fig2", [0.5, 3.0], depth=0.0)
    assert np.array_equal(response.uz[:, 0], response.compliance)
    assert np.allclose(-response.uq[:, 0], response.coupling, rtol=1e-15, atol=0.0)


@pytest.mark.parametrize("traction, first, others", [("along", "sqz", ["szz"]), ("across", "stz", [])])
def test_the_surface_bears_the_traction(traction: str, first: str, others: list[str]) -> None:
    response = percoat.kernel("fig2", [0.5, 3.0], [0.0, 0.2], traction)
    # The body feels cos(qx) on a face whose outer normal is −z.
    assert np.array_equal(response[first][:, 0], [-1.0, -1.0])
    assert all(not response[other][:, 0].any() for other in others)
    normal = {"szz", "sqz", "sqq", "stt", "uz", "uq"}
    expected = normal if traction == "along" else {"stz", "sqt", "ut"}
    assert set(response) - {"wavenumber", "compliance", "correction", "coupling", "z", "side"} == expected
    assert ("coupling" in response) == (traction == "along")


def test_a_bare_half_space_under_shear_across_yields_by_its_shear_modulus() -> None:
    # Antiplane shear: u_t = e^(−qz)/(G q), σ_tz = −e^(−qz).
    bare = percoat.HalfSpace(substrate={"young": 2.6, "poisson": 0.3})
    q, z = 3.0, 0.7
    response = bare.kernel(q, [0.0, z], "across")
    assert response.compliance == pytest.approx(1.0 / q, rel=1e-14)
    assert np.allclose(response.ut, [1.0 / q, np.exp(-q * z) / q], rtol=1e-13)
    assert np.allclose(response.stz, [-1.0, -np.exp(-q * z)], rtol=1e-13)


@pytest.mark.parametrize("shape", [(), (1,), (5,), (2, 3), (2, 0), (0,), (2, 1, 2)])
def test_results_have_the_shape_of_the_wavenumbers(shape: tuple[int, ...]) -> None:
    q = np.linspace(1.0, 2.0, int(np.prod(shape))).reshape(shape)
    coated = percoat.HalfSpace.of("fig2")
    assert np.shape(coated.compliance(q)) == np.shape(coated.correction(q)) == shape
    response = percoat.kernel("fig2", q, depth=[0.1, 0.5])
    assert np.shape(response.wavenumber) == np.shape(response.compliance) == shape
    assert response.z.shape == response.side.shape == (3,) and response.szz.shape == (*shape, 3)
    assert np.array_equal(response.wavenumber, q)


def test_wavenumbers_of_any_kind_give_the_same() -> None:
    coated = percoat.HalfSpace.of("fig2")
    expected = coated.compliance(np.array([1.0, 2.0, 3.0, 4.0]))
    forms: list[Any] = [
        [1, 2, 3, 4],
        (1.0, 2.0, 3.0, 4.0),
        np.arange(1, 5, dtype=np.int8),
        np.arange(1.0, 5.0, dtype=np.float32),
        np.arange(4.0, 0.0, -1.0)[::-1],
        np.arange(1.0, 5.0, 0.5)[::2],
        np.arange(1.0, 5.0, dtype=">f8"),
    ]
    for form in forms:
        assert np.array_equal(coated.compliance(form), expected), form
    assert isinstance(coated.compliance(1), float) and coated.compliance(1) == expected[0]


def test_a_half_space_is_that_of_its_case() -> None:
    case = percoat.case("dlc-on-steel")
    by_hand = percoat.HalfSpace(case["layers"], case["substrate"])
    of = percoat.HalfSpace.of("dlc-on-steel")
    changed = percoat.HalfSpace.of("dlc-on-steel", set={"layers.0.thickness": 3.0})
    q = np.geomspace(0.01, 10.0, 20)
    assert np.array_equal(by_hand.compliance(q), of.compliance(q)) and str(by_hand) == str(of)
    assert np.array_equal(percoat.kernel("dlc-on-steel", q).compliance, of.compliance(q))
    kernel = percoat.kernel("dlc-on-steel", q, set={"layers.0.thickness": 3.0})
    assert np.array_equal(kernel.compliance, changed.compliance(q))
    assert not np.array_equal(kernel.compliance, of.compliance(q))


def test_layers_may_come_in_any_sequence() -> None:
    layer = {"thickness": np.float64(0.5), "shear_ratio": 2, "poisson": np.float32(0.25)}
    substrate = {"young": 1, "poisson": 0.3}
    expected = percoat.HalfSpace([layer], substrate).compliance(1.0)
    assert percoat.HalfSpace((layer,), substrate).compliance(1.0) == expected
    array: Any = np.array([layer])
    assert percoat.HalfSpace(array, substrate).compliance(1.0) == expected
    assert percoat.HalfSpace(layers=(), substrate=substrate).correction(1.0) == 1.0


def test_many_layers_of_one_material_are_none() -> None:
    substrate = {"young": 1.0, "poisson": 0.3}
    layers = [{"thickness": 0.1, "young": 1.0, "poisson": 0.3}] * 20
    q = np.geomspace(0.01, 100.0, 9)
    # Twenty products of matrices, each of some roundings.
    assert np.allclose(percoat.HalfSpace(layers, substrate).correction(q), 1.0, rtol=1e-13, atol=0.0)


def test_half_spaces_print_themselves() -> None:
    coated = percoat.HalfSpace.of("dlc-on-steel")
    assert len(str(coated).splitlines()) == 3 and "substrate (steel): E 210" in str(coated)
    assert repr(coated) == f"<percoat.HalfSpace: {str(coated).splitlines()[0]}>"


@pytest.mark.parametrize("name", ["fig2", "dlc-on-steel", "ring"])
def test_half_spaces_pickle(name: str) -> None:
    coated = percoat.HalfSpace.of(name)
    q = np.geomspace(0.01, 100.0, 30)
    for again in (pickle.loads(pickle.dumps(coated)), copy.copy(coated), copy.deepcopy(coated)):
        assert np.array_equal(again.compliance(q), coated.compliance(q)) and str(again) == str(coated)


def test_a_half_space_of_a_surface_needs_no_surface_to_be_pickled() -> None:
    surface = percoat.HalfSpace.of("rough", set={"grid.points": 64})
    again = pickle.loads(pickle.dumps(surface))
    assert again.compliance(1.0) == surface.compliance(1.0)
    heights = np.outer(np.cos(np.arange(512)), np.cos(np.arange(512)))
    case = {
        "surface": {"heights": heights, "period": [1.0, 1.0]},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": 1.0},
    }
    # Two megabytes of heights are not in what says three numbers.
    state = pickle.dumps(percoat.HalfSpace.of(case))
    assert len(state) < 10_000 and pickle.loads(state).correction(1.0) == 1.0
