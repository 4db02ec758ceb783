"""Surfaces that adhere."""

import math

import numpy as np
import percoat

WORK = 4.0 / (3.0 * math.pi)
# A sphere of the radius 1 on E* = 1: Maugis' units are 1, that of force is 4/3; λ = 1.
BALL = {
    "lattice": {"kind": "isolated", "size": 6.0},
    "levels": [{"shape": "paraboloid", "radius": 1.0}],
    "substrate": {"young": 0.91, "poisson": 0.3},
    "adhesion": {"work": WORK, "strength": 2.0 / 3.0},
    "load": {"penetration": {"from": 0.2, "to": -1.1, "steps": 27, "back": True}},
    "grid": {"points": 64},
}


def test_a_sphere_is_pulled_off_as_by_maugis():
    result = percoat.solve(BALL)
    assert all(step.converged for step in result.steps)
    last = result.steps[-1].adhesion
    assert abs(last.maugis - 1.0) < 1e-12
    exact = -1.60073491 * 4.0 / 3.0
    assert abs(last.pull_off.force - exact) < min(last.pull_off.error, 3e-3 * abs(exact))
    kinds = [jump.kind for step in result.steps for jump in step.adhesion.jumps]
    assert kinds == ["out", "in"]
    # The path ends where it began.
    first = result.steps[0]
    assert abs(result.steps[-1].force - first.force) < 1e-6


def test_the_force_is_that_of_pressure_less_tension():
    step = percoat.solve(BALL, set={"load.penetration": [0.2, -0.3]}).steps[-1]
    area = (6.0 / 64) ** 2
    assert np.all(step.tension >= 0.0) and step.tension.max() <= 2.0 / 3.0
    assert np.all(step.tension[step.pressure > 0.0] == step.tension.max())
    assert abs((step.pressure - step.tension).sum() * area - step.force) < 1e-9
    assert step.force < 0.0 < step.adhesion.contact_load


def test_surfaces_that_do_not_adhere_have_no_tension():
    assert percoat.solve("fig2", set={"grid.points": 32}).steps[-1].tension is None
