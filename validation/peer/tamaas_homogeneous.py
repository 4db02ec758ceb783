#!/usr/bin/env python3
"""Homogeneous half-spaces, solved by Tamaas: reference.csv of this folder.

    pip install tamaas
    python tamaas_homogeneous.py > reference.csv

Tamaas knows rectangular cells. A hexagonal lattice of period 1 is a rectangle 1 x sqrt(3) with two indenters. E* = 1.
Penetration is measured from the mean plane of the deformed surface to the highest apex; the fraction in contact counts samples
and takes off the excess of their outline (Yastrebov, Anciaux & Molinari 2017): beta * perimeter * spacing,
beta = (pi - 1 + ln 2)/24.
"""

import sys

import numpy as np
import tamaas as tm

tm.initialize()
tm.set_log_level(tm.LogLevel.error)

TOLERANCE = 1e-9


def nearest(x, side):
    """Coordinate relative to the nearest image of the origin."""
    return x - side * np.round(x / side)


def paraboloids(x, y, sides, sites, radius):
    """Depth below the highest apex of equal paraboloids."""
    depths = [(nearest(x - a, sides[0]) ** 2 + nearest(y - b, sides[1]) ** 2) / (2 * radius) for a, b in sites]
    return np.min(depths, axis=0)


def egg_box(x, y, sides, amplitude):
    return amplitude * (1 - np.cos(2 * np.pi * x / sides[0]) * np.cos(2 * np.pi * y / sides[1]))


def fraction(touching):
    """Fraction in contact; the cell has square samples."""
    edges = sum((touching != np.roll(touching, 1, axis)).sum() for axis in (0, 1))
    beta = (np.pi - 1 + np.log(2)) / 24
    return (touching.sum() - beta * edges) / touching.size


def solve(sides, points, depth, mean_pressure):
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, list(sides), list(points))
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, -depth, TOLERANCE)
    solver.max_iter = 2000
    residual = solver.solve(mean_pressure)
    assert residual <= TOLERANCE, residual
    pressure, displacement = np.array(model.traction), np.array(model.displacement)
    touching = pressure > 0
    # In contact w + f = delta; w without its mean.
    total = displacement - displacement.mean() + depth
    penetration = (total * pressure).sum() / pressure.sum()
    return penetration, pressure.max(), fraction(touching)


def samples(sides, points):
    return np.meshgrid(*(np.arange(n) * side / n for n, side in zip(points, sides)), indexing="ij")


def main():
    root3 = np.sqrt(3)
    cases = []
    # 1: hexagonal lattice, one level, as a rectangle of two. The samples are square to 3e-3.
    sides, points = (1.0, root3), (280, 484)
    depth = paraboloids(*samples(sides, points), sides, [(0, 0), (0.5, root3 / 2)], 0.8)
    cases += [(1, sides, points, depth, p) for p in (0.002, 0.01, 0.03, 0.06, 0.1)]
    # 2: square lattice.
    sides, points = (1.0, 1.0), (432, 432)
    depth = paraboloids(*samples(sides, points), sides, [(0, 0)], 0.8)
    cases += [(2, sides, points, depth, p) for p in (0.002, 0.01, 0.03, 0.06, 0.1)]
    # 3: oblong lattice, sides 1 and 2.
    sides, points = (1.0, 2.0), (320, 640)
    depth = paraboloids(*samples(sides, points), sides, [(0, 0)], 0.8)
    cases += [(3, sides, points, depth, p) for p in (0.002, 0.01, 0.03, 0.06)]
    # 4: egg-box of amplitude 0.01, at these fractions of its p* = sqrt(2) pi 0.01.
    sides, points = (1.0, 1.0), (432, 432)
    depth = egg_box(*samples(sides, points), sides, 0.01)
    complete = np.sqrt(2) * np.pi * 0.01
    cases += [(4, sides, points, depth, f * complete) for f in (0.05, 0.2, 0.5, 0.8, 0.95)]

    print(f"# Tamaas {tm.__version__}, NumPy {np.__version__}: output of tamaas_homogeneous.py. Cases: 1 hexagonal lattice of")
    print("# paraboloids, 2 square lattice, 3 oblong lattice 1 x 2, 4 egg-box of amplitude 0.01; R = 0.8, E* = 1.")
    print("case,mean_pressure,penetration,peak,fraction")
    for number, sides, points, depth, mean_pressure in cases:
        penetration, peak, contact = solve(sides, points, depth, mean_pressure)
        print(f"{number},{mean_pressure!r},{penetration:.9f},{peak:.9f},{contact:.6f}".replace("np.float64(", "").replace(")", ""))
        sys.stdout.flush()


if __name__ == "__main__":
    main()
