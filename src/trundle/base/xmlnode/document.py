"""XML document for editing, which preserves comments, processing instructions and white space."""

from collections.abc import Sequence
from copy import deepcopy
from pathlib import Path
from typing import Self

from lxml import etree

from trundle.base.diagnostics import DescriptionError, Source
from trundle.base.files import read_file

from .tinyxml import rewrite_as_xml

_INDENT = "  "
_Element = etree._Element  # pyright: ignore[reportPrivateUsage]


class XmlDocument:
    """Document whose elements can be changed."""

    def __init__(self, text: str | bytes, *, name: str) -> None:
        """Parse a text; comments are lost only if it is not XML but accepted by Gazebo's parser.

        Args:
            text: the whole document.
            name: file name in messages.

        Raises:
            DescriptionError: neither XML nor accepted by Gazebo's parser.
        """
        whole = text.encode() if isinstance(text, str) else text
        data = whole.lstrip()
        self._first_line = whole[: len(whole) - len(data)].count(b"\n")
        try:
            root = etree.fromstring(data, _parser())
        except (etree.XMLSyntaxError, ValueError) as error:
            tolerated = rewrite_as_xml(data)
            root = None if tolerated is None else etree.fromstring(tolerated, _parser(recover=True))
            if root is None:
                raise DescriptionError(Source(name), f"not well-formed XML: {error}", "malformed-xml") from None
        self.root = XmlElement(root)
        """Root element."""

    @classmethod
    def read(cls, path: Path) -> Self:
        """Read a file.

        Raises:
            DescriptionError: see the constructor; or the file cannot be read.
        """
        try:
            return cls(read_file(path, max_bytes=64 * 1024 * 1024), name=str(path))
        except OSError as error:
            raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}", "unreadable-file") from None

    def line(self, element: "XmlElement") -> int | None:
        """Return the line of an element as it was parsed."""
        line: int | None = element.raw.sourceline
        return None if line is None else line + self._first_line

    def text(self) -> bytes:
        """Return the document as UTF-8 with a declaration."""
        root = self.root.raw
        before = [etree.tostring(node, with_tail=False) for node in root.itersiblings(preceding=True)]
        after = [etree.tostring(node, with_tail=False) for node in root.itersiblings()]
        whole = etree.tostring(root, encoding="utf-8", with_tail=False)
        return b"\n".join([b'<?xml version="1.0"?>', *reversed(before), whole, *after, b""])


class XmlElement:
    """Element of a document for editing."""

    __slots__ = ("raw",)

    def __init__(self, raw: _Element) -> None:
        self.raw = raw

    @classmethod
    def parse(cls, xml: str) -> Self:
        """Return the element of an XML text."""
        return cls(etree.fromstring(xml.encode(), _parser()))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, XmlElement) and self.raw is other.raw

    def __hash__(self) -> int:
        return hash(self.raw)

    @property
    def tag(self) -> str:
        """Name of the element."""
        return str(self.raw.tag)

    @property
    def text(self) -> str:
        """Text of the element, stripped."""
        return (self.raw.text or "").strip()

    @text.setter
    def text(self, text: str) -> None:
        self.raw.text = text

    def get(self, name: str) -> str | None:
        """Return an attribute's value, or None."""
        value = self.raw.get(name)
        return None if value is None else str(value)

    def set(self, name: str, value: str | None) -> None:
        """Set an attribute; None removes it."""
        if value is None:
            if name in self.raw.attrib:
                del self.raw.attrib[name]
        else:
            self.raw.set(name, value)

    @property
    def children(self) -> "list[XmlElement]":
        """Child elements in file order, without comments."""
        return [XmlElement(child) for child in self.raw.iterchildren("*")]

    def all(self, tag: str) -> "list[XmlElement]":
        """Return the children with a tag."""
        return [child for child in self.children if child.tag == tag]

    def find(self, tag: str) -> "XmlElement | None":
        """Return the first child with a tag, or None."""
        return next((child for child in self.children if child.tag == tag), None)

    def descendants(self) -> "list[XmlElement]":
        """Return all descendants, in file order."""
        return [XmlElement(element) for element in self.raw.iterdescendants("*")]

    def ancestors(self) -> "list[XmlElement]":
        """Return the ancestors, innermost first."""
        return [XmlElement(element) for element in self.raw.iterancestors()]

    def put(self, tag: str, text: str | None = None) -> "XmlElement":
        """Return the first child with a tag, appended if missing; set its text unless None."""
        child = self.find(tag)
        if child is None:
            child = self.insert(XmlElement(etree.Element(tag)))
        if text is not None:
            child.text = text
        return child

    def insert(self, child: "XmlElement", *, at: int | None = None) -> "XmlElement":
        """Insert an element before child number `at` (comments count; None: at the end), and return it."""
        parent, new = self.raw, child.raw
        depth = 1 + sum(1 for _ in parent.iterancestors())
        outer, inner = f"\n{_INDENT * (depth - 1)}", f"\n{_INDENT * depth}"
        index = len(parent) if at is None else at
        if len(new):
            etree.indent(new, _INDENT, level=depth)
        if len(parent) == 0:
            parent.text = (parent.text or "").rstrip() + inner
        elif index == len(parent):
            last = parent[-1]
            outer = last.tail if last.tail and not last.tail.strip() else outer
            last.tail = parent.text if parent.text and not parent.text.strip() else inner
        new.tail = outer if index == len(parent) else inner
        parent.insert(index, new)
        return child

    def replace(self, elements: "Sequence[XmlElement]") -> None:
        """Replace the element by other elements."""
        parent = self.raw.getparent()
        assert parent is not None, "the root element stays"
        container, at = XmlElement(parent), parent.index(self.raw)
        for offset, element in enumerate(elements):
            container.insert(element, at=at + offset)
        self.remove()

    def remove(self) -> None:
        """Remove the element; comments around it stay."""
        parent, before, tail = self.raw.getparent(), self.raw.getprevious(), self.raw.tail
        assert parent is not None, "the root element stays"
        if self.raw.getnext() is None:  # the element is the last child
            if before is None:
                parent.text = tail
            else:
                before.tail = tail
        parent.remove(self.raw)

    def copy(self) -> "XmlElement":
        """Return a copy without a parent."""
        copied = deepcopy(self.raw)
        copied.tail = None
        return XmlElement(copied)


def _parser(*, recover: bool = False) -> etree.XMLParser:
    return etree.XMLParser(
        resolve_entities="internal",  # pyright: ignore[reportArgumentType]  # lxml-stubs knows only bool
        no_network=True,
        load_dtd=False,
        huge_tree=False,
        recover=recover,
    )
