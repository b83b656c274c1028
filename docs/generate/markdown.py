"""Conversion of text in the code to Markdown."""

import re

_CODE = re.compile(r"(`[^`]*`)")


def cell(text: str) -> str:
    """Return a sentence as a table cell: text in backticks is kept, the rest is escaped."""
    parts = _CODE.split(" ".join(text.split()))
    escaped = [part if part.startswith("`") else _escape(part) for part in parts]
    return "".join(escaped).replace("|", "&#124;")


def code(text: str) -> str:
    """Return a word as code in a table cell."""
    return f"<code>{_escape(text).replace('|', '&#124;')}</code>"


def _escape(text: str) -> str:
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([*_\[\]])", r"\\\1", text)
