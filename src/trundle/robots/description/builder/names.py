"""Validation of names and lengths in the builders."""

from collections.abc import Iterable
from typing import Protocol

from trundle.base.arguments import described, number_of
from trundle.base.diagnostics import Source, UsageError
from trundle.robots.model import Rgba
from trundle.spatial import numbers_of

BUILT = Source("<built in code>")


class _Named(Protocol):
    @property
    def name(self) -> str: ...


def check_name(name: str, existing: Iterable[_Named], owner: str) -> str:
    """Return the name if it is free.

    Raises:
        UsageError: the name is a duplicate, empty, or contains SDF's separator.
    """
    if not isinstance(name, str) or not name or "::" in name:  # pyright: ignore[reportUnnecessaryIsInstance]
        raise UsageError(f"{owner}: {described(name)} is no name: it must be text, not empty, and without '::'")
    names = [part.name for part in existing]
    if name in names:
        raise UsageError(f"{owner} has {name!r} already; there are: {', '.join(map(repr, names))}")
    return name


def check_positive(quantity: str, *values: float) -> None:
    """Check lengths or masses.

    Raises:
        UsageError: a value is not above zero, or not finite.
    """
    for value in values:
        if number_of(value, quantity) <= 0.0:
            raise UsageError(f"{quantity} must be above zero, got {', '.join(f'{value:g}' for value in values)}")


def color_of(value: object, name: str) -> Rgba:
    """Return red, green, blue and opacity; opacity is 1 if there are only three numbers.

    Raises:
        UsageError: the argument is no color; `name` begins the sentence.
    """
    problem = f"{name} must be (red, green, blue) or (red, green, blue, opacity), each 0 to 1"
    try:
        red, green, blue, *alpha = numbers_of(value, (3, 4), problem)
    except ValueError as error:
        raise UsageError(str(error)) from None
    opacity = alpha[0] if alpha else 1.0
    if not all(0.0 <= part <= 1.0 for part in (red, green, blue, opacity)):
        raise UsageError(f"{problem}, got {described(value)}")
    return (red, green, blue, opacity)
