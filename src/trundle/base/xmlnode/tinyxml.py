"""Conversion to XML of documents that TinyXML, the parser of Gazebo 11 and urdfdom, accepts beyond XML.

It accepts a bare `&`, values without quotes or with `<`, `--` in comments, control characters, a declaration anywhere
and content after the root element. Line breaks are kept, and so are names, including stray colons.
"""

import re

_NAME = r"[^\W\d][\w.:-]*"
_START = re.compile(rf"<{_NAME}")
_ATTRIBUTE = re.compile(rf"""(\s*)({_NAME})(\s*=\s*)(?:"([^"]*)"|'([^']*)'|([^\s"'<>/]+))""")
_CLOSE = re.compile(r"\s*(/?)>")
_END = re.compile(rf"</{_NAME}\s*>")
_TEXT = re.compile(r"[^<]+")
_CDATA = "<![CDATA["
_BARE = re.compile(r"&(?!(?:amp|lt|gt|quot|apos|#[0-9]{1,7}|#x[0-9a-fA-F]{1,6});)")
_CONTROL = re.compile("[\x01-\x08\x0b\x0c\x0e-\x1f\ufffe\uffff]|&#(?:[0-8]|1[124-9]|2[0-9]|3[01]);")


class _RefusedError(Exception):
    """Document that TinyXML refuses too."""


def rewrite_as_xml(data: bytes) -> bytes | None:
    """Return a document as XML that is well-formed except for its prefixes.

    Args:
        data: the whole document.

    Returns:
        None if TinyXML refuses the document, too, or if it defines entities, which TinyXML never expands.
    """
    text = _decoded(data)
    if "\0" in text or "<!ENTITY" in text:
        return None
    parts: list[str] = []
    at, depth = 0, 0
    try:
        while at < len(text) and not (depth == 0 and parts and parts[-1].endswith(">")):
            part, at, deeper = _next(text, at)
            parts.append(part)
            depth += deeper
    except _RefusedError:
        return None
    return "".join(parts).encode()


def _decoded(data: bytes) -> str:
    """Decode as UTF-8, or as Latin-1, which accepts any bytes."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("latin-1")


def _next(text: str, at: int) -> tuple[str, int, int]:
    """Return the next token as XML, its end, and the change of depth."""
    if plain := _TEXT.match(text, at):
        return _escaped(plain[0]), plain.end(), 0
    if start := _START.match(text, at):
        return _start_tag(text, start)
    if end := _END.match(text, at):
        return end[0], end.end(), -1
    if text.startswith("</", at):
        raise _RefusedError
    if text.startswith(_CDATA, at):
        end = _after(text, at, "]]>")
        return _CONTROL.sub("", text[at:end]), end, 0
    # Comments, declarations and unknown tags: only their line breaks are kept.
    end = _after(text, at, "-->" if text.startswith("<!--", at) else ">")
    return "\n" * text.count("\n", at, end), end, 0


def _start_tag(text: str, start: re.Match[str]) -> tuple[str, int, int]:
    parts, at = [start[0]], start.end()
    while attribute := _ATTRIBUTE.match(text, at):
        space, name, equals, *values = attribute.groups()
        value = next(value for value in values if value is not None)
        parts.append(f'{space or " "}{name}{equals}"{_escaped(value)}"')
        at = attribute.end()
    close = _CLOSE.match(text, at)
    if close is None:
        raise _RefusedError
    return "".join((*parts, close[0])), close.end(), 0 if close[1] else 1


def _after(text: str, at: int, mark: str) -> int:
    """Return the position after a mark."""
    start = text.find(mark, at)
    if start < 0:
        raise _RefusedError
    return start + len(mark)


def _escaped(text: str) -> str:
    """Return escaped text without invalid references; TinyXML also drops a bare `&`."""
    text = _CONTROL.sub("", _BARE.sub("", text))
    return text.replace("<", "&lt;").replace(">", "&gt;").replace('"', "&quot;")
