"""Makes decay.csv, levels.csv, levels-shapes.csv, bodies.csv, bodies-shapes.csv; see README.md.   python periodic.py"""
import sys
from pathlib import Path
import mpmath as mp
import numpy as np
from scipy.linalg import inv
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from bonded_layer import transfer as mp_transfer  # noqa: E402
from dense import matrix, multiplier, solve  # noqa: E402
from layered import compliance  # noqa: E402
B = 'bonded'


def decay():
    """C of single waves to 12 digits, two programs, and what is left of a wave after the path s: exactly and by n implicit steps."""
    rows = ['layer,q,C,ks,exact,n,implicit']
    for name, (h, e, nu) in {'hard': (0.1, 5, 0.2), 'soft': (0.2, 0.1, 0.3), 'incompressible': (0.15, 0.3, 0.5)}.items():
        g1, g2 = mp.mpf(e) / (2 * (1 + mp.mpf(str(nu)))), mp.mpf(1) / (2 * mp.mpf('1.3'))
        for q in (2 * np.pi, 2 * np.pi * np.sqrt(2), 6 * np.pi):
            g1 = mp.mpf(str(e)) / (2 * (1 + mp.mpf(str(nu))))
            c = (1 - mp.mpf(str(nu))) / (g1 * mp.mpf(q)) * mp_transfer(mp.nstr(mp.mpf(q) * mp.mpf(str(h)), 25), mp.nstr(g1 / g2, 28), nu, 0.3)
            other = float(compliance([q], [(h, e, nu, B)], (1, 0.3))[0] / q)
            assert abs(other / float(c) - 1) < 2e-15 * 8, (other, c)
            for ks, n in ((0.02, 1), (0.02, 8), (0.1, 4), (1.0, 16)):
                rows.append(f'{name},{q:.15g},{mp.nstr(c, 15)},{ks},{mp.nstr(mp.exp(-mp.mpf(str(ks)) / c), 13)},{n},{mp.nstr((1 + mp.mpf(str(ks)) / (n * c)) ** (-n), 13)}')
    (HERE / 'decay.csv').write_text('\n'.join(rows) + '\n')


class Contact:
    """p for a gap f under the mean pressure, factors kept while the set of samples in contact stays."""

    def __init__(self, c, mean):
        self.c, self.mean, self.free, self.changes = c, mean, None, 0

    def factor(self, f):
        p, d, (free, _) = solve(self.c, f, mean=self.mean, start=None if self.free is None else (self.free, np.zeros_like(self.free)))
        self.free, self.index = free, np.flatnonzero(free)
        k = self.index.size
        a = np.zeros((k + 1, k + 1))
        a[:k, :k], a[:k, k], a[k, :k] = self.c[np.ix_(self.index, self.index)], -1, 1
        self.inverse, self.off = inv(a), self.c[np.ix_(np.flatnonzero(~free), self.index)]
        self.changes += 1
        return p, d

    def __call__(self, f):
        if self.free is None:
            return self.factor(f)
        x = self.inverse @ np.append(-f[self.index], f.size * self.mean)
        tiny = 1e-14
        if x[:-1].min() < -tiny or (self.off.size and (self.off @ x[:-1] + f[~self.free] - x[-1]).min() < -tiny):
            return self.factor(f)
        p = np.zeros(f.size)
        p[self.index] = x[:-1]
        return p, x[-1]


def run(c, f, mean, k1, k2, shape, times, steps, implicit=False):
    """Shapes worn off counterbody (h1) and body (h2, mean along axis 0) at the times; times and steps: equal steps within each interval."""
    swept = lambda p: np.repeat(p.reshape(shape).mean(0)[None, :], shape[0], 0).ravel()
    n = f.size
    h1, h2, s, out = np.zeros(n), np.zeros(n), 0.0, []
    contact = Contact(c, mean)
    average = np.kron(np.full((shape[0], shape[0]), 1 / shape[0]), np.eye(shape[1]))
    for t, m in zip(times, steps):
        ds = (t - s) / m
        contact = Contact(c + (k1 * ds * np.eye(n) + k2 * ds * average if implicit else 0), mean)
        for _ in range(m):
            p, d = contact(f + h1 + h2)
            h1, h2 = h1 + k1 * ds * p, h2 + k2 * ds * swept(p)
        s = t
        p, d = Contact(c, mean)(f + h1 + h2)
        out.append((p, d, h1, h2))
    return out


def exact(c, f, mean, k1, k2, shape, times, ds):
    """The path without a step error to speak of: while the samples in contact stay, h' = k1 p + k2 mean(p) with p linear in h, by the Runge-Kutta rule
    of fourth order; the place on the path where a pressure or a gap becomes zero is found, and the set of samples changes there."""
    n = f.size
    swept = lambda p: np.repeat(p.reshape(shape).mean(0)[None, :], shape[0], 0).ravel()
    p, d, (free, _) = solve(c, f, mean=mean)
    free = free.copy()
    h, s, out, events, scale = np.zeros((2, n)), 0.0, [], 0, np.ptp(f)

    def factor():
        i = np.flatnonzero(free)
        a = np.zeros((i.size + 1,) * 2)
        a[:-1, :-1], a[:-1, -1], a[-1, :-1] = c[np.ix_(i, i)], -1, 1
        return i, inv(a), c[np.ix_(np.flatnonzero(~free), i)]

    def state(h):
        x = inverse @ np.append(-(f + h[0] + h[1])[index], n * mean)
        p = np.zeros(n)
        p[index] = x[:-1]
        return p, x[-1]

    def rate(h):
        p, _ = state(h)
        return np.stack([k1 * p, k2 * swept(p)])

    def step(h, t):
        a = rate(h)
        b = rate(h + t / 2 * a)
        e = rate(h + t / 2 * b)
        return h + t / 6 * (a + 2 * b + 2 * e + rate(h + t * e))

    def wrong(h):
        """How far each sample is on the wrong side."""
        p, d = state(h)
        v = np.zeros(n)
        v[index] = -p[index] / mean
        v[~free] = -(off @ p[index] + (f + h[0] + h[1])[~free] - d) / scale
        return v

    index, inverse, off = factor()
    for t in times:
        while s < t - 1e-14:
            dt = min(ds, t - s)
            new = step(h, dt)
            v = wrong(new)
            if v.max() > 1e-11:
                side = 0
                lo, hi, low, high = 0.0, dt, wrong(h).max() - 1e-12, v.max() - 1e-12
                for turn in range(60):                    # Illinois
                    middle = hi - high * (hi - lo) / (high - low) if turn < 40 else (lo + hi) / 2
                    value = wrong(step(h, middle)).max() - 1e-12
                    if value > 0:
                        hi, high, low = middle, value, low / 2 if side == 1 else low
                        side = 1
                    else:
                        lo, low, high = middle, value, high / 2 if side == -1 else high
                        side = -1
                    if hi - lo < 1e-14 * max(1.0, t) or 0 < high < 1e-13:
                        break
                h, s = step(h, hi), s + hi
                v = wrong(h)
                flip = v > 1e-13
                free = free ^ flip
                index, inverse, off = factor()
                events += 1
            else:
                h, s = new, s + dt
        s = t
        p, d = state(h)
        out.append((p, d, h[0].copy(), h[1].copy()))
    return out, events


def converge(c, f, mean, k1, k2, shape, times, steps, label):
    """The path with exact changes of contact; half its step, and Euler's explicit and implicit steps extrapolated, beside it."""
    least = np.sort(np.linalg.eigvalsh(c))[1]
    out, events = exact(c, f, mean, k1, k2, shape, times, 0.2 * least / (k1 + k2))
    half, _ = exact(c, f, mean, k1, k2, shape, times, 0.1 * least / (k1 + k2)) if HALF else (out, 0)
    found = []
    for implicit in (False, True):
        r = [run(c, f, mean, k1, k2, shape, times, [m * x for m in steps], implicit) for x in (1, 2)]
        found.append([tuple(2 * np.asarray(v) - np.asarray(u) for u, v in zip(a, b)) for a, b in zip(*r)])
    scale = (mean, np.ptp(f), np.ptp(f), np.ptp(f))
    for i, t in enumerate(times):
        e = lambda other: ' '.join('%.0e' % (np.max(np.abs(np.asarray(a) - np.asarray(b))) / w) for a, b, w in zip(out[i], other[i], scale))
        print(f'{label} s {t:g} (changes of contact {events}; p/mean, delta, h1, h2 over range f): half the step', e(half), '| explicit', e(found[0]), '| implicit', e(found[1]),
              '| volume', '%.0e' % abs((out[i][2].mean() + out[i][3].mean()) / ((k1 + k2) * t * mean) - 1), flush=True)
    return out


HALF = True


def levels():
    l, n, radius = 1.0, 24, 0.8
    a1, a2 = np.sqrt(3) * np.array([1, 0]), np.sqrt(3) * np.array([0.5, np.sqrt(3) / 2])
    u, v = np.meshgrid(np.arange(n) / n, np.arange(n) / n, indexing='ij')
    each = []
    for level, site in enumerate((0, 1 / 3, 2 / 3)):
        best = np.full((n, n), np.inf)
        for s in range(-2, 3):
            for t in range(-2, 3):
                x = (u - site + s)[..., None] * a1 + (v - site + t)[..., None] * a2
                best = np.minimum(best, (x ** 2).sum(-1) / (2 * radius) + 0.01 * level)
        each.append(best)
    owner = np.argmin(each, 0)
    f = np.min(each, 0).ravel()
    e1 = 2 * 1.2 / 1.3
    c = matrix(multiplier((n, n), a1, a2, [([(0.5, e1, 0.2, B)], (1, 0.3))]))
    times = (0.1, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
    steps = [int(x * SCALE) for x in (40, 40, 40, 60, 200, 300, 600)]
    mean = 0.002
    rows = ['ks,delta,contact,largest,share1,share2,share3,contact1,contact2,contact3,worn_mean,worn_largest']
    start = solve(c, f, mean=mean)
    out = [(start[0], start[1], 0 * f, 0 * f)] + converge(c, f, mean, 1.0, 0.0, (n, n), times, steps, 'levels')
    for t, (p, d, h1, _) in zip((0.0,) + times, out):
        own = owner.ravel()
        rows.append('%g,' % t + ','.join('%.9g' % x for x in (d, (p > 1e-12).mean(), p.max(), *[p[own == m].sum() / p.sum() for m in range(3)],
                                                             *[(p[own == m] > 1e-12).mean() for m in range(3)], h1.mean(), h1.max())))
    (HERE / 'levels.csv').write_text('\n'.join(rows) + '\n')
    text = 'i,j,' + ','.join(f'h_{t:g},p_{t:g}' for t in times[1::2]) + '\n'
    for i in range(n):
        for j in range(i + 1):
            q = i * n + j
            text += f'{i},{j},' + ','.join('%.8g,%.8g' % (out[k + 1][2][q], out[k + 1][0][q]) for k in (1, 3, 5)) + '\n'
    (HERE / 'levels-shapes.csv').write_text(text)


def rough(shape):
    u, v = np.meshgrid(np.arange(shape[0]) / shape[0], np.arange(shape[1]) / shape[1], indexing='ij')
    f = np.zeros(shape)
    for m in range(0, 5):
        for n in range(-5, 6):
            if m == 0 and n <= 0:
                continue
            f += 0.012 * (m * m + n * n) ** -0.9 * np.cos(2 * np.pi * (m * u + n * v) + 1.7 * m * m + 2.3 * m * n + 3.1 * n * n + 0.5)
    return (f - f.min()).ravel()


def both():
    rows = ['cell,k1,k2,s,delta,contact,largest,worn1_mean,worn1_largest,worn2_largest,worn2_smallest']
    for cell, (shape, a1, a2) in {'rectangle': ((20, 27), (1, 0), (0, 1.3)), 'oblique': ((21, 24), (1, 0), (0.35, 0.9))}.items():
        f = rough(shape)
        c = matrix(multiplier(shape, a1, a2, [([(0.1, 5, 0.2, B)], (1, 0.3))]))
        text, keep = 'i,j', []
        for k1, k2 in ((0.0, 1.0), (1.0, 0.5)):
            global HALF
            HALF = cell == 'rectangle' and k1 == 0
            times = (0.05, 0.2, 0.5)
            steps = (20, 40, 75)
            out = converge(c, f, 0.02, k1, k2, shape, times, steps, f'{cell} {k1} {k2}')
            for t, (p, d, h1, h2) in zip(times, out):
                rows.append(f'{cell},{k1},{k2},{t:g},' + ','.join('%.9g' % x for x in (d, (p > 1e-12).mean(), p.max(), h1.mean(), h1.max(), h2.max(), h2.min())))
            text += f',h1_{k1:g}_{k2:g},h2_{k1:g}_{k2:g},p_{k1:g}_{k2:g}'
            keep.append(out[1])
        text += '\n'
        for i in range(shape[0]):
            for j in range(shape[1]):
                q = i * shape[1] + j
                text += f'{i},{j}' + ''.join(',%.8g,%.8g,%.8g' % (h1[q], h2[q], p[q]) for p, _, h1, h2 in keep) + '\n'
        (HERE / f'{cell}-shapes.csv').write_text(text)
    (HERE / 'bodies.csv').write_text('\n'.join(rows) + '\n')


SCALE = 1.0
PARTS = dict(decay=decay, levels=levels, both=both)
if __name__ == '__main__':
    for part in sys.argv[1:] or PARTS:
        PARTS[part]()
