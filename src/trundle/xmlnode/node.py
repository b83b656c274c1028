"""One element of an XML tree, which knows its file and line and which of its children and attributes nobody read."""

import math
import re
from collections.abc import Iterator, Mapping
from copy import deepcopy

from lxml import etree

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.spatial import Pose, Vector3

_PLACEHOLDER = "__default__"
"""What libsdformat 1 wrote where there was nothing."""
_INTEGER = re.compile(r"[+-]?\d+")
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")


class XmlNode:
    """One element. Whatever is asked for counts as read; `report_unread` names the rest."""

    __slots__ = (
        "_children",
        "_element",
        "_file",
        "_first_line",
        "_read_attributes",
        "_read_once",
        "_read_tags",
        "is_declared_late",
        "tag",
    )

    def __init__(self, element: etree._Element, *, file: str, first_line: int = 0) -> None:  # pyright: ignore[reportPrivateUsage]
        self._element = element
        self.tag = _written_tag(element)
        """The element's name as written, prefix included."""
        self._file = file
        self._first_line = first_line
        self._read_tags: set[str] = set()
        self._read_once: set[str] = set()
        """Of which the first was asked for alone."""
        self._read_attributes: set[str] = set()
        self._children: list[XmlNode] | None = None
        self.is_declared_late = False
        """Whether blank lines stand before its document's <?xml …?>, which TinyXML skips and expat refuses."""

    @property
    def at(self) -> Source:
        """Where the element starts."""
        line: int | None = self._element.sourceline
        return Source(self._file, None if line is None else line + self._first_line)

    @property
    def text(self) -> str:
        """The element's own text, stripped."""
        return (self._element.text or "").strip()

    def with_text_of(self, attribute: str) -> "XmlNode":
        """This element, its text taken from an attribute where it has that one."""
        value = self.attribute(attribute)
        if value is not None:
            self._element.text = value
        return self

    def write(self, tag: str, text: str) -> None:
        """Give a child this text; one is made where there is none."""
        element = self._element.find(tag)
        if element is None:
            element = etree.SubElement(self._element, tag)
            self._children = None
        element.text = text

    @property
    def raw_text(self) -> str:
        """All text directly inside the element, white space and text between children included."""
        return (self._element.text or "") + "".join(child.tail or "" for child in self._element)

    @property
    def children(self) -> list["XmlNode"]:
        """All child elements, in file order; asking for them does not mark them as read."""
        if self._children is None:
            self._children = [XmlNode(e, file=self._file, first_line=self._first_line) for e in self._element]
        return self._children

    def all(self, tag: str) -> list["XmlNode"]:
        """The children of that name."""
        self._read_tags.add(tag)
        self._read_once.discard(tag)
        return [child for child in self.children if child.tag == tag]

    def find(self, tag: str) -> "XmlNode | None":
        """The first child of that name, or None."""
        if tag not in self._read_tags:
            self._read_tags.add(tag)
            self._read_once.add(tag)
        for child in self.children:
            if child.tag == tag:
                return child
        return None

    def attribute(self, name: str) -> str | None:
        """An attribute's value as written, or None."""
        self._read_attributes.add(name)
        value = self._element.get(name)
        return None if value is None else str(value)

    def attributes(self) -> dict[str, str]:
        """Every attribute as written; all count as read."""
        items = {str(k): str(v) for k, v in self._element.attrib.items()}
        self._read_attributes.update(items)
        return items

    def required_attribute(self, name: str) -> str:
        """An attribute's value.

        Raises:
            DescriptionError: absent or empty.
        """
        value = self.attribute(name)
        if not value:
            raise DescriptionError(self.at, f"<{self.tag}> needs the attribute {name!r}")
        return value

    def string(self, tag: str, *, default: str = "") -> str:
        """A child's text, or the default where the child is absent."""
        child = self.find(tag)
        return default if child is None else child.text

    def number(self, tag: str, *, default: float, report: Diagnostics) -> float:
        """A child's number; an unreadable one is named and the default taken."""
        child = self.find(tag)
        return default if child is None else child.as_number(default=default, report=report)

    def flag(self, tag: str, *, default: bool, report: Diagnostics) -> bool:
        """A child's truth: true, false, 1 or 0."""
        child = self.find(tag)
        return default if child is None else child.as_flag(default=default, report=report)

    def integer(self, tag: str, *, default: int, report: Diagnostics) -> int:
        """A child's whole number; an unreadable one is named and the default taken."""
        child = self.find(tag)
        if child is None:
            return default
        if _INTEGER.fullmatch(child.text):
            return int(child.text)
        if _HEXADECIMAL.fullmatch(child.text):
            return int(child.text, 16)
        value = child.as_number(default=float(default), report=report)
        return int(value)

    def vector(self, tag: str, *, default: Vector3, report: Diagnostics) -> Vector3:
        """A child's three numbers."""
        child = self.find(tag)
        if child is None:
            return default
        values = child.as_numbers(3, report=report)
        return default if values is None else (values[0], values[1], values[2])

    def as_number(self, *, default: float, report: Diagnostics) -> float:
        """This element's text as one finite number."""
        values = self.as_numbers(1, report=report, fallback=f"{default:g} is used")
        return default if values is None else values[0]

    def as_flag(self, *, default: bool, report: Diagnostics) -> bool:
        """This element's text as a truth value."""
        text = self.text.lower()
        if text in ("true", "1"):
            return True
        if text in ("false", "0"):
            return False
        # libsdformat before 15 takes every other text for false.
        report.warn(self.at, f"<{self.tag}>: {self.text!r} is neither true nor false; read as {str(default).lower()}")
        return default

    def as_numbers(
        self, count: int, *, report: Diagnostics, fallback: str = "the default is used"
    ) -> list[float] | None:
        """This element's text as exactly so many finite numbers, or None after a warning."""
        values = parse_numbers(self.text)
        if values is None or len(values) != count:
            wanted = "one number" if count == 1 else f"{count} numbers"
            report.warn(self.at, f"<{self.tag}> wants {wanted}, got {_shorten(self.text)}; {fallback}")
            return None
        if not all(map(math.isfinite, values)):
            report.warn(self.at, f"<{self.tag}>: {_shorten(self.text)} is not finite; {fallback}")
            return None
        return values

    def as_pose(self, *, report: Diagnostics) -> Pose:
        """This element's text as x y z roll pitch yaw [m, rad]; empty text is the identity."""
        if not self.text:
            return Pose()
        values = self.as_numbers(6, report=report, fallback="the identity is used")
        return Pose() if values is None else Pose.from_rpy(*values)

    def attributes_to_children(self, kept: frozenset[str], texts: Mapping[str, str]) -> None:
        """Rewrite this element and all below as the later editions of a format have them.

        Args:
            kept: attributes that stay what they are.
            texts: element → the attribute that becomes its text. Every other attribute becomes a child.
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
        """Give this element and all below their later names."""
        for old, new in names.items():
            for element in self._element.iter(old):
                element.tag = new
        self.tag, self._children = _written_tag(self._element), None

    def append(self, other: "XmlNode") -> None:
        """Add a copy of another file's element below this one; it still says where it stands."""
        copied = deepcopy(other._element)
        copied.tail = None
        self.children.append(XmlNode(copied, file=other._file, first_line=other._first_line))
        self._element.append(copied)

    def remove(self, child: "XmlNode") -> None:
        """Take a child away."""
        self.children.remove(child)
        self._element.remove(child._element)

    def merge_values(self, other: "XmlNode", report: Diagnostics) -> None:
        """Take over another element's text, where it has any, and its attributes."""
        if other.text:
            self._element.text = other.text
        for name, value in other.attributes().items():
            try:
                self._element.set(name, value)
            except ValueError:  # lxml sets no name that XML does not allow
                report.warn(other.at, f"attribute {name!r} has an undeclared prefix; it is left out")

    def drop_attributes(self, *names: str) -> None:
        """Take attributes away."""
        for name in names:
            if name in self._element.attrib:
                del self._element.attrib[name]

    def xml(self) -> str:
        """The element written out again, children included."""
        return etree.tostring(self._element, encoding="unicode", with_tail=False)

    def mark_all_read(self) -> None:
        """Count everything below as read: for what is kept verbatim, such as a plugin's parameters."""
        pending = [self]
        while pending:
            node = pending.pop()
            node._read_tags.update(child.tag for child in node.children)
            node.attributes()
            pending += node.children

    def unread(self) -> Iterator["XmlNode"]:
        """The children nobody asked for."""
        return (child for child in self.children if child.tag not in self._read_tags)

    def report_unread(self, report: Diagnostics) -> None:
        """Name each child and attribute of this element that nobody read, once per tag."""
        named: set[str] = set()
        met: set[str] = set()
        for child in self.children:
            is_second = child.tag in met and child.tag in self._read_once and child.text != _PLACEHOLDER
            if is_second and child.tag not in named:
                named.add(child.tag)
                report.warn(child.at, f"a second <{child.tag}> in <{self.tag}>; the first one is used")
            met.add(child.tag)
        for child in self.unread():
            if child.tag not in named:
                named.add(child.tag)
                report.warn(child.at, f"<{child.tag}> in <{self.tag}> is not supported; it is ignored")
        for name in sorted(set(map(str, self._element.attrib)) - self._read_attributes):
            report.warn(self.at, f"attribute {name!r} of <{self.tag}> is not supported; it is ignored")


def _written_tag(element: etree._Element) -> str:  # pyright: ignore[reportPrivateUsage]
    tag = str(element.tag)
    if not tag.startswith("{"):
        return tag
    local = tag.rpartition("}")[2]
    return f"{element.prefix}:{local}" if element.prefix else local


def parse_numbers(text: str) -> list[float] | None:
    """Numbers separated by white space, or None where one of them is not a number."""
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return None


def _shorten(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:37] + "...")
