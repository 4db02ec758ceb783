#!/usr/bin/env python3
"""percoat beside its peers: the same solves and convolutions by turns in one run, every pressure judged alike.

    python3 benches/peers.py VENV                     # everything; an hour or two on a machine of two cores
    python3 benches/peers.py VENV --quick             # 1024 points, two threads, three rounds
    python3 benches/peers.py VENV --only convolution  # or solve
    python3 benches/peers.py VENV --output peers.md   # the tables as Markdown too

VENV is a Python environment; it is made where there is none (CPython 3.10 to 3.12), and what it lacks is installed by pip:
numpy, scipy, rfgen (for aspher), aspher 0.1.3.post1, tamaas 2.9.0, mkl_fft 2.3.2, pyfftw 0.15.1. ASPHER is compiled from its source twice, with
its two transforms (pocketfft, FFTW), optimised for this machine; that needs a C++ compiler with OpenMP, CMake, and the
headers of Eigen 3.4 and of FFTW 3 in both precisions with OpenMP (Debian: g++ cmake libeigen3-dev libfftw3-dev).

What is timed
- Solve: the bare half-space (E* = 1) under the unit square, from heights to a pressure, tolerance 1e-8; one paraboloid, and
  rough surfaces (H = 0.8, unit rms slope, 4 to 64 waves per cell and 4 to what the grid holds), 15 to 20 % in contact.
  ASPHER sets up inside its solve, so that percoat's setup counts against it; Tamaas has its model and solver made
  before, percoat then too.
- ASPHER in its fastest variant that converges, found before each case: either transform, double or mixed
  precision; nested grids, its |q| preconditioner, no output but the pressure. FFTW measures its plans before.
- Convolution: real to complex, times a table, and back; plans and tables made before, result in place where offered.
- Threads are set alike for everybody; Tamaas, whose package on PyPI is not parallel, is timed on one alone. Each contender is a process of its own that waits while others are timed; rounds go
  A B C A B C …, and a ratio is the median of those of the rounds, peer over percoat: above 1 percoat is faster.
  "processor time" is the same ratio of what the system counted (setup on both sides): it stands where others use the
  machine too, but threads that wait for one another by spinning are counted as working.
  A contender that has used up its time (--budget) sits out the rest; the rounds are in the table.

How answers are judged: on the exact discrete problem, C(q) = 2/(E*q), in double precision, the Frank-Wolfe gap
sum p (g - min g) over the elastic energy 1/2 sum p Cp (an upper bound on the relative excess of energy), the deepest penetration
outside contact over the penetration, and the error of the load. Where a peer's gap is larger than ours it says "worse".
"""

import argparse
import datetime
import json
import os
import platform
import re
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGES = ["numpy", "scipy", "rfgen", "tamaas==2.9.0", "mkl_fft==2.3.2", "pyfftw==0.15.1"]
ASPHER = "aspher==0.1.3.post1"
ENGINES = ["pocketfft", "fftw"]
PRECISIONS = ["double", "float_then_double"]
# Ratios, peer over percoat, that percoat means to reach.
TARGETS = {"ASPHER": 5.0, "Tamaas": 40.0, "MKL": 1.5, "FFTW": 1.8, "SciPy": 1.8}
# The surfaces that peer.rs makes.
CASES = ["one-level", "rough-4-to-64", "rough-to-the-grid"]


# The environment


def prepare(venv):
    """Makes and fills the environment; its interpreter."""
    python = venv / "bin" / "python"
    if not python.exists():
        subprocess.run([sys.executable, "-m", "venv", venv], check=True)
    pip = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    marker = venv / "peers.installed"
    wanted = "\n".join([*PACKAGES, ASPHER]) + "\n"
    if not marker.exists() or marker.read_text() != wanted:
        subprocess.run([*pip, *PACKAGES], check=True)
        for engine in ENGINES:
            options = "-DASPHER_NATIVE=ON -DCMAKE_BUILD_TYPE=Release"
            options += " -DASPHER_USE_FFTW=ON" if engine == "fftw" else ""
            target = ["--no-binary", "aspher", "--no-deps", "--no-cache-dir", "--upgrade", "--target", venv / "aspher" / engine]
            print(f"compiling ASPHER with {engine}, some minutes", flush=True)
            subprocess.run([*pip, *target, ASPHER], check=True, env={**os.environ, "CMAKE_ARGS": options})
        marker.write_text(wanted)
    return python


def build():
    """The bench `peer`, optimised; its path."""
    command = ["cargo", "bench", "--locked", "--bench", "peer", "--no-run", "--message-format=json"]
    lines = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    messages = [json.loads(line) for line in lines if line.startswith("{")]
    paths = [m["executable"] for m in messages if m.get("executable") and m["target"]["name"] == "peer"]
    return paths[-1]


# The contenders: each answers the lines of its standard input, as the head of peer.rs says


def serve(run, field):
    """`run` gives what a timed run has to say, `field` the last result."""
    import numpy as np

    print("ready", flush=True)
    for line in sys.stdin:
        word, _, path = line.strip().partition(" ")
        if word == "write":
            np.save(path, np.ascontiguousarray(field(), dtype=float))
            print("written", flush=True)
        else:
            print(json.dumps(run()), flush=True)


def aspher(heights, mean_pressure, tolerance, threads, precision):
    import aspher
    import numpy as np

    h = np.load(heights)
    gap = (h.max() - h).ravel()
    last = [None]

    def run():
        began = time.perf_counter()
        last[0] = aspher.solve_nested(
            grid_size=len(h), gap=gap, p_nominal=float(mean_pressure), tol=float(tolerance), backend="periodic",
            precision=precision, light_result=True,
        )  # fmt: skip
        seconds = time.perf_counter() - began
        status = {"iterations": last[0].iterations, "converged": last[0].status == "converged"}
        return {"setup": 0.0, "seconds": seconds, **status}

    serve(run, lambda: last[0].pressure)


def tamaas(heights, mean_pressure, tolerance, threads):
    import numpy as np
    import tamaas as tm

    tm.set_log_level(tm.LogLevel.error)
    tm.initialize(int(threads))
    h = np.load(heights)
    model = tm.ModelFactory.createModel(tm.model_type.basic_2d, [1.0, 1.0], list(h.shape))
    model.E, model.nu = 1.0, 0.0
    solver = tm.PolonskyKeerRey(model, h, float(tolerance))
    solver.max_iter = 20000

    def run():
        # It begins with the pressure that it finds.
        model.traction[:] = 0.0
        began = time.perf_counter()
        error = solver.solve(float(mean_pressure))
        return {"setup": 0.0, "seconds": time.perf_counter() - began, "converged": error <= float(tolerance)}

    serve(run, lambda: model.traction)


def convolution(kind, points, threads):
    from concurrent.futures import ThreadPoolExecutor

    import numpy as np

    n, threads = int(points), int(threads)
    table = compliance(n)
    pressure = ((np.arange(n * n) * 7919) % 1009 / 1009).reshape(n, n)
    pool = ThreadPoolExecutor(threads)
    cuts = [n * part // threads for part in range(threads + 1)]
    parts = [slice(a, b) for a, b in zip(cuts, cuts[1:])]

    def times_table(spectrum):
        list(pool.map(lambda part: np.multiply(spectrum[part], table[part], out=spectrum[part]), parts))

    if kind == "MKL":
        import mkl_fft

        spectrum, result = np.empty((n, n // 2 + 1), complex), np.empty((n, n))

        def convolve():
            mkl_fft.rfft2(pressure, out=spectrum)
            times_table(spectrum)
            mkl_fft.irfft2(spectrum, s=(n, n), out=result)
            return result
    elif kind == "SciPy":
        import scipy.fft

        def convolve():
            spectrum = scipy.fft.rfft2(pressure, workers=threads)
            times_table(spectrum)
            return scipy.fft.irfft2(spectrum, s=(n, n), workers=threads, overwrite_x=True)
    else:
        import pyfftw

        flags = ("FFTW_MEASURE", "FFTW_DESTROY_INPUT")
        source = pyfftw.empty_aligned((n, n))
        spectrum, result = pyfftw.empty_aligned((n, n // 2 + 1), complex), pyfftw.empty_aligned((n, n))
        forward = pyfftw.FFTW(source, spectrum, axes=(0, 1), flags=flags[:1], threads=threads)
        backward = pyfftw.FFTW(
            spectrum, result, axes=(0, 1), direction="FFTW_BACKWARD", flags=flags, threads=threads
        )  # fmt: skip
        source[:], table = pressure, table / (n * n)

        def convolve():
            forward.execute()
            times_table(spectrum)
            backward.execute()
            return result

    last = [None]

    def run():
        began = time.perf_counter()
        last[0] = convolve()
        return {"setup": 0.0, "seconds": time.perf_counter() - began}

    serve(run, lambda: last[0])


class Contender:
    """A process that waits until it is told to run."""

    def __init__(self, name, command, threads, environment=None):
        self.name, self.runs, self.spent, self.used = name, {}, 0.0, 0.0
        counts = ["OMP_NUM_THREADS", "MKL_NUM_THREADS", "OPENBLAS_NUM_THREADS", "RAYON_NUM_THREADS"]
        environment = {**os.environ, **dict.fromkeys(counts, str(threads)), "MKL_DYNAMIC": "FALSE", **(environment or {})}
        pipe = subprocess.PIPE
        self.process = subprocess.Popen([*map(str, command)], stdin=pipe, stdout=pipe, text=True, env=environment)
        self.expect("ready")

    def expect(self, word):
        line = self.process.stdout.readline().strip()
        if line != word:
            raise SystemExit(f"{self.name} said {line!r} instead of {word!r}")

    def ask(self):
        """One run: what it says of it."""
        began, used = time.perf_counter(), self.processor()
        print("run", file=self.process.stdin, flush=True)
        answer = json.loads(self.process.stdout.readline())
        self.spent += time.perf_counter() - began
        self.used += self.processor() - used
        return answer

    def processors(self):
        """How many processors were at work, on the average."""
        return self.used / self.spent

    def processor(self):
        """Processor time so far, seconds; 0 where the system does not tell."""
        try:
            fields = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
            return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        except OSError:
            return 0.0

    def field(self):
        import numpy as np

        with tempfile.TemporaryDirectory() as folder:
            print(f"write {folder}/field.npy", file=self.process.stdin, flush=True)
            self.expect("written")
            return np.load(f"{folder}/field.npy")

    def end(self):
        self.process.stdin.close()
        self.process.wait()


def worker(python, *arguments):
    return [python, Path(__file__).resolve(), "--worker", *arguments]


def take_turns(contenders, rounds, budget):
    """Runs by turns after one that does not count; the first contender takes part in every round."""
    for contender in contenders:
        contender.ask()
        contender.spent, contender.used = 0.0, 0.0
    for number in range(rounds):
        present = [c for c in contenders[1:] if c.spent < budget or not c.runs]
        for contender in [contenders[0], *present] if present else []:
            contender.runs[number] = contender.ask()


def ratios(ours, peer, setup=False):
    """Peer over percoat, round by round."""
    seconds = lambda run: run["seconds"] + (run["setup"] if setup else 0.0)
    return [run["seconds"] / seconds(ours.runs[number]) for number, run in peer.runs.items()]


def processor_ratio(ours, peer):
    """Processor time of a run, peer over percoat; a dash where the system does not tell."""
    own, its = (contender.used / len(contender.runs) for contender in (ours, peer))
    return f"{its / own:.2f}" if own > 0 else "–"


def median(runs, key="seconds"):
    return statistics.median(run[key] for run in runs.values())


# The problems


def wavenumbers(n):
    import numpy as np

    return 2 * np.pi * np.hypot((np.fft.fftfreq(n) * n)[:, None], (np.fft.rfftfreq(n) * n)[None, :])


def compliance(n):
    """2/(E*q) with E* = 1, without mean."""
    q = wavenumbers(n)
    q[0, 0] = float("inf")
    return 2 / q


def surface(peer, case, n, path):
    """Writes the heights on n x n points of the unit square; these and the mean pressure."""
    import numpy as np

    command = [str(word) for word in (peer, "heights", case, n, path)]
    mean_pressure = float(subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout)
    return np.load(path), mean_pressure


def judge(heights, mean_pressure, pressure):
    """Energy gap, penetration, error of the load, contact fraction; see the head."""
    import numpy as np

    n = len(heights)
    p = np.maximum(pressure, 0.0)
    u = np.fft.irfft2(compliance(n) * np.fft.rfft2(p), s=(n, n))
    g = u + heights.max() - heights
    delta = (p * g).sum() / p.sum()
    outside = np.where(p > 0, 0.0, g - delta).min()
    energy = 0.5 * (p * u).sum()
    load = abs(pressure.mean() / mean_pressure - 1) + abs(np.minimum(pressure, 0.0).mean()) / mean_pressure
    return (p * (g - g.min())).sum() / energy, max(0.0, -outside) / delta, load, (p > 0).mean()


# The run


class Sheet:
    """A table that is printed row by row, and kept."""

    def __init__(self, title, header):
        self.lines = [f"\n{title}\n", "| " + " | ".join(header) + " |", "|" + "---|" * len(header)]
        print("\n".join(self.lines), flush=True)

    def row(self, *cells):
        self.lines.append("| " + " | ".join(map(str, cells)) + " |")
        print(self.lines[-1], flush=True)


def verdict(name, values):
    return f"{TARGETS[name]:g} " + ("met" if statistics.median(values) >= TARGETS[name] else "**not met**")


def spread(values):
    return f"{statistics.median(values):.2f} ({min(values):.2f}–{max(values):.2f}, {len(values)})"


def best_aspher(python, arguments, threads):
    """The variant that converges fastest, by its second run, where plans are made and memory is warm."""
    best = None
    for engine in ENGINES:
        for precision in PRECISIONS:
            path = {"PYTHONPATH": str(Path(sys.prefix) / "aspher" / engine), "HMC_FFTW_MEASURE": "1"}
            contender = Contender("ASPHER", worker(python, "aspher", *arguments, threads, precision), threads, path)
            runs = [contender.ask() for _ in range(2)]
            print(f"  ASPHER, {engine}, {precision}: {runs[1]}", file=sys.stderr, flush=True)
            if runs[1]["converged"] and (best is None or runs[1]["seconds"] < best[0]):
                if best:
                    best[1].end()
                contender.variant = f"{engine}, {precision.replace('_', ' ')}"
                best = (runs[1]["seconds"], contender)
            else:
                contender.end()
    if best is None:
        print("  no variant of ASPHER converges: it has no row", file=sys.stderr, flush=True)
    return best and best[1]


def solves(options, peer, python):
    header = [
        "case", "points", "threads", "peer", "percoat s", "setup s", "peer s", "peer / percoat (range, rounds)", "target",
        "processor time", "gap, penetration, load error: percoat", "peer", "processors: percoat, peer",
    ]  # fmt: skip
    sheet = Sheet(f"Solve, tolerance {options.tolerance:g}", header)
    for case in options.cases:
        for n in options.points:
            with tempfile.TemporaryDirectory() as folder:
                path = f"{folder}/heights.npy"
                heights, mean_pressure = surface(peer, case, n, path)
                arguments = [path, mean_pressure, options.tolerance]
                for threads in options.threads:
                    ours = Contender("percoat", [peer, "solve", *arguments, threads], threads)
                    others = [best_aspher(python, arguments, threads)] if "ASPHER" in options.peers else []
                    if "Tamaas" in options.peers and threads == 1:  # its package has no more
                        others.append(Contender("Tamaas", worker(python, "tamaas", *arguments, threads), threads))
                    others = [other for other in others if other]
                    take_turns([ours, *others], options.rounds, options.budget)
                    own = judge(heights, mean_pressure, ours.field())
                    for other in others:
                        its = judge(heights, mean_pressure, other.field())
                        values = ratios(ours, other, setup=other.name == "ASPHER")
                        name = other.name + (f" ({other.variant})" if hasattr(other, "variant") else "")
                        worse = "" if its[0] <= own[0] else f", worse {its[0] / own[0]:.1f}×"
                        failed = "" if all(run["converged"] for run in other.runs.values()) else ", not converged"
                        sheet.row(
                            f"{case}, {100 * own[3]:.1f} %", n, threads, name,
                            f"{median(ours.runs):.3f}", f"{median(ours.runs, 'setup'):.3f}", f"{median(other.runs):.3f}",
                            spread(values), verdict(other.name, values), processor_ratio(ours, other),
                            "{:.0e}, {:.0e}, {:.0e}".format(*own), "{:.0e}, {:.0e}, {:.0e}".format(*its) + worse + failed,
                            f"{ours.processors():.1f}, {other.processors():.1f}",
                        )  # fmt: skip
                    for contender in [ours, *others]:
                        contender.end()
    return sheet


def convolutions(options, peer, python):
    import numpy as np

    header = ["points", "threads", "peer", "percoat ms", "peer ms", "peer / percoat (range, rounds)", "target"]
    header += ["processor time", "difference", "processors: percoat, peer"]
    sheet = Sheet("One convolution", header)
    for n in options.convolutions:
        for threads in [max(options.threads)]:
            ours = Contender("percoat", [peer, "convolution", n, threads], threads)
            names = ["MKL", "SciPy", "FFTW"]
            others = [Contender(name, worker(python, "convolution", name, n, threads), threads) for name in names]
            take_turns([ours, *others], 5 * options.rounds, options.budget)
            own = ours.field()
            for other in others:
                values = ratios(ours, other)
                difference = np.abs(other.field() - own).max() / np.abs(own).max()
                milliseconds = [f"{1e3 * median(contender.runs):.2f}" for contender in (ours, other)]
                processors = f"{ours.processors():.1f}, {other.processors():.1f}"
                result = spread(values), verdict(other.name, values), processor_ratio(ours, other)
                sheet.row(n, threads, other.name, *milliseconds, *result, f"{difference:.0e}", processors)
            for contender in [ours, *others]:
                contender.end()
    return sheet


def machine():
    from importlib.metadata import version

    def said(*command):
        try:
            return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()
        except (OSError, subprocess.CalledProcessError):
            return "unknown"

    cpu = platform.processor() or platform.machine()
    if Path("/proc/cpuinfo").exists():
        cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text() + "model name : " + cpu)[1]
    changed = ", changed" if said("git", "status", "--porcelain", "--untracked-files=no") else ""
    packages = ["numpy", "scipy", "tamaas", "mkl_fft", "mkl", "pyfftw"]
    return [
        f"{datetime.date.today()}, {cpu}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} before the run",
        f"percoat {said('git', 'rev-parse', '--short', 'HEAD')}{changed}, {said('rustc', '--version')}",
        ASPHER.replace("==", " ") + ", " + ", ".join(f"{name} {version(name)}" for name in packages),
    ]


def main():
    numbers = lambda text: [int(word) for word in text.split(",")]
    parser = argparse.ArgumentParser(description="percoat beside its peers; the head of this file says how")
    parser.add_argument("venv", type=Path)
    parser.add_argument("--only", choices=["solve", "convolution"])
    parser.add_argument("--points", type=numbers, default=[1024, 2048], help="of the solves")
    parser.add_argument("--convolutions", type=numbers, default=[1024, 2048, 4096], help="points of the convolutions")
    parser.add_argument("--threads", type=numbers, default=[1, 2])
    parser.add_argument("--cases", type=lambda text: text.split(","), default=CASES)
    parser.add_argument("--peers", type=lambda text: text.split(","), default=["ASPHER", "Tamaas"], help="of the solves")
    parser.add_argument("--rounds", type=int, default=7)
    parser.add_argument("--budget", type=float, default=120.0, help="seconds of a peer a case")
    parser.add_argument("--tolerance", type=float, default=1e-8)
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--output", type=Path)
    options = parser.parse_args()
    if options.quick:
        options.points, options.convolutions, options.threads, options.rounds = [1024], [1024], [2], 3
    python = prepare(options.venv.resolve())
    if Path(sys.prefix).resolve() != options.venv.resolve():
        os.execv(python, [str(python), *sys.argv])
    peer = build()
    head = machine()
    print("\n".join(head), flush=True)
    if os.getloadavg()[0] > 0.5:
        print("others use this machine: with two threads contenders that spin lose more than their share", flush=True)
    sheets = [run(options, peer, python) for run in (solves, convolutions) if options.only in (None, run.__name__[:-1])]
    if options.output:
        options.output.write_text("\n".join([*head, *(line for sheet in sheets for line in sheet.lines)]) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        {"aspher": aspher, "tamaas": tamaas, "convolution": convolution}[sys.argv[2]](*sys.argv[3:])
    else:
        main()
