"""Ctrl-C, and an error of who listens, end the work at once; the interpreter is free meanwhile."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from contextlib import contextmanager
from typing import Any, Callable, Iterator

import numpy as np
import pytest

import percoat
from conftest import environment

pytestmark = pytest.mark.skipif(os.name == "nt", reason="signals are those of POSIX")

# Each would take ten seconds and more on two cores.
LONG: dict[str, Callable[..., object]] = {
    "solve": lambda **more: percoat.solve("fig5", set={"grid.points": 512}, **more),
    "a single large step": lambda **more: percoat.solve(
        "fig3a", set={"grid.points": 2048, "solver.tolerance": 1e-14}, **more
    ),
    "a rough surface": lambda **more: percoat.solve("rough", set={"grid.points": 1024}, **more),
    "limit": lambda **more: percoat.limit("dlc-on-steel", set={"grid.points": 384}, **more),
    "sweep": lambda **more: percoat.sweep(
        "fig5", {"grid.points": 256, "layers.0.thickness": "0.1:1:20"}, **more
    ),
    "sweep of small ones": lambda **more: percoat.sweep(
        "fig2", {"grid.points": 64, "layers.0.thickness": "0.1:1:5000"}, **more
    ),
    "sweep of limits": lambda **more: percoat.sweep(
        "dlc-on-steel", {"grid.points": 128, "layers.0.thickness": "1:2:30"}, limit=True, **more
    ),
}

# Between two looks for Ctrl-C lie 50 ms, in which every core computes. Processor time, which does not pass while others have
# the cores.
AT_ONCE = 0.5 * (os.cpu_count() or 1)
# Processor time until a program has begun: imports, and the first load.
BEGUN = 5.0
# Processor time that an iteration, or what else goes on between two looks, may take.
SOON = 1.5 * (os.cpu_count() or 1)


def used() -> float:
    """Processor time of this process so far, all threads."""
    times = os.times()
    return times.user + times.system


@contextmanager
def interrupted(begun: Callable[[], bool]) -> Iterator[list[float]]:
    """SIGINT for this process once the work has begun; holds the processor time used until then."""
    sent: list[float] = []
    ends = threading.Event()

    def send() -> None:
        while not begun():
            if ends.wait(0.001):
                return
        sent.append(used())
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=send)
    thread.start()
    try:
        yield sent
    finally:
        ends.set()
        thread.join()


@pytest.fixture(autouse=True)
def as_from_a_terminal() -> Iterator[None]:
    """Ctrl-C raises, though whoever runs the tests, a shell in the background, may have it ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def of_children() -> float:
    """Processor time of the processes that were started and have ended."""
    times = os.times()
    return times.children_user + times.children_system


def falls_idle(within: float) -> bool:
    """Whether the process stops computing before it has used so much processor time: less than a tenth of one core for a
    fifth of a second."""
    ends = used() + within
    while used() < ends:
        before = used()
        time.sleep(0.2)
        if used() - before <= 0.02:
            return True
    return False


@pytest.fixture(scope="module")
def expected() -> Any:
    return percoat.solve("fig2", set={"grid.points": 48})[0].pressure.copy()


@pytest.mark.parametrize("name", list(LONG))
@pytest.mark.parametrize("listens", [False, True], ids=["", "with progress"])
def test_ctrl_c_ends_the_work_at_once(name: str, listens: bool, expected: Any) -> None:
    heard: list[percoat.Progress] = []
    more: dict[str, Any] = {"progress": heard.append} if listens else {}
    start = used()
    # Without a listener: a hundredth of what the work would take.
    with interrupted(lambda: bool(heard) if listens else used() - start > 0.2) as sent:
        with pytest.raises(KeyboardInterrupt):
            LONG[name](**more)
        raised = used()
    assert sent and raised - sent[0] < AT_ONCE
    assert falls_idle(SOON), "the work goes on though nobody waits for it"
    again = percoat.solve("fig2", set={"grid.points": 48})[0]
    assert np.array_equal(again.pressure, expected)


def test_ctrl_c_ends_a_program() -> None:
    # As a terminal sends it, with the handler that Python itself has.
    before = of_children()
    text = """
import percoat, signal
signal.signal(signal.SIGINT, signal.default_int_handler)
def begun(progress):
    print("begun", flush=True)
percoat.solve("fig5", set={"grid.points": 512}, progress=begun)
"""
    started = subprocess.Popen(
        [sys.executable, "-c", text],
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
    )
    assert started.stdout is not None
    try:
        assert started.stdout.readline() == "begun\n"
        started.send_signal(signal.SIGINT)
        _, told = started.communicate(timeout=20.0)
    finally:
        started.kill()
        started.wait()
    # As Python ends after an interruption that nobody catches.
    assert started.returncode == -signal.SIGINT and "KeyboardInterrupt" in told
    assert of_children() - before < BEGUN + AT_ONCE


def test_ctrl_c_ends_the_command_line(tmp_path: Any) -> None:
    before = of_children()
    words = ["solve", "fig5", "--set", "grid.points=512", "-o", str(tmp_path / "out")]
    started = subprocess.Popen(
        [sys.executable, "-m", "percoat", *words],
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        encoding="utf-8",
        # Whoever runs the tests may have it ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    )
    try:
        ends = time.monotonic() + 20.0
        while not list(tmp_path.rglob("steps.jsonl")) and time.monotonic() < ends:
            time.sleep(0.02)
        started.send_signal(signal.SIGINT)
        started.communicate(timeout=20.0)
    finally:
        started.kill()
        started.wait()
    # As the program without Python: it says 130 or ends by the signal, and leaves what can be gone on from.
    assert started.returncode in (130, -signal.SIGINT) and of_children() - before < BEGUN + AT_ONCE
    assert list(tmp_path.rglob("steps.jsonl"))


WITHOUT_ITERATIONS = {
    "compare": 'percoat.compare("fig2", set={"grid.points": 512})',
    "refine": 'percoat.compare("fig2", set={"grid.accuracy": 1e-6})',
    "stress": "step.stress(np.random.default_rng(1).uniform(0.0, 0.4, (10_000, 3)))",
    "maxima": "step.maxima()",
    "check": 'percoat.check("fig5", set={"grid.points": 2048})',
}


@pytest.mark.parametrize("name", list(WITHOUT_ITERATIONS))
def test_ctrl_c_ends_what_has_no_iterations(name: str) -> None:
    # In a process of its own, which ends with it: what went on would slow the tests that follow.
    text = f"""
import os, signal, threading, time, warnings
import numpy as np
import percoat

warnings.simplefilter("ignore")
signal.signal(signal.SIGINT, signal.default_int_handler)
step = percoat.solve("fig2", set={{"grid.points": 1024}})[0]
threading.Timer(0.1, os.kill, (os.getpid(), signal.SIGINT)).start()
try:
    {WITHOUT_ITERATIONS[name]}
    time.sleep({SOON})
    print("ended")
except KeyboardInterrupt:
    print("interrupted")
ends = sum(os.times()[:2]) + {SOON}
while sum(os.times()[:2]) < ends:
    before = sum(os.times()[:2])
    time.sleep(0.2)
    if sum(os.times()[:2]) - before <= 0.02:
        print("idle")
        break
os._exit(0)
"""
    ended = subprocess.run(
        [sys.executable, "-uc", text],
        env=environment(),
        capture_output=True,
        encoding="utf-8",
        timeout=60,
        check=True,
    )
    assert ended.stdout.split() == ["interrupted", "idle"], ended.stderr


class Enough(Exception):
    """Exception that the listener raises."""


# The listener of a sweep is called when a combination is done, so that only a sweep of small combinations is tried.
@pytest.mark.parametrize(
    "name", ["solve", "a single large step", "a rough surface", "limit", "sweep of small ones"]
)
def test_an_error_of_the_listener_comes_through(name: str, expected: Any) -> None:
    heard: list[float] = []

    def listener(progress: percoat.Progress) -> None:
        heard.append(used())
        if len(heard) == 3:
            raise Enough(progress.phase)

    with pytest.raises(Enough):
        LONG[name](progress=listener)
    count = len(heard)
    assert used() - heard[-1] < AT_ONCE and falls_idle(SOON)
    assert len(heard) == count, "nobody is told any more"
    assert np.array_equal(percoat.solve("fig2", set={"grid.points": 48})[0].pressure, expected)


def test_the_listener_may_interrupt() -> None:
    def listener(progress: percoat.Progress) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        LONG["solve"](progress=listener)
    assert falls_idle(SOON)


def test_a_signal_handler_of_the_user_may_raise() -> None:
    def handler(*_: object) -> None:
        raise Enough

    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.3)
        with pytest.raises(Enough):
            LONG["solve"]()
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert falls_idle(SOON)


def test_a_signal_that_is_handled_does_not_end_the_work(expected: Any) -> None:
    heard: list[int] = []
    before = signal.signal(signal.SIGALRM, lambda number, _: heard.append(number))
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.02, 0.02)
        result = percoat.solve("fig2", set={"grid.points": 512, "load.mean_pressure": [0.02, 0.04, 0.06]})
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    assert len(result) == 3 and result.converged and heard


def test_other_threads_run_meanwhile() -> None:
    ticks: list[float] = []
    ends = threading.Event()

    def count() -> None:
        while not ends.is_set():
            ticks.append(time.monotonic())
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    try:
        began = time.monotonic()
        percoat.solve("fig2", set={"grid.points": 720, "load.mean_pressure": [0.02, 0.04, 0.06]})
        took = time.monotonic() - began
    finally:
        ends.set()
        thread.join()
    during = [tick for tick in ticks if began <= tick <= began + took]
    # Were the interpreter held, there would be one gap as long as the work.
    assert max(np.diff([began, *during, began + took])) < 0.5 * took


def progress_of(**more: Any) -> list[percoat.Progress]:
    heard: list[percoat.Progress] = []
    percoat.solve("fig2", progress=heard.append, **more)
    return heard


def test_progress_tells_how_far_it_is() -> None:
    heard = progress_of(set={"grid.points": 96, "load.mean_pressure": [0.02, 0.04, 0.06]})
    assert all(type(progress) is percoat.Progress for progress in heard)
    assert {progress.unit for progress in heard} == {"step"} and {progress.of for progress in heard} == {3}
    assert {progress.points for progress in heard} == {(96, 96)}
    assert [progress.done for progress in heard] == sorted(progress.done for progress in heard)
    assert {progress.done for progress in heard} == {0, 1, 2, 3} and heard[-1].done == heard[-1].of
    assert [progress.seconds for progress in heard] == sorted(progress.seconds for progress in heard)
    assert heard[0].seconds >= 0.0
    for progress in heard:
        assert progress.iteration >= 0 and (progress.iteration == 0) == np.isnan(progress.residual)
        begins = "3 of 3 steps" if progress.done == 3 else f"step {progress.done + 1} of 3"
        assert str(progress).startswith(f"{begins}, 96 × 96 samples, ") and str(progress).endswith(" s")
        assert repr(progress) == f"<percoat.Progress: {progress}>" and progress.phase in str(progress)


def test_progress_of_grids_that_are_refined() -> None:
    heard = progress_of(set={"grid": {"accuracy": 0.002}})
    grids = list(dict.fromkeys(progress.points for progress in heard))
    assert len(grids) >= 2 and all(grid is not None for grid in grids)
    for grid in grids:
        done = [progress.done for progress in heard if progress.points == grid]
        assert done == sorted(done) and done[-1] == 1
    sizes = [progress.points[0] for progress in heard if progress.points is not None]
    assert sizes == sorted(sizes)


def test_progress_tells_of_iterations() -> None:
    heard = progress_of(set={"grid.points": 1024})  # one of which takes longer than it is silent, 50 ms
    iterating = [progress for progress in heard if progress.iteration]
    assert iterating
    assert all(progress.residual > 0.0 for progress in iterating)
    assert all(f"iteration {progress.iteration}, ε = " in progress.phase for progress in iterating)


def test_progress_prints(capsys: pytest.CaptureFixture[str]) -> None:
    percoat.solve("fig2", set={"grid.points": 48}, progress=print)
    told = capsys.readouterr()
    assert told.out.splitlines()[-1].startswith("1 of 1 steps, 48 × 48 samples, after mean pressure 0.06")
    assert not told.err
    percoat.solve("fig2", set={"grid.points": 48}, progress=True)
    told = capsys.readouterr()
    # Line by line, where nothing can be written over.
    assert not told.out and told.err.startswith("step 1 of 1, 48 × 48 samples") and "\r" not in told.err
    assert told.err.splitlines()[-1].startswith("1 of 1 steps")
    percoat.solve("fig2", set={"grid.points": 48}, progress=False)
    percoat.solve("fig2", set={"grid.points": 48}, progress=None)
    assert capsys.readouterr() == ("", "")


def test_progress_is_a_line_of_a_terminal(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys.stderr, "isatty", lambda: True)
    percoat.solve("fig2", set={"grid.points": 48}, progress=True)
    told = capsys.readouterr().err
    # Written over, and ended when all is done.
    assert told.startswith("\rstep 1 of 1, 48 × 48 samples") and told.count("\n") == 1 and told.endswith("\n")


def test_a_listener_may_solve_in_turn(expected: Any) -> None:
    found: list[Any] = []

    def listener(progress: percoat.Progress) -> None:
        if not found:
            found.append(percoat.solve("fig2", set={"grid.points": 48}, threads=1)[0].pressure)

    outer = percoat.solve("fig2", set={"grid.points": 48}, threads=1, progress=listener)
    assert np.array_equal(found[0], expected) and np.array_equal(outer[0].pressure, expected)
