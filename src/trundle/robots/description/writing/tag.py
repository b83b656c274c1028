"""XML elements for writing, with numbers in the fewest digits that read back exactly."""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from html import escape

from trundle.spatial import Pose

_POSE_TOLERANCE = 1e-14
"""Maximum coordinate of a pose that counts as the identity, up to rounding."""
Value = str | float | bool | Iterable[float] | None


@dataclass(slots=True)
class Tag:
    """Element with attributes, and a value or children."""

    name: str
    attributes: Mapping[str, str] = field(default_factory=dict[str, str])
    text: str = ""
    children: list["Tag | str"] = field(default_factory=list["Tag | str"])
    """Child elements; a str is raw XML."""
    optional: bool = False
    """True if the element is omitted while empty."""

    def add(self, name: str, text: Value = None, /, **attributes: str) -> "Tag":
        """Append a child and return it."""
        child = Tag(name, attributes, format_value(text))
        self.children.append(child)
        return child

    def add_optional(self, name: str) -> "Tag":
        """Append a child that is omitted while empty."""
        child = Tag(name, optional=True)
        self.children.append(child)
        return child

    def add_unless(self, name: str, value: Value, default: object) -> None:
        """Append a child unless the value is the default."""
        if value != default:
            self.add(name, value)

    def add_pose(self, pose: Pose, relative_to: str | None = None) -> None:
        """Append <pose>, unless it is the identity."""
        attributes = {} if relative_to is None else {"relative_to": relative_to}
        numbers = pose.as_list()
        if max(map(abs, numbers)) < _POSE_TOLERANCE and not attributes:
            return
        self.children.append(Tag("pose", attributes, format_value(numbers)))

    def lines(self, indent: int = 0) -> list[str]:
        """Return the element as lines of XML."""
        if self._is_blank():
            return []
        pad = "  " * indent
        attributes = "".join(f' {key}="{_quoted(text)}"' for key, text in self.attributes.items())
        if not self.children:
            end = f">{escape(self.text, quote=False)}</{self.name}>" if self.text else "/>"
            return [f"{pad}<{self.name}{attributes}{end}"]
        inner: list[str] = []
        for child in self.children:
            inner += [pad + "  " + child] if isinstance(child, str) else child.lines(indent + 1)
        return [f"{pad}<{self.name}{attributes}>", *inner, f"{pad}</{self.name}>"]

    def _is_blank(self) -> bool:
        return self.optional and all(isinstance(child, Tag) and child._is_blank() for child in self.children)

    def document(self) -> str:
        """Return the element as a file."""
        return "\n".join(['<?xml version="1.0"?>', *self.lines()]) + "\n"


def format_value(value: Value) -> str:
    """Return a value as XML text."""
    match value:
        case None:
            return ""
        case str():
            return value
        case bool():
            return "true" if value else "false"
        case float() | int():
            return _number(value)
        case _:
            return " ".join(map(_number, value))


def _number(value: float) -> str:
    whole = math.isfinite(value) and float(value).is_integer() and abs(value) < 1e15
    return str(int(value)) if whole else repr(value)


def _quoted(text: str) -> str:
    """Return an attribute's text with tabs and line ends escaped, which a parser would read as spaces."""
    return escape(text).replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")
