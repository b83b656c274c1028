"""Conversion of parameters between the parameter server's types and the protocol's."""

import base64
import binascii
import math
from collections.abc import Iterator, Mapping

import msgspec

from ..clients.protocol import Parameter

_NUMBERS = (int, float)


def flatten(name: str, value: object) -> Iterator[tuple[str, object]]:
    """Yield a parameter, or all parameters of a namespace."""
    if isinstance(value, Mapping) and value:
        for key, inner in value.items():
            yield from flatten(f"{name.rstrip('/')}/{key}", inner)
    else:
        yield name, value


def to_parameter(name: str, value: object) -> Parameter:
    """Convert a value of the parameter server; the type's name distinguishes whole floats from integers."""
    match value:
        case bytes():
            return Parameter(name, base64.b64encode(value).decode(), "byte_array")
        case bool() | int() | str():
            return Parameter(name, value)
        case float():
            return Parameter(name, value, "float64") if math.isfinite(value) else Parameter(name, str(value))
        case list() if value and _is_float_array(value):
            return Parameter(name, value, "float64_array")
        case _:
            return Parameter(name, _plain(value))


def from_parameter(parameter: Parameter) -> object:
    """Convert a client's value.

    Raises:
        ValueError: the value does not have the declared type.
        OverflowError: a number exceeds the range of floats.
    """
    value = parameter.value
    match parameter.type:
        case None:
            return value
        case "byte_array" if isinstance(value, str):
            try:
                return base64.b64decode(value, validate=True)
            except binascii.Error as error:
                raise ValueError(f"not base64: {error}") from None
        case "float64" if _is_number(value):
            return float(value)  # pyright: ignore[reportArgumentType]
        case "float64_array" if isinstance(value, list) and all(map(_is_number, value)):
            return [float(number) for number in value]
        case kind:
            raise ValueError(f"{str(value)[:100]!r} is not a {kind}")


def _is_number(value: object) -> bool:
    return isinstance(value, _NUMBERS) and not isinstance(value, bool)


def _is_float_array(values: list[object]) -> bool:
    numbers = all(_is_number(value) for value in values)
    return numbers and any(isinstance(value, float) for value in values) and all(map(math.isfinite, values))  # pyright: ignore[reportArgumentType]


def _plain(value: object) -> object:
    """Return a nested value in JSON's types."""
    return msgspec.to_builtins(value, enc_hook=str)
