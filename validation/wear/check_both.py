"""Half the step and finer Euler steps for the cases of bodies.csv whose contact changes most.   python check_both.py"""
import numpy as np
from periodic import B, exact, matrix, multiplier, rough, run
for cell, shape, a1, a2 in (('rectangle', (20, 27), (1, 0), (0, 1.3)), ('oblique', (21, 24), (1, 0), (0.35, 0.9))):
    f = rough(shape)
    c = matrix(multiplier(shape, a1, a2, [([(0.1, 5, 0.2, B)], (1, 0.3))]))
    least = np.sort(np.linalg.eigvalsh(c))[1]
    for k1, k2 in ((1.0, 0.5), (0.0, 1.0)):
        if cell == 'rectangle' and k1 == 0:
            continue
        times = (0.05, 0.2)
        a, ea = exact(c, f, 0.02, k1, k2, shape, times, 0.2 * least / (k1 + k2))
        b, eb = exact(c, f, 0.02, k1, k2, shape, times, 0.1 * least / (k1 + k2))
        for t, x, y in zip(times, a, b):
            print(cell, k1, k2, t, 'half the step: p/mean, delta, h1, h2 over range', ['%.0e' % (np.abs(np.asarray(u) - v).max() / w) for u, v, w in zip(x, y, (0.02, *[np.ptp(f)] * 3))], ea, eb, flush=True)
        for implicit in (True, False):
            r = [run(c, f, 0.02, k1, k2, shape, times[:1], (m,), implicit) for m in (80, 160)]
            e = [2 * np.asarray(v) - np.asarray(u) for u, v in zip(r[0][0], r[1][0])]
            print(cell, k1, k2, times[0], 'implicit' if implicit else 'explicit', ['%.0e' % (np.abs(u - v).max() / w) for u, v, w in zip(e, b[0], (0.02, *[np.ptp(f)] * 3))], flush=True)
