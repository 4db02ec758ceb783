"""Makes reference.csv: the stresses inside a half-space under a sliding sphere, normal and tangential load apart.

The closed form of ../sliding_sphere.py in 30 digits, from waves, is asserted against integrals over the contact disc of
the stresses of a point force at the origin (Boussinesq's along z, Cerruti's along x; R = |(x, y, z)|, T = R + z):

    2 pi normal:      ij = -3 z xi xj/R^5 plus, within the plane,
                      (1-2nu) [delta_ij (z/R^3 - 1/(R T)) + xi xj (2R+z)/(R^3 T^2)]
    2 pi tangential:  ij = -3 x xi xj/R^5 plus, within the plane, (1-2nu) times
                      xx  x/R^3 - 3x/(R T^2) + x^3 V,   yy  x/R^3 - x/(R T^2) + x y^2 V,
                      xy  -y/(R T^2) + x^2 y V,         V = 1/(R^3 T^2) + 2/(R^2 T^3)

in polar coordinates about the projection of the point on the surface, s = z sinh v, both integrals by tanh-sinh. Of the
point forces it asserts equilibrium, compatibility, a free surface and the resultant; of the closed form the stresses on
the surface within the contact, Johnson's, Huber's on the axis, and the point forces on the surface outside.

Sources: K. L. Johnson, Contact Mechanics (1985), 3.2, 3.4, 3.6 and 3.7; M. T. Huber, Ann. Phys. 319 (1904) 153.
pip install mpmath numpy; python generate.py
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from sliding_sphere import COMPONENTS, stresses  # noqa: E402

HEAD = """\
# Stresses inside a half-space under a sliding sphere: contact radius 1, pressure sqrt(1 - r^2) ("normal") or traction
# sqrt(1 - r^2) in +x on the body ("tangential"), z into the body, tension positive. Closed form, printed with twelve
# digits; integrals of point forces over the disc agree to 1e-12.
nu,x,y,z,load,xx,yy,zz,xy,xz,yz
"""
POISSON = ("0", "0.3", "0.5")
POINTS = """
    0 0 0.02, 0 0 0.1, 0 0 0.25, 0 0 0.5, 0 0 1, 0 0 3,
    -1 0 0.02, -1 0 0.1, -1 0 0.3, -1 0 1, -1 0 3, 1 0 0.02, 1 0 0.1, 1 0 0.3, 1 0 1, 1 0 3,
    -0.5 0 0.02, 0.5 0 0.2, -0.9 0 0.05, 0.3 0.4 0.02, 0.3 0.4 0.5, 0.6 0.8 0.02, 0.6 0.8 0.3, 0 0.5 0.1, 0 1 0.1,
    -0.3 0.9 0.05, -0.7 0.2 1, -1.2 0 0.02, 1.2 0 0.1, 2 0 0.5, 1 1 0.02, -1.5 1 0.2, 0 2 1, -3 0.5 3
"""
LOADS = ("normal", "tangential")
AGREEMENT = 1e-12
NEAR_SURFACE = 1e-8
STEP, REACH = 1 / 24, 3.3


def point_forces(nu, x, y, z):
    """The components under the normal and under the tangential unit force, for arrays or mpmath numbers."""
    square = x * x + y * y + z * z
    r = square**0.5
    t = r + z
    loose = 1 - 2 * nu
    axes = {"x": x, "y": y, "z": z}
    normal, tangential = (
        {name: -3 * along * axes[name[0]] * axes[name[1]] / (2 * np.pi * r**5) for name in COMPONENTS}
        for along in (z, x)
    )
    even, product = z / r**3 - 1 / (r * t), (2 * r + z) / (r**3 * t * t)
    single, triple = 1 / (r * t * t), 1 / (r**3 * t * t) + 2 / (square * t**3)
    for load, extra in (
        (normal, {"xx": even + x * x * product, "yy": even + y * y * product, "xy": x * y * product}),
        (
            tangential,
            {
                "xx": x / r**3 - 3 * x * single + x**3 * triple,
                "yy": x / r**3 - x * single + x * y * y * triple,
                "xy": x * x * y * triple - y * single,
            },
        ),
    ):
        for name, value in extra.items():
            load[name] = load[name] + loose * value / (2 * np.pi)
    return normal, tangential


def check_point_forces():
    """Equilibrium, compatibility (Beltrami and Michell), no traction on the surface, a resultant of one."""
    axes, zero = "xyz", mp.mpf("1e-12")
    orders = {a: tuple(int(a == b) for b in axes) for a in axes}
    for nu in map(mp.mpf, POISSON):
        for place in ((mp.mpf("0.3"), mp.mpf("-0.4"), mp.mpf("0.2")), (mp.mpf("-1.3"), mp.mpf("0.1"), mp.mpf("0.7"))):
            for load in (0, 1):
                component = lambda i, j: lambda *p: point_forces(nu, *p)[load]["".join(sorted(i + j))]
                trace = lambda *p: sum(point_forces(nu, *p)[load][i + i] for i in axes)
                both = lambda i, j: tuple(a + b for a, b in zip(orders[i], orders[j]))
                for i in axes:
                    assert abs(sum(mp.diff(component(i, j), place, orders[j]) for j in axes)) < zero
                    assert abs(component(i, "z")(*place[:2], mp.mpf(0))) < zero
                    for j in axes:
                        laplacian = sum(mp.diff(component(i, j), place, both(k, k)) for k in axes)
                        assert abs(laplacian + mp.diff(trace, place, both(i, j)) / (1 + nu)) < zero
    turn = np.arange(8) * np.pi / 4
    for load, name in enumerate(("zz", "xz")):
        across = lambda r: point_forces(0.3, float(r) * np.cos(turn), float(r) * np.sin(turn), 1.0)[load][name]
        ring = lambda r: r * np.mean(across(r))
        assert abs(2 * mp.pi * mp.quad(ring, [0, 1, 4, 16, mp.inf]) + 1) < 1e-9


def rule():
    """Tanh-sinh on (0, 1): the distances to both ends and the weights."""
    t = np.arange(-REACH, REACH, STEP)
    left, right = (1 / (1 + np.exp(sign * np.pi * np.sinh(t))) for sign in (-1, 1))
    return left, right, STEP * np.pi * np.cosh(t) * left * right


def disc(nu, x, y, z):
    """Integrals of the point forces over the disc."""
    left, right, weight = rule()
    away, bearing = np.hypot(x, y), np.arctan2(-y, -x)
    total = [dict.fromkeys(COMPONENTS, 0.0) for _ in LOADS]
    if away < 1:
        sectors = [(-np.pi / 2, np.pi / 2), (np.pi / 2, 3 * np.pi / 2)]
    else:
        sectors = [(-np.arcsin(1 / away), np.arcsin(1 / away))]
    for start, end in sectors:
        width = end - start
        angle = (start + width * left)[:, None]
        if away < 1:
            half = np.sqrt(1 - (away * np.sin(angle)) ** 2)
        else:
            half = away * np.sqrt(np.sin(width * left) * np.sin(width * right))[:, None]
        far = away * np.cos(angle) + half
        near = (away * away - 1) / far
        first = np.arcsinh(np.maximum(near, 0) / z)
        length = np.arcsinh(far / z) - first
        v = first + length * left
        s = z * np.sinh(v)
        to_far = 2 * z * np.cosh(v + length * right / 2) * np.sinh(length * right / 2)
        to_near = 2 * z * np.cosh(v - length * left / 2) * np.sinh(length * left / 2) if away >= 1 else s - near
        measure = width * weight[:, None] * length * weight * s * z * np.cosh(v) * np.sqrt(to_near * to_far)
        forces = point_forces(nu, -s * np.cos(angle + bearing), -s * np.sin(angle + bearing), z)
        for sums, force in zip(total, forces):
            for name in COMPONENTS:
                sums[name] += np.sum(measure * force[name])
    return total


def surface(nu, x, y):
    """The stresses on the surface within the contact and at its edge."""
    square = x * x + y * y
    s = mp.sqrt(max(0, 1 - square))
    even = (1 - 2 * nu) / (3 * square) * (1 - s**3)
    normal = {
        "xx": (even * (x * x - y * y) - s * (x * x + 2 * nu * y * y)) / square,
        "yy": (even * (y * y - x * x) - s * (y * y + 2 * nu * x * x)) / square,
        "zz": -s,
        "xy": (2 * even - (1 - 2 * nu) * s) * x * y / square,
        "xz": 0,
        "yz": 0,
    }
    tangential = {
        "xx": -mp.pi * (4 + nu) * x / 8,
        "yy": -3 * mp.pi * nu * x / 8,
        "zz": 0,
        "xy": -mp.pi * (2 - nu) * y / 8,
        "xz": -s,
        "yz": 0,
    }
    return normal, tangential


def check_closed_form():
    """The surface within the contact and its edge (Johnson), the axis (Huber), the surface outside (point forces)."""
    for nu in map(mp.mpf, POISSON):
        for x, y in (map(mp.mpf, place) for place in (("-1", "0"), ("0.6", "0.8"), ("-0.3", "0.5"), ("0", "0.7"))):
            for found, known in zip(stresses(nu, x, y, mp.mpf(0), mp), surface(nu, x, y)):
                assert all(abs(found[name] - known[name]) < 1e-14 for name in COMPONENTS)
        for z in map(mp.mpf, ("0.1", "0.5", "2")):
            normal, _ = stresses(nu, mp.mpf(0), mp.mpf(0), z, mp)
            across = -(1 + nu) * (1 - z * mp.atan(1 / z)) + 1 / (2 * (1 + z * z))
            assert abs(normal["xx"] - across) < 1e-14 and abs(normal["zz"] + 1 / (1 + z * z)) < 1e-14
        for x, y in ((-1.1, 0.0), (1.3, 0.0), (0.8, -0.9), (0.0, 2.0)):
            exact = stresses(nu, mp.mpf(x), mp.mpf(y), mp.mpf(0), mp)
            for closed, integral in zip(exact, disc(float(nu), x, y, NEAR_SURFACE)):
                assert all(abs(closed[name] - integral[name]) < 10 * NEAR_SURFACE for name in COMPONENTS)


def main():
    mp.mp.dps = 30
    check_point_forces()
    check_closed_form()
    text, worst = HEAD, 0.0
    for nu in POISSON:
        for place in (p.split() for p in POINTS.split(",")):
            exact = stresses(*map(mp.mpf, (nu, *place)), mp)
            for load, closed, integral in zip(LOADS, exact, disc(*map(float, (nu, *place)))):
                worst = max(worst, *(abs(float(closed[name]) - integral[name]) for name in COMPONENTS))
                values = (float(closed[name]) if abs(closed[name]) > 1e-20 else 0.0 for name in COMPONENTS)
                text += ",".join((nu, *place, load, *(f"{v:.12g}" for v in values))) + "\n"
    assert worst < AGREEMENT
    (HERE / "reference.csv").write_text(text)
    print(f"closed form and integrals differ by {worst:.1e} at most")


if __name__ == "__main__":
    main()
