"""Check for features of a plan that GPUs do not support."""

import ast
from collections.abc import Iterator

from trundle.base.diagnostics import DescriptionError
from trundle.base.expressions import free_names

from ..plan import Formula, Plan
from ..property_path import is_property

_KEYS = {
    "launch": "launch files",
    "plugins": "plugins",
    "bag": "bags",
    "time_limit": "limits of single runs",
    "memory_limit": "limits of single runs",
}
_TABLES = ("models", "links", "joints")
"""Names whose attributes are names from the world."""


def check_plan(plan: Plan) -> None:
    """Refuse a plan with more than physics and expressions over states.

    Raises:
        DescriptionError: unsupported feature.
    """
    for key, feature in _KEYS.items():
        if key in plan.keys and (key != "plugins" or plan.plugins):
            raise DescriptionError(
                plan.keys[key], f"a sweep on a GPU has no {feature}; leave out `{key}` or the device"
            )
    for measure in plan.measures:
        if measure.function is not None:
            feature = f"a sweep on a GPU calls no Python functions; measure {measure.name!r} by an expression"
            raise DescriptionError(measure.at, f"{feature}, or leave out the device")
    for formula in _state_expressions(plan):
        if "topics" in free_names(formula.text):
            raise DescriptionError(formula.at, "a sweep on a GPU has no topics; leave out `topics` or the device")
        if _reads_effort(formula.text):
            feature = "a sweep on a GPU has no efforts of joints; leave out `effort` or the device"
            raise DescriptionError(formula.at, feature)
    paths = [(variation.name, variation.at) for variation in plan.vary if is_property(variation.name)]
    for path, at in [*paths, *((path, variation.at) for path, variation in plan.assignments.items())]:
        if "sensors" in path.split("/"):
            raise DescriptionError(at, f"{path}: a sweep on a GPU has no sensors; leave it or the device out")


def _state_expressions(plan: Plan) -> Iterator[Formula]:
    yield from plan.stop
    for measure in plan.measures:
        if measure.expression is not None:
            yield Formula(text=measure.expression, at=measure.at)


def _reads_effort(text: str) -> bool:
    return any(
        isinstance(node, ast.Attribute) and node.attr == "effort" and _name(node.value) not in _TABLES
        for node in ast.walk(ast.parse(text.strip(), mode="eval"))
    )


def _name(node: ast.expr) -> str:
    return node.attr if isinstance(node, ast.Attribute) else node.id if isinstance(node, ast.Name) else ""
