"""Threads and processes: how many there are, and who asks, makes no difference."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import signal
import threading
import time
import warnings
from typing import Any, Callable

import numpy as np
import pytest

import percoat

SETTINGS = {"grid.points": 64, "load.mean_pressure": [0.01, 0.06]}
CASES: dict[str, dict[str, Any]] = {
    "fig2": SETTINGS,
    "dlc-on-steel": {"grid.points": 64, "load.mean_pressure": [0.1]},
    "rough": {"grid.points": 64, "surface.random.shortest": 5.0, "load.mean_pressure": [0.1]},
}


def prints(result: percoat.Result) -> list[bytes]:
    """Every bit of the fields, and of the stresses under them."""
    step = result[-1]
    inside = [step.stress([[0.1, 0.2, 0.3], [0.0, 0.0, 0.7]]), step.plane(0.3).mises]
    fields = [getattr(step, name) for step in result for name in ("pressure", "gap", "displacement")]
    return [array.tobytes() for array in (*fields, *inside)]


@pytest.fixture(scope="module")
def expected() -> list[bytes]:
    return prints(percoat.solve("fig2", set=SETTINGS))


@pytest.mark.parametrize("name", list(CASES))
def test_results_do_not_depend_on_threads(name: str) -> None:
    all_cores = percoat.solve(name, set=CASES[name])
    for threads in (1, 2, 3, np.int64(2), 1, None):
        result = percoat.solve(name, set=CASES[name], threads=threads)
        assert prints(result) == prints(all_cores), threads
        ours, theirs = result.to_dict()["steps"], all_cores.to_dict()["steps"]
        for step in (*ours, *theirs):
            del step["seconds"]
        assert ours == theirs, threads


def test_limits_and_checks_do_not_depend_on_threads() -> None:
    settings = {"grid.points": 48, "load.mean_pressure": 0.05, "layers": [], "friction.coefficient": 0.0}
    limits = [percoat.limit("dlc-on-steel", set=settings, threads=threads).to_dict() for threads in (1, 3)]
    for limit in limits:
        for step in limit["steps"]:
            del step["seconds"]
    assert limits[0] == limits[1]
    checks = [percoat.check("fig2", set={"grid.points": 96}, threads=threads) for threads in (1, 2)]
    assert checks[0].first_touch == checks[1].first_touch


def test_as_many_threads_as_asked_for_work() -> None:
    # Processor time over wall time is at most their number.
    for threads, most in ((1, 1.2), (2, 2.2)):
        began, before = time.monotonic(), sum(os.times()[:2])
        percoat.solve("fig2", set={"grid.points": 1024}, threads=threads)
        assert (sum(os.times()[:2]) - before) / (time.monotonic() - began) < most


def test_threads_do_not_pile_up() -> None:
    if not os.path.isdir("/proc/self/task"):
        pytest.skip("threads are counted under Linux")

    def alive() -> int:
        return len(os.listdir("/proc/self/task"))

    for threads in (1, 2, 3):
        percoat.solve("fig2", set=SETTINGS, threads=threads)
    before = alive()
    for threads in (1, 2, 3, 4, 5) * 4:
        percoat.solve("fig2", set=SETTINGS, threads=threads)
    # Threads asked for last are kept, and with them those of all cores; others end, if not in the same moment.
    ends = time.monotonic() + 2.0
    while alive() > before + 5 and time.monotonic() < ends:
        time.sleep(0.02)
    assert alive() <= before + 5


@pytest.mark.parametrize("variable", ["5000", "99999999999999999999", "1"])
def test_the_environment_does_not_ask_for_too_many(python: Callable[..., Any], variable: str) -> None:
    text = """
import os, percoat
percoat.check("fig2", set={"grid.points": 48})
print(len(os.listdir("/proc/self/task")) if os.path.isdir("/proc/self/task") else 0)
"""
    most = 4 * (os.cpu_count() or 1) + 4
    assert int(python(text, RAYON_NUM_THREADS=variable, OPENBLAS_NUM_THREADS="1").stdout) <= most


@pytest.mark.parametrize("variable", ["many", "-1", "2.5", "1e3"])
def test_an_environment_without_a_number_is_refused(python: Callable[..., Any], variable: str) -> None:
    text = """
import percoat
try:
    percoat.check("fig2", set={"grid.points": 48})
except percoat.CaseError as error:
    print(error)
"""
    assert python(text, RAYON_NUM_THREADS=variable).stdout.startswith("RAYON_NUM_THREADS")


def test_several_threads_solve_at_once(expected: list[bytes]) -> None:
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        solving = [pool.submit(percoat.solve, "fig2", set=SETTINGS, threads=n) for n in (1, 2, None, 3) * 4]
        assert all(prints(future.result(timeout=30.0)) == expected for future in solving)


def test_several_threads_hear_their_own_progress() -> None:
    def solve(points: int) -> tuple[int, set[Any], set[int]]:
        grids, thread = set(), set()

        def listener(progress: percoat.Progress) -> None:
            grids.add(progress.points)
            thread.add(threading.get_ident())

        percoat.solve("fig2", set={"grid.points": points}, progress=listener)
        return threading.get_ident(), grids, thread

    with concurrent.futures.ThreadPoolExecutor(3) as pool:
        sizes = (48, 64, 72) * 3
        for size, (caller, grids, thread) in zip(sizes, pool.map(solve, sizes)):
            assert grids == {(size, size)} and thread == {caller}


def test_several_threads_ask_one_step(expected: list[bytes]) -> None:
    result = percoat.solve("fig2", set=SETTINGS)
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        asked = [pool.submit(prints, result) for _ in range(8)]
        assert all(future.result(timeout=30.0) == expected for future in asked)


# Forked children of a process with threads are what Python itself warns of since 3.12.
pytestmark = pytest.mark.filterwarnings("ignore::DeprecationWarning")
forks = pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")


def in_child(work: Callable[[], Any], timeout: float = 20.0) -> Any:
    """Answer of a forked child; it is killed when it takes too long."""
    receive, send = multiprocessing.Pipe(duplex=False)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)
        child = os.fork()
    if child == 0:
        try:
            warnings.simplefilter("ignore")
            send.send(work())
        finally:
            os._exit(0)
    send.close()
    try:
        assert receive.poll(timeout), "the child hangs"
        return receive.recv()
    finally:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)


@forks
@pytest.mark.parametrize("threads", [None, 1, 2])
def test_a_forked_child_solves(expected: list[bytes], threads: Any) -> None:
    assert prints(percoat.solve("fig2", set=SETTINGS, threads=threads)) == expected
    assert in_child(lambda: prints(percoat.solve("fig2", set=SETTINGS, threads=threads))) == expected
    assert prints(percoat.solve("fig2", set=SETTINGS, threads=threads)) == expected


@forks
def test_a_forked_child_asks_what_its_parent_solved(expected: list[bytes]) -> None:
    result = percoat.solve("fig2", set=SETTINGS)
    assert in_child(lambda: prints(result)) == expected


@forks
def test_a_grandchild_solves(expected: list[bytes]) -> None:
    assert in_child(lambda: in_child(lambda: prints(percoat.solve("fig2", set=SETTINGS)))) == expected


@forks
def test_a_child_forked_during_a_solution_solves(expected: list[bytes]) -> None:
    begun, enough = threading.Event(), threading.Event()

    def listener(progress: percoat.Progress) -> None:
        begun.set()
        if enough.is_set():
            raise InterruptedError

    def long() -> None:
        with pytest.raises(InterruptedError):
            percoat.solve("fig5", set={"grid.points": 256}, progress=listener)

    thread = threading.Thread(target=long)
    thread.start()
    try:
        assert begun.wait(10.0)
        for _ in range(5):
            assert in_child(lambda: prints(percoat.solve("fig2", set=SETTINGS))) == expected
    finally:
        enough.set()
        thread.join()


def worker(points: int) -> tuple[int, bytes]:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return points, percoat.solve("fig2", set={"grid.points": points})[0].pressure.tobytes()


@pytest.mark.parametrize(
    "method", [method for method in ("fork", "spawn") if method in multiprocessing.get_all_start_methods()]
)
def test_a_pool_of_processes_solves(method: str) -> None:
    sizes = [48, 64, 72]
    expected = [worker(points) for points in sizes]
    with multiprocessing.get_context(method).Pool(2) as pool:
        assert pool.map_async(worker, sizes).get(timeout=30.0) == expected


def test_results_come_from_a_pool_of_processes(expected: list[bytes]) -> None:
    method = "fork" if "fork" in multiprocessing.get_all_start_methods() else "spawn"
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(method)) as pool:
        results = [pool.submit(percoat.solve, "fig2", set=SETTINGS) for _ in range(2)]
        for future in results:
            assert prints(future.result(timeout=30.0)) == expected
