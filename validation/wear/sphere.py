"""For sphere.csv (finish.py): a rigid-backed paraboloid r^2/2 that wears on a half-space, given load; see README.md.

E* = 1, R = 1, P = 4/3 (Hertz: a = 1, p0 = 2/pi, delta = 1), dh/d(ks) = p.  Two programs:
 1. front: the contact's edge steps from node to node of a mesh, p linear between nodes and zero at the edge; the path to the next node is
    unknown. u + h + f = delta at the nodes of the contact; h by the trapezoidal rule. Errors fall as the mesh.
 2. rings: uniform rings, fixed mesh, implicit steps of given size, contact by sets.
"""
import sys
from pathlib import Path
import numpy as np
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from ring import disc  # noqa: E402

LOAD = 4 / 3


def influence(e):
    """w at the nodes e per unit slope dp/dr of each panel: -int U ds; load per slope: -int pi s^2 ds."""
    x, w = np.polynomial.legendre.leggauss(8)
    lo, hi = e[:-1], e[1:]
    half = (hi - lo) / 2
    s = lo[:, None] + half[:, None] * (1 + x)
    out = -np.einsum('ijk,jk->ij', disc(e[:, None, None], s[None]), half[:, None] * w)
    # panels that touch the node: graded
    edges = np.concatenate([[0], 0.5 ** np.arange(24, -1, -1)])
    gx = (edges[:-1, None] + np.diff(edges)[:, None] / 2 * (1 + x)).ravel()
    gw = (np.diff(edges)[:, None] / 2 * w).ravel()
    for i in range(len(e)):
        for j in (i - 1, i):
            if 0 <= j < len(lo):
                d = hi[j] - lo[j]
                s = hi[j] - d * gx if j == i - 1 else lo[j] + d * gx
                out[i, j] = -(disc(e[i], s) @ gw) * d
    return out, -np.pi * (hi ** 3 - lo ** 3) / 3


def front(n0, amax, theta=0.5):
    e = list(np.arange(n0 + 1) / n0)
    while e[-1] < amax:
        e.append(e[-1] * (1 + 1 / n0))
    e = np.array(e)
    slope_w, slope_p = influence(e)
    d = np.diff(e)
    # nodal pressures -> slopes
    m = len(e)
    nod = np.zeros((m - 1, m))
    nod[np.arange(m - 1), np.arange(m - 1)], nod[np.arange(m - 1), np.arange(1, m)] = -1 / d, 1 / d
    c, load = slope_w @ nod, slope_p @ nod
    f = e * e / 2
    h, ks, p = np.zeros(m), 0.0, np.zeros(m)
    out = []
    # start: edge at node n0 without wear, load as it comes; lengths scale with it at the end
    j = n0
    a = np.zeros((j + 1, j + 1))
    a[:, :j], a[:, j] = c[:j + 1, :j], -1
    x = np.linalg.solve(a, -f[:j + 1])
    p[:j], delta = x[:j], x[j]
    total = load @ p
    out.append((0.0, e[j], delta, p[0], 0.0, 0.0))
    def vol(h):
        return np.pi * np.sum(d * (h[:-1] * (2 * e[:-1] + e[1:]) + h[1:] * (e[:-1] + 2 * e[1:])) / 3)
    for j in range(n0 + 1, m - 1):
        def attempt(ds):
            a = np.zeros((j + 1, j + 1))
            a[:j, :j], a[:j, j], a[j, :j] = c[:j, :j] + theta * ds * np.eye(j), -1, load[:j]
            x = np.linalg.solve(a, np.append(-(f + h + (1 - theta) * ds * p)[:j], total))
            q = np.zeros(m)
            q[:j] = x[:j]
            miss = c[j] @ q + f[j] + h[j] + (1 - theta) * ds * p[j] - x[j]
            return miss, q, x[j]
        guess = out[-1][0] * 4 / n0 if len(out) > 3 else 0.5 / n0
        s0, s1 = 0.8 * (step if len(out) > 1 else guess), (step if len(out) > 1 else guess)
        m0, m1 = attempt(s0)[0], attempt(s1)[0]
        for _ in range(30):
            s2 = s1 - m1 * (s1 - s0) / (m1 - m0)
            s0, m0, s1 = s1, m1, s2
            m1, q, delta = attempt(s1)
            if abs(s1 - s0) < 1e-12 * abs(s1) or abs(m1) < 1e-15:
                break
        step = s1
        h = h + step * (theta * q + (1 - theta) * p)
        p, ks = q, ks + step
        out.append((ks, e[j], delta, p[0], h[0], vol(h) / (ks * total)))
    # scale to load 4/3: length L with total -> L^3
    L = (total / LOAD) ** (1 / 3)
    t = np.array(out)
    return np.column_stack([t[:, 0] / L, t[:, 1] / L, t[:, 2] / L ** 2, t[:, 3] / L, t[:, 4] / L ** 2, t[:, 5]])


def rings(n, rmax, times, steps):
    e = rmax * np.arange(n + 1) / n
    r = (e[:-1] + e[1:]) / 2
    u = disc(r[:, None], e[None, :])
    c = u[:, 1:] - u[:, :-1]
    area = np.pi * (e[1:] ** 2 - e[:-1] ** 2)
    f, h, s = r * r / 2, np.zeros(n), 0.0
    k = int(np.searchsorted(r, 1.0))
    out = []
    def contact(extra):
        nonlocal k
        for _ in range(60):
            a = np.zeros((k + 1, k + 1))
            a[:k, :k], a[:k, k], a[k, :k] = c[:k, :k] + extra * np.eye(k), -1, area[:k]
            x = np.linalg.solve(a, np.append(-(f + h)[:k], LOAD))
            if x[k - 1] < 0:
                k -= 1
                continue
            if c[k, :k] @ x[:k] + f[k] + h[k] - x[k] < 0:
                k += 1
                continue
            return x[:k], x[k]
        raise RuntimeError
    for t, m in zip(times, steps):
        ds = (t - s) / m
        for _ in range(m):
            p, d = contact(ds)
            h[:k] += ds * p
        s = t
        p, d = contact(0.0)
        out.append((d, (9 * p[0] - p[1]) / 8, (9 * h[0] - h[1]) / 8))
    return np.array(out)


def at(table, ks):
    """Rows at given paths by cubic splines."""
    from scipy.interpolate import CubicSpline
    return CubicSpline(table[:, 0], table[:, 1:])(ks)
