"""Check reference.jsonl by a second route that shares nothing with generate.py.

The state y = (sigma_zz, sigma_qz, u_z, u_q) of a harmonic of wavenumber q obeys
y' = A y, straight from equilibrium and Hooke's law in plane strain:

    sigma_zz' = -q sigma_qz          u_z' = ((1-nu) sigma_zz - nu sigma_qq) / (2G)
    sigma_qz' =  q sigma_qq          u_q' = sigma_qz / G + q u_z
    sigma_qq = (2 G q u_q + nu sigma_zz) / (1-nu),   sigma_tt = nu (sigma_qq + sigma_zz)

No stress function is used. (A^2 - q^2)^2 = 0 gives exp(A z) in closed form, and the
states that decay in the substrate are the range of (A - q)^2. Their plane is carried
up to the surface, where sigma_zz = -1 and sigma_qz = 0 fix the two parameters.
The growth of exp(q z) is met with digits.
"""

import json
from pathlib import Path

import mpmath as mp


def operator(q, shear, nu):
    a, b = nu / (1 - nu), 2 * shear * q / (1 - nu)  # sigma_qq = a sigma_zz + b u_q
    return mp.matrix([
        [0, -q, 0, 0],
        [q * a, 0, 0, q * b],
        [((1 - nu) - nu * a) / (2 * shear), 0, 0, -nu * b / (2 * shear)],
        [0, 1 / shear, q, 0]])


def propagator(A, q, z):
    c, s = mp.cosh(q * z), mp.sinh(q * z)
    N = A * A - q * q * mp.eye(4)
    return (c * mp.eye(4) + s / q * A + z * s / (2 * q) * N
            + (z * c / q - s / q ** 2) / (2 * q) * (A * N))


def across(interface, below):
    """Plane of states above an interface; with it, parameters below from those above."""
    if interface == "frictionless":
        # parameters above: the pressure state and a free slip u_q
        w = mp.matrix([below[1, 1], -below[1, 0]])
        w /= (below[0, :] * w)[0]
        above = mp.matrix(4, 2)
        above[0, 0], above[2, 0], above[3, 1] = 1, (below[2, :] * w)[0], 1
        return above, mp.matrix([[w[0], 0], [w[1], 0]])
    above = below.copy()
    if isinstance(interface, dict):
        if "tangential_stiffness" in interface:
            above[3, :] -= below[1, :] / mp.mpf(interface["tangential_stiffness"])
        if "normal_stiffness" in interface:
            above[2, :] -= below[0, :] / mp.mpf(interface["normal_stiffness"])
    return above, mp.eye(2)


def check(case):
    """Largest relative deviation of the compliance and of the interior values."""
    layers = case["layers"]
    total = case["wavenumber"] * sum(layer["thickness"] for layer in layers)
    mp.mp.dps = 200 + int(total)
    q = mp.mpf(case["wavenumber"])
    materials = [(mp.mpf(m["shear"]), mp.mpf(m["poisson"])) for m in layers + [case["substrate"]]]
    A = [operator(q, *m) for m in materials]
    M = A[-1] - q * mp.eye(4)
    plane = (M * M)[:, 0:2]
    planes, maps = [None] * len(layers), [None] * len(layers)
    substrate = plane
    for i in reversed(range(len(layers))):
        plane, maps[i] = across(layers[i]["interface"], plane)
        planes[i] = plane  # at the lower face
        plane = propagator(A[i], q, -mp.mpf(layers[i]["thickness"])) * plane
    w = mp.lu_solve(plane[0:2, :], mp.matrix([-1, 0]))
    worst = abs((plane[2, :] * w)[0] / mp.mpf(case["compliance"]) - 1)

    bases = []  # state at the lower face of each layer, at the top of the substrate
    for i in range(len(layers)):
        bases.append(planes[i] * w)
        w = maps[i] * w
    bases.append(substrate * w)
    tops = [0.0]
    for layer in layers:
        tops.append(tops[-1] + layer["thickness"])
    for point in case["interior"]:
        i = int(point["side"]) - 1
        below = i < len(layers)
        if below:
            thickness = mp.mpf(layers[i]["thickness"])
            local = mp.mpf(0) if point["z"] == tops[i + 1] else mp.mpf(point["z"]) - mp.mpf(tops[i]) - thickness
        else:
            local = mp.mpf(point["z"]) - mp.mpf(tops[i])
        szz, sqz, uz, uq = propagator(A[i], q, local) * bases[i]
        shear, nu = materials[i]
        sqq = (2 * shear * q * uq + nu * szz) / (1 - nu)
        found = {"szz": szz, "sqz": sqz, "sqq": sqq, "stt": nu * (sqq + szz), "uz": uz, "uq": uq}
        for name, value in found.items():
            expected = mp.mpf(point[name])
            if expected:
                worst = max(worst, abs(value / expected - 1))
            else:
                assert abs(value) < mp.mpf(10) ** -60, (name, value)
    return worst


def main():
    worst = count = 0
    for text in open(Path(__file__).with_name("reference.jsonl")):
        raw = json.loads(text, parse_float=str)  # keep all the digits of the results
        case = json.loads(text)
        case["compliance"], kept = raw["compliance"], raw["interior"]
        case["interior"] = [{**p, "z": float(p["z"])} for p in kept]
        deviation = check(case)
        assert deviation < 1e-19, (count, deviation)
        worst, count = max(worst, deviation), count + 1
    print(f"{count} cases agree; largest relative deviation {mp.nstr(worst, 3)}")


if __name__ == "__main__":
    main()
