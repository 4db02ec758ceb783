"""Makes indentation.csv, profiles.csv, cones.csv, ellipse.csv and sliding.csv.

indentation.csv by the integral equation of ../indentation.py with twice the nodes; what changes on doubling them is printed, beside the least
pressure and the least gap outside, which must be above 0.   pip install mpmath numpy scipy; python generate.py (some minutes)
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.special import j0

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from hertz_slide import stresses  # noqa: E402
from indentation import Body, gauss, solve  # noqa: E402

mp.mp.dps = 30
B, F = "bonded", "frictionless"
# Layers (h, E, nu, lower interface) from the surface down; the substrate is E = 1, nu = 0.3.
LAYERS = [
    [(1, 10, 0.2, B)],
    [(1, 100, 0.2, B)],
    [(1, 0.01, 0.5, B)],
    [(1, 4, 0.25, B), (0.5, 0.5, 0.45, B)],
    [(1, 10, 0.2, F)],
    [(1, 0.1, 0.5, F)],
    [(1, 4, 0.25, F), (0.5, 0.5, 0.45, B)],
]
RADII = (0.02, 0.1, 0.5, 1, 2, 5, 20)
PROFILES = (0.5, 2, 5)
CONES = (0, 2, 3, 4)

INDENTATION = """\
# Rigid paraboloid r^2/2 in free space on layers (h, E, nu, lower interface) on a substrate E = 1, nu = 0.3, frictionless:
# 0: (1, 10, 0.2, bonded); 1: (1, 100, 0.2, bonded); 2: (1, 0.01, 0.5, bonded); 3: (1, 4, 0.25, bonded), (0.5, 0.5, 0.45, bonded);
# 4: (1, 10, 0.2, frictionless); 5: (1, 0.1, 0.5, frictionless); 6: (1, 4, 0.25, frictionless), (0.5, 0.5, 0.45, bonded).
# contact radius a, load P, approach delta of distant points, pressure p0 on the axis, stiffness S = dP/ddelta; generate.py, good to 1e-11.
body,a,P,delta,p0,S
"""
PRESSURES = """\
# Pressures of indentation.csv at r/a = sin(pi/2 (i + 1/2)/24), i = 0 to 23, for a = 0.5, 2 and 5.
body,a,r,p
"""
CONE = """\
# Rigid cone z = r on bodies of indentation.csv; delta and P go with the slope.
body,a,P,delta,S
"""
ELLIPSE = """\
# Hertz: gap x^2/(2 R1) + y^2/2, E* = 1, P = 1; semiaxes a along x, b along y; 30-digit arithmetic.
R1,a,b,delta,p0
"""
SLIDING = """\
# Half-space, nu = 0.3, under the pressure sqrt(1 - r^2) and the traction mu p along +x; z into the body, tension positive.
# Closed form of hertz_slide.py, round-off below 1e-13.
mu,x,y,z,xx,yy,zz,xy,xz,yz
"""


def bodies(number):
    return [(LAYERS[number], (1, 0.3))]


def least_gap(body, found):
    """Smallest gap from 1.001 a to 6 a over a^2/2: by Abel from phi, and the transform of what the layers add."""
    a = found["a"]

    def phi(x):
        return found["delta"] - x**2 - (2 / np.pi) * (np.cos(np.outer(x, body.k)) @ (body.wk * found["q"] * np.pi / body.estar))

    gaps = []
    for r in a * (1 + np.geomspace(1e-3, 5, 60)):
        angle, weight = gauss([0, np.arcsin(a / r)], 200)
        displaced = 2 / np.pi * (weight @ phi(r * np.sin(angle))) + 2 / body.estar * ((body.wk * found["q"]) @ j0(body.k * r))
        gaps.append(displaced + r * r / 2 - found["delta"])
    return min(gaps) / (a * a / 2)


def paraboloids():
    table, profiles = INDENTATION, PRESSURES
    for number in range(len(LAYERS)):
        coarse, fine = (Body(bodies(number), max(RADII), nodes) for nodes in (1, 2))
        for a in RADII:
            found, before = solve(fine, a, profile_points=24), solve(coarse, a)
            change = max(abs(before[k] / found[k] - 1) for k in ("P", "delta", "p0", "S"))
            print(number, a, f"{change:.0e}, pressure {found['p'].min() / found['p'].max():.1e}, gap {least_gap(fine, found):.1e}")
            table += f"{number},{a}," + ",".join("%.14g" % found[k] for k in ("P", "delta", "p0", "S")) + "\n"
            if a in PROFILES:
                profiles += "".join(f"{number},{a},{r:.14g},{p:.14g}\n" for r, p in zip(found["r"], found["p"]))
    (HERE / "indentation.csv").write_text(table)
    (HERE / "profiles.csv").write_text(profiles)


def cone(body, a):
    """The equation of the paraboloid with pi x/2 in the place of x^2."""
    n = int((36 + 22 * a / body.top) * body.fine)
    t, w = gauss([0, a], n)
    c = np.cos(np.outer(t, body.k))
    kernel = 2 / np.pi * (c * body.wk) @ c.T
    unit, square = np.linalg.solve(np.eye(n) + kernel * w, np.column_stack([np.ones(n), np.pi * t / 2])).T
    edge = 2 / np.pi * (c * body.wk) @ np.cos(a * body.k)
    delta = (np.pi * a / 2 - (edge * w) @ square) / (1 - (edge * w) @ unit)
    return 2 * body.estar * (w @ (delta * unit - square)), delta, 2 * body.estar * (w @ unit)


def cones():
    table = CONE
    for number in CONES:
        fine = Body(bodies(number), 5, 2)
        for a in (0.1, 0.5, 1, 2, 5):
            table += f"{number},{a}," + ",".join("%.14g" % v for v in cone(fine, a)) + "\n"
    (HERE / "cones.csv").write_text(table)


def ellipse(r1):
    """p0 sqrt(1 - x^2/a^2 - y^2/b^2), m = 1 - b^2/a^2, K and E of m: 1/(2 R1) = p0 b (K - E)/(a^2 m), 1/2 = p0 b (a^2/b^2 E - K)/(a^2 m),
    delta = p0 b K, P = 2 pi a b p0/3 = 1."""
    if r1 == 1:
        a = mp.cbrt(mp.mpf(3) / 4)
        return a, a, a * a, 3 / (2 * mp.pi * a * a)

    def ratio(m):
        return (mp.ellipe(m) / (1 - m) - mp.ellipk(m)) / (mp.ellipk(m) - mp.ellipe(m)) - r1

    m = mp.findroot(ratio, (mp.mpf("0.01"), mp.mpf("0.9999")), solver="anderson", tol=1e-50, verify=False)
    flat = mp.sqrt(1 - m)
    a = mp.cbrt(2 * r1 * 3 / (2 * mp.pi) * (mp.ellipk(m) - mp.ellipe(m)) / m)
    p0 = 3 / (2 * mp.pi * flat * a * a)
    return a, flat * a, p0 * flat * a * mp.ellipk(m), p0


def ellipses():
    rows = [f"{r1}," + ",".join(mp.nstr(v, 18) for v in ellipse(r1)) + "\n" for r1 in (1, 4, 10)]
    (HERE / "ellipse.csv").write_text(ELLIPSE + "".join(rows))


def sliding():
    edge = [(s * r, t * r) for r in (0.99, 1.01) for s, t in ((1, 0), (-1, 0), (0, 1), (-0.6, 0.8), (0.6, 0.8))]
    inside = [(0, 0), (0.3, 0), (-0.3, 0), (0, 0.5), (0.5, 0.4), (-0.6, 0.3), (-0.8, 0), (0.8, 0), (0, 0.9)]
    outside = [(1.3, 0), (-1.3, 0), (0, 1.5), (-1.2, -0.9), (2, 1), (-3, 0), (0, -4)]
    below = [(0, 0), (-0.5, 0), (0.5, 0.5), (-1, 0), (1, 0), (0, 1), (-1.5, 0.5)]
    points = [(x, y, 0) for x, y in inside + edge + outside] + [(x, y, z) for z in (0.05, 0.25, 0.5, 1, 3) for x, y in below]
    table = SLIDING
    for mu in (1, 0.25):
        for place in points:
            values = stresses(*place, mu, 0.3) + 0.0
            table += "%g,%.12g,%.12g,%g," % (mu, *place) + ",".join("%.14g" % v for v in values) + "\n"
    (HERE / "sliding.csv").write_text(table)


if __name__ == "__main__":
    sliding()
    ellipses()
    cones()
    paraboloids()
