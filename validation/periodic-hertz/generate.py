"""Makes one-level.csv, three-levels.csv and coated.csv again with ../periodic_contact.py, and prints the largest relative
difference from the committed ones, which are rounded to their last digit.

    pip install numpy scipy mpmath; python generate.py
"""

import sys
from pathlib import Path

import numpy as np
from scipy.interpolate import CubicSpline

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from bonded_layer import transfer  # noqa: E402
from periodic_contact import Body, grid, solve  # noqa: E402

RADIUS, ROOT = 0.8, 3**0.5
ONE, THREE = ((280, 484), (1.0, ROOT)), ((504, 292), (3.0, ROOT))  # samples and sides of the rectangular cells


def surface(shape, cell, sites):
    """Height of paraboloids at the sites (x, y, height), and which one is on top."""
    x, y = grid(shape, cell)
    away = [[(v - s[k] + 0.5 * cell[k]) % cell[k] - 0.5 * cell[k] for k, v in enumerate((x, y))] for s in sites]
    heights = np.array([s[2] - (dx**2 + dy**2) / (2 * RADIUS) for s, (dx, dy) in zip(sites, away)])
    return heights.max(axis=0), heights.argmax(axis=0)


def rows(name):
    lines = [line for line in (HERE / f"{name}.csv").read_text().splitlines() if not line.startswith("#")]
    return [[float(v) for v in line.split(",")] for line in lines[1:]]


def compare(name, found, given):
    for values, row in zip(found, rows(name)):
        print(name, row[:given], " ".join(f"{v:.6g}" for v in values),
              f"largest difference {max(abs(v / r - 1) for v, r in zip(values, row[given:])):.1e}")


def one_level(pressures, modulus=1.0, change=None):
    body = Body(*ONE, modulus, change)
    height, _ = surface(*ONE, [(0, 0, 0), (0.5, 0.5 * ROOT, 0)])
    for mean in pressures:
        pressure, penetration = solve(body, height, mean)
        yield pressure.max(), penetration


def three_levels():
    body = Body(*THREE)
    for mean, step, *_ in rows("three-levels"):
        levels = [0, 1, 2, 2, 0, 1]  # (n1 - n2) mod 3 of the sites n1 a1 + n2 a2
        sites = [(i % 3 + 0.5 * (i // 3), i // 3 * 0.5 * ROOT, -step * level) for i, level in enumerate(levels)]
        height, owner = surface(*THREE, sites)
        pressure, penetration = solve(body, height, mean)
        level = np.array(levels)[owner]
        own = [pressure[level == m] for m in range(3)]
        yield [*(p.max() for p in own), *(p.sum() / pressure.sum() for p in own), penetration]


def coated():
    for chi, nu1, mean, *_ in rows("coated"):
        x = np.linspace(1.0, 20.0, 1000)  # the least qh is 1.8; beyond the last T - 1 is below 1e-14
        spline = CubicSpline(x, [float(transfer(v, chi, nu1, "0.3")) for v in x])
        modulus = 2 * chi / 2.6 / (1 - nu1)
        yield from one_level([mean], modulus, lambda q: np.where(0.5 * q < 20, spline(np.minimum(0.5 * q, 20)), 1.0))


compare("one-level", one_level([row[0] for row in rows("one-level")]), 1)
compare("three-levels", three_levels(), 2)
compare("coated", coated(), 3)
