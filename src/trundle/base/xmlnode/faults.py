"""Messages for XML syntax errors, in place of libxml2's."""

import re
from collections.abc import Mapping

from lxml import etree

_E = etree.ErrorTypes
_POSITION = re.compile(r", line \d+, column \d+\s*$")
"""Position that libxml2 repeats in its messages."""
_DUPLICATE_ATTRIBUTE = "duplicate attribute {0!r}"
_NO_SPACE = "white space is missing here"
_INCOMPLETE = "<!DOCTYPE …> is incomplete"
_MESSAGES: Mapping[int, tuple[tuple[str, str], ...]] = {
    _E.ERR_DOCUMENT_EMPTY: (("", "the root element must start here, with '<'"),),
    _E.ERR_DOCUMENT_END: (("", "content after the root element"),),
    _E.ERR_TAG_NAME_MISMATCH: ((r": (\S+) line (\d+) and (\S+)", "</{2}> does not match <{0}> of line {1}"),),
    _E.ERR_TAG_NOT_FINISHED: ((r"tag (\S+) line (\d+)", "<{0}> of line {1} is not closed"),),
    _E.ERR_GT_REQUIRED: (
        (r"Start Tag (\S+) line (\d+)", "the '>' that ends <{0} …> of line {1} is missing"),
        ("", "the '>' that ends a tag is missing"),
    ),
    _E.ERR_NAME_REQUIRED: (
        ("EntityRef", "'&' starts no reference here; write &amp;"),
        ("attribute", "an attribute, or the '>' that ends the tag, is expected here"),
        ("StartTag", "'<' starts no tag here; write &lt;"),
    ),
    _E.ERR_ENTITYREF_SEMICOL_MISSING: (("", "a reference without ';'; for a plain '&' write &amp;"),),
    _E.ERR_UNDECLARED_ENTITY: (("'(.*)'", "&{0}; is not defined; XML has &amp; &lt; &gt; &quot; and &apos;"),),
    _E.ERR_ENTITY_LOOP: (("", "an entity that contains itself"),),
    _E.ERR_ATTRIBUTE_REDEFINED: ((r"Attribute (\S+)", _DUPLICATE_ATTRIBUTE),),
    _E.NS_ERR_ATTRIBUTE_REDEFINED: ((r"Attribute (\S+)", _DUPLICATE_ATTRIBUTE),),
    _E.ERR_ATTRIBUTE_WITHOUT_VALUE: ((r"attribute (\S+)", "attribute {0!r} has no value"),),
    _E.ERR_ATTRIBUTE_NOT_STARTED: (("", "the value of an attribute has no quotes"),),
    _E.ERR_ATTRIBUTE_NOT_FINISHED: (("", "the quote that ends the value of an attribute is missing"),),
    _E.ERR_LT_IN_ATTRIBUTE: (("", "'<' in the value of an attribute; write &lt;, or end the value with its quote"),),
    _E.ERR_SPACE_REQUIRED: (("attributes", "no white space between two attributes"), ("", _NO_SPACE)),
    _E.ERR_HYPHEN_IN_COMMENT: (("", "'--' within a comment"),),
    _E.ERR_COMMENT_NOT_FINISHED: (("not terminated", "the '-->' that ends a comment is missing"),),
    _E.ERR_CDATA_NOT_FINISHED: (("", "the ']]>' that ends <![CDATA[ is missing"),),
    _E.ERR_MISPLACED_CDATA_END: (("", "']]>' in text; write ]]&gt;"),),
    _E.ERR_PI_NOT_FINISHED: (("", "the '?>' that ends <? is missing"),),
    _E.ERR_XMLDECL_NOT_FINISHED: (("", "the '?>' that ends <?xml is missing"),),
    _E.ERR_VERSION_MISSING: (("", "<?xml …?> without a version"),),
    _E.ERR_RESERVED_XML_NAME: (("", "<?xml …?> is allowed only at the start"),),
    _E.ERR_DOCTYPE_NOT_FINISHED: (("", _INCOMPLETE),),
    _E.ERR_INT_SUBSET_NOT_FINISHED: (("", _INCOMPLETE),),
    _E.ERR_INVALID_CHAR: (("", "a character that XML does not allow"),),
    _E.ERR_INVALID_HEX_CHARREF: (("", "&#x…; without a hexadecimal number"),),
    _E.ERR_INVALID_DEC_CHARREF: (("", "&#…; without a number"),),
    _E.ERR_INVALID_ENCODING: (("", "bytes that are invalid in the file's encoding"),),
    _E.ERR_UNSUPPORTED_ENCODING: ((r": (\S+)", "unknown encoding {0!r}"),),
    _E.ERR_NAME_TOO_LONG: (("", "a name of more than 50000 characters"),),
    _E.ERR_RESOURCE_LIMIT: (
        (r"depth\D*(\d+)", "elements nested more than {0} deep"),
        ("amplification", "exponential expansion of entities"),
        ("", "a text of more than ten million characters"),
    ),
    _E.NS_ERR_UNDEFINED_NAMESPACE: ((r"prefix (\S+)", 'the prefix {0!r} is not declared; xmlns:{0}="…" declares it'),),
    _E.NS_ERR_QNAME: ((r"'(.*)'", "{0!r} is not a name: a colon is allowed only between two words"),),
}
"""Error code → (pattern in libxml2's message, message formatted with the pattern's groups)."""


def locate_error(error: etree.XMLSyntaxError, *, before: bytes) -> tuple[int, str]:
    """Return the line of an error, and a message with the column.

    Args:
        error: libxml2's error.
        before: white space that was stripped before the document.
    """
    lines = before.count(b"\n")
    line, column = error.lineno or 1, (error.offset or 0) + 1
    column += len(before) - (before.rfind(b"\n") + 1) if line == 1 else 0
    return line + lines, f"not well-formed XML: {_message(error, lines)} (column {column})"


def _message(error: etree.XMLSyntaxError, lines: int) -> str:
    original = " ".join(_POSITION.sub("", error.msg or "no element found").split())
    code = int(error.code)  # pyright: ignore  # lxml-stubs leaves it out
    for pattern, template in _MESSAGES.get(code, ()):
        if match := re.search(pattern, original):
            groups = [int(text) + lines if text.isdigit() and "line" in pattern else text for text in match.groups()]
            return template.format(*groups)
    return original
