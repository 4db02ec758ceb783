"""Dense periodic contact with a hardness, 0 <= p <= H, for the scripts that make reference tables; nothing of percoat enters.

Samples x = (i/N1) a1 + (j/N2) a2; index (m, n) of the transform stands for the shortest of its aliases, q = 2 pi |(m + s N1) b1 + (n + t N2) b2|,
a_i . b_j = delta_ij. u = C p, C circulant, its multiplier compliance(q)/q of layered.py, zero at q = 0 (mean displacement zero).
g = u + f + extra p - delta; 0 <= p <= H, g >= 0 where p = 0, g = 0 between, g <= 0 where p = H. mean(p) or delta given.
"""
import numpy as np
from scipy.linalg import lu_factor, lu_solve
from layered import compliance


def wavenumbers(shape, a1, a2):
    a = np.array([a1, a2], float)
    b = np.linalg.inv(a).T
    m = np.fft.fftfreq(shape[0], 1 / shape[0])[:, None]
    n = np.fft.fftfreq(shape[1], 1 / shape[1])[None, :]
    best = np.full(shape, np.inf)
    for s in range(-3, 4):
        for t in range(-3, 4):
            k = (m + s * shape[0])[..., None] * b[0] + (n + t * shape[1])[..., None] * b[1]
            best = np.minimum(best, 2 * np.pi * np.hypot(k[..., 0], k[..., 1]))
    return best


def multiplier(shape, a1, a2, bodies):
    q = wavenumbers(shape, a1, a2)
    unique, inverse = np.unique(q.round(11), return_inverse=True)
    out = np.zeros(unique.shape)
    for layers, substrate in bodies:
        out[1:] += np.asarray(compliance(unique[1:], layers, substrate) / unique[1:], float)
    return out[inverse].reshape(shape)


def matrix(hat):
    shape = hat.shape
    c = np.fft.ifft2(hat).real
    i, j = np.arange(shape[0]), np.arange(shape[1])
    di, dj = (i[:, None] - i[None, :]) % shape[0], (j[:, None] - j[None, :]) % shape[1]
    n = shape[0] * shape[1]
    return c[di[:, None, :, None], dj[None, :, None, :]].reshape(n, n)


def newton(c, f, hardness=np.inf, mean=None, delta=None, start=None, sweeps=400):
    """Semismooth Newton with three sets. start: (free, full) masks."""
    n = f.size
    scale = np.median(np.diag(c))
    if start is None:
        order = np.argsort(f)
        free = np.zeros(n, bool)
        full = np.zeros(n, bool)
        if mean is None:
            free[f < delta] = True
        else:
            free[order[:max(1, int(min(1, 1.2 * mean / hardness + 0.2) * n))]] = True
    else:
        free, full = (s.copy() for s in start)
    seen = set()
    relax = False
    for sweep in range(sweeps):
        p = np.zeros(n)
        p[full] = hardness
        index = np.flatnonzero(free)
        k = index.size
        known = (c[:, full].sum(1) * hardness if full.any() else 0) + f
        if mean is not None:
            if k == 0:
                free[np.argmin(np.where(full, np.inf, known))] = True
                continue
            a = np.zeros((k + 1, k + 1))
            a[:k, :k] = c[np.ix_(index, index)]
            a[:k, k], a[k, :k] = -1, 1
            right = np.append(-known[index], n * mean - full.sum() * hardness if full.any() else n * mean)
            factors = lu_factor(a)
            x = lu_solve(factors, right)
            x += lu_solve(factors, right - a @ x)
            p[index], d = x[:k], x[k]
        else:
            d = delta
            if k:
                a = c[np.ix_(index, index)]
                right = d - known[index]
                factors = lu_factor(a)
                x = lu_solve(factors, right)
                x += lu_solve(factors, right - a @ x)
                p[index] = x
        g = c @ p + f - d
        g[free] = 0
        tiny = 1e-13 * np.ptp(f)
        bit = tiny / scale
        new_full = (free & (p > hardness + bit)) | (full & (g <= tiny))
        new_zero = (free & (p < -bit)) | (~free & ~full & (g >= -tiny))
        new_free = ~(new_full | new_zero)
        if (new_free == free).all() and (new_full == full).all():
            return np.clip(p, 0, hardness), d, (free, full), sweep
        key = (new_free.tobytes(), new_full.tobytes())
        if key in seen or relax:
            relax = True                       # one change at a time, the worst violation
            worst = np.where(free, np.maximum(p - hardness, -p), np.where(full, g, -g) / scale)
            i = int(np.argmax(worst))
            nf, nu = free.copy(), full.copy()
            nf[i], nu[i] = new_free[i], new_full[i]
            new_free, new_full = nf, nu
        seen.add(key)
        free, full = new_free, new_full
    raise RuntimeError('the sets do not settle')


def gauss_seidel(c, f, hardness, delta, p=None, sweeps=20000, tol=1e-13, omega=1.5):
    """Projected relaxation in displacement control: another algorithm."""
    n = f.size
    p = np.zeros(n) if p is None else p.copy()
    d = np.diag(c).copy()
    for sweep in range(sweeps):
        biggest = 0.0
        for i in range(n):
            new = p[i] - omega * (c[i] @ p + f[i] - delta) / d[i]
            new = min(max(new, 0.0), hardness)
            biggest = max(biggest, abs(new - p[i]))
            p[i] = new
        if biggest < tol:
            return p, sweep
    return p, sweeps


def kkt(hat, f, p, hardness, delta):
    """Largest violations with a fresh convolution by FFT: of g = 0 where 0 < p < H, of the signs, of the box."""
    g = np.fft.ifft2(hat * np.fft.fft2(p.reshape(hat.shape))).real.ravel() + f - delta
    free = (p > 0) & (p < hardness)
    return (abs(g[free]).max() if free.any() else 0.0, max(0.0, (-g[p == 0]).max() if (p == 0).any() else 0.0),
            max(0.0, g[p == hardness].max() if (p == hardness).any() else 0.0), max(0.0, -p.min(), p.max() - hardness)), g


def pivot(c, f, hardness, delta, start=None, limit=4000):
    """Displacement control, c positive definite: block principal pivoting, single pivots at the last index (Murty) where blocks do not help; finite."""
    n = f.size
    scale = np.median(np.diag(c))
    free, full = (f < delta, np.zeros(n, bool)) if start is None else (s.copy() for s in start)
    best, tries = n + 1, 8
    for _ in range(limit):
        p = np.where(full, hardness, 0.0)
        index = np.flatnonzero(free)
        if index.size:
            a = c[np.ix_(index, index)]
            right = delta - f[index] - (c[np.ix_(index, np.flatnonzero(full))].sum(1) * hardness if full.any() else 0)
            factors = lu_factor(a)
            x = lu_solve(factors, right)
            p[index] = x + lu_solve(factors, right - a @ x)
        g = c @ p + f - delta
        tiny = 1e-13 * (scale * p.max() + np.ptp(f))
        up = free & (p > hardness) if np.isfinite(hardness) else np.zeros(n, bool)
        down = free & (p < 0)
        loose = (full & (g > tiny)) | (~full & ~free & (g < -tiny))
        bad = up | down | loose
        count = int(bad.sum())
        if count == 0:
            return p, (free, full)
        if count < best:
            best, tries = count, 8
        elif tries > 0:
            tries -= 1
        else:
            only = np.zeros(n, bool)
            only[np.flatnonzero(bad)[-1]] = True
            up, down, loose = up & only, down & only, loose & only
        free = (free & ~up & ~down) | loose
        full = (full & ~loose) | up
    raise RuntimeError('pivots do not end')


def solve(c, f, hardness=np.inf, mean=None, delta=None, start=None):
    """newton; where it does not settle, delta by regula falsi around pivot."""
    try:
        return newton(c, f, hardness, mean, delta, start, 40)[:3]
    except RuntimeError:
        pass
    if mean is None:
        p, sets = pivot(c, f, hardness, delta, start)
        return p, delta, sets
    shift = np.median(np.diag(c))                  # u + shift * sum(p): under a given load it only moves delta
    cc = c + shift
    lo, hi, sets = f.min(), f.max() + cc.sum(1).max() * min(hardness, 1e3 * mean), start
    for k in range(200):
        middle = (lo + hi) / 2
        p, sets = pivot(cc, f, hardness, middle, sets)
        lo, hi = (middle, hi) if p.mean() < mean else (lo, middle)
        try:
            return newton(c, f, hardness, mean, None, sets, 3)[:3]
        except RuntimeError:
            if hi - lo < 1e-15 * abs(hi):
                break
    raise RuntimeError('no bracket')
