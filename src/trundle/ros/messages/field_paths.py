"""Field paths after a topic's name: /odom/pose/pose, /tf/transforms[0]/child_frame_id."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from trundle.base.diagnostics import UsageError

from .message_library import Messages
from .printing import field_value

_PART = re.compile(r"(?P<name>\w+)(?:\[(?P<index>[^\]]*)\])?")


@dataclass(frozen=True, slots=True)
class FieldStep:
    """One step of a field path: a field, and an index or slice into it."""

    field: str
    index: int | slice | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TopicField:
    """A topic and a field path in its messages."""

    topic: str
    type: str
    path: str
    """Field path; '' for the whole message."""

    @property
    def steps(self) -> list[FieldStep]:
        """Parsed path.

        Raises:
            UsageError: the path is malformed.
        """
        return [_parse_step(part) for part in self.path.split("/") if part]


def split_topic(name: str, types: Mapping[str, str]) -> tuple[str, str] | None:
    """Split a name into topic and field path: the longest topic that the name starts with."""
    name = name.rstrip("/")
    matches = [topic for topic in types if name == topic or name.startswith((topic + "/", topic + "["))]
    topic = max(matches, key=len, default=None)
    return None if topic is None else (topic, name[len(topic) :].strip("/"))


def field_type(type_name: str, path: str, messages: Messages | None = None) -> str:
    """Return the ROS type of the field at a path.

    Args:
        type_name: type of the message.
        path: field path.
        messages: store of types; a new one by default.

    Raises:
        UsageError: there is no such field.
        MessageError: the type is unknown.
    """
    messages = messages or Messages()
    is_list = False
    for step in TopicField(topic="", type=type_name, path=path).steps:
        base, bracket, _ = type_name.partition("[")
        if bracket:
            raise UsageError(f"{step.field} is in each element of a {type_name}; write [0] or [:] before it")
        fields = {"secs": "uint32", "nsecs": "uint32"} if base in ("time", "duration") else messages.fields(base)
        if step.field not in fields:
            raise UsageError(f"no field named {step.field} in {base}; fields here: {', '.join(fields)}")
        type_name = fields[step.field]
        is_list |= isinstance(step.index, slice)
        if step.index is not None:
            type_name = type_name.partition("[")[0]
    return f"{type_name}[]" if is_list and "[" not in type_name else type_name


def value_at(message: Any, steps: list[FieldStep]) -> Any:
    """Return the value at a path; a slice gives the list of its elements' values.

    Raises:
        IndexError: an index is out of range.
        AttributeError: there is no such field.
    """
    for i, step in enumerate(steps):
        message = field_value(message, step.field)
        if step.index is None:
            continue
        message = message[step.index]
        if isinstance(step.index, slice) and steps[i + 1 :]:
            return [value_at(item, steps[i + 1 :]) for item in message]
    return message


def _parse_step(part: str) -> FieldStep:
    match = _PART.fullmatch(part)
    if match is None:
        raise UsageError(f"not a field: {part!r}; fields are written name, name[2] or name[1:3]")
    if match["index"] is None:
        return FieldStep(match["name"], None)
    try:
        numbers = [int(text) if text else None for text in match["index"].split(":")]
        if len(numbers) == 1 and numbers[0] is not None:
            return FieldStep(match["name"], numbers[0])
        if 2 <= len(numbers) <= 3:
            return FieldStep(match["name"], slice(*numbers))
    except ValueError:
        pass
    raise UsageError(f"not an index: [{match['index']}]; indices are written [2] or [1:3]")
