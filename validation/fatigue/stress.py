"""Stresses for the references of fatigue: waves on one bonded layer (or none), numerically per wavenumber, and Hankel integrals of axisymmetric loads.

Conventions of layered.py: s = q z, F: sigma_zz = -F p, sigma_qz = -i F' p, sigma_qq = F'' p, sigma_tt = nu (F'' - F) p; 2 G q u_z = [(1-nu) F''' - (2-nu) F'] p,
2 G (i q u_q) = [(1-nu) F'' + nu F] p. Under pressure F(0) = 1, F'(0) = 0; under the traction q_L along the wavevector F(0) = 0 and sigma_qz = -q_L:
F'(0) = -i, F = -i Phi, Phi(0) = 0, Phi'(0) = 1: sigma_zz = i Phi, sigma_qz = -Phi', sigma_qq = -i Phi'', sigma_tt = -i nu (Phi'' - Phi).
Across: u_t = q_T W, sigma_tz = G dW/dz q_T = -q_T at z = 0, sigma_qt = i q G W q_T.
In a layer F = (a + b s) e^-s + (c + d s') e^s', s' = s - x. One 6 x 6 system a wavenumber, lengths in units of 1/q.
"""
import numpy as np
from scipy.special import jv


def basis(s, x, layered):
    """F, F', F'', F''' of the (2 or 4) functions at s: shape (len(s), 4, n)."""
    out = np.zeros((len(s), 4, 4 if layered else 2))
    e = np.exp(-s)
    for k in range(4):
        out[:, k, 0] = (-1) ** k * e
        out[:, k, 1] = (-1) ** k * (s - k) * e
        if layered:
            g = np.exp(s - x)
            out[:, k, 2] = g
            out[:, k, 3] = (s - x + k) * g
    return out


def disp(f, nu):
    return (1 - nu) * f[:, 3] - (2 - nu) * f[:, 1], (1 - nu) * f[:, 2] + nu * f[:, 0]


class Amplitudes:
    """body: (h, E1, nu1, E2, nu2) or (E, nu)."""

    def __init__(self, q, body):
        self.q, self.body = q, body
        n = len(q)
        if len(body) == 2:
            self.coef = None
            return
        h, e1, nu1, e2, nu2 = body
        g1, g2 = e1 / (2 * (1 + nu1)), e2 / (2 * (1 + nu2))
        x = q * h
        top, bot, sub = basis(0 * x, x, True), basis(x, x, True), basis(0 * x, x, False)
        m = np.zeros((n, 6, 6))
        m[:, 0, :4], m[:, 1, :4] = top[:, 0], top[:, 1]
        for r in (0, 1):
            m[:, 2 + r, :4], m[:, 2 + r, 4:] = bot[:, r], -sub[:, r]
        for r, (l, s) in enumerate(zip(disp(bot, nu1), disp(sub, nu2))):
            m[:, 4 + r, :4], m[:, 4 + r, 4:] = l, -g1 / g2 * s
        rhs = np.zeros((n, 6, 2))
        rhs[:, 0, 0], rhs[:, 1, 1] = 1, 1
        self.coef = np.linalg.solve(m, rhs)          # (n, 6, [F, Phi])
        # across, W in the layer: A e^-s + B e^s', below C e^-(s - x); G dW/dz = -1 at the surface
        t = np.exp(-x)
        r = (g1 - g2) / (g1 + g2)                    # B = A e^-x r
        self.A = 1 / (g1 * q * (1 - r * t * t))
        self.Bc = self.A * t * r
        self.C = self.A * t * (1 + r)
        self.g = (g1, g2)

    def at(self, z, below):
        """Real amplitudes: normal (zz, qz, qq, tt) with factors (1, i, 1, 1); along (zz, qz, qq, tt) with factors (i, 1, i, i); across (tz, qt) with (1, i).

        sigma = factor * amplitude * load.
        """
        q = self.q
        if self.coef is None:
            nu = self.body[1]
            f = basis(q * z, 0, False)
            F, P = f @ np.array([1.0, 1.0]), f @ np.array([0.0, 1.0])
            w = np.exp(-q * z)
            tz, qt = -w, w
        else:
            h, _, nu1, _, nu2 = self.body
            x = q * h
            if below:
                nu = nu2
                f = basis(q * (z - h), x, False)
                F, P = (np.einsum('nkc,nc->nk', f, self.coef[:, 4:, r]) for r in (0, 1))
                e = np.exp(-q * (z - h))
                tz, qt = -self.g[1] * q * self.C * e, self.g[1] * q * self.C * e
            else:
                nu = nu1
                f = basis(q * z, x, True)
                F, P = (np.einsum('nkc,nc->nk', f, self.coef[:, :4, r]) for r in (0, 1))
                d, u = np.exp(-q * z), np.exp(q * (z - h))
                tz, qt = self.g[0] * q * (-self.A * d + self.Bc * u), self.g[0] * q * (self.A * d + self.Bc * u)
        normal = (-F[:, 0], -F[:, 1], F[:, 2], nu * (F[:, 2] - F[:, 0]))
        along = (P[:, 0], -P[:, 1], -P[:, 2], -nu * (P[:, 2] - P[:, 0]))
        return normal, along, (tz, qt)


def hankel_stresses(q, wq, load, amp, r, phi):
    """Tensors (xx, yy, zz, xy, xz, yz) at the points (r, phi): from the pressure s(r) and from the traction s(r) in +x.

    load(q) = int s r J0(q r) dr; field = int q load(q) (1/2pi) int amp e^{i q r cos(theta - phi)} dtheta dq.
    i^m J_m per harmonic m of theta: cos(m theta) -> i^m J_m(q r) cos(m phi).
    """
    normal, along, (tz, qt) = amp
    w = wq * q * load
    j = [jv(m, np.outer(r, q)) for m in range(4)]
    H = lambda m, a: j[m] @ (w * a)
    c, s = [np.cos(m * phi) for m in range(4)], [np.sin(m * phi) for m in range(4)]
    zz, qz, qq, tt = normal
    out_n = {}
    # normal: zz e^{..}: m = 0. qz: i qz (cos, sin): i * i J1 = -J1. qq cos^2 + tt sin^2 ...
    out_n['zz'] = H(0, zz)
    out_n['xz'], out_n['yz'] = -H(1, qz) * c[1], -H(1, qz) * s[1]
    mean, dev = (qq + tt) / 2, (qq - tt) / 2
    out_n['xx'] = H(0, mean) - H(2, dev) * c[2]
    out_n['yy'] = H(0, mean) + H(2, dev) * c[2]
    out_n['xy'] = -H(2, dev) * s[2]
    # tangential: q_L = cos, q_T = -sin
    zz, qz, qq, tt = along
    o = {}
    o['zz'] = -H(1, zz) * c[1]                                     # i zz cos -> i*i J1 cos
    # vector: along (cos, sin) qz q_L; across t = (-sin, cos): tz q_T; no i
    # x: qz cos^2 + tz sin^2 ; y: (qz - tz) sin cos
    o['xz'] = H(0, (qz + tz) / 2) - H(2, (qz - tz) / 2) * c[2]
    o['yz'] = -H(2, (qz - tz) / 2) * s[2]
    # in plane, factor i: n n qq cos + t t tt cos + (n t + t n) qt (-sin)
    # xx: cos^3 qq + sin^2 cos tt + 2 sin^2 cos qt ; (n_x t_x = -cos sin; times -sin: + sin^2 cos, twice)
    # yy: sin^2 cos qq + cos^3 tt - 2 sin^2 cos qt
    # xy: cos^2 sin qq - cos^2 sin tt + (cos^2 - sin^2)(-sin) qt
    c3a, c3b = (lambda a: -H(1, a) * c[1]), (lambda a: H(3, a) * c[3])  # i * i^m: m=1 -> -1, m=3 -> i*(-i) = +1
    s3a, s3b = (lambda a: -H(1, a) * s[1]), (lambda a: H(3, a) * s[3])
    cos3 = lambda a: 0.75 * c3a(a) + 0.25 * c3b(a)
    sin2cos = lambda a: 0.25 * c3a(a) - 0.25 * c3b(a)
    cos2sin = lambda a: 0.25 * s3a(a) + 0.25 * s3b(a)
    cos2th_sin = lambda a: -0.5 * s3a(a) + 0.5 * s3b(a)            # cos 2th sin th = (sin 3th - sin th)/2
    o['xx'] = cos3(qq) + sin2cos(tt + 2 * qt)
    o['yy'] = sin2cos(qq - 2 * qt) + cos3(tt)
    o['xy'] = cos2sin(qq - tt) - cos2th_sin(qt)
    return out_n, o


def principal_shear(t):
    """tau1 = (s1 - s3)/2 of the tensors in a dictionary of equal arrays."""
    m = np.stack([np.stack([t['xx'], t['xy'], t['xz']], -1), np.stack([t['xy'], t['yy'], t['yz']], -1), np.stack([t['xz'], t['yz'], t['zz']], -1)], -2)
    e = np.linalg.eigvalsh(m)
    return (e[..., 2] - e[..., 0]) / 2


def nodes(kmax, step, per=10, graded=True):
    """Gauss nodes on 0 ... kmax, panels of `step`, graded toward zero."""
    x, w = np.polynomial.legendre.leggauss(per)
    edges = np.concatenate([[0], step * 0.5 ** np.arange(12, 0, -1), np.arange(step, kmax + step, step)]) if graded else np.arange(0, kmax + step, step)
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + x)).ravel(), (half * w).ravel()


def hertz(q):
    """int_0^1 sqrt(1 - r^2) r J0(q r) dr = (sin q - q cos q)/q^3."""
    small = q < 0.05
    return np.where(small, 1 / 3 - q * q / 30 + q ** 4 / 840, (np.sin(q) - q * np.cos(q)) / np.where(small, 1, q) ** 3)
