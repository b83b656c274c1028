"""Names of what is built: each once, and an error that lists what there is."""

import math
from collections.abc import Iterable
from typing import Protocol

from trundle.diagnostics import Source, UsageError

BUILT = Source("<built in code>")


class _Named(Protocol):
    @property
    def name(self) -> str: ...


def check_name(name: str, there: Iterable[_Named], owner: str) -> str:
    """Return a name that is still free.

    Raises:
        UsageError: it is taken, empty, or has SDF's separator in it.
    """
    if not name or "::" in name:
        raise UsageError(f"{owner}: {name!r} is no name: it must not be empty or hold '::'")
    names = [each.name for each in there]
    if name in names:
        raise UsageError(f"{owner} has {name!r} already; there are: {', '.join(map(repr, names))}")
    return name


def check_positive(what: str, *values: float) -> None:
    """Refuse lengths and masses that nothing can have.

    Raises:
        UsageError: one is not above zero, or endless.
    """
    if not all(value > 0.0 and math.isfinite(value) for value in values):
        raise UsageError(f"{what} must be above zero, got {', '.join(f'{value:g}' for value in values)}")
