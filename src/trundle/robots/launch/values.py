"""Parameter values from text: roslaunch's typing rules, and YAML with rosparam's angles."""

import datetime
import math
import re
from collections.abc import Callable
from typing import Any

import yaml

from trundle.base.expressions import MATH_NAMES, Interpreter
from trundle.base.yaml_loader import BoundedLoader, load_yaml as load_plain_yaml, one_line

from .plan import ParamType, ParamValue


def convert_value(text: str, kind: ParamType, count: Callable[[int], None] | None = None) -> ParamValue:
    """Convert a parameter's text to its type; `count` as in `load_yaml`.

    Raises:
        ValueError: the text does not fit the type.
    """
    match kind:
        case "auto":
            return _auto_value(text)
        case "str":
            return text
        case "int":
            return _number(int, text, "an integer")
        case "double":
            return _number(float, text, "a number")
        case "bool":
            return read_flag(text)
        case "yaml":
            return load_yaml(text, count)


def _number(read: type[int] | type[float], text: str, kind: str) -> int | float:
    try:
        return read(text)
    except ValueError:
        raise ValueError(f"{text!r} is not {kind}") from None


def _auto_value(text: str) -> ParamValue:
    try:
        if "." in text:
            return float(text)
        # Python accepts 1_000 as a number, ROS does not.
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    lowered = text.lower()
    return lowered == "true" if lowered in ("true", "false") else text


def read_flag(text: str) -> bool:
    """Parse true, false, 1 or 0 in any case.

    Raises:
        ValueError: the text is none of these.
    """
    match text.strip().lower():
        case "true" | "1":
            return True
        case "false" | "0":
            return False
        case _:
            raise ValueError(f"{text!r} is neither true, false, 1 nor 0")


class _Loader(BoundedLoader):
    """YAML loader for plain data and rosparam's angles, without Python objects."""

    def __init__(self, stream: str, count: Callable[[int], None] | None = None) -> None:
        super().__init__(stream, count)
        self.interpreter = Interpreter()


def _radians(loader: _Loader, node: yaml.ScalarNode) -> float:
    text = str(loader.construct_scalar(node)).strip()
    inner = text[4:-1] if text.startswith("rad(") else text
    try:
        return loader.interpreter.evaluate_number(inner, MATH_NAMES)
    except Exception:  # an expression may raise anything
        raise ValueError(f"{text!r} is not an angle in radians") from None


def _degrees(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
    text = str(loader.construct_scalar(node)).strip()
    inner = text[4:-1] if text.startswith("deg(") else text
    try:
        return float(inner) * math.pi / 180.0
    except ValueError:
        raise ValueError(f"{text!r} is not an angle in degrees") from None


_Loader.add_constructor("!radians", _radians)
_Loader.add_constructor("!degrees", _degrees)
_Loader.add_implicit_resolver("!radians", re.compile(r"rad\([^)]*\)$"), ["r"])
_Loader.add_implicit_resolver("!degrees", re.compile(r"deg\([^)]*\)$"), ["d"])


def load_yaml(text: str, count: Callable[[int], None] | None = None) -> ParamValue:
    """Parse YAML as rosparam does; dates become text.

    Args:
        text: YAML document.
        count: called with the number of further values, with aliases expanded.

    Raises:
        ValueError: the text is invalid, too large, or contains more than plain data.
    """
    try:
        return _plain(load_plain_yaml(text, _Loader, count))
    except yaml.YAMLError as error:
        raise ValueError(f"invalid YAML: {one_line(error)}") from None


def _plain(value: Any) -> ParamValue:
    match value:
        case dict():
            for key in value:
                if not isinstance(key, str | int | float | bool):
                    raise ValueError(f"invalid YAML: the key {key!r} cannot be a parameter's name")
            return {str(key): _plain(item) for key, item in value.items()}
        case list() | tuple() | set():
            return [_plain(item) for item in value]
        case datetime.date():  # `date` covers `datetime`; neither can be a parameter
            return value.isoformat()
        case _:
            return value
