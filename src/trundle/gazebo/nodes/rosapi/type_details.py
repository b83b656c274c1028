"""Descriptions of message types: rosapi/TypeDef."""

from typing import Any

import numpy as np

from trundle.ros import Messages

_INTEGERS = frozenset({"byte", "char", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"})
_ATOMIC = _INTEGERS | {"bool", "float32", "float64", "string"}
_TIMES = ("time", "duration")
_EXAMPLES = {"bool": "False", "string": "", "float32": "0.0", "float64": "0.0"}
_TIME_FIELDS: dict[str, Any] = {
    "fieldnames": ["secs", "nsecs"],
    "fieldtypes": ["int32", "int32"],
    "fieldarraylen": [-1, -1],
    "examples": ["0", "0"],
    "constnames": [],
    "constvalues": [],
}


def type_details(messages: Messages, type_name: str) -> list[dict[str, object]]:
    """Describe a type and all its field types, each once, depth first.

    Raises:
        MessageError: no such type.
    """
    return _recurse(messages, type_name, set())


def _recurse(messages: Messages, type_name: str, visited: set[str]) -> list[dict[str, Any]]:
    if type_name in visited or type_name in _ATOMIC:
        return []
    visited.add(type_name)
    details = _describe(messages, type_name)
    return [details, *(inner for kind in details["fieldtypes"] for inner in _recurse(messages, kind, visited))]


def _describe(messages: Messages, type_name: str) -> dict[str, Any]:
    if type_name in _TIMES:
        return {"type": type_name, **_TIME_FIELDS}
    fields = messages.fields(type_name)
    parts = [kind.partition("[") for kind in fields.values()]
    constants = sorted(messages.constants(type_name).items())
    return {
        "type": type_name.replace("/msg/", "/"),
        "fieldnames": list(fields),
        "fieldtypes": [element for element, _, _ in parts],
        "fieldarraylen": [_length(bracket, rest) for _, bracket, rest in parts],
        "examples": [_example(element, bracket) for element, bracket, _ in parts],
        "constnames": [name for name, _ in constants],
        "constvalues": [_constant(*constant) for _, constant in constants],
    }


def _length(bracket: str, rest: str) -> int:
    """Return the length of an array; -1: no array; 0: any length."""
    return int(rest.rstrip("]") or 0) if bracket else -1


def _example(element: str, bracket: str) -> str:
    if bracket:
        return "[]"
    return _EXAMPLES.get(element, "0") if element in _ATOMIC else "{}"


def _constant(kind: str, text: str) -> str:
    """Return a constant as Python prints it."""
    if kind == "bool":
        return str(text.strip().lower() in ("true", "1"))
    if kind.startswith("float"):
        return str(float(np.float64(text)))
    return text
