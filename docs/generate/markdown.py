"""Text of the code as Markdown."""

import re

_CODE = re.compile(r"(`[^`]*`)")


def cell(text: str) -> str:
    """A sentence as a cell of a table: what stands in backticks stays, the rest is escaped."""
    parts = _CODE.split(" ".join(text.split()))
    escaped = [part if part.startswith("`") else _escape(part) for part in parts]
    return "".join(escaped).replace("|", "&#124;")


def code(text: str) -> str:
    """A word as code in a cell of a table."""
    return f"<code>{_escape(text).replace('|', '&#124;')}</code>"


def _escape(text: str) -> str:
    text = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return re.sub(r"([*_\[\]])", r"\\\1", text)
