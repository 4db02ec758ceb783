"""Check tangential.jsonl, digit by digit, by a second route that shares nothing with generate_tangential.py.

ALONG. The state y = (sigma_zz, sigma_qz, u_z, u_q), with amplitudes of sin, cos, sin and
cos(qx), obeys the y' = A y of check.py with -q in the place of q, straight from
equilibrium and Hooke's law in plane strain:

    sigma_zz' =  q sigma_qz          u_z' = ((1-nu) sigma_zz - nu sigma_qq) / (2G)
    sigma_qz' = -q sigma_qq          u_q' = sigma_qz / G - q u_z
    sigma_qq = (-2 G q u_q + nu sigma_zz) / (1-nu),   sigma_tt = nu (sigma_qq + sigma_zz)

The closed-form exp(A z) and the interfaces are those of check.py. The plane of states
that decay in the substrate is carried up to the surface, where sigma_zz = 0 and
sigma_qz = -1 fix the two parameters.

ACROSS. The state (sigma_tz, u_t) obeys sigma_tz' = G q^2 u_t, u_t' = sigma_tz / G; cosh
and sinh carry it from the substrate, (-G q, 1), or from a frictionless face, (0, 1), up
to the surface, where sigma_tz = -1 fixes its scale. Below the uppermost frictionless
interface all is at rest. sigma_qt = -G q u_t.

The growth of exp(q z) is met with digits.
"""

import json
from pathlib import Path

import mpmath as mp

from check import across as state_above, operator, propagator

DIGITS = 20
NOISE = mp.mpf("1e-80")


# ------------------------------------------------------------------------ along

def along_states(q, materials, layers):
    """States at the surface, then at the lower face of each layer and the top of the substrate."""
    A = [operator(-q, *m) for m in materials]
    decaying = A[-1] - q * mp.eye(4)
    plane = (decaying * decaying)[:, 0:2]
    bases, maps = [plane], []  # those at the faces from below upwards
    for i in reversed(range(len(layers))):
        plane, below = state_above(layers[i]["interface"], plane)
        bases.insert(0, plane)
        maps.insert(0, below)
        plane = propagator(A[i], q, -mp.mpf(layers[i]["thickness"])) * plane
    w = mp.lu_solve(plane[0:2, :], mp.matrix([0, -1]))
    states = [plane * w, bases[0] * w]
    for basis, below in zip(bases[1:], maps):
        w = below * w
        states.append(basis * w)
    return states


def along_fields(q, shear, nu, state, z):
    """Fields at z from the place of the state."""
    szz, sqz, uz, uq = propagator(operator(-q, shear, nu), q, z) * state
    sqq = (nu * szz - 2 * shear * q * uq) / (1 - nu)
    return {"szz": szz, "sqz": sqz, "sqq": sqq, "stt": nu * (sqq + szz), "uz": uz, "uq": uq}


# ----------------------------------------------------------------------- across

def carried(q, shear, state, z):
    """The anti-plane state at z from the place of the given one."""
    stz, ut = state
    c, s = mp.cosh(q * z), mp.sinh(q * z)
    return c * stz + shear * q * s * ut, s * stz / (shear * q) + c * ut


def across_states(q, materials, layers):
    """As along_states."""
    state = -materials[-1][0] * q, mp.mpf(1)
    states = [state]
    for layer, (shear, _) in reversed(list(zip(layers, materials))):
        kind = layer["interface"]
        if kind == "frictionless":
            states = [(mp.mpf(0), mp.mpf(0))] * len(states)
            state = mp.mpf(0), mp.mpf(1)
        elif isinstance(kind, dict) and "tangential_stiffness" in kind:
            state = state[0], state[1] - state[0] / mp.mpf(kind["tangential_stiffness"])
        states.insert(0, state)
        state = carried(q, shear, state, -mp.mpf(layer["thickness"]))
    return [(-stz / state[0], -ut / state[0]) for stz, ut in [state] + states]


def across_fields(q, shear, _, state, z):
    stz, ut = carried(q, shear, state, z)
    return {"stz": stz, "sqt": -shear * q * ut, "ut": ut}


# ------------------------------------------------------------------- comparison

def confirm(found, written):
    """Every digit of the fields written for one point; 0.0 stands for less than 1e-80 of the largest."""
    for name, text in written.items():
        value, expected = found[name], mp.mpf(text)
        if expected:
            assert mp.mpf(mp.nstr(value, DIGITS)) == expected, (name, text, value)
        else:
            assert abs(value) <= NOISE * max(abs(v) for k, v in found.items() if k[0] == name[0]), (name, value)
    return len(written)


def local_depth(layers, tops, z, i):
    """Depth below the lower face of layer i, or below the top of the substrate."""
    if i == len(layers):
        return mp.mpf(z) - mp.mpf(tops[i])
    if z == tops[i + 1]:
        return mp.mpf(0)
    return mp.mpf(z) - mp.mpf(tops[i]) - mp.mpf(layers[i]["thickness"])


def check(case, digits):
    """Confirm the surface and interior values, given as text by `digits`; return their number."""
    layers = case["layers"]
    mp.mp.dps = 200 + int(case["wavenumber"] * sum(layer["thickness"] for layer in layers))
    q = mp.mpf(case["wavenumber"])
    materials = [(mp.mpf(m["shear"]), mp.mpf(m["poisson"])) for m in layers + [case["substrate"]]]
    tops = [0.0]
    for layer in layers:
        tops.append(tops[-1] + layer["thickness"])

    count = 0
    for problem, states, fields in (("along", along_states, along_fields),
                                    ("across", across_states, across_fields)):
        surface, *faces = states(q, materials, layers)
        count += confirm(fields(q, *materials[0], surface, mp.mpf(0)), digits[problem])
        for point, written in zip(case["interior"], digits["interior"]):
            i = point["side"] - 1
            found = fields(q, *materials[i], faces[i], local_depth(layers, tops, point["z"], i))
            count += confirm(found, {k: written[k] for k in found})
    return count


def main():
    lines = Path(__file__).with_name("tangential.jsonl").read_text().splitlines()
    numbers = sum(check(json.loads(text), json.loads(text, parse_float=str)) for text in lines)
    print(f"{len(lines)} cases agree: every digit of {numbers} numbers confirmed")


if __name__ == "__main__":
    main()
