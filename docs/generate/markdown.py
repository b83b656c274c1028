"""Conversion of text in the code to Markdown, and tables that fit a phone."""

import re
from collections.abc import Iterable, Sequence
from html import escape

_CODE = re.compile(r"(`[^`]*`)")
_LINK = re.compile(r"\[([^\]]+)\]\(([^)]+)\)")


def cell(text: str) -> str:
    """Return a sentence as text of a list or heading: text in backticks is kept, the rest is escaped."""
    parts = _CODE.split(" ".join(text.split()))
    escaped = [part if part.startswith("`") else _escape(part) for part in parts]
    return "".join(escaped).replace("|", "&#124;")


def code(text: str) -> str:
    """Return a word as code in HTML."""
    return f"<code>{escape(text, quote=False)}</code>"


def html(text: str) -> str:
    """Return a sentence as HTML: text in backticks becomes code."""
    parts = _CODE.split(" ".join(text.split()))
    return "".join(code(part[1:-1]) if part.startswith("`") else escape(part, quote=False) for part in parts)


def table(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Return a table whose cells know their headings, which a narrow screen shows beside them.

    Args:
        headings: one for each column.
        rows: HTML of each cell; an empty one is left out on a narrow screen. Columns without any content are left out.
    """
    filled = list(rows)
    shown = [i for i in range(len(headings)) if any(row[i] for row in filled)]
    head = "".join(f"<th>{headings[i]}</th>" for i in shown)
    lines = ['<table class="reference">', f"<thead><tr>{head}</tr></thead>", "<tbody>"]
    for row in filled:
        cells = "".join(f'<td data-heading="{headings[i]}">{row[i]}</td>' for i in shown)
        lines.append(f"<tr>{cells}</tr>")
    return "\n".join([*lines, "</tbody>", "</table>", ""])


def _escape(text: str) -> str:
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([*_\[\]])", r"\\\1", text)
