"""Setup, solution, stresses and output of whole commands, for which a user waits, by two programs by turns.

`python3 benches/waits.py [BEFORE] [--rounds N] [--threads N] [--only CASE,…]`: BEFORE is a commit (HEAD^ unless named), which is built, or the path of
a program; it is compared with the present tree. Needs NumPy for the heights. Printed are medians in seconds and the ratio of the whole
commands, present over before: below 1 the present tree is quicker. What else runs on the machine disturbs both alike, but not evenly.
"""

import argparse
import datetime
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
PHASES = ["setup", "solve", "stress", "output"]
HEIGHTS = """
[surface]
heights = "{file}"
pixel = {pixel}
[substrate]
young = 1.0
poisson = 0.3
[load]
mean_pressure = {load}
"""


def paraboloid(n):
    x = (np.arange(n) / n - 0.5) ** 2
    return -0.5 * (x[:, None] + x[None, :])


def rough(n):
    """Self-affine, Hurst 0.8, waves 4 to 64, rms slope 0.1."""
    generator = np.random.default_rng(1)
    k = np.fft.fftfreq(n, 1 / n)
    q = np.hypot(k[:, None], np.arange(n // 2 + 1)[None, :])
    amplitude = np.where((q >= 4) & (q <= 64), np.maximum(q, 1) ** -1.8, 0)
    heights = np.fft.irfft2(amplitude * np.exp(2j * np.pi * generator.random(q.shape)), s=(n, n))
    slope = np.gradient(heights, 1 / n)
    return heights * 0.1 / np.sqrt(np.mean(slope[0] ** 2 + slope[1] ** 2))


def cases(folder):
    """Name and arguments of each command; heights are written into the folder."""
    yield "solve ball-on-disc", ["ball-on-disc"]
    yield "solve dlc-on-steel", ["dlc-on-steel"]
    yield "solve scratch", ["scratch"]
    yield "solve pavement", ["pavement"]
    yield "solve polymer-on-steel", ["polymer-on-steel"]
    yield "solve fig2", ["fig2"]
    for kind, heights, load in [("paraboloid", paraboloid, 0.01), ("rough", rough, 0.005)]:
        for n in (1024, 2048):
            np.save(folder / f"{kind}{n}.npy", heights(n))
            path = folder / f"{kind}{n}.toml"
            path.write_text(HEIGHTS.format(file=f"{kind}{n}.npy", pixel=1 / n, load=load))
            yield f"heights, {kind} {n}²", [str(path)]


def built(source, target):
    subprocess.run(["cargo", "build", "--release", "--locked", "--bin", "percoat", "--target-dir", target], cwd=source, check=True)
    return Path(target) / "release" / "percoat"


def earlier(before, place):
    """The program before: of a path, or of a commit, built beside the present one."""
    if os.access(before, os.X_OK) and not os.path.isdir(before):
        return Path(before)
    tree = place / "tree"
    subprocess.run(["git", "worktree", "add", "--quiet", "--detach", str(tree), before], cwd=ROOT, check=True)
    try:
        return built(tree, ROOT / "target" / "before")
    finally:
        subprocess.run(["git", "worktree", "remove", "--force", str(tree)], cwd=ROOT, check=False)


def run(program, arguments, output, threads):
    """Seconds of each phase, and of the whole command."""
    command = [program, "solve", *arguments, "--quiet", "--output", output, *(["--threads", str(threads)] if threads else [])]
    begun = time.perf_counter()
    status = subprocess.run(command, stderr=subprocess.PIPE, text=True)
    whole = time.perf_counter() - begun
    if status.returncode not in (0, 3):
        sys.exit(status.stderr)
    timing = json.loads((Path(output) / "summary.json").read_text())["timing"]
    return [timing[phase] for phase in PHASES] + [whole]


def instructions():
    try:
        flags = Path("/proc/cpuinfo").read_text()
    except OSError:
        return "instruction set not known"
    return "AVX-512" if "avx512f" in flags else "AVX2" if "avx2" in flags else "no AVX2"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", nargs="?", default="HEAD^")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int)
    parser.add_argument("--only", default="", help="parts of the names of cases, comma-separated")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        place = Path(place)
        programs = {"now": built(ROOT, ROOT / "target"), "before": earlier(options.before, place)}
        threads = options.threads or os.cpu_count()
        print(f"{datetime.date.today()}, {platform.machine()}, {instructions()}, {threads} threads, {options.rounds} rounds; before: {options.before}")
        print(f"{'seconds, now / before':26}" + "".join(f"{phase:>16}" for phase in ["setup", "solution", "stresses", "output", "whole"]) + "   ratio")
        wanted = [part for part in options.only.split(",") if part]
        for name, arguments in cases(place):
            if wanted and not any(part in name for part in wanted):
                continue
            times = {program: [] for program in programs}
            for number in range(options.rounds + 1):
                for program, path in programs.items():
                    taken = run(path, arguments, place / program, options.threads)
                    # The first round fills the caches of the disk.
                    times[program] += [taken] if number else []
            now, before = ([statistics.median(column) for column in zip(*times[program])] for program in ("now", "before"))
            cells = "".join(f"{a:8.3f} /{b:6.3f}" for a, b in zip(now, before))
            print(f"{name:26}{cells}   {now[-1] / before[-1]:.2f}", flush=True)


if __name__ == "__main__":
    main()
