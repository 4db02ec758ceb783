"""Sweeps: a case, solved for many settings of its keys."""

from __future__ import annotations

import re
from concurrent.futures import Executor
from os import PathLike
from time import monotonic
from typing import Any, Callable, Dict, Iterable, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import NDArray

from percoat import _core, _html
from percoat._case import CaseLike
from percoat._executor import solve_on
from percoat._solve import Listener, aside, listener
from percoat._warnings import NotConverged, warn


TEXTS = ("status", "reason", "warnings", "route", "criterion", "reached", "state", "rivals", "name")
"""How the columns of texts end; what they do not have is an empty one."""

ROWS, COLUMNS = 10, 12
"""Most rows and columns of a table that a notebook shows."""


Row = Dict[str, Any]
"""A row of the table as it is done: names with their cells, ``None`` where there is no value."""


Solved = Tuple[Dict[str, Any], List[_core.Row], float]
"""The description of a sweep, with its case as it was solved, its rows, and its wall time in seconds."""


class Columns(Dict[str, NDArray[Any]]):
    """The table of a sweep: arrays of equal length under their names, ready for ``pandas.DataFrame(columns)``."""

    @property
    def rows(self) -> int:
        """How many rows it has."""
        return len(next(iter(self.values()), ()))

    @property
    def uncertainty(self) -> Columns:
        """The uncertainty of every result, with ``vary``: the columns of ``uncertainty.csv``, one row a result; none without."""
        solved: Optional[Solved] = self.__dict__.get("_solved")
        columns = [] if solved is None else _core.uncertainty(solved[0], solved[1])
        return Columns({name: _column(name, cells) for name, cells in columns})

    def save(self, folder: Union[str, PathLike[str]]) -> None:
        """Write the output folder of ``percoat sweep --no-pictures``: ``sweep.csv``, ``sweep.json`` and ``sweep.jsonl``, and
        with ``vary`` ``uncertainty.csv``.

        What was solved is written, whatever has become of the columns and of the files of the case since. As on the command line only files are
        replaced that percoat wrote there as a finished result. ``percoat report folder`` makes a page of it.

        Raises
        ------
        CaseError, OSError
            As by :meth:`percoat.Result.save`.
        TypeError
            The columns are not those of a sweep.
        """
        solved: Optional[Solved] = self.__dict__.get("_solved")
        if solved is None:
            raise TypeError("these columns are not those that a sweep returned: write them with pandas.DataFrame(columns)")
        description, rows, wall = solved
        aside(_core.save_sweep(description, rows, wall, folder))

    def __reduce__(self) -> tuple[Any, ...]:
        return _columns, (dict(self), self.__dict__.get("_solved"))

    def __repr__(self) -> str:
        return f"<percoat.Columns: {self.rows} rows of {', '.join(list(self)[:8])}{', …' if len(self) > 8 else ''}>"

    def _repr_html_(self) -> str:
        shown = list(self)[:COLUMNS]
        more = ["…"] if len(self) > COLUMNS else []
        rows = [[_cell(self[name][row]) for name in shown] + more for row in range(min(self.rows, ROWS))]
        note = f"{self.rows} rows × {len(self)} columns" + (f", the first {ROWS} rows" if self.rows > ROWS else "")
        return _html.page("", [("", shown + more, rows, 0)], [note])


def sweep(
    case: CaseLike,
    set: Optional[Mapping[str, Any]] = None,
    *,
    vary: Optional[Mapping[str, Union[str, Tuple[float, float]]]] = None,
    samples: int = 128,
    seed: int = 0,
    zip: bool = False,
    limit: bool = False,
    threads: Optional[int] = None,
    progress: Listener = None,
    executor: Optional[Executor] = None,
    on_row: Optional[Callable[[Row], object]] = None,
) -> Columns:
    """Solve a case for every combination of values.

    Parameters
    ----------
    case
        As for :func:`percoat.solve`.
    set
        Keys and their values: ``{"layers.0.thickness": [0.1, 0.2], "friction.coefficient": np.linspace(0, 0.5, 6)}``; a
        value that is no list holds for all, and ``"0.1:1:5:log"`` gives five geometric ones, as on the command line.
    vary
        Uncertain keys and their ranges instead of values, as on the command line: ``{"layers.0.thickness": "10%", "substrate.young": (190,
        213), "friction.coefficient": "normal:0.2:0.02", "layers.0.young": "library"}``; a pair is a lowest and a highest value.
    samples
        Number of samples of the uncertain keys, a power of 2: each takes two combinations and one more a key.
    seed
        Seed of the samples.
    zip
        Pair the values of the keys, instead of all their combinations.
    limit
        Look for the limit loads of each combination instead of solving its load steps.
    threads
        As for :func:`percoat.solve`; with an executor, threads of each of its tasks, one if it is not given.
    progress
        As for :func:`percoat.solve`: called after each combination.
    executor
        Any :class:`concurrent.futures.Executor`: each combination is one task of it. The table is that of a sweep without
        one, bit for bit where the workers have the same kind of processor. A task that raises, that is cancelled, whose
        worker dies, or that the executor does not take becomes a row with the status ``failed`` and the reason. Files that
        the case names are read by the workers, under the same paths; each task carries the arrays of the sweep. The
        executor is not shut down.
    on_row
        Called in this process with each row of the table as soon as its combination is done, whatever the order: a dict of
        names and cells, ``None`` where there is no value.

    Returns
    -------
    Columns
        One row a combination and load step: ``combination``, ``set_<key>`` of what was set, ``status``, ``step``, and the
        scalars of ``curve.csv``. Numbers that are not there are NaN, truths ``None``; whole numbers of which one is not
        there are floats. With ``vary`` its ``uncertainty`` has quantiles and indices of every result.

    Raises
    ------
    CaseError
        Every combination is refused, memory does not suffice for all rows, or ``threads`` are more than a worker may have.
    RuntimeError
        An executor that is shut down or broken takes no task at all.
    KeyboardInterrupt
        On Ctrl-C. Without an executor solutions end between two iterations; with one its waiting tasks are cancelled, and
        those that have begun end, with :class:`~concurrent.futures.ProcessPoolExecutor` also the few that are queued for its
        processes.

    Warns
    -----
    NotConverged
        Of each combination that did not; of one that failed, and of doubts, a :class:`percoat.PercoatWarning`.

    Examples
    --------
    >>> import percoat
    >>> table = percoat.sweep("fig2", {"layers.0.thickness": [0.2, 0.5], "grid.points": 96})
    >>> table["set_layers_0_thickness"], table["status"].tolist()
    (array([0.2, 0.5]), ['done', 'done'])

    How far results spread, and which key matters; ``pandas.DataFrame(table.uncertainty)`` shows all:

    >>> table = percoat.sweep("fig2", {"grid.points": 96}, vary={"layers.0.thickness": "10%", "levels.0.radius": "5%"}, samples=8)
    >>> found = table.uncertainty
    >>> [name for name in found if name.startswith("total_") and not name.endswith(("_low", "_high"))]
    ['total_layers_0_thickness', 'total_levels_0_radius']

    On the processes of this machine; where processes are spawned the script needs ``if __name__ == "__main__":``

    >>> from concurrent.futures import ProcessPoolExecutor
    >>> def study():
    ...     with ProcessPoolExecutor(4) as executor:
    ...         return percoat.sweep("fig2", {"layers.0.thickness": "0.05:2:25:log"}, executor=executor)

    On a Dask cluster, here one on this machine:

    >>> def study_by_dask():
    ...     from dask.distributed import Client, LocalCluster
    ...     with LocalCluster(n_workers=4, threads_per_worker=1) as cluster, Client(cluster) as client:
    ...         return percoat.sweep("fig2", {"layers.0.thickness": "0.05:2:25:log"}, executor=client.get_executor())

    On the processes of MPI, as ``mpiexec -n 5 python -m mpi4py.futures study.py``:

    >>> def study_by_mpi():
    ...     from mpi4py.futures import MPIPoolExecutor
    ...     with MPIPoolExecutor() as executor:
    ...         return percoat.sweep("fig2", {"layers.0.thickness": "0.05:2:25:log"}, executor=executor)
    """
    set = {} if set is None else set
    if not isinstance(set, Mapping):
        raise TypeError("what is swept over is a dict of keys and their values, {'layers.0.thickness': [0.1, 0.2]}")
    if executor is not None and not isinstance(executor, Executor):
        kind = type(executor).__name__
        raise TypeError(
            f"executor is a concurrent.futures.Executor, not a {kind}; a Dask client gives one by client.get_executor()"
        )
    core = _core.Sweep(case, dict(set), zip, limit, [_range(key, spread) for key, spread in (vary or {}).items()], samples, seed)
    description = core.describe()
    done = _Done(core, listener(progress), on_row)
    rows = core.solve(threads, done.heard()) if executor is None else solve_on(executor, core, threads, done)
    rows.sort(key=lambda row: row.combination)
    warn(_merged(rows))
    warn((f"{row.name}: failed: {row.reason}" for row in rows if row.status == "failed"))
    unsettled = (f"{row.name}: not converged: {row.reason}" for row in rows if row.status == "not_converged")
    warn(unsettled, NotConverged)
    wall = monotonic() - done.began
    return _columns({name: _column(name, cells) for name, cells in _core.columns(rows)}, (description, rows, wall))


class _Done:
    """Passes on each combination that is done, to the progress and to ``on_row``."""

    def __init__(
        self,
        sweep: _core.Sweep,
        progress: Optional[Callable[[_core.Progress], object]],
        on_row: Optional[Callable[[Row], object]],
    ) -> None:
        self.sweep, self.progress, self.on_row = sweep, progress, on_row
        self.count, self.began = 0, monotonic()

    def heard(self) -> Optional[Callable[[_core.Row], object]]:
        """The callback itself, or ``None`` where nothing is passed on."""
        return None if self.progress is None and self.on_row is None else self

    def __call__(self, row: _core.Row) -> None:
        self.count += 1
        if self.on_row is not None:
            for line in row.lines():
                self.on_row({name: _number(cell) if name.startswith("set_") else cell for name, cell in line})
        if self.progress is not None:
            self.progress(self.sweep.told(row, self.count, monotonic() - self.began))


def _columns(arrays: Dict[str, NDArray[Any]], solved: Optional[Solved]) -> Columns:
    """The columns of a table with the sweep that was solved."""
    columns = Columns(arrays)
    if solved is not None:
        columns.__dict__["_solved"] = solved
    return columns


def _range(key: str, spread: Union[str, Tuple[float, float]]) -> str:
    """An uncertain key as on the command line."""
    if isinstance(spread, str):
        return f"{key}={spread}"
    low, high = spread
    return f"{key}={float(low)!r}:{float(high)!r}"


def _cell(value: Any) -> str:
    """A cell in a few letters."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def _merged(rows: list[_core.Row]) -> Iterable[str]:
    """Each doubt once, whatever its numbers, with the number of combinations that have it."""
    found: dict[str, tuple[str, list[str]]] = {}
    for row in rows:
        for doubt in row.warnings:
            _, names = found.setdefault(re.sub(r"[\s0-9.,e+-]+", " ", doubt), (doubt, []))
            if row.name not in names:
                names.append(row.name)
    for doubt, names in found.values():
        others = f" (and {len(names) - 1} more)" if len(names) > 1 else ""
        yield f"{names[0]}{others}: {doubt}"


def _column(name: str, cells: list[Any]) -> NDArray[Any]:
    """Cells as whole numbers, numbers, truths, or texts, whatever all of them are."""
    if name.startswith("set_"):
        numbers = [_number(cell) for cell in cells]
        cells = cells if any(isinstance(number, str) for number in numbers) else numbers
    there = [cell for cell in cells if cell is not None]
    if name.endswith(TEXTS) or any(isinstance(cell, str) for cell in there):
        return np.array(["" if cell is None else str(cell) for cell in cells], dtype=object)
    if there and all(isinstance(cell, bool) for cell in there):
        return np.array(cells, dtype=bool if len(there) == len(cells) else object)
    if len(there) == len(cells) and all(isinstance(cell, int) for cell in there):
        return np.array(cells)
    return np.array([np.nan if cell is None else cell for cell in cells], dtype=float)


def _number(text: str) -> Any:
    """A value as it was typed: a truth or a number where it is one."""
    if text in ("true", "false"):
        return text == "true"
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            pass
    return text
