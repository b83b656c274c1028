"""XML parser with limits, optionally as tolerant as Gazebo's and ROS's old parsers.

Entities are never fetched nor expanded without limit, so a hostile file costs no more than its own size.
"""

import io
from pathlib import Path

from lxml import etree

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.base.files import read_file

from .faults import locate_error
from .node import XmlNode
from .read_budget import ReadBudget
from .tinyxml import rewrite_as_xml

_MAX_BYTES = 64 * 1024 * 1024
_MAX_DEPTH = 256
"""libxml2's default limit."""
_RESOURCE_LIMIT = etree.ErrorTypes.ERR_RESOURCE_LIMIT


def parse_xml(
    text: str | bytes, *, name: str, report: Diagnostics | None = None, max_depth: int = _MAX_DEPTH
) -> XmlNode:
    """Parse a document.

    Args:
        text: the whole document.
        name: file name in messages.
        report: collects warnings about values, and errors that Gazebo's and ROS's old XML parsers tolerate; None: such
            errors raise, and invalid values become their defaults silently.
        max_depth: maximum nesting depth, for readers that do not descend into all of it.

    Raises:
        DescriptionError: not XML, empty, or beyond the size or depth limit.
    """
    data = text.encode(errors="surrogatepass") if isinstance(text, str) else text  # JSON can hold lone surrogates
    if len(data) > _MAX_BYTES:
        raise DescriptionError(Source(name), f"{len(data)} bytes; the largest file read is {_MAX_BYTES}", "too-large")
    if not data.strip():
        raise DescriptionError(Source(name, 1), "the file is empty", "empty-file")
    if report is not None and not _is_declared_or_unicode(data):
        report.warn(Source(name, 1), "not UTF-8, and no encoding is declared; read as Latin-1", "xml-encoding")
        data = data.decode("latin-1").encode()
    if report is not None and data.startswith(_UTF_16):
        report.warn(Source(name, 1), "UTF-16 text, which Gazebo and urdfdom refuse; save it as UTF-8", "xml-encoding")
    parser = _parser()
    document = data.lstrip()  # Gazebo and ROS accept leading blank lines, which tutorials and templates have
    before = data[: len(data) - len(document)]
    try:
        root = etree.fromstring(document, parser)
    except etree.XMLSyntaxError as error:
        line, message = locate_error(error, before=before)
        at = Source(name, line)
        if max_depth > _MAX_DEPTH and any(entry.type == _RESOURCE_LIMIT for entry in parser.error_log):
            root = _deep(document, max_depth)
            if root is None:
                raise DescriptionError(
                    at, f"elements nested more than {max_depth} deep, or exponential expansion of entities", "too-large"
                ) from None
        else:
            root = None if report is None else _recovered(document)
            if root is None or report is None:
                raise DescriptionError(at, message, "malformed-xml") from None
            report.warn(at, f"{message}; read as Gazebo reads it", "malformed-xml")
    except ValueError as error:  # "Unicode strings with encoding declaration": only bytes come here
        raise DescriptionError(Source(name, 1), f"not readable as XML: {error}", "malformed-xml") from None
    node = XmlNode(root, file=name, report=report or Diagnostics(), first_line=before.count(b"\n"))
    node.is_declared_late = bool(before) and document.startswith(b"<?xml")
    return node


_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
_PREFIXES = frozenset(
    {
        etree.ErrorTypes.NS_ERR_QNAME,
        etree.ErrorTypes.NS_ERR_UNDEFINED_NAMESPACE,
        etree.ErrorTypes.NS_ERR_XML_NAMESPACE,
    }
)
"""Error codes of undeclared or double prefixes, which TinyXML treats as part of the name; libxml2 keeps them as
written.
"""


def _is_declared_or_unicode(data: bytes) -> bool:
    """True if a document declares its encoding or is valid UTF-8."""
    if b"encoding" in data[:200].split(b"?>")[0] or data.startswith(_UTF_16):
        return True
    try:
        data.decode()
    except UnicodeDecodeError:
        return False
    return True


def _deep(data: bytes, max_depth: int) -> etree._Element | None:  # pyright: ignore[reportPrivateUsage]
    """Return the tree of a deep document; None if too deep, or with entities, whose limits huge_tree lifts too."""
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
            if depth > max_depth:
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
    """Return the tree of a document that TinyXML accepts, or None."""
    text = rewrite_as_xml(data)
    if text is None:
        return None
    parser = _parser(recover=True)
    try:
        root = etree.fromstring(text, parser)
    except (etree.XMLSyntaxError, ValueError):
        return None
    return root if all(entry.type in _PREFIXES for entry in parser.error_log) else None


def read_xml(
    path: Path,
    *,
    report: Diagnostics | None = None,
    max_depth: int = _MAX_DEPTH,
    budget: ReadBudget | None = None,
    at: Source | None = None,
) -> XmlNode:
    """Parse a file; see `parse_xml` for `report` and `max_depth`.

    Args:
        budget: counts the file and its elements.
        at: element that includes the file.

    Raises:
        DescriptionError: see `parse_xml`; or the file cannot be read.
        ReadBudgetError: the budget is exhausted.
    """
    try:
        data = read_file(path, max_bytes=_MAX_BYTES)
    except FileNotFoundError:
        raise DescriptionError(Source(str(path)), "no such file", "missing-file") from None
    except OSError as error:
        raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}", "unreadable-file") from None
    if budget is None:
        return parse_xml(data, name=str(path), report=report, max_depth=max_depth)
    at = at or Source(str(path))
    budget.add_file(path, len(data), at)
    root = parse_xml(data, name=str(path), report=report, max_depth=max_depth)
    budget.add_nodes(root.count_elements(), at)
    return root
