"""Makes indentation.csv, indentation_noisy.csv and indentation_derivatives.csv: the loading curve of a coated sample, a noisy copy,
and exact derivatives.   pip install mpmath numpy scipy; python generate.py (some minutes)

Rigid sphere (paraboloid) R = 10 um, coating h = 1 um, E = 300 GPa, nu = .2, bonded on E = 70 GPa, nu = .3.
Units um and GPa, so that forces come in GPa um^2 = mN.
"""
import sys
from pathlib import Path

import numpy as np
from scipy.optimize import brentq

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from indentation import Body, gauss, solve  # noqa: E402
from layered import transfer  # noqa: E402

R, H, EC, NC, ES, NS = 10.0, 1.0, 300.0, 0.2, 70.0, 0.3
AMAX = 2.5


def sample(ec=EC, es=ES, h=H, fine=1):
    return Body([([(h, ec, NC, 'bonded')], (es, NS))], AMAX, fine)


def at_force(body, P):
    """State at the load P: radius by root finding, then one Newton step in delta (dP/ddelta = S)."""
    a = brentq(lambda a: solve(body, a, R)['P'] / P - 1, .3 * (.75 * P * R / 300)**(1 / 3), 3 * (.75 * P * R / 70)**(1 / 3), xtol=1e-13, rtol=1e-13)
    s = solve(body, a, R)
    s['delta'] += (P - s['P']) / s['S']
    return s


def main():
    body, fine = sample(), sample(fine=2)
    force = np.geomspace(0.1, 100, 60)
    force[-1] = 100
    rows, worst = [], 0
    for i, P in enumerate(force):
        s = at_force(body, P)
        rows.append((P, s['delta'], s['a'], s['p0'], s['S']))
        if i % 12 == 11:
            t = at_force(fine, P)
            worst = max(worst, max(abs(s[k] / t[k] - 1) for k in ('delta', 'a', 'p0', 'S')))
    head = ('# Loading curve, rigid paraboloid R = 10 um on coating h = 1 um, E = 300 GPa, nu = 0.2, bonded to E = 70 GPa, nu = 0.3; free space, frictionless.\n'
            '# delta: approach of distant points.')
    with open(HERE / 'indentation.csv', 'w') as out:
        out.write(head + ' Exact to 1e-11.\nforce_mN,penetration_um\n')
        for r in rows:
            out.write('%.14g,%.14g\n' % r[:2])
    noise = np.random.default_rng(20260101).normal(0, 0.5e-3, len(rows))
    with open(HERE / 'indentation_noisy.csv', 'w') as out:
        out.write(head + ' Gaussian noise of 0.5 nm standard deviation in the penetration (numpy default_rng(20260101)).\nforce_mN,penetration_um\n')
        for r, n in zip(rows, noise):
            out.write('%.14g,%.9f\n' % (r[0], r[1] + n))
    print('largest relative change on doubling all nodes', worst)
    loads = (0.5, 2, 10, 30, 100)
    step = 0.02

    def fd(make, P, k):
        """Central differences in the logarithm at 1, 2, 3, 4 steps: eighth order; sixth order for the error."""
        d = [(at_force(make(np.exp(j * k)), P)['delta'] - at_force(make(np.exp(-j * k)), P)['delta']) / (2 * j * k) for j in (1, 2, 3, 4)]
        best = (8 * 7 * d[0] - 28 * d[1] + 8 * d[2] - d[3]) / 35
        low = (15 * d[0] - 6 * d[1] + d[2]) / 10
        return best, abs(best - low)

    with open(HERE / 'indentation_derivatives.csv', 'w') as out:
        out.write(head + ' Derivatives of delta at fixed force (um), central differences of order 8, step 0.02 in the logarithm;\n'
                  '# err_*: difference to order 6. scaling: (d_lnEc + d_lnEs + P/S) / (P/S), zero exactly (delta depends on P/E).\n'
                  '# scaling_h: (d_lnh + d_lnR + 2 P/S - delta) / delta, zero exactly (lengths scale together at fixed P/h^2).\n'
                  '# adj_*: relative difference to the adjoint formula int p_flat dK p (independent of the finite differences of the contact).\n'
                  'force_mN,penetration_um,stiffness_mN_per_um,ddelta_dlnEc_um,ddelta_dlnEs_um,ddelta_dlnh_um,ddelta_dlnR_um,err_Ec,err_Es,err_h,scaling,scaling_h,adj_Ec,adj_Es,adj_h\n')
        for P in loads:
            s = at_force(body, P)
            dc, ec = fd(lambda f: sample(ec=EC * f), P, step)
            ds, es = fd(lambda f: sample(es=ES * f), P, step)
            dh, eh = fd(lambda f: sample(h=H * f), P, step)
            dr = radius_derivative(body, P, step)
            sc = (dc + ds) / (P / s['S']) + 1
            sh = (dh + dr + 2 * P / s['S'] - s['delta']) / s['delta']
            ad = adjoint(body, s)
            rel = [a / d - 1 for a, d in zip(ad, (dc, ds, dh))]
            print(P, s['delta'], s['S'], dc, ds, dh, dr, ec, es, eh, sc, sh, rel, flush=True)
            out.write(f"{P},{s['delta']:.14g},{s['S']:.14g},{dc:.12g},{ds:.12g},{dh:.12g},{dr:.12g},{ec:.0e},{es:.0e},{eh:.0e},{sc:.0e},{sh:.0e}," + ','.join('%.0e' % r for r in rel) + '\n')


def radius_derivative(body, P, k):
    def delta(R_):
        a = brentq(lambda a: solve(body, a, R_)['P'] / P - 1, .2, 3, xtol=1e-13, rtol=1e-13)
        s = solve(body, a, R_)
        return s['delta'] + (P - s['P']) / s['S']
    d = [(delta(R * np.exp(j * k)) - delta(R * np.exp(-j * k))) / (2 * j * k) for j in (1, 2, 3, 4)]
    return (56 * d[0] - 28 * d[1] + 8 * d[2] - d[3]) / 35


def adjoint(body, s):
    """d delta / d ln(.) = 2 pi int dC(k) P_flat(k) P(k) dk, C = 2T/E*, P_flat of unit load (virtual work)."""
    k = 0.01
    base = body.k
    # homogeneous part (2/E* at the surface) does not decay: int P_flat P dk = (pi/2) int phi phi_flat dt by Parseval
    # 2(T-1)/E* is integrated on the nodes of the solution
    def compl(ec, es, h):
        T, e = transfer(base, [([(h, ec, NC, 'bonded')], (es, NS))])
        return np.asarray(2 * (T - 1) / e, float), 2 / e

    # q = int phi cos * E*/pi: P(k); q1 the same for the flat punch with load S
    both = s['q'] * s['q1'] / s['S']
    a = s['a']
    x, wx = gauss([0, a], 200)
    ph = []
    for q, rhs in ((s['q'], s['delta'] - x**2 / R), (s['q1'], 1 + 0 * x)):
        ph.append(rhs - (2 / np.pi) * (np.cos(np.outer(x, base)) @ (body.wk * q * np.pi / body.estar)))
    flat = (np.pi / 2) * (wx @ (ph[0] * ph[1])) * (body.estar / np.pi)**2 / s['S']
    out = []
    for var in ('ec', 'es', 'h'):
        p0 = dict(ec=EC, es=ES, h=H)
        d = []
        for j in (1, 2, 3, 4):
            v = []
            for sign in (1, -1):
                q = dict(p0)
                q[var] *= np.exp(sign * j * k)
                v.append(compl(**q))
            d.append([(v[0][i] - v[1][i]) / (2 * j * k) for i in (0, 1)])
        dT, de = [(56 * d[0][i] - 28 * d[1][i] + 8 * d[2][i] - d[3][i]) / 35 for i in (0, 1)]
        out.append(2 * np.pi * (body.w @ (dT * both) + de * flat))
    return out


if __name__ == '__main__':
    main()
