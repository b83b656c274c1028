"""`trundle run --list`: what comes with Trundle to be run."""

import textwrap
from itertools import groupby

from trundle.robots.packages import shipped_files

_INDENT = "  "
_LEAST_TEXT = 40
"""Least width of the sentences [characters]; on narrower terminals they are on lines of their own."""


def shipped_list(width: int) -> str:
    """Return the list by kinds, with commands to type, wrapped at a width [characters]."""
    files = shipped_files()
    start = len(_INDENT) + max(len(file.command) for file in files) + 2
    lines: list[str] = []
    for kind, group in groupby(files, key=lambda file: file.kind):
        lines += ["", kind.capitalize()]
        for file in group:
            command = f"{_INDENT}{file.command}"
            if width - start >= _LEAST_TEXT:
                lines += textwrap.wrap(f"{command:{start}}{file.about}", width, subsequent_indent=" " * start)
            else:
                lines += [command, *textwrap.wrap(file.about, width, initial_indent="    ", subsequent_indent="    ")]
    return "\n".join(lines[1:])
