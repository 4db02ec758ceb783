"""Small solved cases, and the program ``percoat`` beside the package, for all tests."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Callable

import numpy as np
import pytest

import percoat

Program = Callable[..., "subprocess.CompletedProcess[str]"]


def pytest_configure(config: pytest.Config) -> None:
    # Coarse grids are doubtful, and say so; everything else that warns is a failure, what has not converged
    # included.
    for line in ("error", "ignore::percoat.PercoatWarning", "error::percoat.NotConverged"):
        config.addinivalue_line("filterwarnings", line)


def environment(**more: str) -> dict[str, str]:
    """Environment of this process, with its path: a program that it starts finds the same package."""
    package = str(Path(percoat.__file__).parent.parent)
    path = os.pathsep.join(filter(None, [package, os.environ.get("PYTHONPATH", "")]))
    return {**os.environ, "PYTHONPATH": path, **more}


@pytest.fixture(scope="session")
def program() -> Program:
    """Runs the command line with arguments, and demands an exit code."""
    installed = Path(sys.executable).with_name("percoat.exe" if os.name == "nt" else "percoat")
    command = [str(installed)] if installed.exists() else [sys.executable, "-m", "percoat"]

    def run(*arguments: object, code: int = 0) -> subprocess.CompletedProcess[str]:
        typed = [*command, *map(str, arguments)]
        ended = subprocess.run(
            typed,
            env=environment(),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            timeout=60,
        )
        assert ended.returncode == code, f"{typed} ended with {ended.returncode}: {ended.stderr}"
        return ended

    return run


@pytest.fixture(scope="session")
def python() -> Program:
    """Runs a text as a program of its own; it must end well."""

    def run(text: str, timeout: float = 60.0, **variables: str) -> subprocess.CompletedProcess[str]:
        ended = subprocess.run(
            [sys.executable, "-c", text],
            env=environment(**variables),
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            timeout=timeout,
        )
        assert ended.returncode == 0, ended.stderr
        return ended

    return run


@pytest.fixture
def as_piped(monkeypatch: pytest.MonkeyPatch) -> None:
    """Tables as wide as those of the command line where it writes to no terminal."""
    monkeypatch.setenv("COLUMNS", "80")


@pytest.fixture(scope="session")
def three_levels() -> percoat.Result:
    """Figure 2 of the paper at two loads."""
    return percoat.solve("fig2", set={"grid.points": 96, "load.mean_pressure": [0.03, 0.06]})


def wave(points: int = 32, **sections: Any) -> dict[str, Any]:
    """A case: a wave of wavelength 2 and amplitude 0.01 along x, pressed flat.

    Uncoated with E = 1 and ν = 0.3, contact is complete above p* = E* k Δ/2 (Westergaard 1939), that is
    π/(0.91 · 200) = 0.01726.
    """
    x = np.arange(points) / points
    heights = np.repeat(0.01 * np.cos(2.0 * np.pi * x)[:, None], 8, axis=1)
    return {
        "title": "A wave pressed flat",
        "surface": {"heights": heights, "period": [2.0, 0.5]},
        "substrate": {"young": 1.0, "poisson": 0.3},
        "load": {"mean_pressure": [0.02, 0.05]},
        "solver": {"tolerance": 1e-12},
        **sections,
    }


@pytest.fixture(scope="session")
def flat_wave() -> percoat.Result:
    """The wave in complete contact."""
    return percoat.solve(wave())
