"""A description by its name, or from standard input."""

import sys
from pathlib import Path

from trundle.description import Loaded, load, load_text
from trundle.diagnostics import Diagnostics
from trundle.packages import Packages

STANDARD_INPUT = "-"
_MOST_CHARACTERS = 64 * 1024 * 1024


def load_described(file: str, report: Diagnostics, *, packages: Packages, start: Path) -> Loaded:
    """Read a description.

    Args:
        file: as `trundle.description.load` takes it, or "-" for standard input.
        report: takes everything worth saying.
        packages: where URIs lead.
        start: relative URIs in standard input start here.

    Raises:
        DescriptionError: of which nothing sensible can be made.
        UsageError: no such model.
    """
    if file != STANDARD_INPUT:
        return load(file, report, packages=packages)
    text = sys.stdin.read(_MOST_CHARACTERS)
    return load_text(text, name="<stdin>", folder=start, packages=packages, report=report)
