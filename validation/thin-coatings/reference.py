"""Load under which c r^n, c = 1/2, on a bonded coating has the contact radius 1 (nu_2 = 0.3, E_2 = 1): the integral
equation of README.md with Gauss points on [0, 1] and panels over the wavenumber, both refined until ten digits stand.

    python reference.py > reference.csv
"""

import sys
from math import gamma, pi, sqrt

import numpy as np
from numpy.polynomial.legendre import leggauss


def correction(x, chi, nu1, nu2=0.3):
    lam = 1 - 4 * (1 - nu1) / (1 + chi * (3 - 4 * nu2))
    kap = (chi - 1) / (chi + 3 - 4 * nu1)
    theta = np.exp(-2 * x)
    end = lam * kap * theta * theta
    return (1 + 4 * x * kap * theta - end) / (1 - (lam + kap + 4 * kap * x * x) * theta + end)


def load(young, nu1, h, n, points, finer=1):
    chi = young * 1.3 / (1 + nu1)
    scale = young / (1 - nu1**2) / pi
    x, weight = leggauss(points)
    x, weight = 0.5 * (x + 1), 0.5 * weight
    end = 24 / h
    edges = np.linspace(0, end, int(np.ceil(finer * end * (1 / 6 + h / 3))) + 5)
    node, part = leggauss(24)
    width = np.diff(edges)[:, None]
    q = (edges[:-1, None] + 0.5 * width * (node + 1)).ravel()
    wave = (0.5 * width * part).ravel() * (correction(q * h, chi, nu1) - 1)
    cosine = np.cos(np.outer(q, np.append(x, 1.0)))
    kernel = 2 / pi * (cosine.T @ (wave[:, None] * cosine)) * np.append(weight, 0)
    system = np.eye(points) + kernel[:points, :points]
    kappa = 0.5 * sqrt(pi) * gamma(n / 2 + 1) / gamma((n + 1) / 2)
    flat = np.linalg.solve(system, np.full(points, scale))
    curved = np.linalg.solve(system, scale * kappa * x**n)
    edge = kernel[points, :points]
    penetration = (scale * kappa - edge @ curved) / (scale - edge @ flat)
    return 2 * pi * weight @ (penetration * flat - curved)


print("young,poisson,thickness,exponent,load")
for young in (0.1, 0.5, 2, 10, 100, 1000):
    # The stiffest are plates; a thick one would bend as far as the images of the cell.
    for h in (0.01, 0.03, 0.1, 0.3)[: 3 if young == 1000 else 4]:
        for n in (2, 1, 4) if h == 0.03 and young in (0.1, 10) else (2,):
            points = 90 + int(3.3 / h)
            value = load(young, 0.3, h, n, points)
            finer = load(young, 0.3, h, n, points * 5 // 4, 1.3)
            print(f"{young},0.3,{h},{n},{value:.10f}")
            print(f"{young} {h} {n}: changes by {abs(finer / value - 1):.0e} on refinement", file=sys.stderr)
