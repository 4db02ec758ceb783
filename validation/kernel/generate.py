"""Multiprecision reference for the layered elastic half-space under a harmonic pressure.

A pressure p = cos(q x) acts on the frictionless surface z = 0 of a stack of layers
on a half-space, in plane strain. z points into the body, stresses are positive in
tension. With s = q z and a stress function F(s) in every material:

    sigma_zz = -F cos(qx)             2 G q u_z = [(1-nu) F''' - (2-nu) F'] cos(qx)
    sigma_qz =  F' sin(qx)            2 G q u_q = [(1-nu) F''  +  nu F    ] sin(qx)
    sigma_qq =  F'' cos(qx)           sigma_tt  = nu (F'' - F) cos(qx)

    layer      F = (a + b s) e^{-s} + (c + d s') e^{s'}    s  from the layer's top,
    substrate  F = (a + b s) e^{-s}                        s' = s - q h <= 0

    surface                F = 1, F' = 0
    bonded interface       F, F', u_z, u_q continuous
    frictionless           F' = 0 on both sides, F and u_z continuous
    spring                 F, F' continuous, u_q(below) - u_q(above) = F'/k_t,
                           u_z(above) - u_z(below) = F/k_n;  absent stiffness: no jump

The coefficients of all the materials are the unknowns of one banded linear system,
solved directly with pivoting. Every case is solved at two precisions, which are
raised until all the numbers written agree to 30 digits.

    pip install mpmath            (gmpy2 makes it faster)
    python generate.py            writes reference.jsonl
"""

import json
import math
import random
from fractions import Fraction
from pathlib import Path

import mpmath as mp

SEED = 20240607
PRECISIONS = [120, 200, 300, 450, 700, 1000, 1500]
FIELDS = ["szz", "sqz", "sqq", "stt", "uz", "uq"]
DIGITS = 20
NOISE = mp.mpf("1e-80")


# ------------------------------------------------------------------ the solver

def fields(q, shear, poisson, depth, thickness):
    """Amplitudes of the fields, each as a list over the coefficients a, b(, c, d)."""
    def derivative(k):
        s = q * depth
        e = (-1) ** k * mp.exp(-s)
        row = [e, (s - k) * e]
        if thickness is not None:
            s = q * (depth - thickness)
            e = mp.exp(s)
            row += [e, (s + k) * e]
        return row

    f0, f1, f2, f3 = (derivative(k) for k in range(4))
    g = 2 * shear * q
    return {
        "szz": [-x for x in f0],
        "sqz": f1,
        "sqq": f2,
        "stt": [poisson * (y - x) for x, y in zip(f0, f2)],
        "uz": [((1 - poisson) * y - (2 - poisson) * x) / g for x, y in zip(f1, f3)],
        "uq": [((1 - poisson) * y + poisson * x) / g for x, y in zip(f0, f2)],
    }


def solve_sparse(rows, n):
    """Gauss elimination of rows {column: value, n: right side}, scaled row pivoting."""
    pivots = []
    for col in range(n):
        active = [r for r in rows if col in r]
        pivot = max(active, key=lambda r: abs(r[col]) / max(abs(v) for c, v in r.items() if c < n))
        rows = [r for r in rows if r is not pivot]
        pivots.append(pivot)
        for r in active:
            if r is not pivot:
                m = r.pop(col) / pivot[col]
                for c, v in pivot.items():
                    if c != col:
                        r[c] = r.get(c, mp.mpf(0)) - m * v
    x = [mp.mpf(0)] * n
    for col in reversed(range(n)):
        r = pivots[col]
        x[col] = (r.get(n, 0) - sum(v * x[c] for c, v in r.items() if col < c < n)) / r[col]
    return x


def solve(case, digits):
    """Compliance, and the fields at every requested point, at one precision."""
    mp.mp.dps = digits
    q = mp.mpf(case["wavenumber"])
    layers = case["layers"]
    materials = [(mp.mpf(m["shear"]), mp.mpf(m["poisson"]),
                  mp.mpf(m["thickness"]) if "thickness" in m else None)
                 for m in layers + [case["substrate"]]]
    n = 4 * len(layers) + 2

    def row(*terms, right=0):
        """Sum of factor * field of material number i (from 0) = right."""
        r = {n: mp.mpf(right)} if right else {}
        for i, coefficients, factor in terms:
            for j, v in enumerate(coefficients):
                r[4 * i + j] = r.get(4 * i + j, mp.mpf(0)) + factor * v
        return r

    top = fields(q, *materials[0][:2], mp.mpf(0), materials[0][2])
    rows = [row((0, top["szz"], 1), right=-1), row((0, top["sqz"], 1))]
    for i, layer in enumerate(layers):
        shear, poisson, thickness = materials[i]
        up = fields(q, shear, poisson, thickness, thickness)
        shear, poisson, thickness = materials[i + 1]
        down = fields(q, shear, poisson, mp.mpf(0), thickness)
        jump = lambda name: ((i + 1, down[name], 1), (i, up[name], -1))  # below - above
        rows.append(row(*jump("szz")))
        kind = layer["interface"]
        if kind == "frictionless":
            rows += [row((i, up["sqz"], 1)), row((i + 1, down["sqz"], 1)), row(*jump("uz"))]
            continue
        springs = kind if isinstance(kind, dict) else {}
        kt, kn = (springs.get(k) for k in ("tangential_stiffness", "normal_stiffness"))
        rows.append(row(*jump("sqz")))
        # uq(below) - uq(above) = sqz/kt;  uz(below) - uz(above) = szz/kn (szz = -F)
        rows.append(row(*jump("uq"), *([(i, up["sqz"], -1 / mp.mpf(kt))] if kt else [])))
        rows.append(row(*jump("uz"), *([(i, up["szz"], -1 / mp.mpf(kn))] if kn else [])))

    x = solve_sparse(rows, n)

    def at(i, depth):
        shear, poisson, thickness = materials[i]
        return {k: mp.fdot(v, x[4 * i:4 * i + len(v)])
                for k, v in fields(q, shear, poisson, depth, thickness).items()}

    tops = running_tops(layers)
    values = []
    for z, side in case["points"]:
        i = side - 1
        bottom = i < len(layers) and z == tops[i + 1]
        depth = materials[i][2] if bottom else mp.mpf(z) - mp.mpf(tops[i])
        assert depth >= 0 and (i == len(layers) or depth <= materials[i][2])
        values.append(at(i, depth))
    return at(0, mp.mpf(0))["uz"], values


def running_tops(layers):
    """Double-precision depth of the top of every material."""
    tops = [0.0]
    for layer in layers:
        tops.append(tops[-1] + layer["thickness"])
    return tops


def agree(low, high):
    """(agreement to 30 digits, value) of two (value, scale of its kind at that point).

    A value below 1e-80 of its scale is taken for rounding noise and written as 0.
    """
    (x, scale_x), (y, scale_y) = low, high
    if abs(x) <= NOISE * scale_x and abs(y) <= NOISE * scale_y:
        return True, mp.mpf(0)
    return abs(x - y) <= mp.mpf(10) ** -30 * abs(y), y


def reference(case):
    """Solve at rising precisions until two agree; return the record to write."""
    previous = None
    for digits in PRECISIONS:
        compliance, values = solve(case, digits)
        if previous is not None:
            good, _ = agree((previous[0], 1), (compliance, 1))
            interior = []
            for (z, side), a, b in zip(case["points"], previous[1], values):
                record = {"z": z, "side": side}
                for name in FIELDS:
                    group = FIELDS[:4] if name[0] == "s" else FIELDS[4:]
                    scales = [max(abs(v[k]) for k in group) for v in (a, b)]
                    ok, value = agree((a[name], scales[0]), (b[name], scales[1]))
                    good = good and ok
                    record[name] = value
                interior.append(record)
            if good:
                assert compliance > 0
                return compliance, interior, digits
        previous = compliance, values
    raise ArithmeticError(f"no agreement: {case}")


# ------------------------------------------------------------------- the checks

def one_layer(q, chi, nu1, nu2, h, interface, points=()):
    return {"wavenumber": q, "substrate": {"shear": 1.0, "poisson": nu2},
            "layers": [{"shear": chi, "poisson": nu1, "thickness": h, "interface": interface}],
            "points": list(points)}


def close(value, expected, tolerance=2e-11):
    assert abs(value - expected) <= tolerance * abs(expected), (value, expected)


def check_equations():
    """Equilibrium and Hooke's law of the field formulas, by numerical differentiation."""
    mp.mp.dps = 40
    q, shear, nu, h, x = map(mp.mpf, ("1.3", "0.7", "0.31", "0.9", "0.4"))
    weights = [mp.mpf(w) for w in ("0.3", "-1.1", "0.6", "0.45")]

    def field(name):
        wave = mp.sin if name in ("sqz", "uq") else mp.cos
        return lambda x, z: mp.fdot(weights, fields(q, shear, nu, z, h)[name]) * wave(q * x)

    z = mp.mpf("0.35")
    f = {k: field(k)(x, z) for k in FIELDS}
    dx = {k: mp.diff(field(k), (x, z), (1, 0)) for k in FIELDS}
    dz = {k: mp.diff(field(k), (x, z), (0, 1)) for k in FIELDS}
    young = 2 * shear * (1 + nu)
    for residual in (
        dx["sqq"] + dz["sqz"],
        dx["sqz"] + dz["szz"],
        f["sqq"] - nu * (f["szz"] + f["stt"]) - young * dx["uq"],
        f["szz"] - nu * (f["sqq"] + f["stt"]) - young * dz["uz"],
        f["stt"] - nu * (f["sqq"] + f["szz"]),
        f["sqz"] - shear * (dz["uq"] + dx["uz"]),
    ):
        assert abs(residual) < mp.mpf(10) ** -15, residual


def check_solver():
    # A homogeneous half-space, whole or cut by bonded planes.
    for q, shear, nu in ((1.0, 1.0, 0.3), (250.0, 8.0e10, 0.5), (0.01, 3.0, 0.0)):
        layer = {"shear": shear, "poisson": nu, "thickness": 0.7 / q, "interface": "bonded"}
        for count in (0, 1, 4):
            case = {"wavenumber": q, "substrate": {"shear": shear, "poisson": nu},
                    "layers": [dict(layer) for _ in range(count)], "points": []}
            if count == 0:
                compliance = solve_half_space(q, shear, nu)
            else:
                compliance = reference(case)[0]
            expected = (1 - mp.mpf(nu)) / (mp.mpf(shear) * mp.mpf(q))
            assert abs(compliance / expected - 1) < mp.mpf(10) ** -50

    # A stiff spring is a bond; a spring soft in shear is a frictionless contact.
    stack = one_layer(1.0, 3.0, 0.2, 0.4, 0.6, "bonded")
    value = lambda kind: reference({**stack, "layers": [{**stack["layers"][0], "interface": kind}]})[0]
    close(value({"tangential_stiffness": 1e30, "normal_stiffness": 1e30}), value("bonded"), 1e-25)
    close(value({"tangential_stiffness": 1e-30}), value("frictionless"), 1e-25)

    # Independent numbers: T = G1 q u_z / (1 - nu1), G2 = 1, q = 1.
    spring = {"tangential_stiffness": 1.0, "normal_stiffness": 1.0}
    for chi, nu1, nu2, h, interface, expected in (
        (2.0, 0.2, 0.3, 0.1, "bonded", 1.72526660632),
        (2.0, 0.2, 0.3, 0.1, "frictionless", 1.7994760911),
        (2.0, 0.2, 0.3, 0.1, spring, 4.22201616961),
        (2.0, 0.2, 0.3, 1.0, "bonded", 1.41117464928),
        (2.0, 0.2, 0.3, 1.0, "frictionless", 1.81148393277),
        (0.5, 0.45, 0.30, 1.0, spring, 1.30443285527),
    ):
        compliance = reference(one_layer(1.0, chi, nu1, nu2, h, interface))[0]
        close(chi * compliance / (1 - mp.mpf(nu1)), expected)
    points = [(0.0, 1), (1.0, 1), (1.0, 2)]
    top, above, below = reference(one_layer(1.0, 2.0, 0.2, 0.3, 1.0, "bonded", points))[1]
    close(top["szz"], -1)
    assert top["sqz"] == 0
    close(top["sqq"], -1.34506328384)
    close(above["sqq"], 0.382468714853)
    close(below["sqq"], 0.0230500681964)
    for side in (above, below):
        close(-side["szz"], 0.684262191018)
        close(side["sqz"], -0.353656129607)
    top, above, below = reference(one_layer(1.0, 2.0, 0.2, 0.3, 1.0, "frictionless", points))[1]
    close(above["sqq"], 1.28753768244)
    assert above["sqz"] == 0 and below["sqz"] == 0


def solve_half_space(q, shear, nu):
    """The substrate alone: F = 1, F' = 0 at the surface."""
    mp.mp.dps = 120
    f = fields(mp.mpf(q), mp.mpf(shear), mp.mpf(nu), mp.mpf(0), None)
    x = solve_sparse([{0: f["szz"][0], 1: f["szz"][1], 2: mp.mpf(-1)},
                      {0: f["sqz"][0], 1: f["sqz"][1]}], 2)
    return mp.fdot(f["uz"], x)


# -------------------------------------------------------------------- the cases

CHI = [1e-6, 1e-4, 1e-2, 0.2, 0.5, 1.0, 2.0, 5.0, 100.0, 1e4, 1e6]
NU = [(0.0, 0.0), (0.5, 0.5), (0.2, 0.3), (0.5, 0.3), (0.0, 0.5), (0.45, 0.3), (0.4999, 0.3)]
QH = [1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.05, 0.3, 1.0, 3.0, 10.0, 30.0, 1e3]
STIFFNESS = [1e-8, 1e-5, 1e-2, 0.3, 1.0, 10.0, 1e3, 1e8]
KINDS = ["bonded", "frictionless", "kt", "kn", "both"]


def log_uniform(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def single_layer_cases(rng, total=350):
    seen, cases = set(), []

    def add(kind, chi=None, nu=None, qh=None, kt=None, kn=None):
        chi, nu, qh = chi or rng.choice(CHI), nu or rng.choice(NU), qh or rng.choice(QH)
        kt, kn = kt or rng.choice(STIFFNESS), kn or rng.choice(STIFFNESS)
        interface = {"kt": {"tangential_stiffness": kt}, "kn": {"normal_stiffness": kn},
                     "both": {"tangential_stiffness": kt, "normal_stiffness": kn}}.get(kind, kind)
        key = (str(interface), chi, nu, qh)
        if key not in seen:
            seen.add(key)
            cases.append(one_layer(1.0, chi, *nu, qh, interface))

    for kind in KINDS:
        for chi in CHI:
            add(kind, chi=chi)
        for nu in NU:
            add(kind, nu=nu)
        for qh in QH:
            add(kind, qh=qh)
        for chi in (CHI[0], CHI[-1]):
            for qh in (QH[0], QH[-1]):
                add(kind, chi=chi, qh=qh)
    for k in STIFFNESS:
        add("kt", kt=k)
        add("kn", kn=k)
    for kt in (1e-8, 1e8):
        for kn in (1e-8, 1e8):
            add("both", kt=kt, kn=kn)
            add("both", kt=kt, kn=kn, chi=rng.choice((CHI[0], CHI[-1])), qh=QH[0])
    while len(cases) < total:
        add(rng.choice(KINDS))
    return cases


def random_poisson(rng):
    r = rng.random()
    return 0.0 if r < 0.2 else 0.5 if r < 0.4 else rng.uniform(0.0, 0.5)


def random_interface(rng, scale, decades):
    r = rng.random()
    if r < 0.6:
        return "bonded"
    if r < 0.8:
        return "frictionless"
    kt, kn = (scale * 10 ** rng.uniform(-decades, decades) for _ in range(2))
    return rng.choice([{"tangential_stiffness": kt}, {"normal_stiffness": kn},
                       {"tangential_stiffness": kt, "normal_stiffness": kn}])


def stack_case(rng, count, q, shear, mild, thin, decades):
    """`count` random layers, surface down; shear is the substrate's."""
    moduli = [shear]
    for _ in range(count):
        moduli.append(moduli[-1] * log_uniform(rng, 0.1, 10) if mild
                      else shear * log_uniform(rng, 1e-6, 1e6))
    if thin:
        parts = [log_uniform(rng, 1e-2, 1) for _ in range(count)]
        qh = [log_uniform(rng, 0.5, 2) * part / sum(parts) for part in parts]
    else:
        qh = [log_uniform(rng, 1e-8, 1e3) for _ in range(count)]
    layers = [{"shear": g, "poisson": random_poisson(rng), "thickness": s / q,
               "interface": random_interface(rng, q * shear, decades)}
              for g, s in zip(reversed(moduli[1:]), qh)]
    return {"wavenumber": q, "substrate": {"shear": shear, "poisson": random_poisson(rng)},
            "layers": layers, "points": []}


def stack_cases(rng, total=300):
    return [stack_case(rng, 2 + i % 19, 1.0, 1.0, i // 19 % 2 == 0, i // 38 % 2 == 0, 8)
            for i in range(total)]


def unit_cases(rng, total=50):
    cases = []
    for i in range(total):
        q = log_uniform(rng, 1e-3, 1e6)
        shear = 8e10 * log_uniform(rng, 0.1, 10)
        case = stack_case(rng, rng.choice((1, 1, 2, 3, 5, 8)), q, shear, i % 2 == 0, i % 4 < 2, 6)
        if i % 3:  # thicknesses around a micrometre whatever the wavenumber
            for layer in case["layers"]:
                layer["thickness"] = 1e-6 * log_uniform(rng, 0.03, 30)
        cases.append(case)
    return cases


def add_points(rng, case):
    """Choose interior points. Thicknesses of stacks are put on a grid so that their sums are exact."""
    q, layers = case["wavenumber"], case["layers"]
    extent = sum(layer["thickness"] for layer in layers) + 40 / q
    grid = 2.0 ** (math.frexp(extent)[1] - 52)
    snap = lambda z: max(1, round(z / grid)) * grid
    if len(layers) > 1:
        for layer in layers:
            layer["thickness"] = snap(layer["thickness"])
    tops = running_tops(layers)
    exact = sum(Fraction(layer["thickness"]) for layer in layers)
    assert Fraction(tops[-1]) == exact

    points = {(0.0, 1)}
    for i in rng.sample(range(len(layers)), min(2, len(layers))):
        points |= {(tops[i + 1], i + 1), (tops[i + 1], i + 2)}
    for i in rng.sample(range(len(layers)), min(2, len(layers))):
        depth = layers[i]["thickness"] * rng.uniform(0.05, 0.95)
        if rng.random() < 0.5:
            depth = min(depth, rng.uniform(0.2, 20) / q)
        z = tops[i] + (snap(depth) if len(layers) > 1 else depth)
        if tops[i] < z < tops[i + 1]:
            points.add((z, i + 1))
    for depth in (rng.uniform(0.05, 2), rng.uniform(2, 10), rng.uniform(15, 30)):
        points.add((tops[-1] + snap(depth / q), len(layers) + 1))
    case["points"] = sorted(p for p in points if q * p[0] <= 300)  # keeps clear of underflow


# ------------------------------------------------------------------- the output

def number(value):
    return mp.nstr(value, DIGITS, min_fixed=-3, max_fixed=3) if value else "0.0"


def line(case, compliance, interior):
    """One JSON object; doubles by repr, results as decimal numbers of 20 digits."""
    points = ",".join(
        '{"z":%r,"side":%d,%s}' % (p["z"], p["side"], ",".join(f'"{k}":{number(p[k])}' for k in FIELDS))
        for p in interior)
    head = json.dumps({k: case[k] for k in ("wavenumber", "substrate", "layers")}, separators=(",", ":"))
    return '%s,"compliance":%s,"interior":[%s]}' % (head[:-1], number(compliance), points)


def main():
    check_equations()
    check_solver()
    rng = random.Random(SEED)
    cases = single_layer_cases(rng) + stack_cases(rng) + unit_cases(rng)
    for case in cases:
        if rng.random() < 0.5:
            add_points(rng, case)
    used = {}
    with open(Path(__file__).with_name("reference.jsonl"), "w") as out:
        for case in cases:
            compliance, interior, digits = reference(case)
            used[digits] = used.get(digits, 0) + 1
            out.write(line(case, compliance, interior) + "\n")
    print(f"{len(cases)} cases; highest precision needed: {used}")


if __name__ == "__main__":
    main()
