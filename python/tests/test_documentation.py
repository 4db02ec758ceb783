"""The examples of the documentation run and give what stands there."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

import percoat
from conftest import environment

README = Path(__file__).parents[2] / "README.md"


def test_examples_in_docstrings(tmp_path: Path) -> None:
    # In a process and a folder of their own: the modules are those of the package that is installed.
    ended = subprocess.run(
        [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "--rootdir", str(tmp_path)]
        + ["--import-mode", "importlib", "-W", "ignore::percoat.PercoatWarning"]
        + ["--doctest-modules", "--pyargs", "percoat"],
        env=environment(MPLBACKEND="Agg"),
        cwd=tmp_path,
        capture_output=True,
        encoding="utf-8",
        timeout=120,
    )
    assert ended.returncode == 0, ended.stdout[-5000:]
    passed = re.search(r"(\d+) passed", ended.stdout)
    assert passed is not None and int(passed[1]) >= 25, ended.stdout[-1000:]
    assert list(tmp_path.iterdir()) == [], "an example has left files"


def test_everything_public_has_an_example() -> None:
    without = {"COMPONENTS", "STRAINS", "__version__", "s1"}  # it is one of those beside it
    without |= {"CaseError", "NotConverged", "PercoatWarning", "Progress"}
    without |= {"Check", "Columns", "Comparison", "Identification", "Limits", "Plane", "Section"}  # what functions give
    for name in set(percoat.__all__) - without:
        assert ">>> " in (getattr(percoat, name).__doc__ or ""), name


@pytest.mark.skipif(not README.exists(), reason="README.md is in the repository alone")
def test_examples_of_the_readme(tmp_path: Path) -> None:
    pytest.importorskip("matplotlib")
    texts = re.findall("^```python\n(.*?)^```", README.read_text("utf-8"), re.MULTILINE | re.DOTALL)
    # Sweeps of limit loads take minutes.
    ours = [text for text in texts if "import percoat" in text and "percoat.limit(" not in text]
    assert ours
    for text in ours:
        ended = subprocess.run(
            [sys.executable, "-W", "ignore", "-c", text],
            env=environment(MPLBACKEND="Agg"),
            cwd=tmp_path,
            capture_output=True,
            encoding="utf-8",
            timeout=120,
        )
        assert ended.returncode == 0, text + ended.stderr
