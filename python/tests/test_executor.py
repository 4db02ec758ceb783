"""Sweeps on executors: the table is that of a sweep without one, bit for bit, and failures are rows."""

from __future__ import annotations

import multiprocessing
import os
import pickle
import signal
import threading
from concurrent.futures import BrokenExecutor, Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable, Iterator

import numpy as np
import pytest

import percoat
from conftest import wave
from percoat import _executor
from test_topographies import SIZES, Topography, heights
from test_topographies import case as topography

SETTINGS: dict[str, Any] = {
    "grid.points": [32, 48],
    "layers.0.thickness": [0.1, 0.4],
    # The lower load touches no third level: cells without a value.
    "load": {"mean_pressure": [0.0005, 0.05]},
}


def equal(ours: percoat.Columns, theirs: percoat.Columns) -> None:
    assert list(ours) == list(theirs)
    for name in ours:
        column, other = ours[name], theirs[name]
        assert column.dtype == other.dtype and column.shape == other.shape, name
        if column.dtype == object:
            assert column.tolist() == other.tolist(), name
        else:
            assert column.tobytes() == other.tobytes(), name


def processes(kind: str) -> Callable[[], Executor]:
    return lambda: ProcessPoolExecutor(2, mp_context=multiprocessing.get_context(kind))


@contextmanager
def dask() -> Iterator[Executor]:
    distributed = pytest.importorskip("distributed", reason="dask.distributed is not installed")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as cluster, distributed.Client(cluster) as client:
        yield client.get_executor()


POOLS: dict[str, Callable[[], Any]] = {
    "threads": lambda: ThreadPoolExecutor(3),
    **{kind: processes(kind) for kind in multiprocessing.get_all_start_methods()},
    "dask": dask,
}


@pytest.fixture(scope="module")
def serial() -> percoat.Columns:
    return percoat.sweep("fig2", SETTINGS)


@pytest.mark.filterwarnings("default")  # of others: Dask, and forks of a process with threads
@pytest.mark.parametrize("pool", POOLS)
def test_the_table_is_that_of_a_sweep_without_executor(pool: str, serial: percoat.Columns) -> None:
    rows: list[dict[str, Any]] = []
    heard: list[percoat.Progress] = []
    with POOLS[pool]() as executor:
        table = percoat.sweep("fig2", SETTINGS, executor=executor, on_row=rows.append, progress=heard.append)
        # The executor is not shut down, and takes arrays and limits too.
        surfaces = {"substrate.poisson": [0.2, 0.3]}
        equal(percoat.sweep(wave(), surfaces), percoat.sweep(wave(), surfaces, executor=executor))
    equal(serial, table)
    assert [progress.done for progress in heard] == [1, 2, 3, 4] and {progress.of for progress in heard} == {4}
    rows.sort(key=lambda row: (row["combination"], row["step"]))
    assert [row["penetration"] for row in rows] == serial["penetration"].tolist()
    assert [row["set_grid_points"] for row in rows] == [32] * 4 + [48] * 4
    assert rows[0]["levels_3_radius_min"] is None


def test_limits_and_numbers_in_their_types_reach_the_tasks() -> None:
    case = percoat.case("fig2", set={"grid.points": 32})
    # Numbers that are set for all combinations travel as they are, and paths relative to the folder here.
    values = {"substrate.yield_strength": [0.1, 0.2], "solver.tolerance": 2e-7, "layers.0.poisson": 0.1 + 0.2}
    serial = percoat.sweep(case, values, limit=True)
    with ThreadPoolExecutor(2) as executor:
        equal(serial, percoat.sweep(case, values, limit=True, executor=executor))


def test_files_are_found_from_another_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    heights = wave()["surface"]["heights"]
    np.save(tmp_path / "own.npy", heights)
    text = (
        '[surface]\nheights = "own.npy"\nperiod = [2.0, 0.5]\n[substrate]\nyoung = 1.0\npoisson = 0.3\n'
        "[load]\nmean_pressure = 0.02\n"
    )
    (tmp_path / "own.toml").write_text(text, "utf-8")
    monkeypatch.chdir(tmp_path)
    sweep = percoat._core.Sweep("own.toml", {"substrate.poisson": [0.2, 0.3]})
    kept, fingerprint = pickle.dumps(sweep.part(1)), sweep.check()[1]
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    row = pickle.loads(kept).solve_first(1)
    assert row.status == "done" and row.combination == 2 and row.fingerprint == fingerprint
    # A surface that changes under way is another case.
    np.save(tmp_path / "own.npy", 2.0 * heights)
    assert pickle.loads(kept).solve_first(1).fingerprint != row.fingerprint


def test_topographies_with_sizes_reach_processes() -> None:
    case, values = topography(Topography(heights(), SIZES, "µm"), cutoff=2e3), {"substrate.poisson": [0.2, 0.3]}
    serial = percoat.sweep(case, values)
    with processes("spawn")() as executor:
        equal(serial, percoat.sweep(case, values, executor=executor))


def test_rows_and_combinations_pickle_bit_for_bit() -> None:
    sweep = percoat._core.Sweep("fig2", SETTINGS)
    for index in range(len(sweep)):
        row = sweep.part(index).solve_first(1)
        again = pickle.loads(pickle.dumps(row))
        assert again.lines() == row.lines() and again.fingerprint == row.fingerprint
        assert again.name == row.name and again.status == row.status and again.warnings == row.warnings


class Broken(Executor):
    """Ends each task as it is told: by its result, or an error."""

    def __init__(self, ends: "list[BaseException | None]") -> None:
        self.ends, self.shut = ends, False

    def submit(self, work: Callable[..., Any], /, *given: Any, **named: Any) -> "Future[Any]":
        end, future = self.ends.pop(0), Future[Any]()
        if isinstance(end, BaseException):
            future.set_exception(end)
        else:
            future.set_result(work(*given, **named))
        return future

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        self.shut = True


def test_a_task_that_raises_is_a_row() -> None:
    values = {"grid.points": 32, "layers.0.thickness": [0.1, 0.2, 0.4]}
    executor = Broken([None, MemoryError(), RuntimeError("two\nlines")])
    with pytest.warns(percoat.PercoatWarning, match="failed: its task ended without a result"):
        table = percoat.sweep("fig2", values, executor=executor)
    assert not executor.shut
    assert table["status"].tolist() == ["done", "failed", "failed"]
    assert table["reason"].tolist() == [
        "",
        "its task ended without a result: MemoryError",
        "its task ended without a result: RuntimeError: two lines",
    ]
    assert table["set_layers_0_thickness"].tolist() == [0.1, 0.2, 0.4]
    whole = percoat.sweep("fig2", values)
    assert table["penetration"][0] == whole["penetration"][0] and np.isnan(table["penetration"][1:]).all()


@pytest.mark.skipif(os.name == "nt", reason="no process is killed by a signal")
def test_combinations_of_a_worker_that_is_killed_are_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(_executor, "solve_part", killed)
    with processes("spawn")() as executor:
        with pytest.warns(percoat.PercoatWarning, match="failed: .*BrokenProcessPool"):
            table = percoat.sweep("fig2", {"grid.points": [32, 48, 64]}, executor=executor)
        # An executor that takes nothing at all is an error.
        with pytest.raises(BrokenExecutor):
            percoat.sweep("fig2", {"grid.points": [32, 48, 64]}, executor=executor)
    assert set(table["status"]) == {"failed"} and table["combination"].tolist() == [1, 2, 3]


def killed(part: Any, threads: int) -> None:
    os.kill(os.getpid(), signal.SIGKILL)


MANY: "dict[str, Any]" = {"grid.points": 32, "layers.0.thickness": "0.1:0.5:20"}


@pytest.mark.parametrize("where", ["on_row", "another thread"])
def test_tasks_that_a_shutdown_cancels_are_rows(where: str) -> None:
    def stop(row: dict[str, Any]) -> None:
        shut = lambda: executor.shutdown(wait=False, cancel_futures=True)  # noqa: E731
        if row["status"] == "done" and where == "on_row":
            shut()
        elif row["status"] == "done":
            threading.Thread(target=shut).start()

    with ThreadPoolExecutor(1) as executor:
        with pytest.warns(percoat.PercoatWarning, match="failed"):
            table = percoat.sweep("fig2", MANY, executor=executor, on_row=stop)
    assert table["combination"].tolist() == list(range(1, 21))
    failed = table["status"] == "failed"
    assert table["status"][0] == "done" and failed[-1] and set(table["status"]) == {"done", "failed"}
    for reason in table["reason"][failed]:
        assert "CancelledError" in reason or "the executor did not take its task: RuntimeError" in reason, reason


def test_rows_are_there_before_all_tasks_are_and_stay_when_the_executor_ends() -> None:
    class Ending(Broken):
        def submit(self, *given: Any, **named: Any) -> "Future[Any]":
            order.append("task")
            if len(self.ends) == 1:
                raise RuntimeError("cannot schedule new futures after shutdown")
            return super().submit(*given, **named)

    order: list[str] = []
    values = {"grid.points": 32, "layers.0.thickness": [0.1, 0.2, 0.4]}
    with pytest.warns(percoat.PercoatWarning, match="failed: the executor did not take its task: RuntimeError"):
        table = percoat.sweep("fig2", values, executor=Ending([None] * 3), on_row=lambda row: order.append("row"))
    assert order == ["task", "row"] * 3
    assert table["status"].tolist() == ["done", "done", "failed"]
    with ThreadPoolExecutor(1) as executor:
        pass
    with pytest.raises(RuntimeError, match="after shutdown"):
        percoat.sweep("fig2", values, executor=executor)


@pytest.mark.parametrize("where", ["here", "there"])
def test_more_threads_than_there_may_be_are_an_error(where: str) -> None:
    with ThreadPoolExecutor(2) as executor:
        with pytest.raises(percoat.CaseError, match="threads must be between 1 and"):
            percoat.sweep("fig2", MANY, threads=100_000, executor=executor if where == "there" else None)


def test_a_combination_that_is_refused_is_a_row_and_all_are_an_error() -> None:
    values = {"grid.points": [32, 11], "layers.0.thickness": [0.1, 0.4]}
    with ThreadPoolExecutor(2) as executor:
        with pytest.warns(percoat.PercoatWarning, match="failed: .*grid.points"):
            table = percoat.sweep("fig2", values, executor=executor)
        with pytest.warns(percoat.PercoatWarning, match="failed"):
            equal(percoat.sweep("fig2", values), table)
        with pytest.raises(percoat.CaseError, match="grid.points"):
            percoat.sweep("fig2", {"grid.points": [11, 13]}, executor=executor)
        with pytest.raises(percoat.CaseError, match="threads must be at least 1"):
            percoat.sweep("fig2", values, executor=executor, threads=0)
    with pytest.raises(TypeError, match="get_executor"):
        percoat.sweep("fig2", values, executor="processes")  # type: ignore[arg-type]


@pytest.mark.parametrize("where", ["here", "there"])
def test_an_error_of_the_callable_ends_the_sweep(where: str) -> None:
    def stop(row: dict[str, Any]) -> None:
        begun.append(row["combination"])
        raise KeyboardInterrupt

    begun: list[int] = []
    values = {"grid.points": 32, "layers.0.thickness": "0.1:0.5:40"}
    tasks: list[Future[Any]] = []

    class Watched(ThreadPoolExecutor):
        def submit(self, *given: Any, **named: Any) -> "Future[Any]":
            tasks.append(super().submit(*given, **named))
            return tasks[-1]

    with Watched(1) as executor:
        with pytest.raises(KeyboardInterrupt):
            percoat.sweep("fig2", values, on_row=stop, executor=executor if where == "there" else None)
    assert len(begun) == 1
    # Without cancelling, the executor would have ended all of its tasks.
    # With rows taken between submissions, fewer may have been submitted at all.
    assert where == "here" or sum(task.done() and not task.cancelled() for task in tasks) < 20


def test_rows_arrive_one_by_one_and_in_this_thread(tmp_path: Path) -> None:
    rows: list[dict[str, Any]] = []
    threads = set()

    def keep(row: dict[str, Any]) -> None:
        threads.add(threading.current_thread())
        rows.append(row)

    table = percoat.sweep("fig2", {"grid.points": 32, "layers.0.thickness": [0.1, 0.4]}, on_row=keep)
    assert threads == {threading.current_thread()}
    rows.sort(key=lambda row: row["combination"])
    for number, row in enumerate(rows):
        for name, cell in row.items():
            entry = table[name][number]
            assert entry == cell or (cell is None and (entry != entry or entry in ("", None))), name


def test_tasks_of_threads_solve_side_by_side() -> None:
    # Each has a thread of its own: the second is done before the first, which has far more to do.
    order: list[int] = []
    with ThreadPoolExecutor(2) as executor:
        values = {"grid.points": [192, 32], "layers.0.thickness": 0.4}
        percoat.sweep("fig2", values, executor=executor, on_row=lambda row: order.append(row["combination"]))
    assert order == [2, 1]
