"""Text to parameter values: roslaunch's typing rules, and YAML with ROS' angles."""

import datetime
import math
import re
from typing import Any

import yaml

from .bounded import MATH_NAMES, ExpressionError
from .expression import evaluate
from .plan import ParamType, ParamValue

_MAX_YAML_BYTES = 16 * 1024 * 1024
_MAX_YAML_NODES = 500_000
"""Counted with aliases followed: a few lines of `&a [*b, *b]` can stand for billions of values."""


def convert_value(text: str, kind: ParamType) -> ParamValue:
    """Read a parameter's text as the type its `<param>` names.

    Raises:
        ValueError: the text is not of that type; the message says so.
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
            return load_yaml(text)


def _number(read: type[int] | type[float], text: str, what: str) -> int | float:
    try:
        return read(text)
    except ValueError:
        raise ValueError(f"{text!r} is not {what}") from None


def _auto_value(text: str) -> ParamValue:
    try:
        if "." in text:
            return float(text)
        # Python reads 1_000 as a number, ROS does not.
        if "_" not in text:
            return int(text)
    except ValueError:
        pass
    lowered = text.lower()
    return lowered == "true" if lowered in ("true", "false") else text


def read_flag(text: str) -> bool:
    """Read true, false, 1 or 0 in any case.

    Raises:
        ValueError: anything else.
    """
    match text.strip().lower():
        case "true" | "1":
            return True
        case "false" | "0":
            return False
        case _:
            raise ValueError(f"{text!r} is neither true, false, 1 nor 0")


class _Loader(yaml.SafeLoader):
    """Plain YAML data and rosparam's angles; no Python objects."""


def _radians(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
    text = str(loader.construct_scalar(node)).strip()
    inner = text[4:-1] if text.startswith("rad(") else text
    try:
        return float(evaluate(inner, MATH_NAMES))
    except (ExpressionError, TypeError, ValueError):
        raise ValueError(f"{text!r} is no angle in radians") from None


def _degrees(loader: yaml.SafeLoader, node: yaml.ScalarNode) -> float:
    text = str(loader.construct_scalar(node)).strip()
    inner = text[4:-1] if text.startswith("deg(") else text
    try:
        return float(inner) * math.pi / 180.0
    except ValueError:
        raise ValueError(f"{text!r} is no angle in degrees") from None


_Loader.add_constructor("!radians", _radians)
_Loader.add_constructor("!degrees", _degrees)
_Loader.add_implicit_resolver("!radians", re.compile(r"rad\([^)]*\)$"), ["r"])
_Loader.add_implicit_resolver("!degrees", re.compile(r"deg\([^)]*\)$"), ["d"])


def load_yaml(text: str) -> ParamValue:
    """Read YAML as rosparam does, dates as text.

    Raises:
        ValueError: not YAML, too large, or something that is no plain data; the message is one sentence.
    """
    if len(text) > _MAX_YAML_BYTES:
        raise ValueError(f"{len(text)} characters of YAML; the most read is {_MAX_YAML_BYTES}")
    try:
        loader = _Loader(text)  # looks at every character
    except yaml.YAMLError as error:
        raise ValueError(f"invalid YAML: {_one_line(error)}") from None
    try:
        node = loader.get_single_node()
        if node is None:
            return None
        if _expanded_size(node, {}) > _MAX_YAML_NODES:
            raise ValueError(f"invalid YAML: its aliases stand for more than {_MAX_YAML_NODES} values")
        return _plain(loader.construct_document(node))
    except yaml.YAMLError as error:
        raise ValueError(f"invalid YAML: {_one_line(error)}") from None
    except RecursionError:
        raise ValueError("invalid YAML: nested too deeply") from None
    except (TypeError, AttributeError) as error:  # an unhashable key, a merge of something that is no mapping
        raise ValueError(f"invalid YAML: {error}") from None
    finally:
        loader.dispose()


def _expanded_size(node: yaml.Node, known: dict[int, int]) -> int:
    """Count values with aliases followed; a node within itself is an error."""
    size = known.get(id(node))
    if size == 0:
        raise ValueError(f"invalid YAML: line {node.start_mark.line + 1}: a value contains itself")
    if size is not None:
        return size
    known[id(node)] = 0
    match node:
        case yaml.MappingNode(value=pairs):
            size = 1 + sum(_expanded_size(k, known) + _expanded_size(v, known) for k, v in pairs)
        case yaml.SequenceNode(value=items):
            size = 1 + sum(_expanded_size(item, known) for item in items)
        case _:
            size = 1
    known[id(node)] = size
    return size


def _one_line(error: yaml.YAMLError) -> str:
    if not isinstance(error, yaml.MarkedYAMLError):
        return " ".join(str(error).split())
    mark = error.problem_mark or error.context_mark
    what = error.problem or error.context or "unreadable"
    return what if mark is None else f"line {mark.line + 1}, column {mark.column + 1}: {what}"


def _plain(value: Any) -> ParamValue:
    match value:
        case dict():
            for key in value:
                if not isinstance(key, str | int | float | bool):
                    raise ValueError(f"invalid YAML: the key {key!r} cannot be a parameter's name")
            return {str(key): _plain(item) for key, item in value.items()}
        case list() | tuple() | set():
            return [_plain(item) for item in value]
        case datetime.date():  # datetime too; the parameter server has no use for either
            return value.isoformat()
        case _:
            return value
