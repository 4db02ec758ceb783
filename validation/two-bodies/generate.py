"""Makes indentation.csv, periodic.csv and pressures.csv.

indentation.csv: one contact in free space, the integral equation of ../indentation.py with the composite compliance.

periodic.csv and pressures.csv: the discrete problem of a square cell 1 x 1 with 48 x 48 samples, without iterating on the pressure. u = C p, C circulant:
the transform of u is 2T/(E* q) times that of p, summed over both bodies, q = 2 pi (i, j), |i|, |j| <= 24, with the Nyquist lines at their own q and zero at
q = 0. p >= 0, g = u + f - delta >= 0, pg = 0 by active sets, each solved densely, [C -1; 1 0][p; delta] = [-f; N pbar], until p < 0 and g < 0
change nothing.   pip install mpmath numpy scipy; python generate.py (a minute)
"""

import sys
from pathlib import Path

import numpy as np
from scipy.linalg import lu_factor, lu_solve

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from indentation import Body, solve as indent  # noqa: E402
from layered import compliance  # noqa: E402

B = "bonded"
ALONE = [([(1, 2, 0.3, B)], (1, 0.3)), ([(0.5, 0.5, 0.45, B)], (3, 0.25))]
RADII = (0.02, 0.1, 0.5, 1, 2, 5, 20)

N, R = 48, 0.5
BODY = ([(0.1, 2, 0.3, B)], (1, 0.3))
COUNTERBODY = ([(0.05, 0.5, 0.45, B)], (3, 0.25))
# Position, drop, level.
INDENTERS = [((0, 0), 0.0, 0), ((0.5, 0.5), 0.002, 1), ((0.5, 0), 0.004, 2), ((0, 0.5), 0.004, 2)]
LOADS = (0.01, 0.03, 0.1)

INDENTATION = """\
# Paraboloid r^2/2 of an elastic counterbody in free space: body (1, 2, 0.3, bonded) on E = 1, nu = 0.3; counterbody (0.5, 0.5, 0.45,
# bonded) on E = 3, nu = 0.25; (h, E, nu, lower interface). Columns as in free-space/indentation.csv; generate.py, good to 1e-10.
a,P,delta,p0,S
"""
PERIODIC = """\
# The periodic problem of README.md, solved densely: two = 1 with the counterbody, 0 under a rigid one; mean pressure pbar, penetration
# delta, fraction of the samples in contact, loads of the levels over the whole one; generate.py.
two,pbar,delta,fraction,share0,share1,share2
"""
PRESSURES = """\
# Pressures at the samples (i/48, j/48), 0 <= j <= i <= 24, in the order of periodic.csv; the others are the same by x -> -x, y -> -y and
# x <-> y.
"""


def gaps():
    x = np.arange(N) / N
    x, y = np.meshgrid(x, x, indexing="ij")
    each = [((x - px - np.round(x - px)) ** 2 + (y - py - np.round(y - py)) ** 2) / (2 * R) + drop for (px, py), drop, _ in INDENTERS]
    level = np.array([own for _, _, own in INDENTERS])[np.argmin(each, 0)]
    return np.min(each, 0), level


def matrix(bodies):
    i = np.fft.fftfreq(N, 1 / N)
    q = 2 * np.pi * np.hypot(*np.meshgrid(i, i, indexing="ij"))
    unique, inverse = np.unique(q, return_inverse=True)
    multiplier = np.zeros(unique.shape)
    for layers, substrate in bodies:
        multiplier[1:] += np.asarray(compliance(unique[1:], layers, substrate) / unique[1:], float)
    c = np.fft.ifft2(multiplier[inverse].reshape(q.shape)).real
    i = np.arange(N)
    apart = (i[:, None] - i[None, :]) % N
    return c[apart[:, None, :, None], apart[None, :, None, :]].reshape(N * N, N * N)


def solve(c, f, mean):
    """Pressure and penetration."""
    active = f < np.sort(f)[int(0.25 * f.size)]
    for _ in range(200):
        index = np.flatnonzero(active)
        k = index.size
        system = np.zeros((k + 1, k + 1))
        system[:k, :k] = c[np.ix_(index, index)]
        system[:k, k], system[k, :k] = -1, 1
        right = np.append(-f[index], f.size * mean)
        factors = lu_factor(system)
        found = lu_solve(factors, right)
        found += lu_solve(factors, right - system @ found)
        p = np.zeros(f.size)
        p[index], delta = found[:k], found[k]
        g = c @ p + f - delta
        new = (active & (p >= 0)) | (~active & (g < 0))
        if (new == active).all():
            assert abs(g[active]).max() < 1e-15 and p.min() >= 0 and abs(p.mean() - mean) < 1e-15
            return p, delta
        active = new
    raise RuntimeError("the active set does not settle")


def main():
    f, level = gaps()
    table, names, pressures = PERIODIC, [], []
    for two, bodies in ((1, (BODY, COUNTERBODY)), (0, (BODY,))):
        c = matrix(bodies)
        for mean in LOADS:
            p, delta = solve(c, f.ravel(), mean)
            p = p.reshape(f.shape)
            shares = [p[level == m].sum() / p.sum() for m in range(3)]
            table += f"{two},{mean}," + ",".join("%.15g" % v for v in (delta, (p > 0).mean(), *shares)) + "\n"
            names.append(f"{'two' if two else 'rigid'}_{mean}")
            pressures.append(p)
    (HERE / "periodic.csv").write_text(table)
    text = PRESSURES + "i,j," + ",".join(names) + "\n"
    for i in range(N // 2 + 1):
        for j in range(i + 1):
            text += f"{i},{j}," + ",".join("0" if p[i, j] == 0 else "%.15g" % p[i, j] for p in pressures) + "\n"
    (HERE / "pressures.csv").write_text(text)
    table, body = INDENTATION, Body(ALONE, max(RADII), 2)
    for a in RADII:
        found = indent(body, a)
        table += f"{a}," + ",".join("%.14g" % found[k] for k in ("P", "delta", "p0", "S")) + "\n"
    (HERE / "indentation.csv").write_text(table)


if __name__ == "__main__":
    main()
