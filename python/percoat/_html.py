"""Results as HTML, for notebooks: plain tables in the colours of the page, texts escaped."""

from __future__ import annotations

from html import escape
from typing import Sequence, Tuple

Table = Tuple[str, Sequence[str], Sequence[Sequence[str]], int]
"""A caption, the names of the columns, the rows, and the number of first columns that are words."""


def page(title: str, tables: Sequence[Table], notes: Sequence[str] = ()) -> str:
    """A title, tables and lines below them."""
    head = f"<p><strong>{escape(title)}</strong></p>" if title else ""
    tail = "".join(f"<p>{escape(note)}</p>" for note in notes)
    return f"<div>{head}{''.join(map(table, tables))}{tail}</div>"


def table(content: Table) -> str:
    """A table; words stand on the left, numbers on the right."""
    caption, names, rows, words = content

    def line(tag: str, cells: Sequence[str]) -> str:
        side = ("left" if index < words else "right" for index in range(len(cells)))
        inner = (f'<{tag} style="text-align: {align}">{escape(cell)}</{tag}>' for align, cell in zip(side, cells))
        return f"<tr>{''.join(inner)}</tr>"

    head, body = line("th", names), "".join(line("td", row) for row in rows)
    above = f'<caption style="text-align: left">{escape(caption)}</caption>' if caption else ""
    return f"<table>{above}<thead>{head}</thead><tbody>{body}</tbody></table>"


def text(printed: str) -> str:
    """A text as it is printed."""
    return f"<pre>{escape(printed)}</pre>"
