"""The combinations of a sweep as the tasks of an executor: processes, a Dask cluster, MPI."""

from __future__ import annotations

from concurrent.futures import CancelledError, Executor, Future
from queue import SimpleQueue
from typing import Callable, Optional

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
    # A task that is cancelled calls back, but does not wake as_completed.
    ended: SimpleQueue[Future[_core.Row]] = SimpleQueue()

    def add(row: _core.Row) -> None:
        rows.append(row)
        done(row)

    def take() -> None:
        task = ended.get()
        index = tasks.pop(task)
        add(_row(task, sweep, index, prints[index], raises=not rows))

    try:
        for index, fingerprint in enumerate(prints):
            part = sweep.part(index)
            try:
                task = executor.submit(solve_part, part, threads or 1)
            except Exception as refusal:
                if not tasks and not rows:
                    raise
                add(sweep.failed(index, fingerprint, _reason("the executor did not take its task", refusal)))
                continue
            tasks[task] = index
            task.add_done_callback(ended.put)
            while not ended.empty():
                take()
        while tasks:
            take()
    except BaseException:
        for task in tasks:
            task.cancel()
        raise
    return rows


def solve_part(part: _core.Sweep, threads: int) -> _core.Row:
    """The row of one combination: the work of a task."""
    return part.solve_first(threads)


def _row(
    task: Future[_core.Row], sweep: _core.Sweep, index: int, fingerprint: str, raises: bool
) -> _core.Row:
    """The row of a task that has ended, however it did; one that is refused, as for too many threads, ``raises`` instead."""
    try:
        error = task.exception()
    except CancelledError as cancelled:
        error = cancelled
    if raises and isinstance(error, _core.CaseError):
        raise error
    if error is not None:
        return sweep.failed(index, fingerprint, _reason("its task ended without a result", error))
    row = task.result()
    if row.status != "failed" and row.fingerprint != fingerprint:
        return sweep.failed(index, fingerprint, OTHER)
    return row


def _reason(what: str, error: BaseException) -> str:
    """Text of an error on one line, after the words `what`."""
    message = " ".join(str(error).split())
    return ": ".join(filter(None, [what, type(error).__name__, message]))
