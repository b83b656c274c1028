"""Validation of names and lengths in the builders."""

import math
from collections.abc import Iterable
from typing import Protocol

from trundle.base.diagnostics import Source, UsageError

BUILT = Source("<built in code>")


class _Named(Protocol):
    @property
    def name(self) -> str: ...


def check_name(name: str, existing: Iterable[_Named], owner: str) -> str:
    """Return the name if it is free.

    Raises:
        UsageError: the name is a duplicate, empty, or contains SDF's separator.
    """
    if not name or "::" in name:
        raise UsageError(f"{owner}: {name!r} is no name: it must not be empty or hold '::'")
    names = [part.name for part in existing]
    if name in names:
        raise UsageError(f"{owner} has {name!r} already; there are: {', '.join(map(repr, names))}")
    return name


def check_positive(quantity: str, *values: float) -> None:
    """Check lengths or masses.

    Raises:
        UsageError: a value is not above zero, or not finite.
    """
    if not all(value > 0.0 and math.isfinite(value) for value in values):
        raise UsageError(f"{quantity} must be above zero, got {', '.join(f'{value:g}' for value in values)}")
