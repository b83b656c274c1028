"""Rows of results, printed as one table."""

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Row:
    """One result."""

    name: str
    value: float | None
    """None: not measured; the unit has the reason."""
    unit: str
    against: str
    """Peer and its options, measured in the same run; empty: none."""
    ratio: float | None
    """Median of value / peer's value in all pairs; None: no peer."""


def print_table(rows: Sequence[Row]) -> None:
    """Print one line per row."""
    width = max((len(row.name) for row in rows), default=0)
    for row in rows:
        peer = "" if row.ratio is None else f"   {row.ratio:.3g} of {row.against}"
        value = "–" if row.value is None else f"{row.value:,.4g}"
        print(f"{row.name:<{width}}  {value:>12} {row.unit:<9}{peer}")
