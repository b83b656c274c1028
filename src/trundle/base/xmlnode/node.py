"""XML element with file and line, and bookkeeping of unread children and attributes."""

import math
import re
from collections.abc import Iterator, Mapping
from copy import deepcopy

from lxml import etree

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.spatial import Pose, Vector3

from .numbers import parse_numbers, shorten
from .ranges import MAX_LENGTH, MAX_NUMBER, is_within

_PLACEHOLDER = "__default__"
"""Placeholder for a missing value in libsdformat 1."""
_INTEGER = re.compile(r"[+-]?\d+")
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")


class XmlNode:
    """Element whose accessors mark children and attributes as read; `report_unread` lists the rest."""

    __slots__ = (
        "_children",
        "_element",
        "_file",
        "_first_line",
        "_read_attributes",
        "_read_once",
        "_read_tags",
        "is_declared_late",
        "report",
        "tag",
    )

    def __init__(
        self,
        element: etree._Element,  # pyright: ignore[reportPrivateUsage]
        *,
        file: str,
        report: Diagnostics,
        first_line: int = 0,
    ) -> None:
        self._element = element
        self.tag = _written_tag(element)
        """Element name as written, with prefix."""
        self.report = report
        """Collects warnings about invalid values."""
        self._file = file
        self._first_line = first_line
        self._read_tags: set[str] = set()
        self._read_once: set[str] = set()
        """Tags of which only the first child was read."""
        self._read_attributes: set[str] = set()
        self._children: list[XmlNode] | None = None
        self.is_declared_late = False
        """True if blank lines precede <?xml …?> in the document, which TinyXML skips and expat refuses."""

    @property
    def at(self) -> Source:
        """Position of the start tag."""
        line: int | None = self._element.sourceline
        return Source(self._file, None if line is None else line + self._first_line)

    @property
    def text(self) -> str:
        """Text of the element, stripped."""
        return (self._element.text or "").strip()

    def with_text_of(self, attribute: str) -> "XmlNode":
        """Replace the text by an attribute's value if it exists; return the element."""
        value = self.attribute(attribute)
        if value is not None:
            self._element.text = value
        return self

    def write(self, tag: str, text: str) -> None:
        """Set a child's text, creating the child if needed."""
        element = self._element.find(tag)
        if element is None:
            element = etree.SubElement(self._element, tag)
            self._children = None
        element.text = text

    @property
    def raw_text(self) -> str:
        """Text directly inside the element, including white space and text between children."""
        return (self._element.text or "") + "".join(child.tail or "" for child in self._element)

    @property
    def children(self) -> list["XmlNode"]:
        """Child elements in file order; access does not mark them as read."""
        if self._children is None:
            self._children = [
                XmlNode(e, file=self._file, report=self.report, first_line=self._first_line) for e in self._element
            ]
        return self._children

    def count_elements(self) -> int:
        """Count this element and its descendants."""
        return sum(1 for _ in self._element.iter())

    def all(self, tag: str) -> list["XmlNode"]:
        """Return the children with a tag."""
        self._read_tags.add(tag)
        self._read_once.discard(tag)
        return [child for child in self.children if child.tag == tag]

    def find(self, tag: str) -> "XmlNode | None":
        """Return the first child with a tag, or None."""
        if tag not in self._read_tags:
            self._read_tags.add(tag)
            self._read_once.add(tag)
        for child in self.children:
            if child.tag == tag:
                return child
        return None

    def attribute(self, name: str) -> str | None:
        """Return an attribute's value as written, or None."""
        self._read_attributes.add(name)
        value = self._element.get(name)
        return None if value is None else str(value)

    def attributes(self) -> dict[str, str]:
        """Return every attribute as written, and mark all as read."""
        items = {str(k): str(v) for k, v in self._element.attrib.items()}
        self._read_attributes.update(items)
        return items

    def required_attribute(self, name: str) -> str:
        """Return an attribute's value.

        Raises:
            DescriptionError: absent or empty.
        """
        value = self.attribute(name)
        if not value:
            raise DescriptionError(self.at, f"<{self.tag}> needs the attribute {name!r}", "missing-attribute")
        return value

    def string(self, tag: str, *, default: str = "") -> str:
        """Return a child's text, or the default if the child is absent."""
        child = self.find(tag)
        return default if child is None else child.text

    def number(self, tag: str, *, default: float, limit: float = MAX_NUMBER) -> float:
        """Return a child's number, or the default with a warning if it is invalid or beyond the limit."""
        child = self.find(tag)
        return default if child is None else child.as_number(default=default, limit=limit)

    def flag(self, tag: str, *, default: bool) -> bool:
        """Return a child's boolean: true, false, 1 or 0."""
        child = self.find(tag)
        return default if child is None else child.as_flag(default=default)

    def integer(self, tag: str, *, default: int) -> int:
        """Return a child's integer, or the default with a warning if it is invalid."""
        child = self.find(tag)
        if child is None:
            return default
        if _INTEGER.fullmatch(child.text):
            return int(child.text)
        if _HEXADECIMAL.fullmatch(child.text):
            return int(child.text, 16)
        value = child.as_number(default=float(default))
        return int(value)

    def vector(self, tag: str, *, default: Vector3, limit: float = MAX_NUMBER) -> Vector3:
        """Return a child's three numbers, or the default with a warning if one is invalid or beyond the limit."""
        child = self.find(tag)
        if child is None:
            return default
        values = child.as_numbers(3, limit=limit)
        return default if values is None else (values[0], values[1], values[2])

    def as_number(self, *, default: float, limit: float = MAX_NUMBER) -> float:
        """Return the text as one finite number."""
        values = self.as_numbers(1, fallback=f"{default:g} is used", limit=limit)
        return default if values is None else values[0]

    def as_flag(self, *, default: bool) -> bool:
        """Return the text as a boolean."""
        text = self.text.lower()
        if text in ("true", "1"):
            return True
        if text in ("false", "0"):
            return False
        # libsdformat before 15 reads every other text as false.
        self.report.warn(
            self.at,
            f"<{self.tag}>: {self.text!r} is neither true nor false; read as {str(default).lower()}",
            "invalid-value",
        )
        return default

    def as_numbers(
        self, count: int, *, fallback: str = "the default is used", limit: float = MAX_NUMBER
    ) -> list[float] | None:
        """Return the text as exactly `count` finite numbers up to the limit, or None with a warning."""
        values = parse_numbers(self.text)
        if values is None or len(values) != count:
            expected = "one number" if count == 1 else f"{count} numbers"
            self.report.warn(
                self.at, f"<{self.tag}> needs {expected}, got {shorten(self.text)}; {fallback}", "invalid-value"
            )
            return None
        if not all(map(math.isfinite, values)):
            self.report.warn(self.at, f"<{self.tag}>: {shorten(self.text)} is not finite; {fallback}", "invalid-value")
            return None
        if not is_within(values, limit):
            problem = f"{shorten(self.text)} is not within ±{limit:g}"
            self.report.warn(self.at, f"<{self.tag}>: {problem}; {fallback}", "out-of-range")
            return None
        return values

    def as_pose(self) -> Pose:
        """Return the text as a pose x y z roll pitch yaw [m, rad]; empty text is the identity."""
        if not self.text:
            return Pose()
        values = self.as_numbers(6, fallback="the identity is used", limit=MAX_LENGTH)
        return Pose() if values is None else Pose.from_rpy(*values)

    def attributes_to_children(self, kept: frozenset[str], texts: Mapping[str, str]) -> None:
        """Convert attributes of this element and its descendants to elements, as in later versions of a format.

        Args:
            kept: names of attributes that are not converted.
            texts: element → attribute that becomes its text. Every other attribute becomes a child.
        """
        for element in self._element.iter():
            values = {str(name): str(value) for name, value in element.attrib.items()}
            for name, value in values.items():
                if texts.get(str(element.tag)) == name:
                    element.text = value
                elif name in kept or ":" in name or "}" in name:  # a prefixed one belongs to another format
                    continue
                else:
                    child = etree.SubElement(element, name)
                    child.text, child.sourceline = value, element.sourceline
                element.attrib.pop(name)
        self._children = None

    def rename(self, names: Mapping[str, str]) -> None:
        """Rename elements among this element and its descendants."""
        for old, new in names.items():
            for element in self._element.iter(old):
                element.tag = new
        self.tag, self._children = _written_tag(self._element), None

    def append(self, other: "XmlNode") -> None:
        """Append a copy of another file's element, which keeps its source position."""
        copied = deepcopy(other._element)
        copied.tail = None
        self.children.append(XmlNode(copied, file=other._file, report=self.report, first_line=other._first_line))
        self._element.append(copied)

    def remove(self, child: "XmlNode") -> None:
        """Remove a child."""
        self.children.remove(child)
        self._element.remove(child._element)

    def merge_values(self, other: "XmlNode") -> None:
        """Copy another element's text, unless empty, and its attributes."""
        if other.text:
            self._element.text = other.text
        for name, value in other.attributes().items():
            try:
                self._element.set(name, value)
            except ValueError:  # lxml refuses names that XML does not allow
                self.report.warn(
                    other.at, f"attribute {name!r} has an undeclared prefix; it is left out", "undeclared-prefix"
                )

    def drop_attributes(self, *names: str) -> None:
        """Remove attributes."""
        for name in names:
            if name in self._element.attrib:
                del self._element.attrib[name]

    def xml(self) -> str:
        """Return the element as XML text, with children."""
        return etree.tostring(self._element, encoding="unicode", with_tail=False)

    def mark_all_read(self) -> None:
        """Mark all descendants as read, for content kept verbatim, such as a plugin's parameters."""
        pending = [self]
        while pending:
            node = pending.pop()
            node._read_tags.update(child.tag for child in node.children)
            node.attributes()
            pending += node.children

    def unread(self) -> Iterator["XmlNode"]:
        """Return the children that were not read."""
        return (child for child in self.children if child.tag not in self._read_tags)

    def report_unread(self, report: Diagnostics) -> None:
        """Warn of each child and attribute of this element that was not read, once per tag."""
        reported: set[str] = set()
        seen: set[str] = set()
        for child in self.children:
            is_second = child.tag in seen and child.tag in self._read_once and child.text != _PLACEHOLDER
            if is_second and child.tag not in reported:
                reported.add(child.tag)
                report.warn(
                    child.at, f"a second <{child.tag}> in <{self.tag}>; the first one is used", "duplicate-element"
                )
            seen.add(child.tag)
        for child in self.unread():
            if child.tag not in reported:
                reported.add(child.tag)
                report.warn(
                    child.at, f"<{child.tag}> in <{self.tag}> is not supported; it is ignored", "unsupported-element"
                )
        for name in sorted(set(map(str, self._element.attrib)) - self._read_attributes):
            report.warn(
                self.at, f"attribute {name!r} of <{self.tag}> is not supported; it is ignored", "unsupported-attribute"
            )


def _written_tag(element: etree._Element) -> str:  # pyright: ignore[reportPrivateUsage]
    tag = str(element.tag)
    if not tag.startswith("{"):
        return tag
    local = tag.rpartition("}")[2]
    return f"{element.prefix}:{local}" if element.prefix else local
