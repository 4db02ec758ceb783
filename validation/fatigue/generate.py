"""Makes sliding.csv, largest.csv, wave.csv, endurance.csv, coated.csv, coated-interface.csv, contact.csv, contact-interface.csv and places.csv; see README.md.

Isolated contact of radius 1 and largest pressure 1, from far away and to far away: at rest tau1 = 0, so that the range of tau1 along the path is its largest value.
    pip install numpy scipy mpmath; python generate.py [part ...]
"""
import sys
from pathlib import Path
import numpy as np
from scipy.optimize import brentq, minimize, minimize_scalar
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from sliding_sphere import stresses  # noqa: E402
from stress import Amplitudes, hankel_stresses, hertz, nodes, principal_shear  # noqa: E402

KEYS = ('xx', 'yy', 'zz', 'xy', 'xz', 'yz')


def closed(nu, mu, x, y, z):
    x = np.atleast_1d(np.asarray(x, float))
    n, t = stresses(nu, x, y + 0 * x, z + 0 * x)
    return {k: n[k] + mu * t[k] for k in KEYS}


def tau(nu, mu, x, y, z):
    return principal_shear(closed(nu, mu, x, y, z))


def largest(fun, points):
    """Largest value of a function of x and its place: the best of the points, refined between its neighbours."""
    v = fun(points)
    i = int(np.argmax(v))
    lo, hi = points[max(0, i - 1)], points[min(len(points) - 1, i + 1)]
    r = minimize_scalar(lambda x: -fun(np.array([x]))[0], bounds=(lo, hi), method='bounded', options=dict(xatol=1e-10))
    return (v[i], points[i]) if v[i] >= -r.fun else (-r.fun, r.x)


def line(y, z):
    """Places along x: dense, with the edge of contact itself."""
    x = np.concatenate([np.linspace(-3, 3, 601), [0.0]])
    if abs(y) < 1:
        e = np.sqrt(1 - y * y)
        x = np.concatenate([x, [-e, e], *[s * e + d * 10.0 ** np.arange(-8.0, -1.5, 0.5) for s in (-1, 1) for d in (-1, 1)]])
    return np.unique(x)


def passes():
    ys, zs = (0, 0.3, 0.6, 0.9, 1, 1.5, 2.5), (0, 0.05, 0.2, 0.48, 0.8, 1.5, 3)
    rows = ['nu,mu,y,z,range,x']
    for nu, mu in ((0.0, 0), (0.3, 0), (0.5, 0), (0.3, 0.1), (0.3, 0.3), (0.3, 0.5)):
        for y in ys:
            for z in zs:
                v, x = largest(lambda q: tau(nu, mu, q, y, z), line(y, z))
                rows.append('%g,%g,%g,%g,%.10g,%.6g' % (nu, mu, y, z, v, abs(x) if mu == 0 else x))
    (HERE / 'sliding.csv').write_text('\n'.join(rows) + '\n')
    # another program: Hankel integrals
    worst = 0
    rng = np.random.default_rng(1)
    for _ in range(12):
        nu, mu, y, z = rng.choice([0, .3, .5]), rng.choice([0, .1, .5]), rng.uniform(0, 2), rng.uniform(.15, 2)
        x = rng.uniform(-2.5, 2.5, 6)
        q, w = nodes(40 / z, 1.2)
        n, t = hankel_stresses(q, w, hertz(q), Amplitudes(q, (1.0, nu)).at(z, False), np.hypot(x, y), np.arctan2(y, x))
        worst = max(worst, abs(principal_shear({k: n[k] + mu * t[k] for k in KEYS}) - tau(nu, mu, x, y, z)).max())
    print('tau1: closed form against Hankel integrals', worst)


def over_all():
    """The largest range over all (y, z): coarse search over the surface and inside, then refined; the trailing edge of the surface as a candidate."""
    rows = ['nu,mu,range,x,y,z']
    x = np.unique(np.concatenate([np.linspace(-1.3, 1.3, 53), [-1, 1]]))
    for nu in (0.0, 0.2, 0.3, 0.5):
        for mu in (0, 0.1, 0.2, 0.3, 0.5):
            found = []
            for y in (0, 0.3, 0.6):
                for z in (0, 0.05, 0.15, 0.3, 0.4, 0.5, 0.6):
                    v = tau(nu, mu, x, y, z)
                    i = int(np.argmax(v))
                    found.append((v[i], x[i], y, z))
            best = max(found)
            found.sort(reverse=True)
            for v, x0, y0, z0 in [max(f for f in found if f[3] > 0), max(f for f in found if f[3] == 0)]:
                free = 3 if z0 > 0 else 2
                at = lambda s: -tau(nu, mu, s[0], s[1], s[2] if free == 3 else 0.0)[0] if free == 2 or s[2] > 0 else 0.0
                r = minimize(at, [x0 + 0.003, y0 + 0.01, z0 + 0.01][:free], method='Nelder-Mead', options=dict(xatol=1e-8, fatol=1e-14, maxiter=1200))
                if -r.fun > best[0]:
                    best = (-r.fun, r.x[0], abs(r.x[1]), r.x[2] if free == 3 else 0.0)
            v, xb, y, z = best
            rows.append('%g,%g,%.9g,%.6f,%.6f,%.6f' % (nu, mu, v, abs(xb) if mu == 0 else xb, y, z))
            print(rows[-1], flush=True)
    (HERE / 'largest.csv').write_text('\n'.join(rows) + '\n')


def on_axis():
    """The largest of all without friction by the formula of the axis: tau1 = |s_z - s_r|/2."""
    for nu in (0.0, 0.3, 0.5):
        f = lambda z: -0.5 * abs(-(1 + nu) * (1 - z * np.arctan(1 / z)) + 1.5 / (1 + z * z))
        r = minimize_scalar(f, bounds=(.2, .9), method='bounded', options=dict(xatol=1e-12))
        print('axis', nu, -r.fun, r.x)


def wave():
    """p = m + cos kx on a half-space, complete contact, no friction, no lateral strain in the mean: the range of tau1 at depth."""
    rows = ['nu,mean,kz,range,in_plane_range']
    x = np.linspace(0, np.pi, 20001)
    for nu in (0.0, 0.3, 0.5):
        for mean in (0.0, 1.5):
            for kz in (0, 0.1, 0.3, 0.6, 1.0, 2.0):
                e, c, s = np.exp(-kz), np.cos(x), np.sin(x)
                zz = -(1 + kz) * e * c - mean
                xx = -(1 - kz) * e * c - mean * nu / (1 - nu)
                yy = -2 * nu * e * c - mean * nu / (1 - nu)
                xz = -kz * e * s
                o = 0 * x
                t = principal_shear(dict(xx=xx, yy=yy, zz=zz, xy=o, xz=xz, yz=o))
                plane = np.hypot((zz - xx) / 2, xz)
                d0, a = mean * (1 - 2 * nu) / (1 - nu) / 2, kz * e
                closed_form = 2 * min(a, d0)
                assert abs(np.ptp(plane) - closed_form) < 1e-12, (np.ptp(plane), closed_form)
                rows.append('%g,%g,%g,%.9g,%.12g' % (nu, mean, kz, np.ptp(t), closed_form))
    (HERE / 'wave.csv').write_text('\n'.join(rows) + '\n')


# ---- endurance
def deviator(t):
    h = (t['xx'] + t['yy'] + t['zz']) / 3
    a, b = t['xx'] - h, t['yy'] - h
    return np.stack([(a - b) / 2, np.sqrt(3) / 2 * (a + b), t['xz'], t['xy'], t['yz']], -1), h


def ball(points):
    """Smallest ball around points: that of a few, exactly (Welzl), the farthest point joined to them until none lies outside."""
    c = points.mean(0)
    own = [int(np.argmax(((points - c) ** 2).sum(1)))]
    for _ in range(400):
        c, r = small_ball(points[own])
        d = np.sqrt(((points - c) ** 2).sum(1))
        if d.max() <= r * (1 + 1e-12):
            return c, r, own
        own.append(int(np.argmax(d)))
    raise RuntimeError('ball')


def small_ball(points):
    def through(q):
        if len(q) == 1:
            return q[0], 0.0
        m = q[1:] - q[0]
        lam = np.linalg.lstsq(2 * m @ m.T, (m * m).sum(1), rcond=1e-13)[0]
        c = q[0] + lam @ m
        return c, np.sqrt(((q - c) ** 2).sum(1).max())
    def inside(end, support):
        """Smallest ball of order[:end] with the support on its surface."""
        c, r = through(points[support]) if support else (points[order[0]], 0.0)
        if len(support) == rank + 1:
            return c, r
        i = 0
        while i < end:
            d = np.sqrt(((points[order[i:end]] - c) ** 2).sum(1))
            out = np.flatnonzero(d > r * (1 + 1e-13) + 1e-15)
            if not out.size:
                break
            i += int(out[0])
            c, r = inside(i, support + [order[i]])
            i += 1
        return c, r
    rank = np.linalg.matrix_rank(points - points.mean(0), tol=1e-9)
    if len(points) == 1:
        return points[0], 0.0
    c = points.mean(0)
    order = list(np.argsort(-((points - c) ** 2).sum(1)))
    return inside(len(order), [])


def tresca(c):
    a, b = c[..., 0], c[..., 1] / np.sqrt(3)
    o = np.zeros_like(a)
    t = dict(xx=a + b, yy=b - a, zz=-2 * b, xz=c[..., 2], xy=c[..., 3], yz=c[..., 4])
    return principal_shear(t) + 0 * o


def endurance():
    rows = ['nu,mu,z,chord_half,ball_radius,hydrostatic_largest,dang_van_0.1,dang_van_0.3,dang_van_0.6,ball_shear_largest,range_tau1,orthogonal_shear_half_range,centre_1,centre_2,centre_3']
    for nu, mu in ((0.3, 0.0), (0.3, 0.3)):
        for z in (0.3, 0.48, 0.8):
            got = []
            for n in (301, 501):
                x = np.concatenate([np.linspace(-4, 4, n), [-1e6, 1e6], np.geomspace(4, 400, 40), -np.geomspace(4, 400, 40)])
                x.sort()
                at = lambda p: deviator(closed(nu, mu, np.atleast_1d(p), 0.0, z))
                d, h = at(x)
                apart = ((d[:, None] - d[None]) ** 2).sum(-1)
                i, j = np.unravel_index(np.argmax(apart), apart.shape)
                m = minimize(lambda p: -((at(p[0])[0] - at(p[1])[0]) ** 2).sum(), [x[i], x[j]], method='Nelder-Mead', options=dict(xatol=1e-9, fatol=1e-16))
                chord = np.sqrt(max(-m.fun, apart.max())) / 2
                core = [d[k] for k in ball(d)[2]]
                for _ in range(12):                       # places between the samples join where they lie outside
                    c, r = small_ball(np.array(core))
                    dist = np.sqrt(((d - c) ** 2).sum(1))
                    tops = [k for k in range(1, len(x) - 1) if dist[k] >= max(dist[k - 1], dist[k + 1]) and dist[k] > 0.99 * r]
                    new = [largest(lambda p: np.sqrt(((at(p)[0] - c) ** 2).sum(1)), x[k - 1:k + 2]) for k in tops]
                    new = [p for v, p in new if v > r * (1 + 1e-13)]
                    if not new:
                        break
                    core += [at(p)[0][0] for p in new]
                top = lambda f: largest(f, x)[0]
                shear = lambda p: tresca(at(p)[0] - c)
                got.append((chord, r, max(0.0, top(lambda p: at(p)[1])), *(top(lambda p: shear(p) + q * at(p)[1]) for q in (0.1, 0.3, 0.6)),
                            top(shear), top(lambda p: tresca(at(p)[0])), (top(lambda p: closed(nu, mu, p, 0.0, z)['xz']) - -top(lambda p: -closed(nu, mu, p, 0.0, z)['xz'])) / 2, c[0], c[1], c[2]))
            got = np.array(got)
            # the ball by another algorithm: largest distance minimised over the centre, symmetric weights free
            f = lambda c: np.sqrt(((d - np.append(c, [0, 0])) ** 2).sum(1).max())
            start = c[:3] + 1e-3
            best = minimize(f, start, method='Nelder-Mead', options=dict(xatol=1e-10, fatol=1e-13, maxiter=6000, maxfev=6000))
            best = minimize(f, best.x, method='Nelder-Mead', options=dict(xatol=1e-11, fatol=1e-14, maxiter=6000, maxfev=6000))
            print('endurance', nu, mu, z, 'finer', abs(got[1] - got[0]), 'ball, other algorithm', best.fun - got[1][1], 'centre', c[:3], flush=True)
            rows.append('%g,%g,%g,' % (nu, mu, z) + ','.join('%.8g' % v for v in got[1]))
    (HERE / 'endurance.csv').write_text('\n'.join(rows) + '\n')


# ---- coated
class Path_:
    """Stresses along x at (y, z) of a load with transform load(q), layered: closed form of the coating's material plus the rest, or all of it by quadrature."""

    def __init__(self, body, load, rmax, hertz_like=True):
        self.body, self.load, self.rmax, self.hertz_like = body, load, rmax, hertz_like

    def __call__(self, x, y, z, below):
        h, e1, nu1, _, _ = self.body
        split = self.hertz_like and not below
        reach = (2 * h - z) if split else z
        q, w = nodes(min(38 / reach, 4000.0), 3.0 / (self.rmax + 1))
        a = Amplitudes(q, self.body).at(z, below)
        if split:
            b = Amplitudes(q, (e1, nu1)).at(z, False)
            a = tuple(tuple(u - v for u, v in zip(m, n)) for m, n in zip(a, b))
        r, phi = np.hypot(x, y), np.arctan2(y + 0 * x, x)
        n, t = hankel_stresses(q, w, self.load(q), a, r, phi)
        if split:
            cn, ct = stresses(nu1, x, y + 0 * x, z + 0 * x)
            n, t = {k: n[k] + cn[k] for k in KEYS}, {k: t[k] + ct[k] for k in KEYS}
        return n, t


def spline_largest(x, v):
    """Largest of smooth samples: parabola through the three around the best one."""
    i = int(np.argmax(v))
    if i in (0, len(x) - 1):
        return v[i], x[i]
    c = np.polyfit(x[i - 1:i + 2] - x[i], v[i - 1:i + 2], 2)
    return np.polyval(c, -c[1] / (2 * c[0])), x[i] - c[1] / (2 * c[0])


def vector_range(u, v):
    p = np.stack([np.append(u, 0), np.append(v, 0)], -1)
    return max(np.sqrt(((p - a) ** 2).sum(1)).max() for a in p)


def coated():
    rows, inter = ['E1,h,mu,y,z,side,range,x'], ['E1,h,mu,y,shear_range,tension_largest']
    x = np.linspace(-2.5, 2.5, 201)
    for e1, h in ((4.0, 1.0), (0.5, 1.0), (4.0, 0.3), (0.5, 0.3)):
        path = Path_((h, e1, 0.3, 1.0, 0.3), hertz, 2.8)
        for y in (0.0, 0.7):
            for z, below in ((0.1, False), (0.6 * h, False), (h, False), (h, True), (1.4 * h, True), (h + 0.5, True)):
                if not below and z == 0.1 and h == 0.3:
                    z = 0.05
                n, t = path(x, y, z, below)
                for mu in (0, 0.1, 0.3):
                    s = {k: n[k] + mu * t[k] for k in KEYS}
                    v, place = spline_largest(x, principal_shear(s))
                    rows.append('%g,%g,%g,%g,%g,%s,%.8g,%.4f' % (e1, h, mu, y, z, 'below' if below else 'above', v, abs(place) if mu == 0 else place))
                    if z == h and below:
                        inter.append('%g,%g,%g,%g,%.8g,%.8g' % (e1, h, mu, y, vector_range(s['xz'], s['yz']), max(0.0, s['zz'].max())))
        print('coated', e1, h, flush=True)
    # check: the same by quadrature alone, at one depth, and a finer path
    path = Path_((1.0, 4.0, 0.3, 1.0, 0.3), hertz, 2.8, False)
    n, t = path(x, 0.7, 0.6, False)
    n2, t2 = Path_((1.0, 4.0, 0.3, 1.0, 0.3), hertz, 2.8)(x, 0.7, 0.6, False)
    print('split against quadrature alone', max(abs(n[k] - n2[k]).max() + abs(t[k] - t2[k]).max() for k in KEYS))
    xf = np.linspace(-2.5, 2.5, 401)
    nf, tf = Path_((1.0, 4.0, 0.3, 1.0, 0.3), hertz, 2.8)(xf, 0.7, 0.6, False)
    print('path of twice the places', spline_largest(xf, principal_shear({k: nf[k] + .3 * tf[k] for k in KEYS}))[0] - spline_largest(x, principal_shear({k: n[k] + .3 * t[k] for k in KEYS}))[0])
    (HERE / 'coated.csv').write_text('\n'.join(rows) + '\n')
    (HERE / 'coated-interface.csv').write_text('\n'.join(inter) + '\n')


def places():
    """Where in the coating, at the interface and below the range is largest, y = 0, Hertz-shaped loads: what fails first if all materials bear alike."""
    rows = ['E1,h,mu,surface,inside,z_inside,interface_above,interface_below,below,z_below,shear_range']
    x = np.unique(np.concatenate([np.linspace(-2.2, 2.2, 89), [-1, 1], -1 + np.array([-.02, -.005, .005, .02]), 1 + np.array([-.02, -.005, .005, .02])]))
    for e1 in (0.25, 0.5, 2.0, 5.0):
        for h in (0.1, 0.25, 0.5, 1.0):
            path = Path_((h, e1, 0.3, 1.0, 0.3), hertz, 2.2)
            up = [(z, path(x, 0.0, z, False)) for z in h * np.array([0, .05, .12, .25, .4, .55, .7, .85, 1])]
            down = [(z, path(x, 0.0, z, True)) for z in h + np.array([0, .05, .1, .2, .35, .5, .7])]
            for mu in (0, 0.1, 0.3):
                val = lambda item: principal_shear({k: item[1][0][k] + mu * item[1][1][k] for k in KEYS}).max()
                u, d = [val(i) for i in up], [val(i) for i in down]
                i, j = 1 + int(np.argmax(u[1:-1])), 1 + int(np.argmax(d[1:]))
                s = {k: down[0][1][0][k] + mu * down[0][1][1][k] for k in KEYS}
                rows.append('%g,%g,%g,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f' % (e1, h, mu, u[0], u[i], up[i][0], u[-1], d[0], d[j], down[j][0], vector_range(s['xz'], s['yz'])))
            print(rows[-2], flush=True)
    (HERE / 'places.csv').write_text('\n'.join(rows) + '\n')


def contact():
    """The contact of a rigid paraboloid r^2/2 itself, radius 0.6, on coatings; traction mu p without its effect on the pressure (coupling off)."""
    from indentation import Body, gauss, solve as indent
    rows, inter = ['body,h,E1,nu1,a,P,p0,mu,y,z,side,range,x'], ['body,mu,y,shear_range,tension_largest']
    x = np.linspace(-1.8, 1.8, 181)
    for name, (h, e1, nu1) in {'hard': (0.3, 3.0, 0.22), 'soft': (0.25, 0.3, 0.45)}.items():
        a = 0.6
        own = ([(h, e1, nu1, 'bonded')], (1.0, 0.3))
        body = Body([own], a)
        found = indent(body, a)
        for fine in (1, 2):
            q, w = nodes(38 / 0.12, 2.0 / fine)
            # phi again, at the nodes of the solution of indentation.py
            n = int((36 + 22 * a / body.top) * body.fine)
            t, wt = gauss([0, a], n)
            c = np.cos(np.outer(t, body.k))
            K = (c * body.wk) @ c.T
            phi = np.linalg.solve(np.eye(n) + (2 / np.pi) * K * wt, found['delta'] - t ** 2)
            load = body.estar / np.pi * ((wt * phi) @ np.cos(np.outer(t, q)))
            assert abs(2 * np.pi * body.estar / np.pi * (wt @ phi) / found['P'] - 1) < 1e-12
            ranges = []
            for y in (0.0, 0.4):
                for z, below in ((0.12, False), (0.75 * h, False), (h, False), (h, True), (h + 0.15, True)):
                    amp = Amplitudes(q, (h, e1, nu1, 1.0, 0.3)).at(z, below)
                    nn, tt = hankel_stresses(q, w, load, amp, np.hypot(x, y), np.arctan2(y + 0 * x, x))
                    for mu in (0, 0.3):
                        s = {k: nn[k] + mu * tt[k] for k in KEYS}
                        v, place = spline_largest(x, principal_shear(s))
                        ranges.append(v)
                        if fine == 2:
                            rows.append('%s,%g,%g,%g,%g,%.9g,%.9g,%g,%g,%g,%s,%.8g,%.4f' % (name, h, e1, nu1, a, found['P'], found['p0'], mu, y, z, 'below' if below else 'above', v, abs(place) if mu == 0 else place))
                            if z == h and below:
                                inter.append('%s,%g,%g,%.8g,%.8g' % (name, mu, y, vector_range(s['xz'], s['yz']), max(0.0, s['zz'].max())))
            if fine == 1:
                first = np.array(ranges)
        print('contact', name, 'P', found['P'], 'twice the nodes', abs(np.array(ranges) - first).max(), flush=True)
    (HERE / 'contact.csv').write_text('\n'.join(rows) + '\n')
    (HERE / 'contact-interface.csv').write_text('\n'.join(inter) + '\n')


PARTS = dict(axis=on_axis, wave=wave, endurance=endurance, passes=passes, over_all=over_all, coated=coated, places=places, contact=contact)
if __name__ == '__main__':
    for part in sys.argv[1:] or PARTS:
        PARTS[part]()
