"""Text of a lesson: a tree of blocks without HTML, which clients draw."""

from typing import TypeAlias

from msgspec import Struct


class _Part(Struct, frozen=True, tag_field="kind"):
    """Base of all parts of a text."""


class PlainText(_Part, frozen=True, tag="text"):
    """Text."""

    text: str


class CodeSpan(_Part, frozen=True, tag="code"):
    """Code within a sentence."""

    text: str


class LineBreak(_Part, frozen=True, tag="break"):
    """Line break."""


class Emphasis(_Part, frozen=True, tag="emphasis"):
    """Emphasized text."""

    strong: bool
    content: "tuple[Inline, ...]"


class WebLink(_Part, frozen=True, tag="link"):
    """Link to a page of the Web."""

    url: str
    """Address with the scheme http or https."""
    content: "tuple[Inline, ...]"


Inline: TypeAlias = PlainText | CodeSpan | LineBreak | Emphasis | WebLink


class Paragraph(_Part, frozen=True, tag="paragraph"):
    """Paragraph."""

    content: tuple[Inline, ...]


class Heading(_Part, frozen=True, tag="heading"):
    """Heading within a step."""

    content: tuple[Inline, ...]


class ItemList(_Part, frozen=True, tag="list"):
    """List."""

    ordered: bool
    first: int
    """Number of the first item of an ordered list."""
    items: "tuple[tuple[Block, ...], ...]"


class Quotation(_Part, frozen=True, tag="quotation"):
    """Quoted blocks."""

    blocks: "tuple[Block, ...]"


class CodeBlock(_Part, frozen=True, tag="code_block"):
    """Lines of code, commands or output."""

    language: str
    """Language, as `bash`; `text` is output."""
    title: str
    """Name of the file with this content; empty: none."""
    text: str


Block: TypeAlias = Paragraph | Heading | ItemList | Quotation | CodeBlock
