"""Makes reference.csv: the surface displacement around a uniformly loaded disc on a bonded coating.

c [B(r) + integral (T - 1) J1(q) J0(qr)/q dq], c = 2/E1*: B, the part without coating, in elliptic integrals, the rest
by Gauss-Legendre until it has died off.   pip install mpmath numpy; python generate.py > reference.csv
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from bonded_layer import transfer  # noqa: E402

HEAD = """\
# Surface displacement u_z at the distance r from the centre of a disc of radius 1 under unit pressure on a bonded coating: E1 = 10,
# E2 = 1, nu = 0.3, h = 1. Hankel integrals with multiprecision amplitudes and 2000 Gauss nodes, the part without coating in closed
# form, independent of this program; good to about 1e-7, printed with eight decimals.
r,displacement"""
NODES, WEIGHTS = np.polynomial.legendre.leggauss(24)
PANELS = 30  # of unit length


def bare(r):
    if r <= 1:
        return 2 / mp.pi * mp.ellipe(r * r)
    m = 1 / r**2
    return 2 / mp.pi * r * (mp.ellipe(m) - (1 - m) * mp.ellipk(m))


def displacement(r):
    total = bare(mp.mpf(r))
    for panel in range(PANELS):
        for node, weight in zip(NODES, WEIGHTS):
            q = panel + 0.5 * (1 + float(node))
            change = transfer(q, "10", "0.3", "0.3") - 1
            total += 0.5 * weight * change * mp.besselj(1, q) * mp.besselj(0, q * r) / q
    return 2 * (1 - mp.mpf("0.3") ** 2) / 10 * total


print(HEAD)
for r in ("0", "0.5", "1.5", "3"):
    print(f"{r},{float(displacement(float(r))):.8f}")
