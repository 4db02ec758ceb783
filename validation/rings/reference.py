"""Inner and outer radius and peak pressure of ring contacts: c r^4 on a coating that slides on its substrate, in a
hexagonal cell of period 4 whose images act by their curvature at the axis.

Contact between the radii a and b: p = N(s)/sqrt((s-a)(b-s)) solves w(r) = delta - c r^4 + c2 r^2 on it, with

    w(r) = (2/E1*) int p(s) s [G(r,s) + int_0^inf (T(qh) - 1) J0(qr) J0(qs) dq] ds,
    G = int J0(qr) J0(qs) dq = 2 K(m)/(pi (r+s)),  m = 4rs/(r+s)^2,

by Nystroem's method on cosine nodes, the logarithm of K integrated exactly; a and b are those where N vanishes.

    python reference.py > reference.csv
"""

import sys

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.optimize import fsolve
from scipy.special import ellipkm1, j0

NU = 0.3
COEFFICIENT = 1.0
PERIOD = 4.0


def correction(x, chi):
    """T of a layer without friction on its substrate."""
    rho = (1.0 / chi) * 1.0  # E2*/E1*: both nu are 0.3
    x = np.minimum(np.asarray(x, float), 300.0)
    th = np.exp(-2 * x)
    # layer with traction-free faces but for normal loads: F own, G across, over exp scaling
    d = (1 - th) ** 2 / 4 - x * x * th
    f = ((1 - th * th) / 4 + x * th) / d
    g = np.exp(-x) * ((1 - th) / 2 + x * (1 + th) / 2) / d
    # w = (2/E1* q)(F p0 - G p1), bottom (G p0 - F p1) = (1/rho) p1
    return f - g * g / (f + 1.0 / rho)


def solved(a, b, chi, h, load, n, rule):
    q, wave = rule
    phi = (np.arange(n) + 0.5) * np.pi / n
    m, d = 0.5 * (a + b), 0.5 * (b - a)
    r = m + d * np.cos(phi)
    k = np.arange(1, n)
    c = np.cos(np.outer(phi, k))
    log = -np.pi / n * np.log(2) + 2 / n * (c * (-np.pi / k)) @ c.T
    ri, rj = r[:, None], r[None, :]
    one = (ri - rj) ** 2 / (ri + rj) ** 2  # 1 - m
    factor = 2 / (np.pi * (ri + rj))
    # K(1-m) 2/pi is the coefficient of the logarithm
    coefficient = 2 / np.pi * ellipkm1(1 - one)
    with np.errstate(divide="ignore", invalid="ignore"):
        rest = ellipkm1(one) + coefficient * np.log(np.abs(ri - rj))
    np.fill_diagonal(rest, np.log(4) + np.log(2 * r))
    kernel = factor * (-coefficient * (log + np.pi / n * np.log(d)) + np.pi / n * rest)
    bessel = j0(np.outer(r, q))
    kernel = kernel + np.pi / n * (bessel * wave) @ bessel.T
    modulus = chi / (1 - NU**2)
    system = np.zeros((n + 1, n + 1))
    system[:n, :n] = 2 / modulus * kernel * rj
    system[:n, n] = -1
    system[n, :n] = 2 * np.pi * np.pi / n * r
    return system, r, phi


def ring(chi, h, load, n, refine):
    end = 40 / h
    edges = np.linspace(0, end, int(refine * 160) + 1)
    node, part = leggauss(16)
    width = np.diff(edges)[:, None]
    q = (edges[:-1, None] + 0.5 * width * (node + 1)).ravel()
    wave = (0.5 * width * part).ravel() * (correction(q * h, chi) - 1)
    # curvature of the images: a hexagonal lattice of Gaussians less one of them, second moment of the ring
    def curvature(square):
        term = lambda g: g * correction(g * h, chi) * np.exp(-0.5 * g * g * square)
        least = 4 * np.pi / np.sqrt(3) / PERIOD
        most = int(np.ceil(10 / np.sqrt(square) / least)) * 2
        i, j = np.meshgrid(np.arange(-most, most + 1), np.arange(-most, most + 1))
        ii = (i * i + i * j + j * j).ravel()
        lattice = term(least * np.sqrt(ii[ii > 0])).sum() / (np.sqrt(0.75) * PERIOD**2)
        steps = np.linspace(0, 10 / np.sqrt(square), 200001)[1:]
        alone = (steps * term(steps)).sum() * (steps[1] - steps[0]) / (2 * np.pi)
        return -load / 2 * (1 - NU**2) / chi * (lattice - alone)

    def conditions(ends, full=False):
        a, b = ends
        system, r, phi = solved(a, b, chi, h, load, n, (q, wave))
        c2 = 0.0
        for _ in range(3):
            right = np.append(c2 * r**2 - COEFFICIENT * r**4, load)
            solution = np.linalg.solve(system, right)
            number = solution[:n]
            second = 2 * np.pi * np.pi / n * (number * r**3).sum() / load
            c2 = curvature(0.5 * second)
        coefficients = 2 / n * np.cos(np.outer(np.arange(n), phi)) @ number
        coefficients[0] /= 2
        at_b, at_a = coefficients.sum(), (coefficients * (-1.0) ** np.arange(n)).sum()
        if full:
            fine = np.linspace(0.02, np.pi - 0.02, 4001)
            p = np.cos(np.outer(fine, np.arange(n))) @ coefficients / (0.5 * (b - a) * np.sin(fine))
            return a, b, p.max(), c2
        return [at_a, at_b]

    return conditions, lambda ends: conditions(ends, True)


if __name__ == "__main__":
    print("young,thickness,load,inner,outer,peak")
    for chi, h, load, start in [
        (100, 0.05, 0.0026, (0.115, 0.148)),
        (100, 0.05, 0.0087, (0.155, 0.198)),
        (300, 0.05, 0.0087, (0.18, 0.21)),
        (300, 0.02, 0.0026, (0.10, 0.14)),
    ]:
        ends = start
        values = []
        for n, refine in ((24, 1), (48, 2)):
            conditions, read = ring(chi, h, load, n, refine)
            ends, _, ok, message = fsolve(conditions, ends, full_output=True, xtol=1e-12)
            values.append(read(ends))
            if ok != 1: print(chi, h, message, file=sys.stderr)
        a, b, peak, c2 = values[-1]
        print(f"{chi},{h},{load},{a:.8f},{b:.8f},{peak:.8f}")
        print(chi, h, load, "changes", [abs(x / y - 1) for x, y in zip(values[0], values[1])], "c2", c2, file=sys.stderr)
