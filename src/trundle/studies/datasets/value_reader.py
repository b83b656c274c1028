"""Reader of the values that a picture draws: numbers, colours and poses."""

import math
from typing import NoReturn

from trundle.spatial import Vector3
from trundle.studies.plan_files.variation import Distribution
from trundle.studies.plan_files.variation_reader import read_variation
from trundle.studies.plan_files.yaml_node import YamlNode, as_number

from .plan import Colour, Numbers
from .quantity import Quantity, constant

_FORMS = "a number, a list of numbers to choose from, uniform: [low, high], normal: [mean, deviation] or log_uniform: …"
UNIT = Quantity(distribution=Distribution(kind="uniform", parameters=(0.0, 1.0)))
_BRIGHT = Quantity(distribution=Distribution(kind="uniform", parameters=(0.2, 1.0)))
TURN = Quantity(distribution=Distribution(kind="uniform", parameters=(-math.pi, math.pi)))
"""Any angle [rad]."""


def read_quantity(node: YamlNode, what: str, *, at_least: float = -math.inf, at_most: float = math.inf) -> Quantity:
    """Read a number or where it is drawn from.

    Raises:
        DescriptionError: neither, or a number out of bounds.
    """
    if isinstance(node.value, dict):
        found = read_variation(what, node, node.at)
        if found.beside is not None:
            node.value["with"].fail(f"{what}: `with` pairs values of sweeps; each number of a picture is drawn alone")
        if found.distribution is None:
            choices = [value for value in found.values if isinstance(value, int | float)]
            if len(choices) < len(found.values):
                node.fail(f"{what} must be {_FORMS}")
            quantity = Quantity(choices=tuple(float(value) for value in choices))
        else:
            quantity = Quantity(distribution=found.distribution, low=at_least, high=at_most)
    elif isinstance(node.value, list):
        quantity = Quantity(choices=tuple(item.number(what) for item in node.items()))
        if not quantity.choices:
            node.fail(f"{what} must be {_FORMS}")
    else:
        number = as_number(node.value)
        quantity = constant(node.fail(f"{what} must be {_FORMS}") if number is None else number)
    ends = quantity.choices
    if quantity.distribution is not None and quantity.distribution.kind != "normal":
        ends = quantity.distribution.parameters
    for end in ends:
        if not (math.isfinite(end) and at_least <= end <= at_most):
            node.fail(f"{what} must be {_bounds(at_least, at_most)}, not {end:g}")
    return quantity


def _bounds(low: float, high: float) -> str:
    if not (math.isfinite(low) or math.isfinite(high)):
        return "finite"
    if not math.isfinite(high):
        return f"at least {low:g}"
    return f"between {low:g} and {high:g}"


def read_count(node: YamlNode, what: str, *, most: int) -> Quantity:
    """Read a number of things, which is bounded."""
    quantity = read_quantity(node, what, at_least=0)
    if quantity.largest > most:
        node.fail(f"{what} may be {most} at most")
    return quantity


def read_numbers(node: YamlNode, what: str) -> Numbers:
    """Read three numbers, each of which may be drawn."""
    items = node.items()
    if len(items) != 3:
        node.fail(f"{what} must be a list of three, each {_FORMS}")
    x, y, z = (read_quantity(item, what) for item in items)
    return x, y, z


def read_vector(node: YamlNode, what: str) -> Vector3:
    """Read three plain numbers."""
    items = node.items()
    if len(items) != 3:
        node.fail(f"{what} must be a list of three numbers")
    x, y, z = (_finite(item, what) for item in items)
    return x, y, z


def _finite(node: YamlNode, what: str) -> float:
    number = node.number(what)
    return number if math.isfinite(number) else node.fail(f"{what} must be finite")


def read_pair(node: YamlNode, what: str) -> tuple[float, float]:
    """Read two plain numbers in ascending order."""
    items = node.items()
    if len(items) != 2:
        node.fail(f"{what} must be [low, high]")
    low, high = (_finite(item, what) for item in items)
    if not low <= high:
        node.fail(f"{what} must be [low, high], not [{low:g}, {high:g}]")
    return low, high


def read_colour(node: YamlNode, what: str) -> Colour:
    """Read `any`, a colour, a list of colours, or hue, saturation and value."""
    if node.value == "any":
        return Colour(hsv=(UNIT, UNIT, _BRIGHT))
    if isinstance(node.value, dict):
        found = node.check_keys(what, "hue", "saturation", "value")
        hue, saturation, value = (
            read_quantity(found[name], name, at_least=0, at_most=1) if name in found else default
            for name, default in (("hue", UNIT), ("saturation", UNIT), ("value", _BRIGHT))
        )
        return Colour(hsv=(hue, saturation, value))
    if not isinstance(node.value, list) or not node.value:
        _no_colour(node, what)
    rows = node.items() if isinstance(node.items()[0].value, list) else [node]
    return Colour(choices=tuple(_rgb(row, what) for row in rows))


def _no_colour(node: YamlNode, what: str) -> NoReturn:
    node.fail(f"{what} must be any, [red, green, blue] of 0 to 1, a list of such, or hue: …, saturation: …, value: …")


def _rgb(node: YamlNode, what: str) -> Vector3:
    if not isinstance(node.value, list) or len(node.value) != 3:
        _no_colour(node, what)
    rgb = read_vector(node, what)
    if not all(0.0 <= part <= 1.0 for part in rgb):
        _no_colour(node, what)
    return rgb
