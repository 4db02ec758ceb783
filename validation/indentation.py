"""For the scripts that make reference tables: isolated rigid paraboloid r^2/(2R) pressed on layered bodies (free space, frictionless), contact radius a given.

u_z(r) = (2/E*) int_0^inf T(k) P(k) J0(kr) dk,  P(k) = int_0^a p r J0(kr) dr = (E*/pi) int_0^a phi(t) cos(kt) dt.
Abel's operator d/dx int_0^x r (.)/sqrt(x^2-r^2) dr turns u_z = delta - r^2/(2R) into
    phi(x) + (2/pi) int_0^a K(x,t) phi(t) dt = delta - x^2/R,   K = int_0^inf (T-1) cos(kx) cos(kt) dk,
and phi(a) = 0 (no square-root singularity) fixes delta.  Then
    P  = 2 E* int phi dt,     dP/ddelta = 2 E* int phi_1 dt  (phi_1: right-hand side 1, the flat punch of radius a),
    p0 = (E*/pi) [2a/R - (2/pi) int_0^a phi(t) int_0^inf (T-1) k Si(ka) cos(kt) dk dt],
    p(r) = -(E*/pi) int_r^a phi'(t)/sqrt(t^2-r^2) dt.
"""
import numpy as np
from scipy.special import sici
from layered import transfer


def gauss(edges, n):
    x, w = np.polynomial.legendre.leggauss(n)
    edges = np.asarray(edges, float)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()


class Body:
    """T sampled once on graded Gauss panels; fine = 1 or 2 sets the number of nodes per panel."""

    def __init__(self, bodies, amax, fine=1):
        hs = [[l[0] for l in layers] for layers, _ in bodies if layers]
        thin, total, top = min(map(min, hs)), max(map(sum, hs)), min(h[0] for h in hs)
        kmax = 24 / top                                   # T - 1 ~ x^2 exp(-2x), x = k * top, < 1e-17
        step = min(0.25 / thin, 12 / (2 * amax))          # radians per panel of cos(k (x+t)) <= 12
        graded = 0.05 / total * 0.5 ** np.arange(14, -1, -1)
        edges = np.concatenate([[0], graded[graded < step]])
        while edges[-1] < kmax:                           # grow geometrically, then uniformly
            edges = np.append(edges, edges[-1] + min(step, edges[-1]))
        self.k, wk = gauss(edges, 18 * fine)
        T, self.estar = transfer(self.k, bodies)
        self.tm1 = np.asarray(T - 1, float)
        self.w, self.wk = wk, wk * self.tm1
        self.fine = fine
        self.top = top


def solve(body, a, R=1.0, profile_points=0):
    n = int((36 + 22 * a / body.top) * body.fine)
    t, w = gauss([0, a], n)
    c = np.cos(np.outer(t, body.k))
    K = (c * body.wk) @ c.T
    ca = np.cos(a * body.k)
    Ka = (c * body.wk) @ ca                               # K(t, a)
    f1, f2 = np.linalg.solve(np.eye(n) + (2 / np.pi) * K * w, np.column_stack([np.ones(n), t**2])).T
    f1a = 1 - (2 / np.pi) * (Ka * w) @ f1                 # phi at x = a (Nystrom)
    f2a = a * a - (2 / np.pi) * (Ka * w) @ f2
    delta = f2a / f1a / R
    phi = delta * f1 - f2 / R
    P = 2 * body.estar * (w @ phi)
    S = 2 * body.estar * (w @ f1)
    q = (w * phi) @ c                                     # int phi cos(kt) dt
    p0 = body.estar / np.pi * (2 * a / R - (2 / np.pi) * (body.wk * body.k * sici(body.k * a)[0]) @ q)
    out = dict(a=a, P=P, delta=delta, p0=p0, S=S, q=q * body.estar / np.pi, q1=((w * f1) @ c) * body.estar / np.pi)
    if profile_points:
        g = (2 / np.pi) * q * body.wk * body.k
        r = a * np.sin(np.pi / 2 * (np.arange(profile_points) + 0.5) / profile_points)
        p = np.empty_like(r)
        for i, ri in enumerate(r):
            u, wu = gauss([0, np.sqrt(a * a - ri * ri)], 40 + int(10 * a / body.top))
            s = np.sqrt(ri * ri + u * u)
            p[i] = -body.estar / np.pi * (wu @ (-2 / R + np.sin(np.outer(s, body.k)) @ g / s))
        out.update(r=r, p=p)
    return out
