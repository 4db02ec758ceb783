"""The combinations of a sweep as the tasks of an executor: processes, a Dask cluster, MPI."""

from __future__ import annotations

from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, as_completed
from typing import Any, Callable, Optional

from percoat import _core

OTHER = (
    "it was solved from another case: a file that the case names differs between here and there, or the version of percoat does"
)
"""The reason of a combination whose case is another one where it was solved."""


def solve_on(
    executor: Executor, sweep: _core.Sweep, threads: Optional[int], done: Callable[[_core.Row], object]
) -> list[_core.Row]:
    """The rows of all combinations, each a task with so many threads; ``done`` receives each as its task ends."""
    if threads is not None and threads < 1:
        raise _core.CaseError(f"threads must be at least 1, not {threads}")
    prints = sweep.check()
    rows: list[_core.Row] = []
    tasks: dict[Future[_core.Row], int] = {}

    def add(row: _core.Row) -> None:
        rows.append(row)
        done(row)

    try:
        for index, fingerprint in enumerate(prints):
            try:
                tasks[executor.submit(solve_part, sweep.part(index), threads or 1)] = index
            except BrokenExecutor as broken:
                add(sweep.failed(index, fingerprint, _reason(broken)))
        for task in as_completed(tasks):
            index = tasks.pop(task)
            add(_row(task, sweep, index, prints[index]))
    except BaseException:
        for task in tasks:
            task.cancel()
        raise
    return rows


def solve_part(part: _core.Sweep, threads: int) -> _core.Row:
    """The row of one combination: the work of a task."""
    return part.solve_first(threads)


def _row(task: Future[_core.Row], sweep: _core.Sweep, index: int, fingerprint: str) -> _core.Row:
    """The row of a task that has ended, however it did."""
    try:
        error = task.exception()
    except CancelledError as cancelled:
        error = cancelled
    if error is not None:
        return sweep.failed(index, fingerprint, _reason(error))
    row = task.result()
    if row.status != "failed" and row.fingerprint != fingerprint:
        return sweep.failed(index, fingerprint, OTHER)
    return row


def _reason(error: BaseException) -> str:
    """The error of a task, on one line."""
    told = " ".join(str(error).split())
    kind = type(error).__name__
    return f"its task ended without a result: {kind}: {told}" if told else f"its task ended without a result: {kind}"
