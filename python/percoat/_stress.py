"""Quantities that are derived from a stress tensor."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def principal(stress: ArrayLike) -> Array:
    """Principal stresses σ₁ ≥ σ₂ ≥ σ₃ (…, 3) of stresses (…, 6): xx, yy, zz, xy, xz, yz.

    >>> import percoat
    >>> percoat.principal([1.0, -2.0, 3.0, 0.0, 0.0, 0.0])
    array([ 3.,  1., -2.])
    """
    xx, yy, zz, xy, xz, yz = np.moveaxis(np.asarray(stress, dtype=float), -1, 0)
    tensor = np.stack([np.stack(row, axis=-1) for row in ((xx, xy, xz), (xy, yy, yz), (xz, yz, zz))], axis=-2)
    return np.linalg.eigvalsh(tensor)[..., ::-1]


def s1(stress: ArrayLike) -> Array:
    """The largest tension σ₁ (…) of stresses (…, 6)."""
    return principal(stress)[..., 0]


def tau1(stress: ArrayLike) -> Array:
    """The largest shear τ₁ = (σ₁ − σ₃)/2 (…) of stresses (…, 6).

    >>> import percoat
    >>> float(percoat.tau1([0.0, 0.0, 0.0, 2.0, 0.0, 0.0]))
    2.0
    """
    values = principal(stress)
    return 0.5 * (values[..., 0] - values[..., 2])


def mises(stress: ArrayLike) -> Array:
    """The von Mises stress (…) of stresses (…, 6).

    >>> import percoat
    >>> float(percoat.mises([1.0, 0.0, 0.0, 0.0, 0.0, 0.0]))
    1.0
    """
    xx, yy, zz, xy, xz, yz = np.moveaxis(np.asarray(stress, dtype=float), -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    squared: Array = 0.5 * normal + 3.0 * (xy**2 + xz**2 + yz**2)
    return np.sqrt(squared)
