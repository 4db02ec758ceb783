"""Stresses inside the body: closed forms, and one way of asking against the other."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import percoat
from conftest import wave

Q = np.pi  # of the wave, of wavelength 2


def exact(x: Any, z: Any, mean: float, poisson: float = 0.3) -> dict[str, Any]:
    """Under p̄ + P cos(qx) on a half-space of E = 1 without mean lateral strain (ANCHORS 3.2)."""
    p = Q * 0.01 / (2.0 * 0.91)
    decay, cos, sin = p * np.exp(-Q * z), np.cos(Q * x), np.sin(Q * x)
    shear = 1.0 / 2.6
    confined = 2.0 * shear * (1.0 - poisson) / (1.0 - 2.0 * poisson)
    return {
        "xx": -poisson / (1.0 - poisson) * mean - decay * (1.0 - Q * z) * cos,
        "yy": -poisson / (1.0 - poisson) * mean - 2.0 * poisson * decay * cos,
        "zz": -mean - decay * (1.0 + Q * z) * cos,
        "xz": -decay * Q * z * sin,
        "xy": 0.0 * x,
        "yz": 0.0 * x,
        # From the mean plane of the surface, toward which the mean pressure shortens what lies above z.
        "uz": decay / (2.0 * shear * Q) * (2.0 - 2.0 * poisson + Q * z) * cos - mean * z / confined,
        "ux": -decay / (2.0 * shear * Q) * (1.0 - 2.0 * poisson - Q * z) * sin,
        "uy": 0.0 * x,
    }


# All numbers are of the order 0.05 and below, and sums have some ten terms that do not vanish.
ROUNDING = 1e-14


@pytest.mark.parametrize("z", [0.0, 0.1, 1.0 / np.pi, 2.0])
def test_a_wave_has_the_stresses_of_its_closed_form(flat_wave: percoat.Result, z: float) -> None:
    for step in flat_wave:
        plane = step.plane(z)
        for name, values in exact(plane.x, z, step.mean_pressure).items():
            assert np.abs(plane[name] - values).max() < ROUNDING, name
        assert (plane.z, plane.material) == (z, 1)


def test_a_wave_has_the_shear_of_its_closed_form(flat_wave: percoat.Result) -> None:
    # Where cos(qx) = 0 the mean stress has σ_xx = σ_yy, and the wave adds pure shear qz e^(−qz): its circle
    # is exact.
    mean, z, p = flat_wave[0].mean_pressure, 1.0 / Q, Q * 0.01 / (2.0 * 0.91)
    stress = flat_wave[0].stress([0.5, 0.0, z])
    half = 0.5 * mean * (1.0 - 3.0 / 7.0)
    assert percoat.tau1(stress) == pytest.approx(np.hypot(half, p / np.e), rel=1e-12)


def test_a_section_is_that_of_the_closed_form(flat_wave: percoat.Result) -> None:
    step = flat_wave[0]
    section = step.section((0.25, 0.1), (1.0, 0.0), length=1.5, depth=0.75, behind=0.5)
    assert (section.s[0], section.s[-1], section.z[0], section.z[-1]) == (-0.5, 1.0, 0.0, 0.75)
    assert np.allclose(section.x, 0.25 + section.s, rtol=0.0, atol=1e-15) and np.all(section.y == 0.1)
    assert section.xx.shape == (len(section.z), len(section.s)) and set(section.material) == {1}
    for name, values in exact(section.x[None, :], section.z[:, None], step.mean_pressure).items():
        assert np.abs(section[name] - values).max() < ROUNDING, name


def test_points_are_those_of_the_closed_form(flat_wave: percoat.Result) -> None:
    random = np.random.default_rng(3)
    # Also far outside of the cell, and in no order of depth.
    points = random.uniform([-10.0, -10.0, 0.0], [10.0, 10.0, 2.0], (4, 7, 3))
    for step in flat_wave:
        stress = step.stress(points)
        values = exact(points[..., 0], points[..., 2], step.mean_pressure)
        assert stress.shape == (4, 7, 6)
        for index, name in enumerate(percoat.COMPONENTS[:6]):
            assert np.abs(stress[..., index] - values[name]).max() < 10.0 * ROUNDING, name


def test_the_mean_stress_is_confined_or_that_of_a_half_space() -> None:
    confined, free = (percoat.solve(wave(stress={"mean": mean}))[0] for mean in ("confined", "half-space"))
    # Under a wide disc of pressure: σ_r = −(1 + 2ν) p̄/2 at the surface (ANCHORS 3.1); without mean strain
    # −ν/(1 − ν) p̄.
    difference = free.plane(0.4).xx - confined.plane(0.4).xx
    assert np.allclose(difference, -0.02 * (0.8 - 3.0 / 7.0), rtol=1e-11)


@pytest.mark.parametrize("z, material", [(0.0, 1), (0.2, 1), (0.5, 1), (0.5, 2), (0.9, 2)])
def test_points_planes_and_sections_agree(three_levels: percoat.Result, z: float, material: int) -> None:
    step = three_levels[1]
    plane = step.plane(z, material=material)
    places = np.stack([plane.x, plane.y, np.full_like(plane.x, z)], axis=-1)[::16, ::12]
    stress = step.stress(places, material=material)
    # A sum over 96² waves in another order: roundings of that many numbers up to 0.4.
    for index, name in enumerate(percoat.COMPONENTS[:6]):
        assert np.abs(stress[..., index] - plane[name][::16, ::12]).max() < 1e-12, name
    if z == 0.0:
        return  # a section sharpens the edges of the contact there
    a1 = three_levels.a1
    section = step.section((0.0, 0.0), tuple(a1), length=float(np.hypot(*a1)), depth=1.0)
    row = int(np.flatnonzero((np.abs(section.z - z) < 1e-12) & (section.material == material))[0])
    along = section.s / np.hypot(*a1) * 96
    here = np.abs(along - np.rint(along)) < 1e-9
    assert here.sum() >= 2
    for name in percoat.COMPONENTS[:9]:
        values = plane[name][np.rint(along[here]).astype(int) % 96, 0]
        assert np.abs(section[name][row, here] - values).max() < 1e-12, name


def test_the_sides_of_an_interface(three_levels: percoat.Result) -> None:
    step = three_levels[1]
    upper, lower = step.plane(0.5, material=1), step.plane(0.5, material=2)
    assert np.array_equal(step.plane(0.5).xx, upper.xx) and (upper.material, lower.material) == (1, 2)
    for name in ("zz", "xz", "yz", "ux", "uy", "uz"):
        assert np.abs(upper[name] - lower[name]).max() < 1e-13, name
    # What is bonded is strained alike: σ_xx + σ_yy = 4 G ε/(1 − ν) + 2 ν σ_zz/(1 − ν) with 2ε = ε_xx + ε_yy
    # of both.
    (g1, nu1), (g2, nu2) = (2.0 / 2.6, 0.2), (1.0 / 2.6, 0.3)
    strains = [
        ((side.xx + side.yy) * (1.0 - nu) - 2.0 * nu * side.zz) / (2.0 * g * (1.0 + nu))
        for side, g, nu in ((upper, g1, nu1), (lower, g2, nu2))
    ]
    assert np.abs(strains[0] - strains[1]).max() < 1e-13 and np.ptp(upper.xx - lower.xx) > 1e-3


def test_the_surface_bears_the_pressure(three_levels: percoat.Result) -> None:
    for step in three_levels:
        surface = step.plane(0.0)
        assert np.abs(surface.zz + step.pressure).max() < 1e-13
        assert np.abs(surface.uz - step.displacement).max() < 1e-13
        assert np.abs(surface.xz).max() == 0.0


def test_sliding_adds_its_traction() -> None:
    friction = {"coefficient": 0.3, "direction": [3.0, 4.0], "coupling": False}
    step = percoat.solve("fig2", set={"grid.points": 96, "friction": friction})[0]
    surface = step.plane(0.0)
    # The body feels μp along the direction of sliding, on a face whose outer normal is −z: σ_xz = −μ p cos φ.
    assert np.abs(surface.xz + 0.3 * 0.6 * step.pressure).max() < 1e-13
    assert np.abs(surface.yz + 0.3 * 0.8 * step.pressure).max() < 1e-13
    assert step.friction.residual < 1e-8


@pytest.mark.parametrize("points", [32, np.int64(32), (32, 48), [45, 50], np.array([31, 1]), (1, 1)])
def test_a_plane_has_the_points_asked_for(flat_wave: percoat.Result, points: Any) -> None:
    plane = flat_wave[0].plane(0.25, points=points)
    n1, n2 = (int(points), int(points)) if np.ndim(points) == 0 else map(int, points)
    assert plane.x.shape == plane.y.shape == plane.mises.shape == (n1, n2)
    assert np.allclose(plane.x[:, 0], 2.0 * np.arange(n1) / n1)
    assert np.allclose(plane.y[0], 0.5 * np.arange(n2) / n2)
    values = exact(plane.x, 0.25, flat_wave[0].mean_pressure)
    assert np.abs(plane.zz - values["zz"]).max() < ROUNDING
    assert f"{n1} × {n2} points at z = 0.25, in material 1" in repr(plane)


def test_the_maxima_are_at_their_places(three_levels: percoat.Result) -> None:
    step = three_levels[1]
    maxima = step.maxima()
    assert maxima is not None and step.maxima() == maxima
    invariants = {"max_tau1": percoat.tau1, "max_mises": percoat.mises}
    for name, invariant in invariants.items():
        peak = maxima[name]
        stress = step.stress([peak.x, peak.y, peak.z], material=peak.material)
        assert invariant(stress) == pytest.approx(peak.value, rel=1e-9), name
        # Nowhere on a section through the largest contact is it larger.
        section = step.section("level 1", "level 2", length=1.0, depth=1.0)
        assert section["tau1" if name == "max_tau1" else "mises"].max() <= peak.value * (1.0 + 1e-9)
    assert maxima.max_tau1.material == 1 and [peaks.interface for peaks in maxima.interfaces] == [1]
    shear = maxima.interfaces[0].max_shear
    xz, yz = step.stress([shear.x, shear.y, shear.z])[[4, 5]]
    assert np.hypot(xz, yz) == pytest.approx(shear.value, rel=1e-9)


def test_what_the_case_asks_for_is_what_the_step_finds() -> None:
    settings = {"grid.points": 96, "stress.planes": [0.1]}
    asked = percoat.solve("fig2", set=settings)[0]
    found = percoat.solve("fig2", set={"grid.points": 96})[0]
    assert "stress" in asked.to_dict() and "stress" not in found.to_dict()
    maxima = found.maxima()
    assert maxima is not None and maxima == asked.maxima()
    assert maxima.to_dict() == asked.to_dict()["stress"]


def test_invariants_of_a_stress() -> None:
    random = np.random.default_rng(5)
    stress = random.normal(size=(3, 5, 6))
    principal = percoat.principal(stress)
    assert principal.shape == (3, 5, 3) and np.all(np.diff(principal, axis=-1) <= 0.0)
    xx, yy, zz, xy, xz, yz = np.moveaxis(stress, -1, 0)
    # Trace and determinant of a tensor do not depend on its axes.
    assert np.allclose(principal.sum(axis=-1), xx + yy + zz, rtol=0.0, atol=1e-13)
    determinant = xx * yy * zz + 2.0 * xy * xz * yz - xx * yz**2 - yy * xz**2 - zz * xy**2
    assert np.allclose(principal.prod(axis=-1), determinant, rtol=1e-12, atol=1e-13)
    assert np.array_equal(percoat.s1(stress), principal[..., 0])
    assert np.allclose(percoat.tau1(stress), 0.5 * np.ptp(principal, axis=-1), rtol=1e-14)
    mises = np.sqrt(0.5 * sum((principal[..., i] - principal[..., i - 1]) ** 2 for i in range(3)))
    assert np.allclose(percoat.mises(stress), mises, rtol=1e-12)
    # Lists of whole numbers, and one tensor alone.
    assert percoat.mises([2, 0, 0, 0, 0, 0]) == 2.0
    assert percoat.principal([1, 2, 3, 0, 0, 0]).tolist() == [3.0, 2.0, 1.0]


def test_invariants_of_points_are_those_of_planes(three_levels: percoat.Result) -> None:
    plane = three_levels[1].plane(0.3)
    stress = np.stack([plane[name] for name in percoat.COMPONENTS[:6]], axis=-1)
    assert np.abs(percoat.mises(stress) - plane.mises).max() < 1e-14
    # On the axis of a contact two principal stresses are equal, and the closed formula for the roots of a
    # cubic loses half of the digits there: √(2⁻⁵²) = 1.5e-8 of the deviator, at most 0.2.
    assert np.abs(percoat.tau1(stress) - plane.tau1).max() < 1.5e-8 * 0.2
    assert np.abs(percoat.s1(stress) - plane.s1).max() < 1.5e-8 * 0.2


@pytest.mark.parametrize("shape", [(0, 3), (5, 0, 3), (3,), (1, 1, 1, 3)])
def test_points_of_any_shape(three_levels: percoat.Result, shape: tuple[int, ...]) -> None:
    assert three_levels[0].stress(np.zeros(shape)).shape == (*shape[:-1], 6)


def test_points_in_any_memory(three_levels: percoat.Result) -> None:
    points = np.random.default_rng(1).uniform(0.0, 0.4, (6, 3))
    expected = three_levels[0].stress(points)
    for form in (
        points.tolist(), np.asfortranarray(points), points[::-1][::-1], np.repeat(points, 2, axis=0)[::2]
    ):
        assert np.array_equal(three_levels[0].stress(form), expected)
    whole = np.array([[0, 0, 1], [1, 1, 2]])
    assert np.array_equal(three_levels[0].stress(whole), three_levels[0].stress(whole.astype(float)))


def test_strains_follow_hookes_law_at_points_on_planes_and_on_sections(three_levels: percoat.Result) -> None:
    step = three_levels[1]
    case = three_levels.case
    young, nu = case["substrate"]["young"], case["substrate"]["poisson"]
    point = [0.1, 0.2, 0.7]
    stress, strain = step.stress(point), step.strain(point)
    expected = (1.0 + nu) / young * stress
    expected[:3] -= nu / young * stress[:3].sum()
    assert np.allclose(strain, expected, rtol=1e-12, atol=1e-15)
    assert step.strain(np.zeros((2, 5, 3))).shape == (2, 5, 6)
    plane, section = step.plane(0.7, strain=True), step.section("level 1", "level 2", length=1.0, depth=1.0, strain=True)
    for field in (plane, section):
        below = slice(None) if field is plane else section.material == 2
        strains = np.stack([field[name][below] for name in percoat.STRAINS[:6]], axis=-1)
        stresses = np.stack([field[name][below] for name in percoat.COMPONENTS[:6]], axis=-1)
        hydrostatic = nu / young * stresses[..., :3].sum(axis=-1, keepdims=True) * [1, 1, 1, 0, 0, 0]
        assert np.abs(strains - (1.0 + nu) / young * stresses + hydrostatic).max() < 1e-15
        principal = np.stack([field[name][below] for name in ("e1", "e2", "e3")], axis=-1)
        # Half of the digits are lost where two are equal, as of stresses.
        assert np.abs(percoat.principal(strains) - principal).max() < 1.5e-8 * np.abs(strains).max()
        assert np.abs(strains[..., :3].sum(axis=-1) - field.ev[below]).max() < 1e-16
    assert not set(percoat.STRAINS) & {*step.plane(0.7), *step.section("level 1", "level 2", length=1.0, depth=1.0)}


def test_the_largest_strains_are_there_where_the_case_asks_for_them() -> None:
    settings = {"grid.points": 96, "stress.strain": True}
    step = percoat.solve("fig2", set=settings)[0]
    maxima = step.maxima()
    assert maxima is not None and maxima.to_dict() == step.to_dict()["stress"]
    for peaks in [maxima, *maxima.materials, *maxima.faces]:
        assert peaks.max_strain.error > 0.0 and peaks.max_vertical_compression.value > 0.0
    peak = maxima.materials[1].max_vertical_compression
    there = step.strain([peak.x, peak.y, peak.z], material=2)
    assert -there[2] == pytest.approx(peak.value, rel=1e-9)
    without = percoat.solve("fig2", set={"grid.points": 96})[0].maxima()
    assert without is not None and "max_strain" not in without
    assert without.max_tau1 == maxima.max_tau1
