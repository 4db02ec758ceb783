"""Makes coated.csv and foundation.csv: paraboloid r^2/2 with a hardness on layered bodies, contact radius 1, plastic disc of radius c; see README.md."""
import sys
from pathlib import Path
import numpy as np
from scipy.special import j0, j1
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from layered import transfer  # noqa: E402
from ring import plastic_paraboloid  # noqa: E402


def rigid_base(x, nu):
    x = np.asarray(x, float)
    e = np.exp(-2 * x)                                  # times 2 exp(-2x)
    return ((3 - 4 * nu) * (1 - e * e) - 4 * x * e) / ((3 - 4 * nu) * (1 + e * e) + 2 * e * (5 - 12 * nu + 8 * nu * nu + 2 * x * x))


class Correction:
    """2 int (T - 1) J1(k s) s J0(k r)/k dk, the disc's displacement on layers less that on a half-space of the coating, E* = 1."""

    def __init__(self, t_minus_one, h, total=None, fine=1):
        x, w = np.polynomial.legendre.leggauss(10 * fine)
        kmax = 20 / h
        edges = [0.0] + [0.05 / (total or h) * 0.5 ** i for i in range(12, -1, -1)]
        while edges[-1] < kmax:
            edges.append(edges[-1] + min(2.5, edges[-1]))
        edges = np.array(edges)
        half = np.diff(edges)[:, None] / 2
        self.k = (edges[:-1, None] + half * (1 + x)).ravel()
        self.w = (half * w).ravel() * 2 * np.asarray(t_minus_one(self.k), float) / self.k
        # smooth in s: Chebyshev nodes, barycentric
        m = 40 + int(14 / h)
        self.c = 0.55 * (1 - np.cos(np.pi * (np.arange(m) + 0.5) / m))
        self.b = (-1.0) ** np.arange(m) * np.sin(np.pi * (np.arange(m) + 0.5) / m)
        self.table = j1(np.outer(self.c, self.k)) * self.w * self.c[:, None]

    def __call__(self, r, s):
        v = self.table @ j0(self.k * r)
        d = np.asarray(s)[:, None] - self.c
        d[d == 0] = 1e-300
        q = self.b / d
        return (q @ v) / q.sum(1)


def row(c, corr, estar, n=24):
    s = plastic_paraboloid(c, n, corr, estar)
    depth = s['delta'] - s['w'](0.0)[0]
    x, wq = np.polynomial.legendre.leggauss(16)
    rr = np.sqrt((1 + x) / 2) * c
    g = s['w'](rr) + rr ** 2 / 2 - s['delta']
    assert g.max() < 0
    return s['H'], s['P'], s['delta'], depth, -np.pi * (wq * c * c / 2) @ g


def main():
    rows = ['body,c,H,P,delta,depth,volume']
    bodies = {'hard': ([(0.3, 3, 0.22, 'bonded')], (1, 0.3)), 'two': ([(0.2, 4, 0.25, 'bonded'), (0.1, 0.5, 0.45, 'bonded')], (1, 0.3)),
              'soft': ([(0.25, 0.3, 0.45, 'bonded')], (1, 0.3))}
    for name, body in bodies.items():
        h, total = body[0][0][0], sum(l[0] for l in body[0])
        _, estar = transfer([1.0], [body])
        corr = [Correction(lambda k: transfer(k, [body])[0] - 1, h, total, f) for f in (1, 2)]
        for c in (0.3, 0.6, 0.9):
            a, b = row(c, corr[0], estar, 18), row(c, corr[1], estar, 26)
            print(name, c, ['%.10g' % v for v in b], 'coarser', ['%.0e' % abs(x - y) for x, y in zip(a, b)], flush=True)
            rows.append(f'{name},{c},' + ','.join('%.9g' % v for v in b))
    (HERE / 'coated.csv').write_text('\n'.join(rows) + '\n')
    rows = ['h,c,H,P,delta,depth,P_foundation,a_foundation,c_foundation']
    nu, estar = 0.3, 1.0                                  # E = 0.91; M = E (1-nu)/((1+nu)(1-2nu))
    M = 0.91 * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
    for h in (1.0, 0.5, 0.2, 0.1, 0.05):
        corr = Correction(lambda k: rigid_base(k * h, nu) - 1, h)
        for c in (0.5,):
            H, P, d, depth, vol = row(c, corr, estar)
            k = M / h
            a2, c2 = 2 * d, 2 * (d - H / k)
            Pf = np.pi * c2 * H + np.pi * k / 4 * (a2 - c2) ** 2
            rows.append(f'{h},{c},' + ','.join('%.9g' % v for v in (H, P, d, depth, Pf, np.sqrt(a2), np.sqrt(max(c2, 0)))))
            print(rows[-1], 'P over Winkler', P / Pf, flush=True)
    (HERE / 'foundation.csv').write_text('\n'.join(rows) + '\n')


if __name__ == '__main__':
    main()
