"""Makes periodic.csv, pressures.csv, path.csv and residual.csv; see README.md.   python periodic.py (two minutes)"""
import sys
from pathlib import Path
import numpy as np
HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from dense import gauss_seidel, kkt, matrix, multiplier, solve  # noqa: E402

B = 'bonded'
CELLS = {'square': ((24, 24), (1, 0), (0, 1)), 'rectangle': ((20, 27), (1, 0), (0, 1.3)), 'oblique': ((21, 24), (1, 0), (0.35, 0.9))}
BODIES = {'bare': [([], (0.91, 0.3))], 'coated': [([(0.1, 5, 0.2, B)], (1, 0.3))]}
HARDNESS = {'bare': (0.005, 0.1, 0.3), 'coated': (0.02, 0.3, 1.0)}
SHARES = (0.1, 0.5, 0.95, 0.99)


def surface(kind, shape):
    u, v = np.meshgrid(np.arange(shape[0]) / shape[0], np.arange(shape[1]) / shape[1], indexing='ij')
    if kind == 'wavy':
        return (0.02 * (2 - np.cos(2 * np.pi * u) - np.cos(2 * np.pi * v))).ravel()
    f = np.zeros(shape)
    for m in range(0, 5):
        for n in range(-5, 6):
            if m == 0 and n <= 0:
                continue
            f += 0.012 * (m * m + n * n) ** -0.9 * np.cos(2 * np.pi * (m * u + n * v) + 1.7 * m * m + 2.3 * m * n + 3.1 * n * n + 0.5)
    return (f - f.min()).ravel()


def row(hat, f, p, d, hardness):
    v, g = kkt(hat, f, p, hardness, d)
    assert max(v) < 3e-13 * np.ptp(f), v
    full, free = p == hardness, (p > 0) & (p < hardness)
    pressed = np.where(full, np.maximum(-g, 0), 0)
    margins = [np.minimum(p, hardness - p)[free].min() / hardness] if free.any() else []
    margins += [abs(g[~free]).min() / np.ptp(f)] if (~free).any() else []
    # Frank-Wolfe gap at the best multiplier: zero but for rounding
    h = np.sort(g)
    fill = p.sum() / hardness
    k = int(fill)
    best = hardness * h[:k].sum() + (hardness * (fill - k) * h[k] if k < h.size else 0)
    assert abs(p @ g - best) < 1e-13 * p.sum() * np.ptp(f), (p @ g, best)
    return dict(mean=p.mean(), delta=d, fraction=(p > 0).mean(), plastic=full.mean(), depth=pressed.max(), pressed=pressed.mean(), margin=min(margins)), pressed


def main():
    names = ('mean', 'delta', 'fraction', 'plastic', 'depth', 'pressed', 'margin')
    table = ['cell,surface,body,hardness,control,' + ','.join(names)]
    pressures, residual, path = {}, {}, ['case,step,' + ','.join(names)]
    checks = []
    for cell, (shape, a1, a2) in CELLS.items():
        for body, bodies in BODIES.items():
            hat = multiplier(shape, a1, a2, bodies)
            c = matrix(hat)
            for kind in ('wavy', 'rough'):
                f = surface(kind, shape)
                for hardness in HARDNESS[body]:
                    for share in SHARES:
                        p, d, sets = solve(c, f, hardness, mean=share * hardness)
                        r, _ = row(hat, f, p, d, hardness)
                        mirrored, dm, _ = solve(c, f.max() - f, hardness, mean=(1 - share) * hardness)
                        checks.append(('mirror', abs(hardness - mirrored - p).max() / hardness, abs(f.max() - dm - d) / np.ptp(f)))
                        if share == 0.5 and kind == 'rough' and hardness == HARDNESS[body][1]:
                            q, sweeps = gauss_seidel(c, f, hardness, d, tol=1e-12 * hardness, sweeps=400)
                            checks.append(('relaxation %s %s %d' % (cell, body, sweeps), abs(q - p).max() / hardness, 0))
                        table.append(f'{cell},{kind},{body},{hardness},load,' + ','.join('%.12g' % r[k] for k in names))
                        if kind == 'rough' and hardness == HARDNESS[body][1] and share in ((0.5, 0.99) if body == 'coated' else (0.5,)):
                            pressures[f'{cell}_{body}_{hardness}_{share}'] = p
                    d = round(0.45 * np.ptp(f), 4)
                    p, d, sets = solve(c, f, hardness, delta=d)
                    r, _ = row(hat, f, p, d, hardness)
                    table.append(f'{cell},{kind},{body},{hardness},approach,' + ','.join('%.12g' % r[k] for k in names))
            if (cell, body) in (('square', 'bare'), ('oblique', 'coated'), ('rectangle', 'coated')):
                f = surface('rough', shape)
                hardness = HARDNESS[body][1]
                name = f'{cell}_{body}'
                shapef, total = f.copy(), np.zeros_like(f)
                at = {}
                for step, share in enumerate((0.05, 0.2, 0.5, 0.2, 0.02, 0.5, 0.7), 1):
                    p, d, sets = solve(c, shapef, hardness, mean=share * hardness)
                    r, pressed = row(hat, shapef, p, d, hardness)
                    if step == 6:
                        checks.append(('reloaded ' + name, abs(p - at[3]).max() / hardness, abs(pressed).max() / np.ptp(f)))
                    at[step] = p
                    shapef, total = shapef + pressed, total + pressed
                    r['depth'], r['pressed'] = total.max(), total.mean()
                    path.append(f'{name},{step},' + ','.join('%.12g' % r[k] for k in names))
                    if step == 3:
                        residual[name] = total.copy()
                        q, e, _ = solve(c, f, hardness, mean=share * hardness)
                        checks.append(('direct against path ' + name, abs(p - q).max() / hardness, abs(total - row(hat, f, q, e, hardness)[1]).max() / np.ptp(f)))
    for label in sorted(set(x[0] for x in checks)):
        print(label, '%.1e %.1e' % tuple(max(x[i] for x in checks if x[0] == label) for i in (1, 2)))
    (HERE / 'periodic.csv').write_text('\n'.join(table) + '\n')
    (HERE / 'path.csv').write_text('\n'.join(path) + '\n')
    for file, fields in (('pressures.csv', pressures), ('residual.csv', residual)):
        for cell, (shape, _, _) in CELLS.items():
            own = {k: v for k, v in fields.items() if k.startswith(cell)}
            if not own:
                continue
            text = 'i,j,' + ','.join(own) + '\n'
            for i in range(shape[0]):
                for j in range(shape[1]):
                    text += f'{i},{j},' + ','.join('%.10g' % v[i * shape[1] + j] for v in own.values()) + '\n'
            (HERE / f'{cell}-{file}').write_text(text)


if __name__ == '__main__':
    main()
