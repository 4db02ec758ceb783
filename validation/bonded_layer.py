"""T(qh) of a layer bonded to a half-space, for the scripts that make the reference tables.

Stress function F(s), s = qz, as in kernel/generate.py: F = 1 and F' = 0 on the surface; F, F', u_z, u_q continuous at
the interface, 2Gq u_z = (1-nu)F''' - (2-nu)F', 2Gq u_q = (1-nu)F'' + nu F. One 6 x 6 system in 30 digits; nothing of
percoat enters. shear_ratio = G1/G2 = 0 makes the substrate rigid.   pip install mpmath
"""

from functools import lru_cache

import mpmath as mp

mp.mp.dps = 30


def derivatives(x, s, growing):
    """F to F''' of (a + b s)e^-s and, of a layer of thickness x, (c + d s')e^s', s' = s - x."""
    rows = []
    for k in range(4):
        e = (-1) ** k * mp.exp(-s)
        row = [e, (s - k) * e]
        if growing:
            e = mp.exp(s - x)
            row += [e, (s - x + k) * e]
        rows.append(row)
    return rows


def displacements(f, nu):
    """2Gq u_z and 2Gq u_q."""
    normal = [(1 - nu) * c - (2 - nu) * a for a, c in zip(f[1], f[3])]
    return normal, [(1 - nu) * c + nu * a for a, c in zip(f[0], f[2])]


@lru_cache(maxsize=None)
def transfer(x, shear_ratio, nu1, nu2):
    """Surface displacement over that of a half-space of the layer's material; x = qh."""
    x, ratio, nu1, nu2 = (mp.mpf(str(v)) for v in (x, shear_ratio, nu1, nu2))
    top, bottom, below = derivatives(x, mp.mpf(0), True), derivatives(x, x, True), derivatives(x, mp.mpf(0), False)
    system = [top[0] + [0, 0], top[1] + [0, 0]]
    system += [bottom[k] + [-v for v in below[k]] for k in (0, 1)]
    for layer, substrate in zip(displacements(bottom, nu1), displacements(below, nu2)):
        system.append(layer + [-ratio * v for v in substrate])
    solution = mp.lu_solve(mp.matrix(system), mp.matrix([1, 0, 0, 0, 0, 0]))
    surface = displacements(top, nu1)[0]
    return mp.fdot(surface, solution[:4]) / (2 * (1 - nu1))
