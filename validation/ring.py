"""Axisymmetric frictionless problems of a rigid shape on a layered half-space, for the scripts that make reference tables; nothing of percoat enters.

A uniform unit pressure on the disc r < s displaces the surface of a half-space (E* = 1) by
    U(r, s) = (4 s/pi) E(r/s), r < s;   (4 r/pi) [E(s/r) - (1 - s^2/r^2) K(s/r)], r > s   (Johnson 1985, 3.4; moduli, not parameters),
on layers by 2 int T(k) J1(ks) s J0(kr)/k dk; w(r) = - int p'(s) U(r, s) ds for any p that vanishes at the edge.
"""
import numpy as np
from scipy.special import ellipk, ellipe, ellipkm1


def disc(r, s):
    r, s = np.broadcast_arrays(np.asarray(r, float), np.asarray(s, float))
    out = np.empty(r.shape)
    i = r <= s
    out[i] = 4 * s[i] / np.pi * ellipe((r[i] / np.where(s[i] > 0, s[i], 1)) ** 2)
    j = ~i
    m1 = (r[j] - s[j]) * (r[j] + s[j]) / r[j] ** 2
    out[j] = 4 * r[j] / np.pi * (ellipe((s[j] / r[j]) ** 2) - m1 * ellipkm1(m1))
    return out


def disc_slope(r, s):
    """dU/dr: -(4/pi) (K - E)(r/s) s/r for r < s; outside (4/pi)[E(s/r) - K(s/r)]."""
    r, s = np.broadcast_arrays(np.asarray(r, float), np.asarray(s, float))
    out = np.empty(r.shape)
    i = r < s
    m1 = (s[i] - r[i]) * (s[i] + r[i]) / s[i] ** 2
    m = (r[i] / s[i]) ** 2
    small = m < 1e-6
    full = (ellipkm1(m1) - ellipe(m)) / np.where(m > 0, np.sqrt(m), 1)
    out[i] = -4 / np.pi * np.where(small, np.sqrt(m) * np.pi / 4 * (1 + 3 * m / 8), full)
    j = ~i
    m1 = (r[j] - s[j]) * (r[j] + s[j]) / r[j] ** 2
    out[j] = 4 / np.pi * (ellipe((s[j] / r[j]) ** 2) - ellipkm1(np.maximum(m1, 1e-300)))
    return out


_X, _W = np.polynomial.legendre.leggauss(16)


def graded(lo, hi, at, levels=28):
    """Gauss nodes on (lo, hi), panels halved toward the point `at` inside or at an end."""
    edges = {lo, hi}
    for end in (lo, hi):
        if abs(end - at) > 0:
            edges |= {at + (end - at) * 0.5 ** k for k in range(levels)}
    edges.add(at)
    edges = np.array(sorted(e for e in edges if lo <= e <= hi))
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + _X)).ravel(), (half * _W).ravel()


def plastic_paraboloid(c, n=40, correction=None, estar=1.0):
    """Outer radius 1, R = 1, plastic disc r < c: hardness H, load P, approach delta and what evaluates the shape.

    r^2 = m - d cos t, m = (1 + c^2)/2, d = (1 - c^2)/2, 0 <= t <= pi; dp/dt = sum_{k=0}^{n-1} d_k cos(k t), pi d_0 = -H: both edges without
    singularity by construction. w(r) = -int dp/dt U dt; w = delta - r^2/2 on c <= r <= 1 at the n + 1 nodes of Chebyshev.
    """
    m, d = (1 + c * c) / 2, (1 - c * c) / 2
    t = np.pi * (np.arange(n + 1) + 0.5) / (n + 1)
    r = np.sqrt(m - d * np.cos(t))
    k = np.arange(n)
    a = np.zeros((n + 1, n + 1))
    for j in range(n + 1):
        x, w = graded(0, np.pi, t[j])
        u = disc(r[j], np.sqrt(m - d * np.cos(x)))
        if correction is not None:
            u = u + correction(r[j], np.sqrt(m - d * np.cos(x)))
        a[j, :n] = -(w * u) @ np.cos(np.outer(x, k)) / estar
    a[:, n] = -1
    x = np.linalg.solve(a, -r * r / 2)
    dk, delta = x[:n], x[n]
    hardness = -np.pi * dk[0]
    tt, w = graded(0, np.pi, np.pi / 2, 8)
    s2 = m - d * np.cos(tt)
    load = -np.pi * (w * s2) @ (np.cos(np.outer(tt, k)) @ dk)          # P = -int p' pi s^2 ds

    def pressure(theta):
        theta = np.atleast_1d(theta)
        return hardness + dk[0] * theta + sum(dk[i] * np.sin(i * theta) / i for i in range(1, n))

    def field(rr, kernel):
        out = []
        for q in np.atleast_1d(rr):
            at = np.arccos(np.clip((m - q * q) / d, -1, 1))
            x, w = graded(0, np.pi, at)
            out.append(-(w * kernel(q, np.sqrt(m - d * np.cos(x)))) @ (np.cos(np.outer(x, k)) @ dk) / estar)
        return np.array(out)

    u = disc if correction is None else (lambda a, b: disc(a, b) + correction(a, b))
    return dict(H=hardness, P=load, delta=delta, pressure=pressure, dk=dk,
                w=lambda q: field(q, u), slope=lambda q: field(q, disc_slope), m=m, d=d)


def rings(load, hardness, n, rmax, f=lambda r: r * r / 2, mesh=1.0):
    """Another algorithm: n rings of uniform pressure on 0 < r < rmax, collocated at their middles, three sets, given load. E* = 1."""
    e = rmax * (np.arange(n + 1) / n) ** mesh
    r = (e[:-1] + e[1:]) / 2
    u = disc(r[:, None], e[None, :])
    c = u[:, 1:] - u[:, :-1]
    area = np.pi * (e[1:] ** 2 - e[:-1] ** 2)
    ff = f(r)
    full, free = np.zeros(n, bool), r < 0.5 * rmax
    for _ in range(300):
        i = np.flatnonzero(free)
        a = np.zeros((i.size + 1,) * 2)
        a[:-1, :-1], a[:-1, -1], a[-1, :-1] = c[np.ix_(i, i)], -1, area[i]
        x = np.linalg.solve(a, np.append(-ff[i] - (c[np.ix_(i, np.flatnonzero(full))].sum(1) * hardness if full.any() else 0),
                                         load - hardness * area[full].sum()))
        p = np.where(full, hardness, 0.0)
        p[i], delta = x[:-1], x[-1]
        g = c @ p + ff - delta
        nfull = (free & (p > hardness)) | (full & (g <= 0))
        nfree = ~(nfull | (free & (p < 0)) | (~free & ~full & (g >= 0)))
        if (nfull == full).all() and (nfree == free).all():
            return dict(p=p, r=r, e=e, g=g, delta=delta, free=free, full=full, area=area)
        full, free = nfull, nfree
    raise RuntimeError('rings do not settle')
