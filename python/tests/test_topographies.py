"""Heights of other libraries with sizes and units of their own, and places without a measurement."""

from typing import Any, Optional

import numpy as np
import pytest
from conftest import wave

import percoat

NX, NY = 24, 15
SIZES = (12.0, 9.0)


def heights() -> np.ndarray:
    """A tilted surface, which neither transposed nor mirrored is the same."""
    i, j = np.meshgrid(np.arange(NX), np.arange(NY), indexing="ij")
    return 0.02 * i - 0.035 * j + 0.008 * ((7 * i + 11 * j * j) % 13)


def case(heights: Any, length: Optional[str] = "nm", **surface: Any) -> "dict[str, Any]":
    units = {} if length is None else {"units": {"length": length}}
    return {
        "surface": {"heights": heights, **surface},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": 1e-3},
        **units,
    }


class Topography:
    """The shape of SurfaceTopography's topographies."""

    def __init__(self, heights: Any, physical_sizes: Any, unit: Optional[str] = None) -> None:
        self._heights, self.physical_sizes, self.unit = heights, physical_sizes, unit

    def heights(self) -> Any:
        return self._heights


def check_sizes_and_unit(topography: Any) -> None:
    as_run = percoat.case(case(topography))
    assert as_run["lattice"]["a1"] == pytest.approx([12e3, 0.0]) and as_run["lattice"]["a2"] == pytest.approx([0.0, 9e3])
    assert as_run["surface"]["unit"] == "µm"
    assert np.array_equal(as_run["surface"]["heights"], heights())
    # The same in nanometres by hand, where the period is.
    by_hand = case(heights() * 1e3, period=[12e3, 9e3])
    told, expected = percoat.check(case(topography)).surface, percoat.check(by_hand).surface
    assert told.rms_height == pytest.approx(expected.rms_height, rel=1e-12)
    assert told.rms_slope == pytest.approx(expected.rms_slope, rel=1e-12)
    # A case that was run is read again.
    again = percoat.check(as_run).surface
    assert again.rms_height == pytest.approx(expected.rms_height, rel=1e-12)


def test_an_object_with_heights_and_physical_sizes_brings_its_unit() -> None:
    check_sizes_and_unit(Topography(heights(), SIZES, "µm"))
    # Without a unit in that of the case.
    unitless = Topography(heights(), SIZES)
    assert percoat.case(case(unitless, None))["lattice"]["a1"] == pytest.approx([12.0, 0.0])
    with pytest.raises(percoat.CaseError, match="add \\[units\\]"):
        percoat.case(case(Topography(heights(), SIZES, "µm"), None))
    for sizes in [(1.0,), (1.0, 2.0, 3.0), None]:
        with pytest.raises(TypeError, match="physical sizes"):
            percoat.case(case(Topography(heights(), sizes, "µm")))
    with pytest.raises(percoat.CaseError, match="greater than 0"):
        percoat.case(case(Topography(heights(), (1.0, -2.0), "µm")))


def test_topographies_of_surfacetopography() -> None:
    library = pytest.importorskip("SurfaceTopography")
    check_sizes_and_unit(library.Topography(heights(), SIZES, unit="µm"))
    holes = np.ma.array(heights(), mask=np.zeros((NX, NY), bool))
    holes[3, 2] = np.ma.masked
    told = percoat.check(case(library.Topography(holes, SIZES, unit="µm")))
    assert any("1 of 360 places" in line for line in told.warnings), told.warnings


def test_places_without_a_measurement_are_filled_with_a_warning() -> None:
    holes = heights()
    holes[3, 2] = holes[17, 11] = np.nan
    masked = np.ma.masked_invalid(holes)
    surfaces = (holes, masked, Topography(masked, SIZES))
    checks = [percoat.check(case(surface, period=[12.0, 9.0])) for surface in surfaces]
    for told in checks:
        assert any("2 of 360 places (0.55556 %)" in line for line in told.warnings), told.warnings
        assert [stage["stage"] for stage in told.surface.stages] == ["as_read", "filled"]
    assert len({told.surface.rms_height for told in checks}) == 1
    with pytest.raises(percoat.CaseError, match="at most half"):
        percoat.check(wave(surface={"heights": np.where(np.arange(64).reshape(8, 8) % 8 < 6, np.nan, 1.0), "period": 1.0}))


def test_a_form_is_removed_and_short_waves_are_left_out() -> None:
    i, j = np.meshgrid(np.arange(NX) - 11.5, np.arange(NY) - 7.0, indexing="ij")
    ball = np.sqrt(900.0 - i**2 - j**2) + 0.01 * heights()
    told = percoat.check(case(ball, period=[NX, NY], form="sphere", cutoff=4.0))
    stages = told.surface.stages
    assert [stage["stage"] for stage in stages] == ["as_read", "without_form", "smoothed"]
    assert stages[1]["radius"] == pytest.approx(30.0, rel=1e-2)
    assert stages[0]["height"] > 100 * stages[1]["height"] > 100 * stages[2]["height"]
    assert "without its sphere of radius" in str(told)
