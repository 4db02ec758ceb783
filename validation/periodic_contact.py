"""Periodic contact on a rectangular cell after Polonsky & Keer, Wear 231 (1999) 206: conjugate gradients on one grid with
the mean pressure prescribed. For the scripts that make the reference tables; nothing of percoat enters.

    pip install numpy scipy
"""

import numpy as np
from scipy import fft


class Body:
    """A surface with the compliance 2 T(q)/(E* q); the mean of its displacement is zero."""

    def __init__(self, shape, cell, modulus=1.0, transfer=None):
        q = 2 * np.pi * np.hypot(
            fft.fftfreq(shape[0], cell[0] / shape[0])[:, None], fft.rfftfreq(shape[1], cell[1] / shape[1])[None, :]
        )
        q[0, 0] = 1.0
        self.compliance = 2 / (modulus * q) * (1.0 if transfer is None else transfer(q))
        self.compliance[0, 0] = 0.0
        self.shape = shape

    def displacement(self, pressure):
        return fft.irfft2(self.compliance * fft.rfft2(pressure), s=self.shape)


def solve(body, height, mean, start=None, tolerance=1e-9):
    """Pressure and penetration under the mean pressure; height: of the rigid surface, toward the body."""
    p = np.full(height.shape, mean) if start is None else start * (mean / start.mean())
    direction, before, restart = np.zeros_like(p), 1.0, True
    for _ in range(5000):
        gap = body.displacement(p) - height
        contact = p > 0
        penetration = gap[contact].mean()
        gap -= penetration
        square = (gap[contact] ** 2).sum()
        direction = np.where(contact, gap + (0 if restart else square / before) * direction, 0.0)
        before = square
        answer = body.displacement(direction)
        answer -= answer[contact].mean()
        step = (gap[contact] * direction[contact]).sum() / (answer[contact] * direction[contact]).sum()
        old = p
        p = np.maximum(np.where(contact, p - step * direction, 0.0), 0.0)
        overlap = (p == 0) & (gap < 0)
        restart = bool(overlap.any())
        p[overlap] -= step * gap[overlap]
        p *= mean / p.mean()
        if np.abs(p - old).sum() < tolerance * old.sum():
            return p, penetration
    raise RuntimeError("not converged")


def grid(shape, cell):
    """Coordinates of the samples."""
    return np.meshgrid(*(np.arange(n) * (length / n) for n, length in zip(shape, cell)), indexing="ij")
