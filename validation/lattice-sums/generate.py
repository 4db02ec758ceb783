"""Makes reference.csv: effective lattice sums of a triangular lattice on a bonded coating.

Bare: S_n = 6 zeta(n/2) L(chi_-3, n/2), S1 checked by an Ewald sum with two splitting parameters. The coating adds
reciprocal sums of T - 1, which falls as exp(-2Gh).   python generate.py > reference.csv
"""

import sys
from collections import Counter
from pathlib import Path

import mpmath as mp

sys.path.insert(0, str(Path(__file__).parent.parent))
from bonded_layer import transfer  # noqa: E402

HEAD = """\
# Effective lattice sums of a triangular lattice of period 1 on a bonded coating, nu2 = 0.3: 30-digit Epstein zeta sums
# (6 zeta(n/2) L(chi_-3, n/2), confirmed by an Ewald sum) plus converged reciprocal sums of T - 1. thickness infinite: none.
# s1, s3, s5: one level; own_1: S1 of three levels to their own level, other_1, other_3: S1, S3 to each other level.
thickness,chi,nu1,s1,s3,s5,own_1,other_1,other_3"""
COATINGS = ["0.5,2.0,0.20", "0.5,0.5,0.45", "0.5,0.5,0.20", "0.12,0.2,0.22", "0.12,5.0,0.22"]
REACH = 26  # largest Gh: exp(-52)


def bare(n):
    return 6 * mp.zeta(mp.mpf(n) / 2) * mp.dirichlet(mp.mpf(n) / 2, [0, 1, -1])


def norms(most):
    """How often i^2 + ij + j^2 takes each of its values from 1 to most."""
    size = int((4 * most / 3) ** 0.5) + 1
    values = (i * i + i * j + j * j for i in range(-size, size + 1) for j in range(-size, size + 1))
    return Counter(v for v in values if 0 < v <= most)


def ewald(alpha):
    area, total = mp.sqrt(3) / 2, -2 * alpha / mp.sqrt(mp.pi) - 2 * mp.sqrt(mp.pi) * 2 / (mp.sqrt(3) * alpha)
    for value, count in norms(40).items():
        r = mp.sqrt(value)
        g = 4 * mp.pi / mp.sqrt(3) * r
        total += count * (mp.erfc(alpha * r) / r + 2 * mp.pi / (area * g) * mp.erfc(g / (2 * alpha)))
    return total


def coated(period, thickness, chi, nu1):
    """S1, S3, S5 of a lattice of this period."""
    first = 4 * mp.pi / (mp.sqrt(3) * period)
    area = mp.sqrt(3) / 2 * period**2
    sums = [bare(n) / period**n for n in (1, 3, 5)]
    for value, count in sorted(norms(int((REACH / (first * thickness)) ** 2)).items()):
        g = first * mp.sqrt(value)
        change = count * 2 * mp.pi / area * (transfer(g * thickness, chi, nu1, "0.3") - 1)
        sums = [sums[0] + change / g, sums[1] - change * g, sums[2] + change * g**3 / 9]
    return sums


def row(full, own):
    return [*full, own[0], (full[0] - own[0]) / 2, (full[1] - own[1]) / 2]


def main():
    mp.mp.dps = 30
    assert max(abs(ewald(mp.mpf(alpha)) - bare(1)) for alpha in ("1.8", "2.2")) < 1e-20
    print(HEAD)
    root = mp.sqrt(3)
    values = row([bare(n) for n in (1, 3, 5)], [bare(n) / root**n for n in (1, 3, 5)])
    print("inf,1.0,0.30," + ",".join(repr(float(v)) for v in values))
    for coating in COATINGS:
        thickness, chi, nu1 = coating.split(",")
        full, own = (coated(period, mp.mpf(thickness), chi, nu1) for period in (mp.mpf(1), root))
        digits = [10, 10, 8, 8, 8, 8]
        print(coating + "," + ",".join(f"{float(v):.{d}f}" for v, d in zip(row(full, own), digits)))


if __name__ == "__main__":
    main()
