#!/usr/bin/env python3
"""percoat beside its peers: the same solves and convolutions by turns in one run, every pressure judged alike.

    python3 benches/peers.py VENV                     # everything; an hour or two on a machine of two cores
    python3 benches/peers.py VENV --quick             # 1024 points, two threads, three rounds
    python3 benches/peers.py VENV --only convolution  # or solve
    python3 benches/peers.py VENV --avx2              # percoat and MKL without AVX-512
    python3 benches/peers.py VENV --output peers.md   # the tables as Markdown too

VENV is a Python environment; it is made where there is none (CPython 3.10 to 3.12), and what it lacks is installed by pip:
numpy, scipy, rfgen (for aspher), aspher 0.1.3.post1, tamaas 2.9.0, mkl_fft 2.3.2, pyfftw 0.15.1. ASPHER is compiled from
its source twice, with its two transforms (pocketfft, FFTW), optimised for this machine; that needs a C++ compiler with
OpenMP, CMake, and the headers of Eigen 3.4 and of FFTW 3 in both precisions with OpenMP (Debian: g++ cmake libeigen3-dev
libfftw3-dev).

What is timed
- Whole run: what `percoat solve` does between reading the case and having its results. Setup: surface, tables and plans of
  all grids. Solve. Readings: boundaries, areas, spots, peaks, of the two next coarser grids too for the errors; warnings.
  Not timed: reading and checking the case or the heights, pictures and files; the cases ask for no stresses.
  ASPHER sets up inside its solve and gives the pressure alone. The ratio is to be 3 at least; the goal is 5.
- "processor time" is the ratio of what the system counted: it stands where others use the machine too, but threads that
  wait for one another by spinning are counted as working.
- Solve: of the same runs, without the readings. percoat's setup counts beside ASPHER; Tamaas has its model and solver made
  before, percoat then too.
- Cases: the bare half-space (E* = 1) under the unit square, tolerance 1e-8, 15 to 20 % in contact. One paraboloid: an
  indenter of one level for percoat, as in a case file, its heights for the peers. Rough surfaces (H = 0.8, unit rms slope,
  4 to 64 waves per cell and 4 to what the grid holds): heights for all.
- "convolutions": those of percoat's solve on all grids, as equivalents of the finest grid in double precision; one in single
  precision counts half. Nearly all are single: "solve over them" is the time of the solve over that of twice as many in
  single precision, of which one is timed after each run in the same process (and counted in its processor time).
- ASPHER in its fastest variant that converges, found before each case: either transform, double or mixed
  precision; nested grids, its |q| preconditioner, no output but the pressure. FFTW measures its plans before.
- Convolution: real to complex, times a table, and back, in double and in single precision; plans and tables made before.
  The input is written just before, untimed, and may be destroyed. The result goes into memory that was there before, where
  the library offers that; percoat's is in place. "library" is the same by realfft and rustfft, benches/shared/library.rs.
  On processors of AMD, MKL takes its general code (libmkl_def), not that for AVX2 or AVX-512.
- Threads are set alike for everybody; Tamaas, whose package on PyPI is not parallel, is timed on one alone. Each contender is
  a process of its own that waits while others are timed; rounds go A B C A B C …, and a ratio is the median of those of the
  rounds, peer over percoat: above 1 percoat is faster. A contender that has used up its time (--budget) sits out the rest;
  the rounds are in the table.
- --avx2: percoat is built without AVX-512, and MKL is told to leave it alone (MKL_ENABLE_INSTRUCTIONS). SciPy, FFTW from its
  package and rustfft have none; ASPHER stays as it is, compiled for this machine.

How answers are judged: on the exact discrete problem, C(q) = 2/(E*q), in double precision, the Frank-Wolfe gap
sum p (g - min g) over the elastic energy 1/2 sum p Cp (an upper bound on the relative excess of energy), the deepest penetration
outside contact over the penetration, and the error of the load. Where a peer's gap is larger than ours it says "worse".
"""

import argparse
import datetime
import itertools
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
TARGETS = {"whole run": 3.0, "ASPHER": 5.0, "Tamaas": 40.0, "MKL": 1.3, "library": 1.3, "FFTW": 1.8, "SciPy": 1.8}
# Parts of percoat's time.
WHOLE = ["setup", "seconds", "readings"]
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


def build(avx2):
    """The bench `peer`, optimised, in a folder of its own where it has no AVX-512; its path."""
    command = ["cargo", "bench", "--locked", "--bench", "peer", "--no-run", "--message-format=json"]
    environment = dict(os.environ)
    if avx2:
        environment["CARGO_TARGET_DIR"] = str(Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "avx2")
        environment["RUSTFLAGS"] = os.environ.get("RUSTFLAGS", "") + " --cfg disable_dispatch_avx512"
    built = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True, env=environment)
    lines = built.stdout.splitlines()
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
        return {"seconds": seconds, **status}

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
        # The solver begins with the pressure that it finds.
        model.traction[:] = 0.0
        began = time.perf_counter()
        error = solver.solve(float(mean_pressure))
        return {"seconds": time.perf_counter() - began, "converged": error <= float(tolerance)}

    serve(run, lambda: model.traction)


def convolution(kind, precision, points, threads):
    from concurrent.futures import ThreadPoolExecutor

    import numpy as np
    import pyfftw

    n, threads = int(points), int(threads)
    real, complex_ = {"double": ("f8", "c16"), "single": ("f4", "c8")}[precision]
    table = compliance(n).astype(real)
    pressure = ((np.arange(n * n) * 7919) % 1009 / 1009).reshape(n, n).astype(real)
    source, result = pyfftw.empty_aligned((n, n), real), pyfftw.empty_aligned((n, n), real)
    spectrum = pyfftw.empty_aligned((n, n // 2 + 1), complex_)
    pool = ThreadPoolExecutor(threads)
    cuts = [n * part // threads for part in range(threads + 1)]
    parts = [slice(a, b) for a, b in zip(cuts, cuts[1:])]

    def times_table(spectrum):
        list(pool.map(lambda part: np.multiply(spectrum[part], table[part], out=spectrum[part]), parts))

    if kind == "MKL":
        import mkl_fft

        def convolve():
            mkl_fft.rfft2(source, out=spectrum)
            times_table(spectrum)
            return mkl_fft.irfft2(spectrum, s=(n, n), out=result)
    elif kind == "SciPy":
        import scipy.fft

        def convolve():
            spectrum = scipy.fft.rfft2(source, workers=threads, overwrite_x=True)
            times_table(spectrum)
            return scipy.fft.irfft2(spectrum, s=(n, n), workers=threads, overwrite_x=True)
    else:
        plan = {"axes": (0, 1), "flags": ("FFTW_MEASURE", "FFTW_DESTROY_INPUT"), "threads": threads}
        forward = pyfftw.FFTW(source, spectrum, **plan)
        backward = pyfftw.FFTW(spectrum, result, direction="FFTW_BACKWARD", **plan)
        table /= n * n

        def convolve():
            forward.execute()
            times_table(spectrum)
            backward.execute()
            return result

    last = [None]

    def run():
        source[:] = pressure
        began = time.perf_counter()
        last[0] = convolve()
        return {"seconds": time.perf_counter() - began}

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


def ratios(ours, peer, parts):
    """Peer over these parts of percoat, round by round."""
    return [run["seconds"] / sum(ours.runs[number][part] for part in parts) for number, run in peer.runs.items()]


def processor_ratio(ours, peer):
    """Processor time of a run, peer over percoat; a dash where the system does not tell."""
    ours_used, peer_used = (contender.used / len(contender.runs) for contender in (ours, peer))
    return f"{peer_used / ours_used:.2f}" if ours_used > 0 else "–"


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
    """A table; its rows are told as they come."""

    def __init__(self, title, header):
        self.lines = [f"\n{title}\n", "| " + " | ".join(header) + " |", "|" + "---|" * len(header)]

    def row(self, *cells):
        self.lines.append("| " + " | ".join(map(str, cells)) + " |")
        print(self.lines[-1], file=sys.stderr, flush=True)

    def done(self):
        print("\n".join(self.lines), flush=True)
        return self.lines


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
    first = ["case", "points", "threads", "peer"]
    last = ["peer s", "peer / percoat (range, rounds)", "target"]
    parts = ["setup, solve, readings s", *last, "processor time", "convolutions", "solve over them"]
    whole = Sheet(f"Whole run, tolerance {options.tolerance:g}", [*first, "percoat s", *parts])
    judged = ["gap, penetration, load error: percoat", "peer", "processors: percoat, peer"]
    solve = Sheet(f"Solve, tolerance {options.tolerance:g}", [*first, "percoat s", "setup s", *last, *judged])
    for case in options.cases:
        for n in options.points:
            with tempfile.TemporaryDirectory() as folder:
                path = f"{folder}/heights.npy"
                heights, mean_pressure = surface(peer, case, n, path)
                arguments = [path, mean_pressure, options.tolerance]
                for threads in options.threads:
                    ours = Contender("percoat", [peer, "solve", case, n, options.tolerance, threads], threads)
                    others = [best_aspher(python, arguments, threads)] if "ASPHER" in options.peers else []
                    if "Tamaas" in options.peers and threads == 1:  # its package has no more
                        others.append(Contender("Tamaas", worker(python, "tamaas", *arguments, threads), threads))
                    others = [other for other in others if other]
                    take_turns([ours, *others], options.rounds, options.budget)
                    errors = judge(heights, mean_pressure, ours.field())
                    for other in others:
                        its = judge(heights, mean_pressure, other.field())
                        name = other.name + (f" ({other.variant})" if hasattr(other, "variant") else "")
                        row = [f"{case}, {100 * errors[3]:.1f} %", n, threads, name]
                        setup, seconds, readings = (f"{median(ours.runs, part):.3f}" for part in WHOLE)
                        if other.name == "ASPHER":
                            values = ratios(ours, other, WHOLE)
                            total = statistics.median(sum(run[part] for part in WHOLE) for run in ours.runs.values())
                            over = [run["seconds"] / (2 * run["convolutions"] * run["single"]) for run in ours.runs.values()]
                            whole.row(
                                *row, f"{total:.3f}", f"{setup}, {seconds}, {readings}", f"{median(other.runs):.3f}",
                                spread(values), verdict("whole run", values), processor_ratio(ours, other),
                                f"{median(ours.runs, 'convolutions'):.1f}", f"{statistics.median(over):.2f}",
                            )  # fmt: skip
                        values = ratios(ours, other, ["setup", "seconds"] if other.name == "ASPHER" else ["seconds"])
                        worse = "" if its[0] <= errors[0] else f", worse {its[0] / errors[0]:.1f}×"
                        failed = "" if all(run["converged"] for run in other.runs.values()) else ", not converged"
                        solve.row(
                            *row, seconds, setup, f"{median(other.runs):.3f}", spread(values), verdict(other.name, values),
                            "{:.0e}, {:.0e}, {:.0e}".format(*errors), "{:.0e}, {:.0e}, {:.0e}".format(*its) + worse + failed,
                            f"{ours.processors():.1f}, {other.processors():.1f}",
                        )  # fmt: skip
                    for contender in [ours, *others]:
                        contender.end()
    return whole.done() + solve.done()


def convolutions(options, peer, python):
    import numpy as np

    header = ["points", "threads", "precision", "peer", "percoat ms", "peer ms", "peer / percoat (range, rounds)", "target"]
    header += ["processor time", "difference", "processors: percoat, peer"]
    sheet = Sheet("One convolution", header)
    limits = {"MKL_ENABLE_INSTRUCTIONS": "AVX2"} if options.avx2 else {}
    for n, threads, precision in itertools.product(options.convolutions, options.threads, ["double", "single"]):
        what = [precision, n, threads]
        ours, *others = (Contender(name, [peer, "convolution", name, *what], threads) for name in ["percoat", "library"])
        for name in ["MKL", "SciPy", "FFTW"]:
            others.append(Contender(name, worker(python, "convolution", name, *what), threads, limits))
        take_turns([ours, *others], 5 * options.rounds, options.budget)
        field = ours.field()
        for other in others:
            values = ratios(ours, other, ["seconds"])
            difference = np.abs(other.field() - field).max() / np.abs(field).max()
            milliseconds = [f"{1e3 * median(contender.runs):.2f}" for contender in (ours, other)]
            processors = f"{ours.processors():.1f}, {other.processors():.1f}"
            result = spread(values), verdict(other.name, values), processor_ratio(ours, other)
            sheet.row(n, threads, precision, other.name, *milliseconds, *result, f"{difference:.0e}", processors)
        for contender in [ours, *others]:
            contender.end()
    return sheet.done()


def machine(avx2):
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
        f"{datetime.date.today()}, {cpu}, {os.cpu_count()} processors, load {os.getloadavg()[0]:.1f} before the run"
        + (", no AVX-512 in percoat and MKL" if avx2 else ""),
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
    parser.add_argument("--avx2", action="store_true", help="percoat and MKL without AVX-512")
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--output", type=Path)
    options = parser.parse_args()
    if options.quick:
        options.points, options.convolutions, options.threads, options.rounds = [1024], [1024], [2], 3
    python = prepare(options.venv.resolve())
    if Path(sys.prefix).resolve() != options.venv.resolve():
        os.execv(python, [str(python), *sys.argv])
    peer = build(options.avx2)
    head = machine(options.avx2)
    print("\n".join(head), flush=True)
    if os.getloadavg()[0] > 0.5:
        print("others use this machine: with two threads contenders that spin lose more than their share", flush=True)
    lines = []
    for run in (solves, convolutions):
        if options.only in (None, run.__name__[:-1]):
            lines += run(options, peer, python)
    if options.output:
        options.output.write_text("\n".join([*head, *lines]) + "\n")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--worker"]:
        {"aspher": aspher, "tamaas": tamaas, "convolution": convolution}[sys.argv[2]](*sys.argv[3:])
    else:
        main()
