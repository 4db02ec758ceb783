"""Makes yield.csv, switch.csv and tension.csv: the largest von Mises and the largest principal stress under a sliding
sphere, and where they stand.

    sigma = sigma of p = sqrt(1 - r^2)  +  mu sigma of the traction sqrt(1 - r^2) in +x        (stresses over p0)
    mises^2 = ((xx-yy)^2 + (yy-zz)^2 + (zz-xx)^2)/2 + 3 (xy^2 + yz^2 + xz^2)

in the closed form of ../sliding_sphere.py, everywhere with z >= 0. At the trailing edge x = -1, y = z = 0, where slopes
are infinite, with e = (1-2nu)/3 (Johnson),

    xx = e + mu pi (4+nu)/8,   yy = -e + 3 mu pi nu/8,   all others zero.

The von Mises stress has three kinds of maxima, all with y = 0: smooth ones inside the body and on the surface within
the contact (zero gradient, Newton in 30 digits), and the edge. They are found on a grid of the plane y = 0; that
nothing in the body has more is asserted on a grid in space, outside the contact too, and close around the edge. So it
is for the principal stress, whose largest is xx at the edge.

Source: K. L. Johnson, Contact Mechanics (1985), 3.4, 3.7, 6.1 and 7.1.
pip install mpmath numpy scipy; python generate.py
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.ndimage import maximum_filter

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from sliding_sphere import COMPONENTS, stresses  # noqa: E402

POISSON = ("0.3", "0.25")
FRICTION = ("0", "0.05", "0.1", "0.15", "0.2", "0.25", "0.28", "0.3", "0.32", "0.35", "0.4", "0.5", "0.7", "1")
SMALL = ("0.001", "0.01")  # tension only: where the rest of the edge comes close
EDGE = (mp.mpf(-1), mp.mpf(0), mp.mpf(0))
NEAR = 0.97  # of the grid's largest: maxima to be polished
ROUNDING = 1e-12
YIELD = """\
# The largest von Mises stress over p0 in the body under a sliding sphere and its place over a, z into the body, the
# slider moving to +x; first yield at p0/Y = 1/mises. Closed form, ten digits.
nu,mu,mises,x,y,z
"""
SWITCH = """\
# Friction at which the largest von Mises stress leaves the inside for the trailing edge, and the edge for the contact.
nu,from,to,mu,mises
"""
TENSION = """\
# The largest principal stress over p0 in the body under a sliding sphere and its place over a: at the trailing edge,
# without friction all around the edge.
nu,mu,s1,x,y,z
"""


def added(loads, mu):
    normal, tangential = loads
    return {name: normal[name] + mu * tangential[name] for name in COMPONENTS}


def mises(s):
    apart = (s["xx"] - s["yy"]) ** 2 + (s["yy"] - s["zz"]) ** 2 + (s["zz"] - s["xx"]) ** 2
    return (apart / 2 + 3 * (s["xy"] ** 2 + s["xz"] ** 2 + s["yz"] ** 2)) ** 0.5


def principal(s):
    """The largest principal stress, for arrays."""
    rows = [[s["xx"], s["xy"], s["xz"]], [s["xy"], s["yy"], s["yz"]], [s["xz"], s["yz"], s["zz"]]]
    return np.linalg.eigvalsh(np.moveaxis(np.array(rows), (0, 1), (-2, -1)))[..., -1]


def at_edge(nu, mu):
    even = (1 - 2 * nu) / 3
    along, across = even + mu * mp.pi * (4 + nu) / 8, -even + 3 * mu * mp.pi * nu / 8
    return along, mp.sqrt(along**2 - along * across + across**2)


def at(nu, mu, x, z):
    return mises(added(stresses(nu, x, mp.mpf(0), z, mp), mu))


def inside(nu, mu, x, z):
    """The maximum inside the body next to a start, and its place."""
    slopes = lambda x, z: [mp.diff(lambda *p: at(nu, mu, *p), (x, z), order) for order in ((1, 0), (0, 1))]
    x, z = mp.findroot(slopes, (x, z))
    return at(nu, mu, x, z), (x, mp.mpf(0), z)


def within(nu, mu, x):
    """The maximum on the surface within the contact next to a start, and its place."""
    surface = lambda x: at(nu, mu, x, mp.mpf(0))
    x = mp.findroot(lambda x: mp.diff(surface, x), x)
    return surface(x), (x, mp.mpf(0), mp.mpf(0))


def plane():
    """The plane y = 0, closer towards the edges and the surface."""
    towards = np.linspace(0, 1, 101) ** 2
    right = np.concatenate([1 - towards[:0:-1], 1 + 4 * towards])
    x, z = np.meshgrid(np.concatenate([-right[::-1], right]), 4 * towards, indexing="ij")
    return x, np.zeros_like(x), z


def space():
    """The body as half-rings and, about the trailing edge, shells that shrink on it."""
    towards = np.linspace(0, 1, 61) ** 2
    r, angle, z = np.meshgrid(
        np.concatenate([1 - towards[::-1], 1 + 4 * towards[1:]]), np.linspace(0, np.pi, 91), 4 * towards, indexing="ij"
    )
    size, way, off = np.meshgrid(
        np.logspace(-6, -1, 51), np.linspace(0, np.pi, 61), np.linspace(0, 0.1, 41), indexing="ij"
    )
    radius = 1 + size * np.cos(way)
    parts = (
        (r * np.cos(angle), r * np.sin(angle), z),
        (-radius * np.cos(off), radius * np.sin(off), size * np.sin(way)),
    )
    return (np.concatenate([part.ravel() for part in axis]) for axis in zip(*parts))


def largest(nu, mu, places, loads):
    """The largest von Mises stress and its place, from the maxima on a grid of the plane."""
    x, _, z = places
    found = mises(added(loads, float(mu)))
    peaks = np.argwhere((found == maximum_filter(found, 3)) & (found > NEAR * found.max()))
    candidates = [(at_edge(nu, mu)[1], EDGE)]
    for start_x, start_z in {(float(x[i, j]), float(z[i, j])) for i, j in peaks}:
        if start_z > 0:
            candidates.append(inside(nu, mu, start_x, start_z))
        elif abs(start_x) < 1:
            candidates.append(within(nu, mu, start_x))
        else:
            assert start_x == -1
    return max(candidates)


def switches(nu):
    """Where the maximum goes from inside the body to the edge, and from there into the contact."""
    first = mp.findroot(lambda mu: inside(nu, mu, 0.32, 0.42)[0] - at_edge(nu, mu)[1], (0.28, 0.31))
    second = mp.findroot(lambda mu: within(nu, mu, -0.4)[0] - at_edge(nu, mu)[1], (0.8, 1))
    return ("inside", "edge", first), ("edge", "contact", second)


def row(names, values):
    return ",".join((*names, *(f"{float(mp.chop(v)):.10g}" for v in values))) + "\n"


def main():
    mp.mp.dps = 30
    yields, switch, tension = YIELD, SWITCH, TENSION
    everywhere, section = tuple(space()), plane()
    for poisson in POISSON:
        nu = mp.mpf(poisson)
        body, cut = stresses(float(nu), *everywhere), stresses(float(nu), *section)
        for friction in FRICTION + SMALL:
            mu = mp.mpf(friction)
            state = added(body, float(mu))
            tensile, distortion = at_edge(nu, mu)
            assert abs(at(nu, mu, EDGE[0], EDGE[2]) - distortion) < ROUNDING
            assert principal(state).max() < tensile + ROUNDING
            if friction in SMALL:
                continue
            tension += row((poisson, friction), (tensile, *EDGE))
            worst, place = largest(nu, mu, section, cut)
            assert mises(state).max() < worst + ROUNDING
            yields += row((poisson, friction), (worst, *place))
        for start, end, mu in switches(nu):
            switch += row((poisson, start, end), (mu, at_edge(nu, mu)[1]))
    for name, text in (("yield", yields), ("switch", switch), ("tension", tension)):
        (HERE / f"{name}.csv").write_text(text)


if __name__ == "__main__":
    main()
