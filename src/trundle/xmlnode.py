"""An XML tree that knows file and line, and which children and attributes nobody read.

The only door to lxml. Entities are never fetched and never expanded without bound, so a hostile file costs
no more than its own size.
"""

import io
import math
import re
from collections.abc import Iterator, Mapping
from copy import deepcopy
from pathlib import Path

from lxml import etree

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.spatial import Pose, Vector3

_MAX_BYTES = 64 * 1024 * 1024
_DEEPEST = 256
"""libxml2's own bound."""
_TOO_MUCH = etree.ErrorTypes.ERR_RESOURCE_LIMIT
_PLACEHOLDER = "__default__"
"""What libsdformat 1 wrote where there was nothing."""
_INTEGER = re.compile(r"[+-]?\d+")
_HEXADECIMAL = re.compile(r"0[xX][0-9a-fA-F]{1,16}")
_POSITION = re.compile(r", line \d+, column \d+$")
"""libxml2 repeats the place, which every message of ours starts with."""


def parse_xml(text: str | bytes, *, name: str, report: Diagnostics | None = None, deepest: int = _DEEPEST) -> "XmlNode":
    """Parse a document.

    Args:
        text: all of it.
        name: how messages call it.
        report: with one, slips that Gazebo's and ROS's old XML readers let pass are named there and let pass too.
        deepest: elements within one another that are read, for readers that do not go down all of them.

    Raises:
        DescriptionError: not XML, empty, or larger or deeper than any honest file.
    """
    data = text.encode() if isinstance(text, str) else text
    if len(data) > _MAX_BYTES:
        raise DescriptionError(Source(name), f"{len(data)} bytes; the largest file read is {_MAX_BYTES}")
    if not data.strip():
        raise DescriptionError(Source(name, 1), "the file is empty")
    # Tutorials and xacro templates often carry blank lines before <?xml …?>, which Gazebo and ROS accept.
    blank_lines = data[: len(data) - len(data.lstrip())].count(b"\n")
    if report is not None and not _says_or_is_unicode(data):
        report.warn(Source(name, 1), "bytes that are no UTF-8 in a file that names no encoding; read as Latin-1")
        data = data.decode("latin-1").encode()
    parser = _parser()
    try:
        root = etree.fromstring(data.lstrip(), parser)
    except etree.XMLSyntaxError as error:
        line = (error.lineno or 1) + blank_lines
        what = _POSITION.sub("", error.msg or "no element found")
        at = Source(name, line)
        if deepest > _DEEPEST and any(entry.type == _TOO_MUCH for entry in parser.error_log):
            root = _deep(data.lstrip(), deepest)
            if root is None:
                raise DescriptionError(
                    at, f"elements more than {deepest} deep in one another, or entities that multiply"
                ) from None
            return XmlNode(root, file=name, first_line=blank_lines)
        root = None if report is None else _recovered(data.lstrip())
        if root is None or report is None:
            raise DescriptionError(at, f"not well-formed XML: {what}") from None
        report.warn(at, f"not well-formed XML: {what}; read as Gazebo reads it")
    except ValueError as error:  # "Unicode strings with encoding declaration": only bytes come here
        raise DescriptionError(Source(name, 1), f"not readable as XML: {error}") from None
    return XmlNode(root, file=name, first_line=blank_lines)


_SLIPS = frozenset(
    {  # of attributes, only what `_with_quotes` does not mend
        etree.ErrorTypes.ERR_ENTITYREF_NO_NAME,
        etree.ErrorTypes.ERR_ENTITYREF_SEMICOL_MISSING,
        etree.ErrorTypes.ERR_UNDECLARED_ENTITY,
        etree.ErrorTypes.WAR_UNDECLARED_ENTITY,
        etree.ErrorTypes.ERR_HYPHEN_IN_COMMENT,
        etree.ErrorTypes.ERR_DOCUMENT_END,
        etree.ErrorTypes.ERR_NAME_REQUIRED,
        etree.ErrorTypes.ERR_RESERVED_XML_NAME,
        etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE,
    }
)
"""What TinyXML let pass: a bare &, `--` in a comment, text after the root, an unquoted value, a prefix nobody declared.
A document that ends too soon or closes what it did not open is none of these."""


_START_TAG = re.compile(rb"<[A-Za-z_][^<>]*>")
_ATTRIBUTE = re.compile(rb"""(\s*)([\w:.-]+)(\s*=\s*)("[^"]*"|'[^']*'|[^\s"'<>]+?(?=[\s>]|/>))""")


def _with_quotes(tag: re.Match[bytes]) -> bytes:
    """A start tag with every value in quotes and a space before every attribute; lines stay where they are."""

    def mended(attribute: re.Match[bytes]) -> bytes:
        space, name, equals, value = attribute.groups()
        quoted = value if value[:1] in b"\"'" else b'"' + value + b'"'
        return (space or b" ") + name + equals + quoted

    return _ATTRIBUTE.sub(mended, tag[0])


def _says_or_is_unicode(data: bytes) -> bool:
    """Whether a document names its encoding, or needs to name none."""
    if b"encoding" in data[:200].split(b"?>")[0] or data.startswith((b"\xff\xfe", b"\xfe\xff")):
        return True
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return True


def _deep(data: bytes, deepest: int) -> etree._Element | None:  # pyright: ignore[reportPrivateUsage]
    """The tree of a deep document; None where it is too deep, or defines entities, whose bounds fall with depth's."""
    if b"<!DOCTYPE" in data:
        return None
    walk = etree.iterparse(
        io.BytesIO(data),
        events=("start", "end"),
        remove_comments=True,
        remove_pis=True,
        no_network=True,
        huge_tree=True,
    )
    depth = 0
    try:
        for event, _ in walk:
            depth += 1 if event == "start" else -1
            if depth > deepest:
                return None
    except etree.XMLSyntaxError:
        return None
    return walk.root


def _parser(*, recover: bool = False) -> etree.XMLParser:
    return etree.XMLParser(
        resolve_entities="internal",  # pyright: ignore[reportArgumentType]  # lxml-stubs knows only bool
        no_network=True,
        load_dtd=False,
        huge_tree=False,
        remove_comments=True,
        remove_pis=True,
        recover=recover,
    )


def _recovered(data: bytes) -> etree._Element | None:  # pyright: ignore[reportPrivateUsage]
    """The tree of a document whose faults are all slips, or None."""
    parser = _parser(recover=True)
    try:
        root = etree.fromstring(_START_TAG.sub(_with_quotes, data), parser)
    except (etree.XMLSyntaxError, ValueError):
        return None
    return root if all(entry.type in _SLIPS for entry in parser.error_log) else None


def read_xml(path: Path, *, report: Diagnostics | None = None, deepest: int = _DEEPEST) -> "XmlNode":
    """Parse a file; `report` and `deepest` as for `parse_xml`.

    Raises:
        DescriptionError: as `parse_xml`, or the file cannot be read.
    """
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise DescriptionError(Source(str(path)), f"larger than {_MAX_BYTES} bytes, the largest file read")
        data = path.read_bytes()
    except FileNotFoundError:
        raise DescriptionError(Source(str(path)), "no such file") from None
    except IsADirectoryError:
        raise DescriptionError(Source(str(path)), "is a folder, not a file") from None
    except OSError as error:
        raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}") from None
    return parse_xml(data, name=str(path), report=report, deepest=deepest)


class XmlNode:
    """One element. Whatever is asked for counts as read; `report_unread` names the rest."""

    __slots__ = ("_children", "_element", "_file", "_first_line", "_read_attributes", "_read_once", "_read_tags")

    def __init__(self, element: etree._Element, *, file: str, first_line: int = 0) -> None:  # pyright: ignore[reportPrivateUsage]
        self._element = element
        self._file = file
        self._first_line = first_line
        self._read_tags: set[str] = set()
        self._read_once: set[str] = set()
        """Of which the first was asked for alone."""
        self._read_attributes: set[str] = set()
        self._children: list[XmlNode] | None = None

    @property
    def tag(self) -> str:
        """The element's name as written, prefix included."""
        tag = str(self._element.tag)
        if not tag.startswith("{"):
            return tag
        local = tag.rpartition("}")[2]
        return f"{self._element.prefix}:{local}" if self._element.prefix else local

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
        return next((child for child in self.children if child.tag == tag), None)

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
                elif name in kept:
                    continue
                else:
                    child = etree.SubElement(element, name)
                    child.text, child.sourceline = value, element.sourceline
                element.attrib.pop(name)
        self._children = None

    def rename(self, names: Mapping[str, str]) -> None:
        """Give this element and all below their later names."""
        for element in self._element.iter():
            element.tag = names.get(str(element.tag), element.tag)
        self._children = None

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

    def take_values(self, other: "XmlNode") -> None:
        """Take over another element's text, where it has any, and its attributes."""
        if other.text:
            self._element.text = other.text
        for name, value in other.attributes().items():
            self._element.set(name, value)

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


def parse_numbers(text: str) -> list[float] | None:
    """Numbers separated by white space, or None where one of them is not a number."""
    try:
        return [float(word) for word in text.split()]
    except ValueError:
        return None


def _shorten(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:37] + "...")
