"""Stresses in a half-space under a sliding sphere in closed form, for numpy arrays or mpmath numbers.

Lengths over the contact radius, stresses over p0 or q0, z into the body, tension positive. Under the normal load the
body carries the pressure s(r) = sqrt(1 - r^2), under the tangential one the traction s(r) in +x, sigma_xz = -s.

Waves exp(i k.x) on the surface, n along k, t across it, zeta = kz, all times exp(-zeta):

    pressure 1         zz = -(1+zeta)    nz = i zeta        nn = -(1-zeta)     tt = -2 nu
    traction 1 on n    zz = i zeta       nz = -(1-zeta)     nn = i (2-zeta)    tt = 2 i nu
    traction 1 on t                      tz = -1            nt = i

The transform of s is 2 pi (sin k - k cos k)/k^3, so that cos or sin(m theta) zeta^j exp(-zeta) becomes
i^m cos or sin(m phi) z^j H_jm,

    H_jm = int_0^inf (sin k - k cos k)/k^2 k^j exp(-kz) J_m(kr) dk = -Im [i g_(j-1)m + g_(j-2)m],
    g_jm = int_0^inf k^j exp(-k Z) J_m(kr) dk,   Z = z + i,  R = sqrt(r^2 + Z^2),  v = 1/(R + Z),

    g_0m  = (rv)^m / R
    g_-1m = (rv)^m / m                     g_-10 = log v
    g_-2m = r (g_-1(m-1) + g_-1(m+1))/2m   g_-20 = -Z log v - R    (but for what drops out of H)

theta and phi are the bearings of k and of the point. (rv)^m cos or sin(m phi) are v^m times polynomials in x and y.

Sources: K. L. Johnson, Contact Mechanics (1985), 13.2, for the waves under pressure; the rest is an own derivation.
G. M. Hamilton, Proc. Inst. Mech. Eng. 197C (1983) 53, gives closed forms of the same stresses.
"""

import mpmath
import numpy as np

COMPONENTS = ("xx", "yy", "zz", "xy", "xz", "yz")


def hankel(x, y, z, library):
    """H_0m/r^m and z H_1m/r^m for m = 0 ... 3."""
    square = x * x + y * y
    source = z + 1j
    root = library.sqrt((square - 1 + z * z) + 2j * z)
    v = 1 / (root + source)
    log = library.log(v)
    depth = z / (root + (root == 0))  # at the edge it is zero
    once = [log, v, v**2 / 2, v**3 / 3, v**4 / 4]
    twice = [-source * log - root, (once[0] + square * once[2]) / 2]
    twice += [(once[m - 1] + square * once[m + 1]) / (2 * m) for m in (2, 3)]
    return (
        [-(1j * once[m] + twice[m]).imag for m in range(4)],
        [-(1j * depth * v**m + z * once[m]).imag for m in range(4)],
    )


def stresses(nu, x, y, z, library=np):
    """The components under the normal and under the tangential load; library: np or mpmath."""
    h, zh = hankel(x, y, z, library)
    square, product = x * x - y * y, 2 * x * y
    cube, cross = x * x * x - 3 * x * y * y, 3 * x * x * y - y * y * y
    mean = -((1 + 2 * nu) * h[0] - zh[0]) / 2
    turned = ((1 - 2 * nu) * h[2] - zh[2]) / 2
    normal = {
        "xx": mean + square * turned,
        "yy": mean - square * turned,
        "zz": -h[0] - zh[0],
        "xy": product * turned,
        "xz": -x * zh[1],
        "yz": -y * zh[1],
    }
    first, third = (2 * nu * h[1] + zh[1]) / 4, (2 * nu * h[3] + zh[3]) / 4
    tangential = {
        "xx": x * (3 * first - 2 * (1 + nu) * h[1]) - cube * third,
        "yy": x * (first - 2 * nu * h[1]) + cube * third,
        "zz": -x * zh[1],
        "xy": y * (first - h[1]) - cross * third,
        "xz": -h[0] + zh[0] / 2 - square * zh[2] / 2,
        "yz": -product * zh[2] / 2,
    }
    return normal, tangential
