"""Markdown to the text of a lesson: a safe subset of CommonMark, in which HTML is text.

Only modules that read a lesson import this one.
"""

import re
from collections.abc import Iterable, Sequence
from urllib.parse import urlsplit

from markdown_it import MarkdownIt
from markdown_it.rules_core import StateCore
from markdown_it.tree import SyntaxTreeNode

from trundle.base.diagnostics import DescriptionError, Source

from .text import (
    Block,
    CodeBlock,
    CodeSpan,
    Emphasis,
    Heading,
    Inline,
    ItemList,
    LineBreak,
    Paragraph,
    PlainText,
    Quotation,
    WebLink,
)

_COMMENTS = re.compile(r"(\s*<!--.*?-->)*\s*", re.DOTALL)
_TITLE = re.compile(r'\btitle="([^"]*)"')
_SCHEMES = ("http", "https")
_MAX_LOOKS = 1_000_000
"""Limit of the characters that the parser looks at for ends of links: after each '[' the rest of its paragraph."""


def parse_markdown(text: str, *, file: str) -> list[SyntaxTreeNode]:
    """Return the nodes at the top of a document.

    Args:
        text: document.
        file: name in errors.

    Raises:
        DescriptionError: too many brackets in long paragraphs.
    """
    looks = 0

    def limit_looks(state: StateCore) -> None:
        nonlocal looks
        for token in state.tokens:
            looks += token.content.count("[") * len(token.content) if token.type == "inline" else 0
            if looks > _MAX_LOOKS:
                line = None if token.map is None else token.map[0] + 1
                problem = f"{token.content.count('[')} brackets '[' in {len(token.content)} characters are too many"
                raise DescriptionError(Source(file, line), f"{problem}; divide the paragraph, or write a code block")

    parser = MarkdownIt("commonmark")
    parser.core.ruler.before("inline", "limit_looks", limit_looks)
    return list(SyntaxTreeNode(parser.parse(text)).children)


def line_of(node: SyntaxTreeNode) -> int:
    """Return the line of a node, counted from 1."""
    return 1 if node.map is None else node.map[0] + 1


def plain_text(node: SyntaxTreeNode) -> str:
    """Return the text of a node without its formatting."""
    return "".join(_plain(_inlines(node)))


def blocks_of(nodes: Iterable[SyntaxTreeNode]) -> tuple[Block, ...]:
    """Return what nodes say, without comments and lines between sections."""
    return tuple(block for node in nodes if (block := _block(node)) is not None)


def _block(node: SyntaxTreeNode) -> Block | None:
    match node.type:
        case "paragraph":
            return Paragraph(_inlines(node))
        case "heading":
            return Heading(_inlines(node))
        case "bullet_list" | "ordered_list":
            return ItemList(
                ordered=node.type == "ordered_list",
                first=int(node.attrs.get("start", 1)),
                items=tuple(blocks_of(item.children) for item in node.children),
            )
        case "blockquote":
            return Quotation(blocks_of(node.children))
        case "fence" | "code_block":
            title = _TITLE.search(node.info)
            return CodeBlock(node.info.partition(" ")[0], title[1] if title else "", node.content.rstrip("\n"))
        case "html_block" if _COMMENTS.fullmatch(node.content) is None:
            return Paragraph((PlainText(node.content.strip()),))
        case _:
            return None


def _inlines(node: SyntaxTreeNode) -> tuple[Inline, ...]:
    return tuple(part for child in node.children for part in _inline(child))


def _inline(node: SyntaxTreeNode) -> Sequence[Inline]:
    match node.type:
        case "inline":
            return _inlines(node)
        case "text":
            return (PlainText(node.content),)
        case "softbreak":
            return (PlainText(" "),)
        case "hardbreak":
            return (LineBreak(),)
        case "code_inline":
            return (CodeSpan(node.content),)
        case "em" | "strong":
            return (Emphasis(node.type == "strong", _inlines(node)),)
        case "link":
            return _link(str(node.attrs.get("href", "")), _inlines(node))
        case "image":
            return _inlines(node)
        case "html_inline" if _COMMENTS.fullmatch(node.content) is None:
            return (PlainText(node.content),)
        case _:
            return ()


def _link(url: str, content: tuple[Inline, ...]) -> Sequence[Inline]:
    """Return a link to the Web; others, such as those to neighboring files, are text."""
    try:
        parts = urlsplit(url)
    except ValueError:
        return content
    return (WebLink(url, content),) if parts.scheme in _SCHEMES and parts.netloc else content


def _plain(content: Iterable[Inline]) -> Iterable[str]:
    for part in content:
        match part:
            case PlainText(text) | CodeSpan(text):
                yield text
            case LineBreak():
                yield " "
            case Emphasis(content=inner) | WebLink(content=inner):
                yield from _plain(inner)
