"""Multiprecision reference for the layered elastic half-space under harmonic tangential tractions.

The stacks of generate.py, in the same axes: z points into the body, stresses are
positive in tension. The surface z = 0 bears no pressure but a shear traction cos(q x).

ALONG the wavevector, in +x (plane strain): with s = q z and a stress function F(s)
in every material, the fields of generate.py moved by a quarter of a wave,

    sigma_zz = -F sin(qx)             2 G q u_z = [(1-nu) F''' - (2-nu) F'] sin(qx)
    sigma_qz = -F' cos(qx)            2 G q u_q = -[(1-nu) F''  +  nu F   ] cos(qx)
    sigma_qq =  F'' sin(qx)           sigma_tt  = nu (F'' - F) sin(qx)

    surface                F = 0, F' = 1
    layer, substrate       F as in generate.py
    interfaces             as in generate.py: frictionless sigma_qz = 0 on both sides; spring
                           u_q(below) - u_q(above) = sigma_qz/k_t,
                           u_z(below) - u_z(above) = sigma_zz/k_n

ACROSS it, in the direction t (anti-plane strain): with a function U(s),

    u_t = U/(G q) cos(qx)        sigma_tz = U' cos(qx)        sigma_qt = -U sin(qx)

    layer      U = a e^{-s} + b e^{s'}      s  from the layer's top,
    substrate  U = a e^{-s}                 s' = s - q h <= 0

    surface                U' = -1
    bonded interface       u_t, sigma_tz continuous
    frictionless           sigma_tz = 0 on both sides
    spring                 sigma_tz continuous, u_t(below) - u_t(above) = sigma_tz/k_t;
                           absent stiffness: no jump; k_n has no part

Each problem is one banded linear system, solved as in generate.py at two precisions
that agree to 30 digits. By reciprocity the surface u_z along is minus the surface u_q
under the pressure of generate.py: with p = sin(qx), a quarter of a wave on, that body
moves by -u_q cos(qx) along x, and the work of cos(qx) on it is the work of sin(qx) on
u_z sin(qx). It is asserted to 50 digits in every case.

    pip install mpmath                      (gmpy2 makes it faster)
    python generate_tangential.py           writes tangential.jsonl
"""

import json
import random
from pathlib import Path

import mpmath as mp

from generate import (CHI, NOISE, PRECISIONS, QH, SEED, add_points, agree, close, fields, number,
                      one_layer, running_tops, single_layer_cases, solve_sparse,
                      stack_cases, unit_cases)
from generate import solve as solve_normal

KEPT = (0, 4, 5, 6)  # of every seven cases of generate.py
TINY = mp.mpf("1e-50")


# ---------------------------------------------------------------- the two problems

def along_fields(q, shear, poisson, depth, thickness):
    """Amplitudes of the in-plane fields, each as a list over the coefficients a, b(, c, d)."""
    moved = fields(q, shear, poisson, depth, thickness)
    return {k: [-x for x in v] if k in ("sqz", "uq") else v for k, v in moved.items()}


def across_fields(q, shear, _, depth, thickness):
    """Amplitudes of the anti-plane fields, each as a list over the coefficients a(, b)."""
    value, slope = [mp.exp(-q * depth)], [-mp.exp(-q * depth)]
    if thickness is not None:
        e = mp.exp(q * (depth - thickness))
        value, slope = value + [e], slope + [e]
    return {"stz": slope, "sqt": [-x for x in value], "ut": [x / (shear * q) for x in value]}


ABOVE, BELOW = 0, 1


def jump(name, stress=None, stiffness=None):
    """Terms of name(below) - name(above) [- stress/stiffness] = 0."""
    spring = [(ABOVE, stress, -1 / mp.mpf(stiffness))] if stiffness else []
    return [(BELOW, name, 1), (ABOVE, name, -1), *spring]


def stiffnesses(kind):
    springs = kind if isinstance(kind, dict) else {}
    return springs.get("tangential_stiffness"), springs.get("normal_stiffness")


def along_interface(kind):
    if kind == "frictionless":
        return [jump("szz"), [(ABOVE, "sqz", 1)], [(BELOW, "sqz", 1)], jump("uz")]
    kt, kn = stiffnesses(kind)
    return [jump("szz"), jump("sqz"), jump("uq", "sqz", kt), jump("uz", "szz", kn)]


def across_interface(kind):
    if kind == "frictionless":
        return [[(ABOVE, "stz", 1)], [(BELOW, "stz", 1)]]
    return [jump("stz"), jump("ut", "stz", stiffnesses(kind)[0])]


# unknowns of a layer, field formulas, interface conditions, stresses at the surface
ALONG = 4, along_fields, along_interface, {"szz": 0, "sqz": -1}
ACROSS = 2, across_fields, across_interface, {"stz": -1}


# ------------------------------------------------------------------ the solver

def solve(problem, case, digits):
    """Fields at the surface, followed by those at every requested point, at one precision."""
    mp.mp.dps = digits
    width, formulas, conditions, surface = problem
    q = mp.mpf(case["wavenumber"])
    layers = case["layers"]
    materials = [(mp.mpf(m["shear"]), mp.mpf(m["poisson"]),
                  mp.mpf(m["thickness"]) if "thickness" in m else None)
                 for m in layers + [case["substrate"]]]
    n = width * len(layers) + width // 2

    def row(terms, right=0):
        """Sum of factor * coefficients of material number i (from 0) = right."""
        r = {n: mp.mpf(right)} if right else {}
        for i, coefficients, factor in terms:
            for j, v in enumerate(coefficients):
                r[width * i + j] = r.get(width * i + j, mp.mpf(0)) + factor * v
        return r

    def local(i, depth):
        shear, poisson, thickness = materials[i]
        return formulas(q, shear, poisson, depth, thickness)

    top = local(0, mp.mpf(0))
    rows = [row([(0, top[name], 1)], right) for name, right in surface.items()]
    for i, layer in enumerate(layers):
        faces = local(i, materials[i][2]), local(i + 1, mp.mpf(0))
        rows += [row([(i + side, faces[side][name], factor) for side, name, factor in terms])
                 for terms in conditions(layer["interface"])]
    x = solve_sparse(rows, n)

    def at(i, depth):
        return {k: mp.fdot(v, x[width * i:width * i + len(v)]) for k, v in local(i, depth).items()}

    tops = running_tops(layers)
    values = [at(0, mp.mpf(0))]
    for z, side in case["points"]:
        i = side - 1
        bottom = i < len(layers) and z == tops[i + 1]
        depth = materials[i][2] if bottom else mp.mpf(z) - mp.mpf(tops[i])
        assert depth >= 0 and (i == len(layers) or depth <= materials[i][2])
        values.append(at(i, depth))
    return values


def agree_at_point(low, high):
    """(agreement to 30 digits, values) of the fields at one point, stresses and displacements."""
    good, values = True, {}
    for name in high:
        scales = [max(abs(v[k]) for k in v if k[0] == name[0]) for v in (low, high)]
        ok, values[name] = agree((low[name], scales[0]), (high[name], scales[1]))
        good = good and ok
    return good, values


def reference(problem, case):
    """Solve at rising precisions until two agree; return surface, points, precision."""
    previous = None
    for digits in PRECISIONS:
        values = solve(problem, case, digits)
        if previous is not None:
            checked = [agree_at_point(a, b) for a, b in zip(previous, values)]
            if all(good for good, _ in checked):
                surface, *interior = (v for _, v in checked)
                return surface, interior, digits
        previous = values
    raise ArithmeticError(f"no agreement: {case}")


# ------------------------------------------------------------------- the checks

def check_along_equations():
    """Equilibrium and Hooke's law of the in-plane formulas, by numerical differentiation."""
    mp.mp.dps = 40
    q, shear, nu, h, x, z = map(mp.mpf, ("1.3", "0.7", "0.31", "0.9", "0.4", "0.35"))
    weights = [mp.mpf(w) for w in ("0.3", "-1.1", "0.6", "0.45")]

    def field(name):
        wave = mp.cos if name in ("sqz", "uq") else mp.sin
        return lambda x, z: mp.fdot(weights, along_fields(q, shear, nu, z, h)[name]) * wave(q * x)

    f, dx, dz = derivatives(field, ("szz", "sqz", "sqq", "stt", "uz", "uq"), x, z)
    young = 2 * shear * (1 + nu)
    vanish(dx["sqq"] + dz["sqz"],
           dx["sqz"] + dz["szz"],
           f["sqq"] - nu * (f["szz"] + f["stt"]) - young * dx["uq"],
           f["szz"] - nu * (f["sqq"] + f["stt"]) - young * dz["uz"],
           f["stt"] - nu * (f["sqq"] + f["szz"]),
           f["sqz"] - shear * (dz["uq"] + dx["uz"]))


def check_across_equations():
    """The same of the anti-plane formulas."""
    mp.mp.dps = 40
    q, shear, h, x, z = map(mp.mpf, ("1.3", "0.7", "0.9", "0.4", "0.35"))
    weights = [mp.mpf(w) for w in ("0.3", "-1.1")]

    def field(name):
        wave = mp.sin if name == "sqt" else mp.cos
        return lambda x, z: mp.fdot(weights, across_fields(q, shear, None, z, h)[name]) * wave(q * x)

    f, dx, dz = derivatives(field, ("stz", "sqt", "ut"), x, z)
    vanish(dx["sqt"] + dz["stz"],
           f["stz"] - shear * dz["ut"],
           f["sqt"] - shear * dx["ut"])


def derivatives(field, names, x, z):
    """Values and first derivatives of the named fields."""
    return [{k: d(field(k)) for k in names} for d in (
        lambda f: f(x, z),
        lambda f: mp.diff(f, (x, z), (1, 0)),
        lambda f: mp.diff(f, (x, z), (0, 1)))]


def vanish(*residuals):
    for residual in residuals:
        assert abs(residual) < mp.mpf(10) ** -15, residual


def check_homogeneous():
    """A homogeneous half-space, whole or cut by bonded planes."""
    for q, shear, nu in ((1.0, 1.0, 0.3), (250.0, 8.0e10, 0.5), (0.01, 3.0, 0.0)):
        layer = {"shear": shear, "poisson": nu, "thickness": 0.75 / q, "interface": "bonded"}
        for count in (0, 1, 4):
            layers = [dict(layer) for _ in range(count)]
            z = running_tops(layers)[-1] + 0.5 / q
            case = {"wavenumber": q, "substrate": {"shear": shear, "poisson": nu},
                    "layers": layers, "points": [(z, count + 1)]}
            for problem, expected in ((ALONG, homogeneous_along), (ACROSS, homogeneous_across)):
                surface, (inside,), _ = reference(problem, case)
                for found, depth in ((surface, 0), (inside, z)):
                    values = expected(*map(mp.mpf, (q, shear, nu, depth)))
                    assert found.keys() == values.keys()
                    for name, value in values.items():
                        assert abs(found[name] - value) <= TINY * abs(value), (name, found[name], value)


def homogeneous_along(q, shear, nu, z):
    s, e, g = q * z, mp.exp(-q * z), 2 * shear * q
    return {"szz": -s * e, "sqz": -(1 - s) * e, "sqq": -(2 - s) * e, "stt": -2 * nu * e,
            "uz": (1 - 2 * nu + s) * e / g, "uq": (2 - 2 * nu - s) * e / g}


def homogeneous_across(q, shear, _, z):
    e = mp.exp(-q * z)
    return {"stz": -e, "sqt": -e, "ut": e / (shear * q)}


def surface_values(case):
    """Surface u_q and u_z along, u_t across."""
    along, across = reference(ALONG, case)[0], reference(ACROSS, case)[0]
    return along["uq"], along["uz"], across["ut"]


def check_springs():
    """A stiff spring is a bond, one soft in shear a frictionless contact; across, in closed form."""
    soft, stiff = {"tangential_stiffness": 1e-30}, {"tangential_stiffness": 1e30, "normal_stiffness": 1e30}
    for spring, limit in ((stiff, "bonded"), (soft, "frictionless")):
        found, expected = (surface_values(one_layer(1.0, 3.0, 0.2, 0.4, 0.6, kind)) for kind in (spring, limit))
        for value, other in zip(found, expected):
            close(value, other, 1e-25)
    for spring, slip in (({"tangential_stiffness": 0.25}, 4), ({"normal_stiffness": 0.25}, 0)):
        _, _, ut = surface_values(one_layer(1.0, 3.0, 0.2, 0.4, 0.6, spring))
        t = mp.tanh(mp.mpf(0.6))
        close(ut, (1 + slip + t / 3) / (1 + 3 * t * (1 + slip)), TINY)


def check_free_layer():
    """On frictionless contact a layer is pulled like a plate: u_q -> (1-nu)/(2 G h q^2)."""
    q, shear, nu, h = 0.5, 3.0, 0.2, 2e-12
    uq, _, ut = surface_values(one_layer(q, shear, nu, 0.4, h, "frictionless"))
    close(uq, (1 - nu) / (2 * shear * h * q ** 2))
    close(ut, mp.coth(mp.mpf(q) * mp.mpf(h)) / (shear * q), TINY)


def check_anchors():
    """Independent numbers, one bonded layer, q = 1, G1 = chi, G2 = 1:

    T_c = 2 G1 u_z/(1-2 nu1), T_l = G1 u_q/(1-nu1), T_t = G1 u_t.
    """
    for chi, nu1, nu2, h, *expected in (
        (2.0, 0.20, 0.30, 0.1, 1.277278155820, 1.463897852880, 1.750692060811),
        (2.0, 0.20, 0.30, 0.5, 1.413150886307, 1.127790561441, 1.279530844389),
        (2.0, 0.20, 0.30, 1.0, 1.460084378451, 1.088554505852, 1.094485949748),
        (2.0, 0.20, 0.30, 2.0, 1.205689866993, 1.048650182070, 1.012285431099),
        (0.5, 0.45, 0.30, 0.5, 0.501121907560, 0.944833168395, 0.781536454854),
        (0.5, 0.45, 0.30, 1.0, -0.268057141760, 0.948516036561, 0.913670934040),
        (0.5, 0.45, 0.30, 2.0, 0.158820859371, 0.953032119770, 0.987863668960),
    ):
        uq, uz, ut = surface_values(one_layer(1.0, chi, nu1, nu2, h, "bonded"))
        close(2 * chi * uz / (1 - 2 * mp.mpf(nu1)), expected[0], 5e-12)
        close(chi * uq / (1 - mp.mpf(nu1)), expected[1], 5e-12)
        close(chi * ut, expected[2], 5e-12)


def check_reciprocity(case, along, digits):
    """The surface u_z along is minus the surface u_q of the normal problem."""
    normal = solve_normal({**case, "points": [(0.0, 1)]}, digits)[1][0]
    assert abs(along["uz"] + normal["uq"]) <= TINY * abs(along["uz"]) + NOISE * along["uq"], case


# ------------------------------------------------------------------- the output

def corner(case):
    """One layer at both an extreme shear ratio and an extreme thickness."""
    layer, *others = case["layers"]
    return not others and layer["shear"] in (CHI[0], CHI[-1]) and layer["thickness"] in (QH[0], QH[-1])


def selected_cases():
    """Four of every seven cases of generate.py and all its corners, with their interior points."""
    rng = random.Random(SEED)
    cases = single_layer_cases(rng) + stack_cases(rng) + unit_cases(rng)
    for case in cases:
        if rng.random() < 0.5:
            add_points(rng, case)
    return [case for i, case in enumerate(cases) if i % 7 in KEPT or corner(case)]


def numbers(values):
    return ",".join(f'"{k}":{number(v)}' for k, v in values.items())


def line(case, along, across, interior):
    """One JSON object; doubles by repr, results as decimal numbers of 20 digits."""
    points = ",".join('{"z":%r,"side":%d,%s}' % (z, side, numbers(values))
                      for (z, side), values in zip(case["points"], interior))
    head = json.dumps({k: case[k] for k in ("wavenumber", "substrate", "layers")}, separators=(",", ":"))
    return '%s,"along":{%s},"across":{%s},"interior":[%s]}' % (
        head[:-1], numbers({k: along[k] for k in ("uq", "uz")}), numbers({"ut": across["ut"]}), points)


def main():
    check_along_equations()
    check_across_equations()
    check_homogeneous()
    check_springs()
    check_free_layer()
    check_anchors()
    cases = selected_cases()
    used = {}
    with open(Path(__file__).with_name("tangential.jsonl"), "w") as out:
        for case in cases:
            along, inside_along, digits = reference(ALONG, case)
            across, inside_across, digits_across = reference(ACROSS, case)
            assert along["uq"] > 0 and across["ut"] > 0
            check_reciprocity(case, along, digits)
            digits = max(digits, digits_across)
            used[digits] = used.get(digits, 0) + 1
            interior = [{**a, **b} for a, b in zip(inside_along, inside_across)]
            out.write(line(case, along, across, interior) + "\n")
    print(f"{len(cases)} cases; highest precision needed: {used}")


if __name__ == "__main__":
    main()
