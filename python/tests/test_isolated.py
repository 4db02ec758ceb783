"""One contact in a window: it has a force and an area, no mean pressure, and nothing repeats it."""

from __future__ import annotations

import pickle

import numpy as np
import pytest

import percoat

SETTINGS = {"grid.points": 64}


@pytest.fixture(scope="module")
def ball() -> percoat.Result:
    return percoat.solve("ball-on-disc", set=SETTINGS)


def test_a_step_prints_its_force_and_its_area(ball: percoat.Result) -> None:
    for step, force in zip(ball, (1000.0, 5000.0)):
        assert step.force == pytest.approx(force, rel=1e-12)
        assert step.mean_pressure is None and step.contact_fraction is None and step.isolated
        area = f"contact area {step.contact_area:.5g}"
        assert repr(step).startswith(f"<percoat.Step: force {force:.5g}, penetration ") and area in repr(step)
        (level,) = step.levels
        assert step.contact_area == pytest.approx(np.pi * level.contact_radius**2, rel=1e-3)
    assert repr(pickle.loads(pickle.dumps(ball))[0]) == repr(ball[0]) and "force (N)" in str(ball)


def test_a_periodic_case_in_force_prints_its_force() -> None:
    (step,) = percoat.solve("fig2", set={"grid.points": 48, "load": {"force": 0.05}})
    fraction = f", contact {100.0 * step.contact_fraction:.3g} %, "
    assert repr(step).startswith("<percoat.Step: force 0.05, penetration ") and fraction in repr(step)
    assert step.mean_pressure == pytest.approx(0.05 / (1.5 * np.sqrt(3.0)), rel=1e-12) and not step.isolated


def test_progress_tells_the_force() -> None:
    heard: list[str] = []
    percoat.solve("ball-on-disc", set={**SETTINGS, "load.force": 1000.0}, progress=lambda told: heard.append(told.phase))
    assert heard[-1] == "after force 1000.0"


def test_planes_lie_around_the_middle_of_the_window(ball: percoat.Result) -> None:
    plane, coarse = ball[0].plane(3.0), ball[0].plane(3.0, points=32)
    assert np.array_equal(plane.x, ball.x) and np.array_equal(plane.y, ball.y) and plane.isolated
    assert np.array_equal(coarse.x, ball.x[::2, ::2]) and np.array_equal(coarse.y, ball.y[::2, ::2])
    # The ball presses from above: below it the compression is largest.
    lowest = np.unravel_index(np.argmin(coarse.zz), coarse.zz.shape)
    assert np.hypot(coarse.x[lowest], coarse.y[lowest]) < ball[0].levels[0].contact_radius


def test_a_dataset_has_what_an_isolated_contact_has(ball: percoat.Result) -> None:
    pytest.importorskip("xarray")
    data = ball.to_xarray()
    assert set(data.coords) == {"x", "y", "force"} and "contact_fraction" not in data
    assert data.force.values.tolist() == [step.force for step in ball] and data.force.attrs["units"] == "GPa µm²"
    assert data.contact_area.values.tolist() == [step.contact_area for step in ball]
    assert data.contact_stiffness.values.tolist() == [step.contact_stiffness for step in ball]
    assert data.contact_stiffness.attrs["units"] == "GPa µm" and data.elastic_energy.attrs["units"] == "GPa µm³"


def test_an_isolated_contact_is_drawn_once(ball: percoat.Result) -> None:
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot
    from matplotlib.collections import QuadMesh

    from percoat import plot

    step = ball[1]
    for ax in (plot.pressure(step), plot.contact(step), plot.plane(step.plane(3.0), window=(-200, 200, -200, 200))):
        (mesh,) = (collection for collection in ax.collections if isinstance(collection, QuadMesh))
        # Each sample is the middle of its square.
        corners = mesh.get_coordinates()
        middles = 0.25 * (corners[1:, 1:] + corners[1:, :-1] + corners[:-1, 1:] + corners[:-1, :-1])
        assert np.allclose(middles[..., 0], ball.x) and np.allclose(middles[..., 1], ball.y)
    assert plot.pressure(step).get_xlim() == (-70.0, 70.0)
    curve = plot.curve(ball)
    assert curve.get_ylabel() == "force (GPa µm²)"
    assert curve.lines[0].get_ydata().tolist() == [step.force for step in ball]
    pyplot.close("all")


def test_limits_in_force() -> None:
    heard: list[str] = []
    weak = {**SETTINGS, "substrate.yield_strength": 0.8}
    limits = percoat.limit("ball-on-disc", set=weak, progress=lambda told: heard.append(told.phase))
    first = limits.first
    assert first is not None and first.mean_pressure is None and first.force > 0.0
    assert repr(limits).endswith(f" at force {first.force}>")
    assert repr(pickle.loads(pickle.dumps(limits))) == repr(limits)
    assert {phase.rsplit(" ", 1)[0] for phase in heard if phase.startswith("after")} == {"after force"}
