"""The package says its types, and a script of a user passes with strict ones."""

from __future__ import annotations

import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

import pytest

import percoat
from conftest import environment

SCRIPT = '''
"""A program as a user may write it."""

from concurrent.futures import Executor, ProcessPoolExecutor
from pathlib import Path
from typing import Any, Dict, List, Optional

import numpy as np
from numpy.typing import NDArray

import percoat


def listen(progress: percoat.Progress) -> None:
    told: str = f"{progress.unit} {progress.done + 1} of {progress.of}: {progress.phase}"
    grid: Optional[tuple[int, int]] = progress.points
    print(told, grid, progress.iteration, progress.residual, progress.seconds)


case: Dict[str, Any] = percoat.case("fig2", set={"layers.0.thickness": 0.2})
titles: Dict[str, str] = percoat.cases()
told: percoat.Check = percoat.check(case, set=["grid.points=64"], threads=2)
print(told.points[0], told.memory, told.first_touch, told.warnings, str(told))
percoat.explain("layers.thickness")
schema: Dict[str, Any] = percoat.schema()

result: percoat.Result = percoat.solve(Path("own.toml"), set={"grid.points": 64}, threads=1, progress=listen)
result = percoat.solve(case, progress=True)
for step in result:
    depth: float = step.penetration
    force: float = step.force * step.contact_area
    mean: Optional[float] = step.mean_pressure
    share: float = step.levels[0].load_share
    peak: Optional[float] = step.levels[0].max_pressure
    fine: bool = step.converged
    field: NDArray[np.float64] = step.pressure + step.gap + step.displacement
    stress: NDArray[np.float64] = step.stress([[0.0, 0.0, 0.1]], material=1)
    largest: NDArray[np.float64] = percoat.mises(stress) + percoat.tau1(stress) + percoat.s1(stress)
    order: NDArray[np.float64] = percoat.principal(stress)
    plane: percoat.Plane = step.plane(0.5, points=(32, 48), material=2)
    section: percoat.Section = step.section("level 1", (1.0, 0.0), length=1.0, depth=0.5, behind=0.1)
    print(plane.xx + plane.uz, plane.z, plane.material, section.s, section.material, section.mises)
    maxima = step.maxima()
    if maxima is not None:
        print(maxima.max_tau1.value)
    print(force, mean, step.isolated)
    print(depth, share, peak, fine, field, largest, order, step.to_dict(), step.errors.penetration)

first: percoat.Step = result[0]
some: List[percoat.Step] = result.steps[1:]
number: int = len(result)
owner: NDArray[np.int32] = result.owner
table: Dict[str, Any] = result.to_dict()
print(
    result.x,
    result.a1,
    result.summary.timing.solve,
    first.owner,
    first.units.length,
    result.title,
    result.units.length,
    result.accuracy,
    result.converged,
    result.warnings,
)

limits: percoat.Limits = percoat.limit(case, set={"substrate.yield_strength": 0.1})
if limits.first is not None:
    print(limits.first.mean_pressure, limits.converged, [limit.criterion for limit in limits.limits])

found: percoat.Identification = percoat.identify(case, (np.ones(3), [0.1, 0.2, 0.3]), ["offset"], threads=1)
value: float = found.values["offset"] + found.errors["offset"] + found.intervals["offset"][0] + found.rms_residual
misfit: NDArray[np.float64] = found.penetration - found.fitted + found.fitted_error @ found.correlation
print(percoat.identify(case, Path("curve.csv"), "offset", set=["grid.points=64"]), found.case, found.contact_radii[0])

columns: percoat.Columns = percoat.sweep(case, {"layers.0.thickness": [0.1, 0.2]}, zip=True, limit=False)
print(columns.rows, columns["penetration"])


def row(cells: Dict[str, Any]) -> None:
    print(cells["combination"], cells["status"])


def study(executor: Executor) -> percoat.Columns:
    return percoat.sweep("fig2", {"layers.0.thickness": [0.1]}, executor=executor, on_row=row, threads=2)


result.save(Path("out"))
study(ProcessPoolExecutor(2)).save("out/study")

body = percoat.HalfSpace(layers=case["layers"], substrate=case["substrate"])
print(body.compliance(np.geomspace(0.1, 10.0, 5)), percoat.HalfSpace.of("fig2").correction(1.0))
response: percoat.Record = percoat.kernel("fig2", [1.0, 2.0], depth=0.5, traction="along")
print(response.szz, percoat.COMPONENTS, percoat.__version__)

try:
    percoat.solve("none")
except percoat.CaseError as error:
    reason: ValueError = error
both = percoat.compare("fig2", threads=2)
print(both.spectral.penetration, both.localized[0].difference.load)
warned: type[UserWarning] = percoat.NotConverged
'''

# Each of these lines is a mistake that types find.
MISTAKES = [
    'percoat.solve(3)',
    'percoat.solve("fig2", threads="2")',
    'percoat.solve("fig2", grid=64)',
    'percoat.solve("fig2", progress=3)',
    'percoat.solve("fig2").pressure',
    'percoat.solve("fig2").steps[0].penetration.upper()',
    'percoat.solve("fig2").steps[0].plane("deep")',
    'percoat.sweep("fig2", 3)',
    'percoat.sweep("fig2", {}, executor=4)',
    'percoat.sweep("fig2", {}, on_row=len("x"))',
    'percoat.solve("fig2").save()',
    'percoat.identify("fig2", 3.0, ["offset"])',
    'percoat.identify("fig2", "curve.csv", ["offset"]).values.upper()',
    'percoat.kernel("fig2", 1.0, traction=3)',
    'percoat.check("fig2").points.upper()',
    'percoat.nothing',
]


@pytest.mark.skipif(find_spec("mypy") is None, reason="mypy is not installed")
def test_types_are_strict(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    (tmp_path / "script.py").write_text(SCRIPT, "utf-8")
    lines = [f"{mistake}  # mistake {index}" for index, mistake in enumerate(MISTAKES)]
    (tmp_path / "mistakes.py").write_text("import percoat\n" + "\n".join(lines) + "\n", "utf-8")
    package = Path(percoat.__file__).parent
    cache = getattr(request.config, "cache", None)
    kept = tmp_path / "cache" if cache is None else Path(cache.mkdir("mypy"))
    # Where a wheel has put it, it is found by its mark `py.typed`.
    path = {} if "site-packages" in package.parts else {"MYPYPATH": str(package.parent)}

    def mypy(*checked: str) -> "subprocess.CompletedProcess[str]":
        options = ["--strict", "--no-error-summary", "--no-color-output", "--cache-dir", str(kept)]
        return subprocess.run(
            [sys.executable, "-m", "mypy", *options, *checked],
            env=environment(**path),
            cwd=tmp_path,
            capture_output=True,
            encoding="utf-8",
            timeout=300,
        )

    for checked in (["-p", "percoat"], ["script.py"]):
        ended = mypy(*checked)
        assert ended.returncode == 0, ended.stdout + ended.stderr
    ended = mypy("mistakes.py")
    found = {line.split(":")[1] for line in ended.stdout.splitlines() if ": error: " in line}
    missed = [mistake for number, mistake in enumerate(MISTAKES, 2) if str(number) not in found]
    assert not missed, f"{missed} pass:\n{ended.stdout}"


def test_the_package_is_marked_as_typed() -> None:
    package = Path(percoat.__file__).parent
    assert (package / "py.typed").exists() and (package / "_core.pyi").exists()


def test_the_stub_names_what_is_compiled() -> None:
    import ast

    from percoat import _core

    tree = ast.parse((Path(percoat.__file__).parent / "_core.pyi").read_text("utf-8"))
    named = {node.name for node in tree.body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    compiled = {name for name in dir(_core) if not name.startswith("_")}
    assert named == compiled
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            kind = getattr(_core, node.name)
            methods = {entry.name for entry in node.body if isinstance(entry, ast.FunctionDef)}
            public = {name for name in vars(kind) if not name.startswith("_")}
            assert {name for name in methods if not name.startswith("_")} == public, node.name
        elif isinstance(node, ast.FunctionDef):
            signature = getattr(_core, node.name).__text_signature__
            arguments = [entry.arg for entry in node.args.args]
            given = [word.split("=")[0].strip() for word in signature.strip("()").split(",") if word.strip()]
            assert arguments == given, node.name
