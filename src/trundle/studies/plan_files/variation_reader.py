"""Reader of variations: lists, ranges and distributions."""

import math
from typing import Literal

from trundle.base.diagnostics import Source

from .variation import Distribution, Value, Variation
from .yaml_node import YamlNode, as_number

_KINDS: dict[str, Literal["uniform", "normal", "log_uniform"]] = {
    "uniform": "uniform", "normal": "normal", "log_uniform": "log_uniform",
}  # fmt: skip
_FORMS = (
    "a list of values, range: [first, last, step], uniform: [low, high], normal: [mean, deviation] "
    "or log_uniform: [low, high]"
)
_MAX_VALUES = 1_000_000


def read_variation(name: str, node: YamlNode, at: Source) -> Variation:
    """Read the values of one quantity.

    Raises:
        DescriptionError: none of `_FORMS`.
    """
    if isinstance(node.value, list):
        return Variation(name=name, at=at, values=_values(node))
    if not isinstance(node.value, dict):
        node.fail(f"{name!r} must be {_FORMS}; a single value belongs to `set`")
    values = node.check_keys(f"{name!r}", "values", "range", "with", *_KINDS)
    paired_with = values["with"].text("with") if "with" in values else None
    forms = [form for form in values if form != "with"]
    if len(forms) != 1:
        node.fail(f"{name!r} must be {_FORMS}")
    (form,) = forms
    if form == "values":
        return Variation(name=name, at=at, values=_values(values[form]), paired_with=paired_with)
    if form == "range":
        return Variation(name=name, at=at, values=_range(values[form]), paired_with=paired_with)
    if paired_with is not None:
        values["with"].fail("`with` pairs lists and ranges, not distributions")
    return Variation(name=name, at=at, distribution=_distribution(_KINDS[form], values[form]))


def _values(node: YamlNode) -> tuple[Value, ...]:
    values = tuple(_value(item) for item in node.items())
    return values or node.fail("an empty list; give at least one value")


def _value(node: YamlNode) -> Value:
    if isinstance(node.value, list):
        return tuple(_value(item) for item in node.value)
    number = as_number(node.value)
    if isinstance(node.value, bool | int):
        return node.value
    return node.text("a value") if number is None else number


def _numbers(node: YamlNode, label: str, form: str) -> tuple[float, ...]:
    if len(node.items()) != form.count(",") + 1:
        node.fail(f"{label} must be {form}")
    return tuple(item.number(label) for item in node.items())


def _range(node: YamlNode) -> tuple[Value, ...]:
    """Return first, first + step, …, up to and including last."""
    first, last, step = _numbers(node, "range", "[first, last, step]")
    if step == 0 or (last - first) / step < 0:
        node.fail(f"range: steps of {step:g} do not lead from {first:g} to {last:g}")
    count = math.floor((last - first) / step + 1e-9) + 1
    if count > _MAX_VALUES:
        node.fail(f"range: {count} values; at most {_MAX_VALUES}")
    whole = all(isinstance(item.value, int) for item in node.items())
    values = [first + i * step for i in range(count)]
    return tuple(map(int, values)) if whole else tuple(values)


def _distribution(kind: Literal["uniform", "normal", "log_uniform"], node: YamlNode) -> Distribution:
    if kind == "normal":
        mean, deviation = _numbers(node, kind, "[mean, deviation]")
        if not deviation > 0:
            node.fail(f"normal: the deviation must be above 0, not {deviation:g}")
        return Distribution(kind=kind, parameters=(mean, deviation))
    low, high = _numbers(node, kind, "[low, high]")
    if not low < high or (kind == "log_uniform" and low <= 0):
        requirement = "0 < low < high" if kind == "log_uniform" else "low < high"
        node.fail(f"{kind}: needs {requirement}, not [{low:g}, {high:g}]")
    return Distribution(kind=kind, parameters=(low, high))
