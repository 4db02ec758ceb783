"""Makes reference.csv and merging.csv again with ../periodic_contact.py and prints the largest differences from the committed
ones. python generate.py [SAMPLES], 512 across the cell unless said otherwise; merging on a quarter of them.

Hexagonal waves on the rectangular cell 1 x sqrt 3. Areas counted in samples, less (pi - 1 + ln 2)/24 of the perimeter of
the contact times the spacing (Yastrebov, Anciaux & Molinari, 2017).   pip install numpy scipy
"""

import sys
from math import log, pi
from pathlib import Path

import numpy as np

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE.parent))
from periodic_contact import Body, grid, solve  # noqa: E402

ROOT = 3**0.5
# Side of the cell, p* for unit amplitude and E* = 1, saddle between two crests in fractions of the cell.
WAVES = {
    "egg_box": (1.0, 2**0.5 * pi, (0.25, 0.25)),
    "peaks": (ROOT, 3 * pi / ROOT, (0.5, 0.0)),
    "holes": (ROOT, 6 * pi / ROOT, (0.0, 0.5)),
}


def table(name):
    lines = [line for line in (HERE / name).read_text().splitlines() if not line.startswith("#")]
    return dict(zip(lines[0].split(","), np.array([line.split(",") for line in lines[1:]], float).T))


def prepare(name, samples):
    side = WAVES[name][0]
    shape = (samples, samples if side == 1 else 6 * round(samples * side / 6))  # crests and saddles on samples
    x, y = (2 * pi * v for v in grid(shape, (1.0, side)))
    if name == "egg_box":
        return Body(shape, (1.0, side)), np.cos(x) * np.cos(y)
    height = 2 * np.cos(x) * np.cos(y / ROOT) + np.cos(2 * y / ROOT)
    return Body(shape, (1.0, side)), height if name == "peaks" else -height


def area(contact):
    edges = sum((contact != np.roll(contact, 1, axis)).sum() for axis in (0, 1))
    return (contact.sum() - (pi - 1 + log(2)) / 24 * edges) / contact.size


def merging(name, samples, near):
    body, height = prepare(name, samples)
    place = tuple(round(part * n) for part, n in zip(WAVES[name][2], height.shape))
    low, high = 0.8 * near, 1.2 * near
    while high - low > 4e-4:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if solve(body, height, middle * WAVES[name][1])[0][place] > 0 else (middle, high)
    return 0.5 * (low + high)


samples = int(sys.argv[1]) if len(sys.argv) > 1 else 512
reference, merged = table("reference.csv"), table("merging.csv")
for name, (_, complete, _) in WAVES.items():
    body, height = prepare(name, samples)
    found = []
    for fraction in reference["fraction"]:
        pressure, _ = solve(body, height, fraction * complete)
        found.append((area(pressure > 0), pressure.max() / complete))
        print(f"{name},{fraction},{found[-1][0]:.4f},{found[-1][1]:.5f}", flush=True)
    areas, peaks = np.array(found).T
    load = merging(name, samples // 4, merged[name][0])
    print(f"{name}: areas differ by {abs(areas - reference[name + '_area']).max():.1e}, peaks by "
          f"{abs(peaks / reference[name + '_peak'] - 1).max():.1e} relative; merge at {load:.4f}, {merged[name][0]} given")
