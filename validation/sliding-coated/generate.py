"""Makes stresses.csv and coupling.csv: a bonded coating under a Hertz-shaped pressure and traction, and its surface response.

Stress functions F(s), s = kz, of one layer bonded to a half-space, from the pieces of ../bonded_layer.py; across the wavevector a
harmonic V(s). With n along k, t across, all times e^(ik.x):

    pressure 1        F = 1, F' = 0     zz = -F          nz = -i F'    nn = F''       tt = nu (F'' - F)
    traction 1 on n   F = 0, F' = 1     zz = i F         nz = -F'      nn = -i F''    tt = nu i (F - F'')
    traction 1 on t   V' = -1           tz = V'          nt = i V

The transform of sqrt(1 - r^2) leaves integrals over k of (sin k - k cos k)/k^2 J_m(kx), m = 0 ... 3, by Gauss-Legendre until
e^(-kz) has died off. On the surface the part of a half-space of the coating's material is Johnson's: under the pressure
(1-2nu)/3 at the edge and -(1+2nu)/2 in the middle, under the traction -pi (4+nu) x/8 and -3 pi nu x/8. A coating of the substrate's
material is asserted to give ../sliding_sphere.py.

K. L. Johnson, Contact Mechanics (1985), 3.4, 7.1.   pip install mpmath numpy scipy; python generate.py
"""

import sys
from pathlib import Path

import mpmath as mp
import numpy as np
from scipy.special import jv

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from bonded_layer import derivatives, displacements, transfer  # noqa: E402
from sliding_sphere import stresses  # noqa: E402

STRESSES = """\
# Stresses of a layer on a half-space, bonded, nu = 0.3 in both, h = 1, in the plane y = 0, under the pressure sqrt(1 - r^2) ("normal") and
# under the traction sqrt(1 - r^2) in +x on the body ("tangential", 1 in its column); z into the body, tension positive; material 1 is
# the coating. ratio = E1/E2. Hankel integrals of 30-digit amplitudes, good to 1e-10; made by generate.py.
ratio,x,z,material,tangential,xx,yy,zz,xz
"""
COUPLING = """\
# Surface of a bonded layer, shear_ratio = G1/G2, under a pressure p: u_z = (1-nu1) T p/(G1 k), u_n = i coupling p/(2 G1 k), x = kh. On
# a half-space T = 1 and the coupling is 1 - 2nu1. One system of six equations in 30 digits; made by generate.py.
shear_ratio,nu1,nu2,x,T,coupling
"""
NU = mp.mpf("0.3")
POINTS = [(-1, 0, 1), (0, 0, 1), (-0.5, 0.5, 1), (0, 1, 1), (0, 1, 2), (-1, 1, 1), (-1, 1, 2), (0.5, 2, 2)]
POINTS += [(-1.5, 0.5, 1), (-2, 1, 2)]
RATIOS = ("4", "0.5")
STACKS = (("2", "0.2", "0.3"), ("0.5", "0.45", "0.3"), ("0.2", "0.5", "0.3"))
NODES, WEIGHTS = np.polynomial.legendre.leggauss(20)


def in_plane(x, chi, nu1, nu2):
    """Constants of F under the pressure and under the traction along k."""
    top, bottom, below = derivatives(x, mp.mpf(0), True), derivatives(x, x, True), derivatives(x, x, False)
    # What dies off in the substrate is measured from the interface.
    below = [[v * mp.exp(x) for v in row] for row in below]
    system = [top[0] + [0, 0], top[1] + [0, 0]]
    system += [bottom[k] + [-v for v in below[k]] for k in (0, 1)]
    for layer, substrate in zip(displacements(bottom, nu1), displacements(below, nu2)):
        system.append(layer + [-chi * v for v in substrate])
    system = mp.matrix(system)
    return [mp.lu_solve(system, mp.matrix(load + [0] * 4)) for load in ([1, 0], [0, 1])]


def amplitudes(k, z, material, chi):
    """zz, nz, nn, tt of the pressure, the same of the traction along k and tz, nt of that across, without their i."""
    k = mp.mpf(k)
    x, s = k, k * z  # h = 1
    solutions = in_plane(x, chi, NU, NU)
    values = []
    for constants in solutions:
        if material == 1:
            rows, part = derivatives(x, s, True), constants[:4]
        else:
            rows, part = derivatives(x, s, False), [c * mp.exp(x) for c in constants[4:]]
        values.append([mp.fdot(row, part) for row in rows[:3]])
    (f, f1, f2), (g, g1, g2) = values
    # V = a e^-s + b e^(s-x) in the layer, c e^(x-s) below; V' and V/G are continuous.
    die = mp.exp(-x)
    a, b, c = mp.lu_solve(mp.matrix([[-1, die, 0], [-die, 1, 1], [die, 1, -chi]]), mp.matrix([-1, 0, 0]))
    if material == 1:
        falling, growing = a * mp.exp(-s), b * mp.exp(s - x)
    else:
        falling, growing = c * mp.exp(x - s), 0
    v, v1 = falling + growing, growing - falling
    return [float(value) for value in (-f, f1, f2, NU * (f2 - f), g, -g1, -g2, NU * (g - g2), v1, v)]


def bare(s):
    """The same for a half-space of the coating's material."""
    s = float(s)
    e, nu = np.exp(-s), float(NU)
    return [-(1 + s) * e, -s * e, -(1 - s) * e, -2 * nu * e, s * e, -(1 - s) * e, (2 - s) * e, 2 * nu * e, -e, e]


def johnson(x):
    nu, pi = float(NU), np.pi
    hoop = -(1 + 2 * nu) / 2 if x == 0 else (1 - 2 * nu) / 3
    other = hoop if x == 0 else -hoop
    zz = -np.sqrt(1 - x * x)
    return [hoop, other, zz, 0], [-pi * (4 + nu) * x / 8, -3 * pi * nu * x / 8, 0, zz]


def integrals(x, z, material, chi):
    reach = 34 / (2 if z == 0 else z)
    edges = np.linspace(0, reach, int(np.ceil(reach / 2)) + 1)
    total = np.zeros((2, 4))
    for low, high in zip(edges[:-1], edges[1:]):
        half = (high - low) / 2
        k = low + half * (1 + NODES)
        a = np.array([amplitudes(value, z, material, chi) for value in k])
        if z == 0:
            a -= np.array([bare(0)] * len(k))
        zz, nz, nn, tt, lzz, lnz, lnn, ltt, tz, nt = a.T
        w = half * WEIGHTS * (np.sin(k) - k * np.cos(k)) / k**2
        j0, j1, j2, j3 = (jv(m, k * x) for m in range(4))
        cc, ss = (j0 - j2) / 2, (j0 + j2) / 2  # means of cos^2, sin^2 times e^(ikx cos)
        total[0] += [np.sum(w * v) for v in (nn * cc + tt * ss, nn * ss + tt * cc, zz * j0, nz * j1)]
        # Of i cos^3 and i sin^2 cos.
        ccc, ssc = (-3 * j1 + j3) / 4, (-j1 - j3) / 4
        total[1] += [
            np.sum(w * v)
            for v in (lnn * ccc + (ltt + 2 * nt) * ssc, lnn * ssc + ltt * ccc - 2 * nt * ssc, -lzz * j1, lnz * cc + tz * ss)
        ]
    return total + np.array(johnson(x)) if z == 0 else total


for x, z, material in POINTS:
    found = integrals(x, z, 1, mp.mpf(1))
    known = [[load[name] for name in ("xx", "yy", "zz", "xz")] for load in stresses(float(NU), x, 0.0, float(z))]
    assert np.abs(found - known).max() < 1e-10, (x, z, found - known)

with (HERE / "stresses.csv").open("w") as file:
    file.write(STRESSES)
    for ratio in RATIOS:
        for x, z, material in POINTS:
            for load, row in enumerate(integrals(x, z, material, mp.mpf(ratio))):
                numbers = ",".join(f"{round(value, 10) + 0.0:.10f}" for value in row)
                file.write(f"{ratio},{x},{z},{material},{load},{numbers}\n")

with (HERE / "coupling.csv").open("w") as file:
    file.write(COUPLING)
    for chi, nu1, nu2 in STACKS:
        for x in ("0.5", "1", "2"):
            pressed, _ = in_plane(mp.mpf(x), mp.mpf(chi), mp.mpf(nu1), mp.mpf(nu2))
            top = derivatives(mp.mpf(x), mp.mpf(0), True)
            # 2 G k u_n = -i times the displacement in terms of F.
            coupling = -mp.fdot(displacements(top, mp.mpf(nu1))[1], pressed[:4])
            normal = transfer(x, chi, nu1, nu2)
            file.write(f"{chi},{nu1},{nu2},{x},{mp.nstr(normal, 16)},{mp.nstr(coupling, 16)}\n")
