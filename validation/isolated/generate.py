"""Makes reference.csv and incompressible.csv: a rigid paraboloid r^2/2 alone on a bonded coating of thickness 1.

The Fredholm equation of README.md at Gauss points, linear in the penetration, which phi(a) = 0 determines; the
transform of T - 1 by Gauss points too, until it has died off.   pip install mpmath numpy; python generate.py
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent))
from bonded_layer import transfer  # noqa: E402

HERE = Path(__file__).parent
REACH, PANELS = 24.0, 24  # T - 1 falls as q^2 exp(-2q)
NODES = 80


def gauss(count, start, end):
    x, w = np.polynomial.legendre.leggauss(count)
    return 0.5 * (end - start) * x + 0.5 * (end + start), 0.5 * (end - start) * w


EDGES = np.linspace(0.0, REACH, PANELS + 1)
Q, WEIGHTS = (np.concatenate(v) for v in zip(*(gauss(10, a, b) for a, b in zip(EDGES, EDGES[1:]))))


def contact(shear_ratio, nu1, nu2, modulus, radius):
    """Load, penetration and pressure on the axis."""
    change = WEIGHTS * np.array([float(transfer(float(q), shear_ratio, nu1, nu2) - 1) for q in Q])
    t, w = gauss(NODES, 0.0, radius)
    points = np.append(t, radius)
    kernel = np.cos(np.outer(points, Q)) @ (change[:, None] * np.cos(np.outer(Q, t)))
    system = np.eye(NODES + 1)
    system[:, :NODES] += 2 / np.pi * kernel * w
    unit, square = np.linalg.solve(system, modulus / np.pi * np.array([np.ones(NODES + 1), points**2]).T).T
    penetration = square[-1] / unit[-1]
    phi = (penetration * unit - square)[:NODES]
    sine = np.array([float(mp.si(q * radius)) for q in Q])  # integral of sin(qx)/x from 0 to a
    peak = 2 * modulus * radius / np.pi - 2 / np.pi * np.dot(w * phi, np.cos(np.outer(t, Q)) @ (change * Q * sine))
    return 2 * np.pi * np.dot(w, phi), penetration, peak


REFERENCE = """\
# A paraboloid of radius 1 alone on a bonded coating of thickness 1, E2 = 1, nu2 = 0.3: contact radius, load, penetration, pressure
# on the axis. Fredholm equation after Abel's transformation, 60 to 140 Gauss points, independent of this program.
chi,nu1,radius,load,penetration,peak
"""
INCOMPRESSIBLE = """\
# An incompressible layer bonded to a rigid base under a sphere: X = sqrt(R delta)/h and P/(4/3 E* sqrt(R) delta^(3/2)) from the
# integral equation; its expansion 1 + 1.12696 X + 1.48170 X^2 + 1.47001 X^3 + ... agrees with the published
# 1 + 1.133 X + 1.497 X^2 + 1.469 X^3 + 0.755 X^4 of Garcia & Garcia, Biophys. J. 114 (2018) 2923.
x,ratio
"""


def main():
    text = REFERENCE
    for chi, nu1 in (("2.0", "0.20"), ("0.5", "0.45")):
        modulus = 2 * float(chi) / (2 * 1.3) / (1 - float(nu1))
        for radius in ("0.1", "0.3", "0.5", "1", "2"):
            values = contact(chi, nu1, "0.3", modulus, float(radius))
            text += f"{chi},{nu1},{radius}," + ",".join(f"{v:.10f}" for v in values) + "\n"
    (HERE / "reference.csv").write_text(text)
    text = INCOMPRESSIBLE
    for radius in (0.1, 0.3, 0.6, 1.0):
        load, penetration, _ = contact("0", "0.5", "0.3", 1.0, radius)
        x = penetration**0.5
        text += f"{x:.5f},{load / (4 / 3 * x**3):.6f}\n"
    (HERE / "incompressible.csv").write_text(text)


if __name__ == "__main__":
    main()
