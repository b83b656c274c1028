"""Fields of a form: values read from an element's children and attributes, and written to them."""

import math

from msgspec import UNSET, Struct

from trundle.base.diagnostics import UsageError
from trundle.base.xmlnode import XmlElement, parse_numbers
from trundle.page import Value

from ..world.draft_info import DraftField, FieldKind, ShownValue

_COUNTS: dict[str, int] = {"number": 1, "pose": 6, "color": 4}
_ANGLE_ATTRIBUTES = ("degrees", "rotation_format")


class Field(Struct, frozen=True, kw_only=True):
    """Value of a part."""

    name: str
    """Path of an element, "inertial/mass", or of an attribute, "axis/@name"."""
    label: str
    kind: FieldKind = "number"
    unit: str = ""
    labels: tuple[str, ...] = ()
    """Names of a vector's components."""
    default: str = ""
    """Text if the file has none."""
    choices: tuple[str, ...] = ()
    minimum: float = -1e9
    maximum: float = 1e9
    also: tuple[str, ...] = ()
    """Further paths to which the value is written."""
    derived: tuple[float, ...] | None = None
    """Value of a computed field, which has no element."""


class Section(Struct, frozen=True, kw_only=True):
    """Fields under one heading."""

    title: str
    fields: tuple[Field, ...]


def shown_field(element: XmlElement, field: Field) -> DraftField:
    """Return a field with its value, for the client."""
    text = read_text(element, field.name)
    has_numbers = field.kind in ("number", "vector", "pose", "color")
    value: ShownValue = text
    default: ShownValue = field.default
    if has_numbers:
        value = _numbers(text, field) if field.derived is None else field.derived
        default = _numbers(field.default, field)
    elif field.kind == "flag":
        value = None if text is None else text in ("1", "true")
        default = field.default == "true"
    return DraftField(
        name=field.name,
        label=field.label,
        kind=field.kind,
        value=value,
        default=default,
        unit=field.unit,
        labels=field.labels,
        choices=field.choices,
        minimum=field.minimum if has_numbers else UNSET,
        maximum=field.maximum if has_numbers else UNSET,
    )


def _numbers(text: str | None, field: Field) -> tuple[float, ...] | None:
    numbers = tuple(parse_numbers(text or "") or ())
    if not numbers or not all(map(math.isfinite, numbers)):
        return None
    if field.kind == "color" and len(numbers) == 3:
        numbers = (*numbers, 1.0)
    return numbers if len(numbers) == count_of(field) else None


def count_of(field: Field) -> int:
    """Return the number of a field's components."""
    return _COUNTS.get(field.kind, len(field.labels))


def read_text(element: XmlElement, path: str) -> str | None:
    """Return the text at a path; None if there is none."""
    at: XmlElement | None = element
    for step in path.split("/"):
        if step.startswith("@"):
            return None if at is None else at.get(step[1:])
        at = None if at is None else at.find(step)
    return None if at is None else at.text


def write_value(element: XmlElement, field: Field, value: Value) -> None:
    """Write a value to its element, which is created if necessary; None removes the element.

    Raises:
        UsageError: the value is invalid.
    """
    text = _checked(element, field, value)
    for path in (field.name, *field.also):
        if text is None:
            _remove(element, path)
        else:
            _write(element, path, text)


def _checked(element: XmlElement, field: Field, value: Value) -> str | None:
    """Return a value as text."""
    if value is None:
        return None
    if field.kind in ("text", "choice", "flag"):
        if not isinstance(value, str):
            raise UsageError(f"{field.label} must be text")
        if field.choices and value not in field.choices:
            raise UsageError(f"{field.label} must be one of: {', '.join(field.choices)}")
        if field.kind == "flag" and value not in ("true", "false"):
            raise UsageError(f"{field.label} must be true or false")
        if any(ord(letter) < 32 for letter in value):
            raise UsageError(f"{field.label} must be one line of text")
        return value
    if isinstance(value, str) or len(value) != count_of(field):
        raise UsageError(f"{field.label} needs {count_of(field)} numbers")
    if not all(number is None or field.minimum <= number <= field.maximum for number in value):
        raise UsageError(f"{field.label}: enter numbers from {field.minimum:g} to {field.maximum:g}")
    current = _numbers(read_text(element, field.name), field) or _numbers(field.default, field) or (0.0,) * len(value)
    return number_text([old if new is None else new for new, old in zip(value, current, strict=True)])


def number_text(numbers: "tuple[float, ...] | list[float]") -> str:
    """Return numbers as text with 12 digits, which hides rounding errors."""
    return " ".join(f"{0.0 if abs(number) < 1e-14 else number:.12g}" for number in numbers)


def _write(element: XmlElement, path: str, text: str) -> None:
    at = element
    for step in path.split("/"):
        if step.startswith("@"):
            at.set(step[1:], text)
            return
        at = at.put(step)
    for attribute in _ANGLE_ATTRIBUTES if at.tag == "pose" else ():
        at.set(attribute, None)
    at.text = text


def _remove(element: XmlElement, path: str) -> None:
    at: XmlElement | None = element
    for step in path.split("/"):
        if at is None:
            return
        if step.startswith("@"):
            at.set(step[1:], None)
            return
        at = at.find(step)
    if at is not None:
        at.remove()
