"""Arrays are not copied, outlive what they are of, and go when nobody has them any more."""

from __future__ import annotations

import gc
import os
import pickle
import sys
import weakref
from typing import Any

import numpy as np
import pytest

import percoat


@pytest.mark.parametrize("name", ["pressure", "gap", "displacement"])
def test_fields_are_not_copied(three_levels: percoat.Result, name: str) -> None:
    for step in three_levels:
        first, second = getattr(step, name), getattr(step, name)
        assert np.shares_memory(first, second) and first.dtype == np.float64
        assert first.flags.c_contiguous and first.flags.aligned and first.dtype.isnative


@pytest.mark.parametrize("name", ["pressure", "gap"])
def test_fields_are_where_the_solver_has_them(three_levels: percoat.Result, name: str) -> None:
    # Two arrays of the same step that know nothing of each other.
    step = three_levels[0]
    first, second = getattr(step._core, name), getattr(step._core, name)
    assert first is not second and first.ctypes.data == second.ctypes.data == getattr(step, name).ctypes.data
    assert type(first.base).__name__ == "Step"


@pytest.mark.parametrize("name", ["pressure", "gap", "displacement", "x", "y"])
def test_fields_cannot_be_written_to(three_levels: percoat.Result, name: str) -> None:
    array = getattr(three_levels[0], name)
    assert not array.flags.writeable
    with pytest.raises(ValueError, match="read-only"):
        array[0, 0] = 1.0
    with pytest.raises(ValueError):
        array += 1.0
    # Nor by a detour, where the memory is that of the solver.
    if name in ("pressure", "gap"):
        with pytest.raises(ValueError):
            array.flags.writeable = True
        with pytest.raises(ValueError):
            array.view().flags.writeable = True
    copied = array.copy()
    copied[0, 0] = 1.0
    assert copied.flags.writeable


def test_the_owner_cannot_be_written_to(three_levels: percoat.Result) -> None:
    assert three_levels.owner.dtype == np.int32 and not three_levels.owner.flags.writeable


@pytest.mark.parametrize("pickled", [False, True])
def test_fields_outlive_their_result(pickled: bool) -> None:
    result = percoat.solve("fig2", set={"grid.points": 96})
    if pickled:
        result = pickle.loads(pickle.dumps(result))
    names = ("pressure", "gap", "displacement")
    fields = [getattr(result[0], name) for name in names]
    parts = [field[10:20, ::3].T for field in fields]
    copies, copied = [field.copy() for field in fields], [part.copy() for part in parts]
    x = result.x
    kept = x.copy()
    del result
    gc.collect()
    # What takes their place, if they are gone.
    others = [np.full((96, 96), 7.0) for _ in range(200)]
    again = percoat.solve("fig3a", set={"grid.points": 96})
    assert all(np.array_equal(field, copy) for field, copy in zip(fields, copies))
    del fields
    gc.collect()
    others += [np.full((96, 96), 9.0) for _ in range(200)]
    assert all(np.array_equal(part, copy) for part, copy in zip(parts, copied))
    assert np.array_equal(x, kept) and len(others) == 400 and again.converged


def test_a_step_outlives_its_result() -> None:
    step = percoat.solve("fig2", set={"grid.points": 64}).steps[0]
    gc.collect()
    assert step.stress([0.0, 0.0, 0.1]).shape == (6,)
    assert step.x.shape == step.pressure.shape == (64, 64) and str(step)


def test_stresses_are_arrays_of_their_own(three_levels: percoat.Result) -> None:
    step = three_levels[0]
    first, second = step.plane(0.3), step.plane(0.3)
    first.xx[:] = 0.0
    assert second.xx.any() and step.plane(0.3).xx.any()
    stress = step.stress([0.0, 0.0, 0.3])
    stress[:] = 0.0
    assert step.stress([0.0, 0.0, 0.3]).any()


def test_a_result_goes_when_nobody_has_it_any_more() -> None:
    # At once, and not when cycles are looked for: of large grids a few are more than there is.
    gc.collect()
    gc.disable()
    try:
        result = percoat.solve("fig2", set={"grid.points": 48})
        str(result), repr(result[0]), result[0].pressure.sum()
        gone = weakref.ref(result)
        del result
        assert gone() is None
    finally:
        gc.enable()


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="resident memory is read under Linux")
def test_many_solutions_take_no_memory() -> None:
    # One array of 48² doubles that is left behind each time would add up to 500 · 18 KiB = 9 MB; half of it
    # is allowed for what the allocator keeps of the pieces it hands out. The twelve fields of a plane, asked
    # for every twentieth time, would add up to 500/20 · 12 · 18 KiB = 5.5 MB.
    points, repeats = 48, 500
    bound = repeats * points**2 * 8 // 2
    case: dict[str, Any] = {
        "lattice": {"kind": "square", "period": 1.0},
        "levels": [{"shape": "paraboloid", "radius": 1.0}],
        "layers": [{"thickness": 0.3, "young": 3.0, "poisson": 0.25}],
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": 0.01},
        "grid": {"points": points},
    }
    deep = {**case, "load": {"penetration": 10.0}}

    def enough(progress: percoat.Progress) -> None:
        raise InterruptedError

    def once() -> None:
        step = percoat.solve(case)[0]
        assert step.pressure.shape == step.gap.shape == step.displacement.shape

    def seldom() -> None:
        step = percoat.solve(case)[0]
        step.plane(0.1)
        step.stress([[0.0, 0.0, 0.1], [0.1, 0.2, 0.3]])
        with pytest.raises(percoat.CaseError):
            step.stress([0.0, 0.0, -0.1])
        for refused in (deep, {**case, "grid": {"points": 11}}):
            with pytest.raises(percoat.CaseError):
                percoat.solve(refused)
        with pytest.raises(InterruptedError):
            percoat.solve(case, progress=enough)

    def resident() -> int:
        gc.collect()
        with open("/proc/self/statm", encoding="ascii") as text:
            return int(text.read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

    def repeat(times: int) -> None:
        for index in range(times):
            once()
            if index % 20 == 0:
                seldom()

    repeat(100)
    before = resident()
    repeat(repeats)
    grown = resident() - before
    assert grown < bound, f"{grown / 1e6:.1f} MB more after {repeats} solutions"


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="resident memory is read under Linux")
def test_results_that_are_gone_take_no_memory(python: Any) -> None:
    # Twenty results of three fields of 512² doubles would add up to 126 MB; half of it is allowed.
    text = """
import gc, os, percoat

def resident():
    gc.collect()
    return int(open("/proc/self/statm").read().split()[1]) * os.sysconf("SC_PAGE_SIZE")

def solve():
    step = percoat.solve("fig2", set={"grid.points": 512, "solver.tolerance": 1e-4})[0]
    return step.pressure, step.displacement

solve()
before = resident()
for _ in range(20):
    kept = solve()
print(resident() - before)
"""
    grown = int(python(text).stdout)
    assert grown < 20 * 3 * 512**2 * 8 // 2, f"{grown / 1e6:.0f} MB"


def test_references_are_counted() -> None:
    heard: list[object] = []
    step = percoat.solve("fig2", set={"grid.points": 48}, progress=heard.append)[0]
    heights = np.outer(np.cos(np.arange(8)), np.ones(8))
    case = {
        "surface": {"heights": heights, "period": [1.0, 1.0]},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": 1.0},
    }
    points = np.array([[0.0, 0.0, 0.1]])
    before = [sys.getrefcount(value) for value in (heights, case, points, heard.append.__self__)]
    for _ in range(10):
        percoat.solve(case)
        step.stress(points)
    gc.collect()
    assert [sys.getrefcount(value) for value in (heights, case, points, heard.append.__self__)] == before


HUGE = {
    "broadcast": "np.broadcast_to(np.zeros(1), (10**6, 10**6))",
    "broadcast of another type": "np.broadcast_to(np.zeros(1, np.int8), (10**6, 10**6))",
    "one long axis": "np.broadcast_to(np.zeros((1, 2)), (10**12, 2))",
    "overlapping": "np.lib.stride_tricks.as_strided(np.zeros(8), (10**6, 10**6), (0, 0))",
    "a list of one list": "[[0.0] * 10**6] * 10**6",
    "as many as can be": "np.broadcast_to(np.zeros(1), (2**30, 2**29))",
}


@pytest.mark.parametrize("name", list(HUGE))
def test_heights_that_memory_does_not_hold(python: Any, name: str) -> None:
    # In a process of its own: it would be killed, or all others with it.
    text = f"""
import numpy as np, percoat, resource
huge = {HUGE[name]}
before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for ask in (percoat.check, percoat.solve, percoat.case):
    try:
        ask({{
            "surface": {{"heights": huge, "period": [1.0, 1.0]}},
            "substrate": {{"young": 1.0, "poisson": 0.3}},
            "load": {{"mean_pressure": 1e-3}},
        }})
    except MemoryError as error:
        print(error)
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 100_000)
"""
    *told, modest = python(text, timeout=60.0).stdout.splitlines()
    assert modest == "True" and len(told) == 3, told
    assert all("`surface.heights` of " in line and "of memory" in line for line in told), told


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="address space is limited under Linux")
@pytest.mark.parametrize("points", [2048, 4096, 8192])
def test_heights_beyond_the_limit_of_a_process(python: Any, points: int) -> None:
    # Without a core: an interpreter that aborts ends with another code.
    text = f"""
import numpy as np, percoat, resource
percoat.check("fig2", set={{"grid.points": 48}})
heights = np.broadcast_to(np.cos(np.arange({points}) * 2 * np.pi / {points})[:, None], ({points}, {points}))
case = {{
    "surface": {{"heights": heights, "period": [1.0, 1.0]}},
    "substrate": {{"young": 1.0, "poisson": 0.3}},
    "load": {{"mean_pressure": 1e-3}},
}}
taken = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
for more in (2**24, 2**26, 2**27):
    resource.setrlimit(resource.RLIMIT_AS, (taken + more, resource.RLIM_INFINITY))
    try:
        percoat.check(case)
    except (MemoryError, percoat.CaseError) as error:
        print(type(error).__name__)
resource.setrlimit(resource.RLIMIT_AS, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
print(percoat.check("fig2", set={{"grid.points": 48}}).points)
"""
    told = python(text, timeout=60.0).stdout.splitlines()
    assert told[0] == "MemoryError" and told[-1] == "[48, 48]", told
