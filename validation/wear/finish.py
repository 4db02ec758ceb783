"""Makes sphere.csv from the two programs of sphere.py; see README.md.   python finish.py"""
from pathlib import Path
import numpy as np
from sphere import at, front, rings

TIMES = np.array([0.01, 0.03, 0.1, 0.3, 1, 3, 10, 30, 100])


def main():
    g = np.array([at(front(n, 4.2), TIMES) for n in (50, 100, 200)])       # a, delta, p0, h0, (volume)
    second = (4 * g[1:] - g[:-1]) / 3
    best = second[-1].copy()
    best[:, 0] = 2 * g[2, :, 0] - g[1, :, 0]
    before = second[0].copy()
    before[:, 0] = 2 * g[1, :, 0] - g[0, :, 0]
    rows = ['ks,a,delta,p0,worn0,a_rigid,a_next']
    P = 4 / 3
    for i, s in enumerate(TIMES):
        rigid = (4 * s * P / np.pi) ** 0.25
        a = rigid
        for _ in range(200):
            a = (4 / np.pi * (s * P + 4 * P * a / (3 * np.pi))) ** 0.25
        rows.append('%g,' % s + '%.6f,' % best[i, 0] + ','.join('%.8g' % v for v in best[i, 1:4]) + ',%.6f,%.6f' % (rigid, a))
        print(rows[-1], 'against the pair before', ['%.0e' % abs(u - v) for u, v in zip(best[i, :4], before[i, :4])], flush=True)
    (Path(__file__).parent / 'sphere.csv').write_text('\n'.join(rows) + '\n')
    times, steps = TIMES[2:7], np.array([40, 40, 60, 60, 80])
    r = [rings(n, 2.2, times, steps * m) for n, m in ((150, 1), (150, 2), (300, 1), (300, 2))]
    inter = [2 * r[1] - r[0], 2 * r[3] - r[2]]
    other = (4 * inter[1] - inter[0]) / 3
    for s, u, v, c in zip(times, other, best[2:7], inter[1]):
        print('rings', s, 'delta, p0, worn0 minus front', u - v[1:4], 'before the last extrapolation', c - v[1:4])


if __name__ == '__main__':
    main()
