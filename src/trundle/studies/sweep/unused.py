"""Check for varied quantities without effect."""

from collections.abc import Iterator

from trundle.base.diagnostics import DescriptionError, nearest
from trundle.base.expressions import MATH_NAMES, PYTHON_NAMES, free_names
from trundle.studies.plan_files.variation import Variation

from .plan import Plan
from .property_path import TIME_STEP, is_property


def check_used(plan: Plan) -> None:
    """Refuse a quantity without effect; texts paired `with` another quantity are its labels.

    Raises:
        DescriptionError: no expression names the quantity, or `set` replaces it.
    """
    used = {name for text in _expressions(plan) for name in free_names(text)}
    for variation in plan.vary:
        if variation.name in plan.assignments:
            raise DescriptionError(
                variation.at, f"vary: `set` gives {variation.name!r} another value; leave one of them out"
            )
        if not is_property(variation.name) and variation.name not in used and not _is_label(variation):
            unknown = used - {other.name for other in plan.vary} - MATH_NAMES.keys() - PYTHON_NAMES.keys()
            closest = nearest(variation.name, {TIME_STEP, *unknown})
            hint = f"; the nearest name is {closest!r}" if closest else ""
            remedy = "name it in `set`, `events`, `stop`, `measure` or `pass`, or vary a property, whose path has a /"
            raise DescriptionError(variation.at, f"vary: nothing uses {variation.name!r}{hint}; {remedy}")


def _is_label(variation: Variation) -> bool:
    return variation.paired_with is not None and all(isinstance(value, str) for value in variation.values)


def _expressions(plan: Plan) -> Iterator[str]:
    """Yield the text of each expression."""
    for formula in (*plan.assignments.values(), *plan.stop, *plan.criteria):
        yield formula.text
    for measure in plan.measures:
        if measure.expression is not None:
            yield measure.expression
    for event in plan.events:
        for formula in (event.time_s, *event.numbers, *([] if event.duration_s is None else [event.duration_s])):
            yield formula.text
