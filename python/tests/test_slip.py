"""Contacts that stick and slip."""

import pickle

import numpy as np
import percoat
import pytest

SLIPS = {
    "lattice": {"kind": "isolated", "size": 2.6},
    "levels": [{"shape": "paraboloid", "radius": 1.0}],
    "substrate": {"young": 2.0, "poisson": 0.0},
    "counterbody": {"young": 2.0, "poisson": 0.0},
    "load": {"force": 4.0 / 3.0},
    "friction": {"coefficient": 0.5},
    "tangential": {"path": {"amplitude": 0.6, "steps": 4}},
    "grid": {"points": 64},
}


def test_a_shaken_ball_has_the_loop_of_mindlin():
    result = percoat.solve(SLIPS)
    assert [round(step.tangential.mobilised, 12) for step in result.steps] == [0.6, 0.0, 0.6, 0.0, 0.6]
    up = result.steps[0].tangential
    # Shear modulus and radius of contact are 1.
    shift = 0.75 * 0.5 * (4.0 / 3.0) * (1.0 - 0.4 ** (2.0 / 3.0))
    assert abs(up.tangential_shift - shift) < up.tangential_shift_error + 1e-3 * shift
    rise = 1.0 - 0.4 ** (5.0 / 3.0) - 0.5 * (1.0 + 0.4 ** (2.0 / 3.0))
    loop = sum(step.tangential.work for step in result.steps[1:])
    assert abs(loop / (18.0 / 5.0 * 0.25 * (4.0 / 3.0) ** 2 * rise) - 1.0) < 1e-2
    # The end of a cycle is its beginning.
    assert abs(result.steps[-1].tangential.tangential_shift / up.tangential_shift - 1.0) < 1e-3


def test_tractions_keep_to_coulombs_law():
    step = percoat.solve(SLIPS, set={"tangential": {"force": [0.4, [0.1, 0.2]]}}).steps[-1]
    size = np.hypot(*step.traction)
    assert np.all(size <= 0.5 * step.pressure * (1.0 + 1e-9))
    slips = np.hypot(*step.slip) > 1e-6 * np.abs(step.slip).max()
    assert 0.0 < slips.mean() < 1.0 and np.allclose(size[slips], 0.5 * step.pressure[slips], rtol=1e-3)
    area = (2.6 / 64) ** 2
    limit = 0.5 * 4.0 / 3.0
    assert np.allclose(step.traction.sum(axis=(1, 2)) * area, [0.1 * limit, 0.2 * limit], rtol=1e-9)
    assert abs(step.slip_work.sum() * area - step.tangential.work) < 1e-2 * step.tangential.work


def test_a_contact_that_slides_has_no_slip_of_its_own():
    step = percoat.solve("fig2", set={"grid.points": 32}).steps[-1]
    assert step.traction is None and step.slip is None and step.slip_work is None


def test_a_step_that_follows_from_others_is_not_pickled():
    step = percoat.solve(SLIPS, set={"grid.points": 48}).steps[-1]
    with pytest.raises(Exception, match="cannot be pickled"):
        pickle.dumps(step)
