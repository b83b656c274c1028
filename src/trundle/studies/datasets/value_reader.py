"""Reader of random values: numbers, colors and poses."""

import math
from typing import NoReturn

from trundle.spatial import Vector3
from trundle.studies.plan_files.variation import Distribution
from trundle.studies.plan_files.variation_reader import read_variation
from trundle.studies.plan_files.yaml_node import YamlNode, as_number

from .plan import Color, Numbers
from .quantity import Quantity, constant

_FORMS = "a number, a list of numbers to choose from, uniform: [low, high], normal: [mean, deviation] or log_uniform: …"
UNIT = Quantity(distribution=Distribution(kind="uniform", parameters=(0.0, 1.0)))
_BRIGHT = Quantity(distribution=Distribution(kind="uniform", parameters=(0.2, 1.0)))
TURN = Quantity(distribution=Distribution(kind="uniform", parameters=(-math.pi, math.pi)))
"""Any angle [rad]."""


def read_quantity(node: YamlNode, label: str, *, minimum: float = -math.inf, maximum: float = math.inf) -> Quantity:
    """Read a constant or random number.

    Raises:
        DescriptionError: invalid, or a number out of bounds.
    """
    if isinstance(node.value, dict):
        variation = read_variation(label, node, node.at)
        if variation.paired_with is not None:
            node.value["with"].fail(f"{label}: `with` pairs values of sweeps; each number of a picture is drawn alone")
        if variation.distribution is None:
            choices = [value for value in variation.values if isinstance(value, int | float)]
            if len(choices) < len(variation.values):
                node.fail(f"{label} must be {_FORMS}")
            quantity = Quantity(choices=tuple(float(value) for value in choices))
        else:
            quantity = Quantity(distribution=variation.distribution, low=minimum, high=maximum)
    elif isinstance(node.value, list):
        quantity = Quantity(choices=tuple(item.number(label) for item in node.items()))
        if not quantity.choices:
            node.fail(f"{label} must be {_FORMS}")
    else:
        number = as_number(node.value)
        quantity = constant(node.fail(f"{label} must be {_FORMS}") if number is None else number)
    ends = quantity.choices
    if quantity.distribution is not None and quantity.distribution.kind != "normal":
        ends = quantity.distribution.parameters
    for end in ends:
        if not (math.isfinite(end) and minimum <= end <= maximum):
            node.fail(f"{label} must be {_bounds(minimum, maximum)}, not {end:g}")
    return quantity


def _bounds(low: float, high: float) -> str:
    if not (math.isfinite(low) or math.isfinite(high)):
        return "finite"
    if not math.isfinite(high):
        return f"at least {low:g}"
    return f"between {low:g} and {high:g}"


def read_count(node: YamlNode, label: str, *, maximum: int) -> Quantity:
    """Read a count between 0 and a maximum."""
    quantity = read_quantity(node, label, minimum=0)
    if quantity.largest > maximum:
        node.fail(f"{label} may be {maximum} at most")
    return quantity


def read_numbers(node: YamlNode, label: str) -> Numbers:
    """Read three constant or random numbers."""
    items = node.items()
    if len(items) != 3:
        node.fail(f"{label} must be a list of three, each {_FORMS}")
    x, y, z = (read_quantity(item, label) for item in items)
    return x, y, z


def read_vector(node: YamlNode, label: str) -> Vector3:
    """Read three constant numbers."""
    items = node.items()
    if len(items) != 3:
        node.fail(f"{label} must be a list of three numbers")
    x, y, z = (_finite(item, label) for item in items)
    return x, y, z


def _finite(node: YamlNode, label: str) -> float:
    number = node.number(label)
    return number if math.isfinite(number) else node.fail(f"{label} must be finite")


def read_pair(node: YamlNode, label: str) -> tuple[float, float]:
    """Read two constant numbers in ascending order."""
    items = node.items()
    if len(items) != 2:
        node.fail(f"{label} must be [low, high]")
    low, high = (_finite(item, label) for item in items)
    if not low <= high:
        node.fail(f"{label} must be [low, high], not [{low:g}, {high:g}]")
    return low, high


def read_color(node: YamlNode, label: str) -> Color:
    """Read `any`, a color, a list of colors, or hue, saturation and value."""
    if node.value == "any":
        return Color(hsv=(UNIT, UNIT, _BRIGHT))
    if isinstance(node.value, dict):
        fields = node.check_keys(label, "hue", "saturation", "value")
        hue, saturation, value = (
            read_quantity(fields[name], name, minimum=0, maximum=1) if name in fields else default
            for name, default in (("hue", UNIT), ("saturation", UNIT), ("value", _BRIGHT))
        )
        return Color(hsv=(hue, saturation, value))
    if not isinstance(node.value, list) or not node.value:
        _fail_color(node, label)
    rows = node.items() if isinstance(node.items()[0].value, list) else [node]
    return Color(choices=tuple(_rgb(row, label) for row in rows))


def _fail_color(node: YamlNode, label: str) -> NoReturn:
    node.fail(f"{label} must be any, [red, green, blue] of 0 to 1, a list of such, or hue: …, saturation: …, value: …")


def _rgb(node: YamlNode, label: str) -> Vector3:
    if not isinstance(node.value, list) or len(node.value) != 3:
        _fail_color(node, label)
    rgb = read_vector(node, label)
    if not all(0.0 <= part <= 1.0 for part in rgb):
        _fail_color(node, label)
    return rgb
