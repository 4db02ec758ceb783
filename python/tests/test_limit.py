"""Limit loads are loads at which something is at its limit."""

from __future__ import annotations

import copy
import pickle
from typing import Any

import numpy as np
import pytest

import percoat

SETTINGS = {"grid.points": 64, "load.mean_pressure": [0.05, 0.2]}


@pytest.fixture(scope="module")
def limits() -> percoat.Limits:
    return percoat.limit("dlc-on-steel", set=SETTINGS)


def test_limits_are_sorted_and_the_first_is_first(limits: percoat.Limits) -> None:
    loads = [limit.mean_pressure for limit in limits.limits if limit.mean_pressure is not None]
    assert limits.first is not None and limits.first.mean_pressure == min(loads)
    first = limits.first.to_dict()
    # Other criteria that may come before it by the errors of both.
    rivals = first.pop("rivals")
    names = {f"{limit.criterion} of {'material' if limit.get('material') else 'interface'}" for limit in limits.limits}
    assert all(rival.rsplit(" ", 1)[0] in names for rival in rivals)
    assert first == next(limit.to_dict() for limit in limits.limits if limit.mean_pressure == min(loads))
    low, high = first["interval"]
    assert low <= min(loads) <= high
    kinds = {(limit.criterion, limit.get("material"), limit.get("interface")) for limit in limits.limits}
    assert kinds == {
        ("yield", 1, None), ("yield", 2, None), ("yield", 3, None), ("cracking", 1, None),
        ("delamination", None, 1), ("delamination", None, 2),
    }  # fmt: skip
    assert limits.converged and limits.title == percoat.cases()["dlc-on-steel"]


def test_at_its_limit_a_material_is_used_up(limits: percoat.Limits) -> None:
    # The load of each limit, solved: what bears up to it has a utilisation of one, within the stated error of
    # the load. Utilisation grows no faster than the load, for under Hertz stresses grow as its third root, by
    # which what is residual does not grow.
    inside = [limit for limit in limits.limits if limit.z > 0.0]
    assert len(inside) == 4
    for limit in inside:
        step = percoat.solve("dlc-on-steel", set={**SETTINGS, "load.mean_pressure": limit.mean_pressure})[0]
        place = "material" if "material" in limit else "interface"
        (used,) = [
            used for used in step.strength if (used.criterion, used.get(place)) == (limit.criterion, limit[place])
        ]
        assert used.utilisation == pytest.approx(1.0, abs=limit.error / limit.mean_pressure), limit
        assert (used.x, used.y, used.z) == pytest.approx((limit.x, limit.y, limit.z), abs=0.02)


def paraboloids(strength: float, **sections: Any) -> dict[str, Any]:
    """Paraboloids of radius 0.8 on the triangular lattice of period 1, on a half-space of E* = 1."""
    return {
        "lattice": {"kind": "hexagonal", "period": 1.0},
        "levels": [{"shape": "paraboloid", "radius": 0.8}],
        "substrate": {"young": 0.91, "poisson": 0.3, "yield_strength": strength},
        "load": {"mean_pressure": 1e-3},
        "grid": {"points": 128},
        **sections,
    }


@pytest.mark.parametrize("strength", [0.03, 0.04])
def test_the_yield_of_a_half_space_is_that_of_hertz(strength: float) -> None:
    # Von Mises' stress is twice the largest shear, 0.310021 p₀ (ν = 0.3, ANCHORS 3.1), with p₀ = 2 E* a/(π R)
    # and P = 2 p₀ π a²/3. Neighbours change p₀ by less than S₃ a³ = 11.03 a³ of it (1.5), the mean stress
    # adds p̄ at most.
    peak = strength / (2.0 * 0.310021)
    a = 0.5 * np.pi * 0.8 * peak
    mean = 2.0 / 3.0 * np.pi * a**2 * peak / np.sqrt(0.75)
    # The load grows as the cube of the stress.
    neighbours = 3.0 * (11.03 * a**3 + mean / strength)
    assert neighbours < 0.1
    first = percoat.limit(paraboloids(strength)).first
    assert first is not None and (first.criterion, first.material) == ("yield", 1)
    assert first.mean_pressure == pytest.approx(mean, abs=neighbours * mean + first.error)
    assert first.error < 0.03 * mean
    # At a depth of 0.480864 a (3.1); where the stress is largest it is flat, so that the place is known less
    # well: to a tenth of a, by which it falls by less than 2 %.
    assert first.z == pytest.approx(0.480864 * a, abs=0.1 * a) and np.hypot(first.x, first.y) < 0.1 * a


def test_what_never_fails_has_no_limit() -> None:
    # The largest tension under Hertz is at the edge; a coating pulled tight by its own stress is beyond it
    # without a load.
    layer = {"thickness": 0.5, "young": 0.91, "poisson": 0.3, "tensile_strength": 0.1, "residual_stress": 0.2}
    cracked = percoat.limit(paraboloids(1.0, layers=[layer]))
    assert cracked.first is not None
    assert (cracked.first.criterion, cracked.first.mean_pressure) == ("cracking", 0.0)
    # An interface under compression alone does not open, up to complete contact.
    layer = {"thickness": 0.5, "young": 0.91, "poisson": 0.3, "interface_strength": {"normal": 100.0}}
    sound = percoat.limit(paraboloids(1e6, layers=[layer], grid={"points": 64}))
    opening = next(limit for limit in sound.limits if limit.criterion == "delamination")
    assert sound.first is None and opening.mean_pressure is None and opening.up_to > 1.0
    assert repr(sound).endswith(": nothing fails>") and "nothing fails up to the mean pressure" in str(sound)


def test_limits_up_to_a_load_with_its_unit() -> None:
    found = percoat.limit("ball-on-disc", up_to="5 mN", set={"grid.points": 32})
    assert found.first is None and max(limit.up_to for limit in found.limits) <= 5.0 * (1 + 1e-9)
    with pytest.raises(percoat.CaseError, match="must be a force"):
        percoat.limit("ball-on-disc", up_to="5 µm", set={"grid.points": 32})


def test_doubts_about_limits_are_told_at_the_line_of_the_user() -> None:
    with pytest.warns(percoat.PercoatWarning, match="fewer than 10 samples") as caught:
        limits = percoat.limit(paraboloids(0.04, grid={"points": 48}))
    assert [str(warning.message) for warning in caught] == limits.warnings and limits.converged
    assert {warning.filename for warning in caught} == {__file__}


def test_limits_of_what_has_not_converged_are_told() -> None:
    case = paraboloids(0.04, grid={"points": 96}, solver={"max_iterations": 2})
    with pytest.warns(percoat.NotConverged) as caught:
        limits = percoat.limit(case)
    assert not limits.converged
    assert {warning.filename for warning in caught} == {__file__}


def test_limits_print_their_table(limits: percoat.Limits) -> None:
    assert str(limits).startswith(limits.title) and "delamination of chromium/steel" in str(limits)
    assert repr(limits).startswith(f"<percoat.Limits {limits.title!r}: yield of chromium at mean pressure 0.04")


def test_names_of_materials_stand_in_the_place_of_their_numbers() -> None:
    names = {"layers.0.name": "DLC", "layers.1.name": "Cr", "substrate.name": "steel"}
    limits = percoat.limit("dlc-on-steel", set={**SETTINGS, **names})
    assert repr(limits).startswith(f"<percoat.Limits {limits.title!r}: yield of Cr at mean pressure 0.04")
    assert "delamination of Cr/steel" in str(limits) and limits.first is not None
    assert (limits.first.material, limits.first.name) == (2, "Cr")
    step = percoat.solve("dlc-on-steel", set={"grid.points": 64, **names})[0]
    assert repr(step.plane(1.0)).endswith("at z = 1.0, in DLC>") and step.plane(2.2).name == "Cr"
    assert [peaks.max_tau1.name for peaks in step.maxima().materials] == ["DLC", "Cr", "steel"]


def test_limits_are_a_dict_and_pickle(limits: percoat.Limits) -> None:
    plain = limits.to_dict()
    assert type(plain) is dict and type(plain["limits"][0]) is dict
    for again in (pickle.loads(pickle.dumps(limits)), copy.deepcopy(limits), copy.copy(limits)):
        assert type(again) is percoat.Limits and again == limits and again.to_dict() == plain
        assert str(again) == str(limits) and repr(again) == repr(limits)
        assert again.first is not None and again.first.mean_pressure == plain["first"]["mean_pressure"]


def test_progress_of_limits() -> None:
    heard: list[percoat.Progress] = []
    percoat.limit(paraboloids(0.04), progress=heard.append)
    assert all(type(progress) is percoat.Progress and (progress.unit, progress.of) == ("load", 0) for progress in heard)
    assert heard[-1].done >= 3 and {progress.points for progress in heard} == {(128, 128)}
    assert [progress.seconds for progress in heard] == sorted(progress.seconds for progress in heard)
    assert [progress.done for progress in heard] == sorted(progress.done for progress in heard)
