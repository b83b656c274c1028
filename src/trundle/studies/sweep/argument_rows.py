"""Rows whose arguments differ: each may read other files."""

from collections.abc import Iterator

from msgspec.structs import replace

from trundle.base.expressions import free_names
from trundle.studies.plan_files.variation import Variation

from .plan import Plan
from .property_path import ARGUMENTS
from .rows import Row, Rows

_MOST = 32
"""Most values of arguments that are read beside those of the first row."""


def argument_rows(plan: Plan, rows: Rows) -> Iterator[Row]:
    """Yield the first row, and then that row with each further value of a list on which an argument depends."""
    first, left = rows.row(0), _MOST
    yield first
    named = {name for path, each in plan.assignments.items() if _is_argument(path) for name in free_names(each.text)}
    for root in plan.vary:
        together = [each for each in plan.vary if root.beside is None and root.name in (each.name, each.beside)]
        if not any(_is_argument(each.name) or each.name in named for each in together):
            continue
        for number in range(1, len(root.values)):
            if left > 0:
                left -= 1
                yield _with_values(first, together, number)


def _is_argument(path: str) -> bool:
    return path.startswith(f"{ARGUMENTS}/")


def _with_values(row: Row, variations: list[Variation], number: int) -> Row:
    return replace(row, values={**row.values, **{each.name: each.values[number] for each in variations}})
