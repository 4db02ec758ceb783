"""Makes wave.csv, wave-pressure.csv, paraboloid.csv, unloading.csv, coated.csv and foundation.csv; see README.md.   python exact.py"""
import sys
from pathlib import Path
import mpmath as mp
import numpy as np
from scipy.optimize import brentq
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from dense import matrix, solve  # noqa: E402
from ring import graded, plastic_paraboloid, rings  # noqa: E402
mp.mp.dps = 25


# ---- the wave f = D (1 - cos x), wavelength 2 pi, E* = 1, D = 1: p* = 1/2
T = np.pi / 2 * (np.arange(800) + 0.5) / 800
WT = np.pi / 1600                                    # the rule of the middles is exact to round-off for these integrands, even and of period pi


def wave(a, c):
    """Half-widths a of contact and c of the plastic strip, c < a < pi: hardness and mean pressure over p* = 1/2.  s = cos c + (1 - cos c) sin^2 t."""
    e1, e2 = np.cos(a), np.cos(c)
    gap = 2 * np.sin((a + c) / 2) * np.sin((a - c) / 2)            # e2 - e1
    step = 2 * np.sin(c / 2) ** 2 * np.sin(T) ** 2                 # s - e2
    g = 2 / np.sqrt((1 + e2 + step) * (gap + step))
    i0, i1 = WT * g.sum(), WT * (g * (gap / 2 + step)).sum()       # of 1 and of s - (e1 + e2)/2
    return np.pi / i0, i1 / i0


def wave_exact(a, c):
    """The same in 25 digits by adaptive quadrature."""
    a, c = mp.mpf(a), mp.mpf(c)
    e1, e2 = mp.cos(a), mp.cos(c)
    def integral(g):
        def inner(t):
            s = e2 + (1 - e2) * mp.sin(t) ** 2
            return 2 * g(s) / mp.sqrt((1 + s) * (s - e1))
        return mp.quad(inner, [0, mp.pi / 4, mp.pi / 2])
    i0 = integral(lambda s: mp.mpf(1))
    return mp.pi / i0, integral(lambda s: s - (e1 + e2) / 2) / i0


def wave_pressure(a, c, x):
    """p/H at x, pole and first term at s = cos c taken out in closed form."""
    if x <= c:
        return 1.0
    if x >= a:
        return 0.0
    e1, e2 = np.cos(a), np.cos(c)
    A = 2 * np.sin((x + c) / 2) * np.sin((x - c) / 2)              # e2 - y
    Bb = 2 * np.sin(c / 2) ** 2                                    # 1 - e2
    below = 2 * np.sin((a + x) / 2) * np.sin((a - x) / 2)          # y - e1
    u = Bb * np.sin(T) ** 2
    g = 1 / np.sqrt((1 + e2 + u) * (e2 - e1 + u))
    g0 = 1 / np.sqrt((1 + e2) * (e2 - e1))
    g1 = -g0 / 2 * (1 / (1 + e2) + 1 / (e2 - e1))
    pole = np.pi / np.sqrt(A * (A + Bb))
    rest = WT * (2 * (g - g0 - g1 * u) / (A + u)).sum()
    return np.sin(x) * np.sqrt(A * below) / np.pi * (g0 * pole + g1 * (np.pi - A * pole) + rest)


def wave_delta(a, c):
    """delta/D = w + f at x = a,  w = -(2/(pi E*)) int_0^pi p ln|2 (cos s - cos a)| ds;  H = wave(a, c)[0]/2 at D = E* = 1."""
    hard = wave(a, c)[0] / 2
    mid = (a + c) / 2
    s, w = graded(mid, a, a, 24)
    s2, w2 = graded(c, mid, c, 24)
    q, v = graded(0.0, c, c, 24)
    s, w = np.concatenate([s2, s]), np.concatenate([w2, w])
    p = np.array([wave_pressure(a, c, x) for x in s])
    log = lambda x: np.log(4 * np.abs(np.sin((x + a) / 2) * np.sin((x - a) / 2)))
    load = (w @ p + c) / np.pi * hard
    assert abs(load * 2 - wave(a, c)[1]) < 1e-9, (2 * load, wave(a, c)[1])
    return -2 * hard / np.pi * ((w * p) @ log(s) + v @ log(q)) + 1 - np.cos(a)


def wave_numeric(n, hard, mean):
    q = np.abs(np.fft.fftfreq(n, 1 / n))
    hat = np.where(q > 0, 2 / np.where(q > 0, q, 1), 0)[:, None]
    c = matrix(hat)
    f = 1 - np.cos(2 * np.pi * np.arange(n) / n)
    p, d, sets = solve(c, f, hard, mean=mean)
    free, full = sets
    # edges from the pressures beside them: sqrt law
    return p, d, full, free


def main_wave():
    rows, pres = ['H_pstar,pbar_pstar,plastic,contact,delta_D'], ['H_pstar,pbar_pstar,x_pi,p_H']
    targets = [(0.2, .1), (.2, .9), (.5, .3), (.5, .5), (.5, .8), (1, .3), (1, .5), (1, .8), (1.2, .5), (1.3, .4), (1.3, .8), (2.5, .9)]
    check = []
    for hard, share in targets:
        # find (a, c): unknown logit
        def solve_a(c):
            lo, hi = c * (1 + 1e-4), np.pi * (1 - 1e-9)
            g = lambda a: float(wave(a, c)[0]) - hard
            return brentq(g, lo, hi, xtol=1e-15, rtol=1e-14) if g(lo) * g(hi) < 0 else None
        def miss(c):
            a = solve_a(c)
            return float(wave(a, c)[1]) - share * hard
        cs = np.linspace(.01, .99, 60) * np.pi
        vals = []
        for c in cs:
            a = solve_a(c)
            vals.append(np.nan if a is None else float(wave(a, c)[1]) - share * hard)
        vals = np.array(vals)
        ok = np.flatnonzero((vals[:-1] < 0) & (vals[1:] >= 0) & (2 * np.sqrt(hard * (1 - share)) > hard))
        if not ok.size:
            S = hard * (1 - share)                       # contact is complete: H - p is the pressure on the wave upside down
            c, a, d = 2 * np.arccos(np.sqrt(S)), np.pi, 2 - S * (1 - np.log(S))
            assert 2 * np.sqrt(S) <= hard, (hard, share)
            rows.append('%g,%g,%.12f,1,%.11f' % (hard, share * hard, c / np.pi, d))
            for i in range(1, 8):
                x = c + (a - c) * i / 8
                pres.append('%g,%g,%.12f,%.12f' % (hard, share * hard, x / np.pi, 1 - np.sqrt((np.cos(c) - np.cos(x)) * (1 - np.cos(x))) / hard))
            p, dn, full, free = wave_numeric(512, hard / 2, share * hard / 2)
            check.append((hard, share, 512, dn - d, full.mean() - c / np.pi, (full | free).mean() - 1, 0, 0))
            continue
        c = brentq(miss, cs[ok[0]], cs[ok[0] + 1], xtol=1e-14)
        a = solve_a(c)
        d = wave_delta(a, c)
        fine = wave_exact(a, c)
        assert abs(fine[0] - hard) < 1e-11 and abs(fine[1] - share * hard) < 1e-11, (fine, hard)
        rows.append('%g,%g,%.12f,%.12f,%.11f' % (hard, share * hard, c / np.pi, a / np.pi, d))
        for i in range(1, 8):
            x = c + (a - c) * i / 8
            pres.append('%g,%g,%.12f,%.12f' % (hard, share * hard, x / np.pi, float(wave_pressure(a, c, x))))
        for n in (128, 256, 512):
            p, dn, full, free = wave_numeric(n, hard / 2, share * hard / 2)
            xs = 2 * np.pi * np.arange(n) / n
            mine = np.array([float(wave_pressure(a, c, min(x, 2 * np.pi - x))) for x in xs[: n // 2: max(1, n // 128)]])
            err = np.abs(p[: n // 2: max(1, n // 128)] / (hard / 2) - mine)
            check.append((hard, share, n, dn - d, full.mean() - c / np.pi, (full | free).mean() - a / np.pi, err.max(), err.mean()))
    for r in check:
        print('wave H/p*=%g pbar/H=%g n=%d  delta %+.1e plastic %+.1e contact %+.1e pressure/H max %.1e mean %.1e' % r)
    (HERE / 'wave.csv').write_text('\n'.join(rows) + '\n')
    (HERE / 'wave-pressure.csv').write_text('\n'.join(pres) + '\n')


# ---- the paraboloid, R = 1, E* = 1, load 4/3: Hertz a = 1, p0 = 2/pi, delta = 1
def scaled(c, n=24, **kw):
    s = plastic_paraboloid(c, n, **kw)
    return s


def main_paraboloid():
    rows = ['H_p0,a,c,delta,depth,volume,plastic_fraction,H_over_mean']
    unload = ['H_p0,P_over_load,a,delta']
    for eta in (0.9, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3):
        def miss(c, n=24):
            s = plastic_paraboloid(c, n)
            p0 = (6 * s['P'] / np.pi ** 3) ** (1 / 3)
            return s['H'] / p0 - eta
        c0 = brentq(lambda c: miss(c, 14), .2, 1 - 2e-6, xtol=1e-13)
        out = []
        for n in (16, 24, 32):
            c = c0
            s = plastic_paraboloid(c, n)
            L = (s['P'] / (4 / 3)) ** (1 / 3)          # P ~ length^3: scale so that the load is 4/3
            q = np.linspace(0, c, 2)
            w0 = s['w'](0.0)[0]
            depth = s['delta'] - w0                     # -g(0), f(0) = 0
            x, wq = np.polynomial.legendre.leggauss(20)
            rr = np.sqrt((1 + x) / 2) * c               # r dr
            g = s['w'](rr) + rr ** 2 / 2 - s['delta']
            volume = -np.pi * (wq * c * c / 2) @ g
            out.append((1 / L, c / L, s['delta'] / L ** 2, depth / L ** 2, volume / L ** 4, c * c, s['H'] * np.pi / s['P']))
        spread = np.abs(np.array(out) - out[1]).max(0)
        rows.append('%g,' % eta + ','.join('%.11g' % v for v in out[1]))
        print('paraboloid', eta, ['%.10g' % v for v in out[1]], 'spread', ['%.0e' % v for v in spread])
        # rings
        res = []
        for n in ((200, 400) if eta in (.9, .7, .5) else ()):
            rg = rings(4 / 3, eta * 2 / np.pi, n, 1.15 / L)
            i = np.flatnonzero(rg['full'])
            res.append((rg['delta'] - out[1][2], -rg['g'][0] - rg['r'][0] ** 2 * 0 - out[1][3], -(rg['area'] * np.minimum(rg['g'], 0))[rg['full']].sum() - out[1][4]))
        print('   rings 200, 400 minus it (delta, depth at r_1, volume):', [['%+.1e' % v for v in r] for r in res])
        # unloading: shape f2, f2' = -w' for r < c, r outside; g(x) = x int_0^x f2'/sqrt(x^2-r^2) dr
        s = plastic_paraboloid(c0, 24)
        # slope of the shape over r inside the plastic disc, smooth in v = sqrt(1 - r^2/c^2)
        from numpy.polynomial import chebyshev
        v = (1 - np.cos(np.pi * (np.arange(32) + 0.5) / 32)) / 2
        rv = c0 * np.sqrt((1 - v) * (1 + v))
        fit = chebyshev.chebfit(2 * v - 1, -s['slope'](rv) / rv, 31)
        def over(r):
            return chebyshev.chebval(2 * np.sqrt(np.maximum(0, 1 - (r / c0) ** 2)) - 1, fit)
        probe = np.array([.13, .5, .9, .99]) * c0
        print('   fit of the slope', abs(over(probe) * probe + s['slope'](probe)).max(), 'last coefficients', abs(fit[-3:]).max())
        def gx(x):
            # r = x sin t
            edge = np.arcsin(min(1.0, c0 / x))
            t, w = graded(0, edge, edge, 20)
            v = (over(x * np.sin(t)) * x * np.sin(t)) @ w if edge > 0 else 0
            if edge < np.pi / 2:
                v += x * np.cos(edge)                   # int x sin t dt
            return x * v
        def load(a1):
            t, w = graded(0, a1, min(a1, c0), 12)
            vals = np.array([gx(x) for x in t])
            ga = gx(a1)
            return 2 * (ga * a1 - vals @ w), ga
        p_full, d_full = load(1.0)
        depth = s['delta'] - s['w'](0.0)[0]
        print('   unloading law at the full radius: load %.2e, approach %.2e (relative, should be 0)' % (p_full / s['P'] - 1, (d_full + depth) / s['delta'] - 1))
        if eta in (.9, .7, .5, .3):
            for share in (.9, .5, .1, .01):
                a1 = brentq(lambda a: load(a)[0] / s['P'] - share, .02, 1.0, xtol=1e-7)
                _, dd = load(a1)
                unload.append('%g,%g,%.8g,%.9g,' % (eta, share, a1 / L, (dd + depth) / L ** 2))
            unload.append('%g,0,0,%.9g,' % (eta, depth / L ** 2))
    (HERE / 'paraboloid.csv').write_text('\n'.join(rows) + '\n')
    (HERE / 'unloading.csv').write_text('\n'.join(u.rstrip(',') for u in unload) + '\n')


if __name__ == '__main__':
    what = sys.argv[1:] or ['wave', 'paraboloid']
    if 'paraboloid' in what:
        main_paraboloid()
    if 'wave' in what:
        main_wave()
