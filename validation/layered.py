"""Normal compliance of a layered elastic half-space, one wave at a time, for the scripts that make reference tables.

Nothing of percoat enters.   pip install mpmath numpy; python layered.py prints its checks.

Derivation.  Wave p = N(0) e^{iqx} on the surface, s = q z.  With a stress function F(s)
    sigma_zz = -F, sigma_xz = -i F', sigma_xx = F''      (equilibrium),   F'''' - 2F'' + F = 0,
    2 G U = (1-nu) F'' + nu F          U = i q u_x (plane strain)
    2 G W = (1-nu) F''' - (2-nu) F'    W = q u_z.
State at a depth: tractions (N, S) = (F, F'), displacements (U, W).  The stack below a plane is a 2 x 2
flexibility A:  (U, W) = A (N, S).  A layer is crossed upward by reflection of the downward decaying pair into
the upward decaying pair, each anchored at the face where it is largest, so that no growing exponential occurs:
    F = (a + b s) e^{-s} + (c + d s') e^{s'},  s' = s - x <= 0,  x = q h.
Extended precision (np.longdouble, 64 bit mantissa) throughout; waves long against the layer (q h < 0.05), where
the pairs are nearly dependent, in 50 decimal digits (mpmath).
"""
import mpmath
import numpy as np

LD = np.longdouble


def _mul(p, q):
    return ((p[0][0] * q[0][0] + p[0][1] * q[1][0], p[0][0] * q[0][1] + p[0][1] * q[1][1]),
            (p[1][0] * q[0][0] + p[1][1] * q[1][0], p[1][0] * q[0][1] + p[1][1] * q[1][1]))


def _sub(p, q):
    return tuple(tuple(p[i][j] - q[i][j] for j in (0, 1)) for i in (0, 1))


def _add(p, q):
    return tuple(tuple(p[i][j] + q[i][j] for j in (0, 1)) for i in (0, 1))


def _neg(p):
    return tuple(tuple(-p[i][j] for j in (0, 1)) for i in (0, 1))


def _inv(p):
    det = p[0][0] * p[1][1] - p[0][1] * p[1][0]
    return ((p[1][1] / det, -p[0][1] / det), (-p[1][0] / det, p[0][0] / det))


def _pairs(G, nu, num):
    """Tractions and displacements (columns: a, b | c, d) of both pairs at their anchor plane."""
    down = ((1, 0), (-1, 1), (1, -2), (-1, 3))   # F, F', F'', F''' of (a + b s) e^{-s} at s = 0
    up = ((1, 0), (1, 1), (1, 2), (1, 3))        # of (c + d s) e^{s}
    out = []
    for f in (down, up):
        f = [[num(v) for v in row] for row in f]
        trac = (tuple(f[0]), tuple(f[1]))
        disp = (tuple(((1 - nu) * f[2][j] + nu * f[0][j]) / (2 * G) for j in (0, 1)),
                tuple(((1 - nu) * f[3][j] - (2 - nu) * f[1][j]) / (2 * G) for j in (0, 1)))
        out += [trac, disp]
    return out


def compliance(q, layers, substrate):
    """q u_z per unit pressure amplitude (length-free), for waves q > 0.

    layers: from the surface down, tuples (h, E, nu, interface), the interface being the lower one:
    'bonded' or 'frictionless'.  substrate: (E, nu).  u_z = compliance / q.
    """
    q = np.atleast_1d(np.asarray(q, dtype=LD))
    if not layers:
        return np.full_like(q, 2 / estar(LD(substrate[0]), LD(substrate[1])))
    long_wave = q * LD(min(l[0] for l in layers)) < 0.05
    out = np.empty_like(q)
    out[~long_wave] = _recursion(q[~long_wave], layers, substrate, LD, np.exp)
    if long_wave.any():
        with mpmath.workdps(50):
            wide = np.array([mpmath.mpf(float(v)) for v in q[long_wave]], dtype=object)
            wide = _recursion(wide, layers, substrate, mpmath.mpf, np.frompyfunc(mpmath.exp, 1, 1))
            out[long_wave] = [LD(mpmath.nstr(v, 25)) for v in wide]
    return out


def _recursion(q, layers, substrate, num, exp):
    one = 0 * q + num(1)
    E, nu = num(float(substrate[0])), num(float(substrate[1]))
    G = E / (2 * (1 + nu))
    trac, disp, _, _ = _pairs(G, nu, num)
    A = _mul(disp, _inv(trac))
    A = tuple(tuple(A[i][j] * one for j in (0, 1)) for i in (0, 1))
    for h, E, nu, interface in reversed(layers):
        E, nu = num(float(E)), num(float(nu))
        G = E / (2 * (1 + nu))
        td, dd, tu, du = _pairs(G, nu, num)
        x = q * num(float(h))
        e = exp(-x)
        if interface == 'bonded':        # disp - A trac = 0, both rows
            cu = _sub(du, _mul(A, tu))
            cd = _sub(dd, _mul(A, td))
        elif interface == 'frictionless':   # S = 0;  W = A_WN N (A[1][0])
            cu = (tu[1], tuple(du[1][j] - A[1][0] * tu[0][j] for j in (0, 1)))
            cd = (td[1], tuple(dd[1][j] - A[1][0] * td[0][j] for j in (0, 1)))
        else:
            raise ValueError(interface)
        refl = _neg(_mul(_inv(cu), cd))           # (c, d) at the bottom from (a1, b1) at the bottom
        down = ((e, x * e), (0 * e, e))           # (a, b) at the top -> (a1, b1) at the bottom
        upw = ((e, -x * e), (0 * e, e))           # (c, d) at the bottom -> at the top
        back = _mul(upw, _mul(refl, down))
        A = _mul(_add(dd, _mul(du, back)), _inv(_add(td, _mul(tu, back))))
    return A[1][0]


def estar(E, nu):
    return E / (1 - nu * nu)


def surface(body):
    layers, substrate = body
    return layers[0][1:3] if layers else substrate


def transfer(q, bodies):
    """T(q) of one or two layered bodies together and the E* of their surfaces:
    u_z = 2/(E* q) T p, 1/E* = sum 1/E*_surface."""
    total = sum(compliance(q, layers, sub) for layers, sub in bodies)
    compl = sum(1 / LD(estar(LD(surface(b)[0]), LD(surface(b)[1]))) for b in bodies)
    return total / (2 * compl), float(1 / compl)


def t_closed(x, chi, nu1, nu2):
    """One bonded layer, closed form (Burmister), for checks only."""
    x = np.asarray(x, dtype=LD)
    chi, nu1, nu2 = LD(chi), LD(nu1), LD(nu2)
    th = np.exp(-2 * x)
    lam = 1 - 4 * (1 - nu1) / (1 + chi * (3 - 4 * nu2))
    kap = (chi - 1) / (chi + 3 - 4 * nu1)
    return (1 + 4 * x * kap * th - lam * kap * th**2) / (1 - (lam + kap + 4 * kap * x**2) * th + lam * kap * th**2)


def t_smooth(x, chi, nu1, nu2):
    """One layer on a frictionless interface, closed form, for checks only."""
    x = np.asarray(x, dtype=LD)
    rho = LD(chi) * (1 - LD(nu2)) / (1 - LD(nu1))
    th = np.exp(-2 * x)
    d = (1 - th)**2 / 4 - x * x * th
    f = ((1 - th**2) / 4 + x * th) / d
    g = np.exp(-x) * ((1 - th) / 2 + x * (1 + th) / 2) / d
    return f - g * g / (f + rho)


if __name__ == '__main__':
    def one(x, chi, nu1, nu2, itf):
        layers = [(1, LD(2) * LD(chi) * (1 + LD(nu1)), nu1, itf)]
        sub = (LD(2) * (1 + LD(nu2)), nu2)
        return transfer(x, [(layers, sub)])[0]
    worst = 0
    for row in [(2, .2, .3, .1, 'bonded', 1.72526660632), (2, .2, .3, .5, 'bonded', 1.61261047905), (2, .2, .3, 1, 'bonded', 1.41117464928),
                (2, .2, .3, 2, 'bonded', 1.1244653574), (2, .2, .3, 4, 'bonded', 1.00660669173), (2, .2, .3, .1, 'frictionless', 1.7994760911),
                (2, .2, .3, .5, 'frictionless', 1.93268354951), (2, .2, .3, 1, 'frictionless', 1.81148393277),
                (.5, .45, .3, .1, 'bonded', .618461746474), (.5, .45, .3, .5, 'bonded', .606912178864),
                (.5, .45, .3, 1, 'bonded', .687768355896), (.5, .45, .3, 1, 'frictionless', 1.03780023197), (.5, .45, .3, 2, 'bonded', .874281670537)]:
        t = float(one([row[3]], row[0], row[1], row[2], row[4])[0])
        worst = max(worst, abs(t / row[5] - 1))
    print('independent values of T, worst relative difference (printed digits 1e-12):', worst)
    x = np.geomspace(1e-3, 60, 400)
    for chi, n1, n2 in [(10, .2, .3), (100, .2, .3), (.01, .5, .3), (1e3, .3, .3), (1e-3, .3, .5)]:
        b = np.abs(one(x, chi, n1, n2, 'bonded') / t_closed(x, chi, n1, n2) - 1)
        f = np.abs(one(x, chi, n1, n2, 'frictionless') / t_smooth(x, chi, n1, n2) - 1)
        for lo in (1e-3, 1e-2, .1):
            print(f'chi {chi}: x>{lo}: bonded {float(b[x >= lo].max()):.1e}, frictionless {float(f[x >= lo].max()):.1e}')
    # one layer split in two, and a stack of one material
    q = np.geomspace(1e-3, 30, 100)
    one_l = transfer(q, [([(1, 5, .25, 'bonded')], (1, .3))])[0]
    two_l = transfer(q, [([(.3, 5, .25, 'bonded'), (.7, 5, .25, 'bonded')], (1, .3))])[0]
    same = transfer(q, [([(.3, 1, .3, 'bonded'), (.7, 1, .3, 'bonded')], (1, .3))])[0]
    print('split layer', float(np.abs(two_l / one_l - 1).max()), 'homogeneous', float(np.abs(same - 1).max()))
