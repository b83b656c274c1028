"""Rows with different arguments, which may read different files."""

from collections.abc import Iterator

from msgspec.structs import replace

from trundle.base.expressions import free_names
from trundle.studies.plan_files.variation import Variation

from .plan import Plan
from .property_path import ARGUMENTS
from .rows import Row, Rows

_MAX_VALUES = 32
"""Maximum number of argument values besides those of the first row."""


def argument_rows(plan: Plan, rows: Rows) -> Iterator[Row]:
    """Yield the first row, and that row with each further value of every list on which an argument depends."""
    first, remaining = rows.row(0), _MAX_VALUES
    yield first
    used_names = {
        name
        for path, variation in plan.assignments.items()
        if _is_argument(path)
        for name in free_names(variation.text)
    }
    for root in plan.vary:
        group = [
            variation
            for variation in plan.vary
            if root.paired_with is None and root.name in (variation.name, variation.paired_with)
        ]
        if not any(_is_argument(variation.name) or variation.name in used_names for variation in group):
            continue
        for number in range(1, len(root.values)):
            if remaining > 0:
                remaining -= 1
                yield _with_values(first, group, number)


def _is_argument(path: str) -> bool:
    return path.startswith(f"{ARGUMENTS}/")


def _with_values(row: Row, variations: list[Variation], number: int) -> Row:
    return replace(row, values={**row.values, **{variation.name: variation.values[number] for variation in variations}})
