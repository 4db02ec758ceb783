"""Results in notebooks: plain tables with the cells of the printed ones, texts escaped."""

from __future__ import annotations

import copy
import pickle
from html.parser import HTMLParser
from typing import Any

import numpy as np
import pytest

import percoat
from conftest import wave


class Page(HTMLParser):
    """Reads a page: the cells of its tables, its text, and whether every element is closed."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.open: list[str] = []
        self.names: set[str] = set()
        self.attributes: set[str] = set()
        self.cells: list[str] = []
        self.text = ""
        self.feed(text)
        self.close()
        assert self.open == [], "an element is not closed"

    def handle_starttag(self, tag: str, attrs: "list[tuple[str, str | None]]") -> None:
        self.open.append(tag)
        self.names.add(tag)
        self.attributes |= {name for name, _ in attrs}
        if tag in ("td", "th"):
            self.cells.append("")

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        self.text += data
        if self.open and self.open[-1] in ("td", "th"):
            self.cells[-1] += data


def shown(answer: Any) -> Page:
    page = Page(answer._repr_html_())
    # Nothing runs, and no colour of its own is in the way of a dark page.
    assert page.names <= {"div", "p", "strong", "table", "caption", "thead", "tbody", "tr", "th", "td", "pre"}
    assert page.attributes <= {"style"} and "color" not in answer._repr_html_()
    return page


def printed(answer: Any, monkeypatch: pytest.MonkeyPatch) -> str:
    """The printed text of one line for each row, whatever its width."""
    monkeypatch.setenv("COLUMNS", "1000")
    return str(answer)


def test_results_and_steps(three_levels: percoat.Result, monkeypatch: pytest.MonkeyPatch) -> None:
    page, text = shown(three_levels), printed(three_levels, monkeypatch)
    assert three_levels.title in page.text and "2 of 2 load steps converged on 96 × 96 samples" in page.text
    assert len(page.cells) == 7 * 9 and all(cell in text for cell in page.cells)
    assert len(shown(three_levels[1]).cells) == 4 * 9
    stressed = percoat.solve("dlc-on-steel", set={"grid.points": 32, "load.mean_pressure": 0.2})
    page, text = shown(stressed), printed(stressed, monkeypatch)
    assert "Largest stresses" in page.text and all(cell in text for cell in page.cells)


def test_texts_of_a_case_are_escaped() -> None:
    bad = "<script>alert('a & b')</script>"
    result = percoat.solve(wave(title=bad, substrate={"young": 1.0, "poisson": 0.3, "name": "<i>x</i>"}))
    for answer in (result, percoat.check(wave(title=bad))):
        assert bad in shown(answer).text
    table = percoat.sweep("fig2", {"grid.points": 32, "title": [bad]})
    # A setting is shown as it is typed, in quotes.
    assert f'"{bad}"' in shown(table).cells


def test_limits_lives_and_comparisons(monkeypatch: pytest.MonkeyPatch) -> None:
    strong = {"grid.points": 32, "substrate.yield_strength": 0.1}
    found: list[Any] = [
        percoat.limit("fig2", set=strong),
        percoat.life("tin-fatigue", set={"grid.points": 32, "life.passes": 1e6}),
        percoat.compare("fig2", set={"grid.points": 32, "localized.indenters": [7], "localized.elements": 16}),
    ]
    for answer in found:
        page = shown(answer)
        text = printed(answer, monkeypatch) if answer is not found[2] else None
        assert answer.title in page.text and len(page.cells) >= 6
        assert text is None or all(cell in text for cell in page.cells)
        for again in (pickle.loads(pickle.dumps(answer)), copy.deepcopy(answer)):
            assert again == answer and again._repr_html_() == answer._repr_html_()


def test_checks_are_their_text() -> None:
    checked = percoat.check("fig2")
    assert shown(checked).text == checked.text


def test_tables_of_sweeps_are_their_first_rows() -> None:
    table = percoat.sweep("fig2", {"grid.points": 32, "layers.0.thickness": np.linspace(0.1, 0.4, 12)})
    page = shown(table)
    names = list(table)[:12]
    assert page.cells[:13] == [*names, "…"] and len(page.cells) == 11 * 13
    assert page.cells[13:16] == ["1", "0.1", "done"] and page.cells[26] == "2"
    assert f"12 rows × {len(table)} columns, the first 10 rows" in page.text
    for again in (pickle.loads(pickle.dumps(table)), copy.deepcopy(table)):
        assert type(again) is percoat.Columns and again._repr_html_() == table._repr_html_()
