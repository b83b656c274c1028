"""Validation of names and lengths in the builders."""

import math
from collections.abc import Iterable
from typing import Protocol

from trundle.base.diagnostics import Source, UsageError

BUILT = Source("<built in code>")


class _Named(Protocol):
    @property
    def name(self) -> str: ...


def check_name(name: str, there: Iterable[_Named], owner: str) -> str:
    """Return the name if it is free.

    Raises:
        UsageError: it is taken, empty, or contains SDF's separator.
    """
    if not name or "::" in name:
        raise UsageError(f"{owner}: {name!r} is no name: it must not be empty or hold '::'")
    names = [each.name for each in there]
    if name in names:
        raise UsageError(f"{owner} has {name!r} already; there are: {', '.join(map(repr, names))}")
    return name


def check_positive(what: str, *values: float) -> None:
    """Check lengths and masses.

    Raises:
        UsageError: one is not above zero, or not finite.
    """
    if not all(value > 0.0 and math.isfinite(value) for value in values):
        raise UsageError(f"{what} must be above zero, got {', '.join(f'{value:g}' for value in values)}")
