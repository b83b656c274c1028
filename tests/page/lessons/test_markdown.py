"""Markdown becomes a tree without HTML; what is hostile becomes text."""

import contextlib

import msgspec
import pytest
from markdown_it.parser_inline import ParserInline
from markdown_it.rules_inline import StateInline

from trundle.base.diagnostics import DescriptionError
from trundle.page.lessons.markdown import blocks_of, parse_markdown
from trundle.page.lessons.text import (
    Block,
    CodeBlock,
    CodeSpan,
    Emphasis,
    Heading,
    ItemList,
    LineBreak,
    Paragraph,
    PlainText,
    Quotation,
    WebLink,
)


def _blocks(text: str) -> tuple[Block, ...]:
    return blocks_of(parse_markdown(text, file="l.md"))


def test_the_subset_of_markdown() -> None:
    text = 'A *b* **c** `d`  \ne\nf\n\n### g\n\n1. h\n   - i\n2. j\n\n> k\n\n```xml title="m.sdf"\n<n/>\n```\n'

    assert _blocks(text) == (
        Paragraph(
            (
                PlainText("A "),
                Emphasis(False, (PlainText("b"),)),
                PlainText(" "),
                Emphasis(True, (PlainText("c"),)),
                PlainText(" "),
                CodeSpan("d"),
                LineBreak(),
                PlainText("e"),
                PlainText(" "),
                PlainText("f"),
            )
        ),
        Heading((PlainText("g"),)),
        ItemList(
            ordered=True,
            first=1,
            items=(
                (
                    Paragraph((PlainText("h"),)),
                    ItemList(ordered=False, first=1, items=((Paragraph((PlainText("i"),)),),)),
                ),
                (Paragraph((PlainText("j"),)),),
            ),
        ),
        Quotation((Paragraph((PlainText("k"),)),)),
        CodeBlock("xml", "m.sdf", "<n/>"),
    )


def test_only_links_to_the_web_are_links() -> None:
    (paragraph,) = _blocks("[a](https://example.org/x?y=1) [b](../howto/plugin.md) <http://example.org>")

    assert isinstance(paragraph, Paragraph)
    assert paragraph.content == (
        WebLink("https://example.org/x?y=1", (PlainText("a"),)),
        PlainText(" "),
        PlainText("b"),
        PlainText(" "),
        WebLink("http://example.org", (PlainText("http://example.org"),)),
    )


@pytest.mark.parametrize(
    "url",
    [
        "javascript:alert(1)",
        "JaVaScRiPt:alert(1)",
        "java&#115;cript:alert(1)",
        "data:text/html,<script>alert(1)</script>",
        "vbscript:x",
        "file:///etc/passwd",
        "//example.org",
        "http:",
        "https:///x",
        "?token=1",
    ],
)
def test_other_links_are_text(url: str) -> None:
    for block in _blocks(f"[a]({url})\n\n[b][r]\n\n[r]: {url}\n"):
        assert isinstance(block, Paragraph)
        assert all(isinstance(part, PlainText) for part in block.content)


@pytest.mark.parametrize(
    "html",
    [
        "<script>alert(1)</script>",
        "<img src=x onerror=alert(1)>",
        "a <img src=x onerror=alert(1)> b",
        "<svg/onload=alert(1)>",
        "<a href='javascript:alert(1)'>x</a>",
        "<!-- a --><b>x</b>",
        "<!-- a --> <script>",
    ],
)
def test_html_is_text(html: str) -> None:
    (paragraph,) = _blocks(html)

    assert isinstance(paragraph, Paragraph)
    assert all(isinstance(part, PlainText) for part in paragraph.content)
    text = "".join(part.text for part in paragraph.content if isinstance(part, PlainText))
    assert text.replace("<!-- a -->", "") == html.replace("<!-- a -->", "")


def test_comments_are_left_out() -> None:
    assert _blocks("<!-- slow -->\n\n<!-- not run:\nx -->\n\na<!-- b -->c\n") == (
        Paragraph((PlainText("a"), PlainText("c"))),
    )


def test_pictures_are_their_descriptions() -> None:
    assert _blocks("![the *robot*](https://example.org/track.png)") == (
        Paragraph((PlainText("the "), Emphasis(False, (PlainText("robot"),)))),
    )


@pytest.mark.parametrize(
    "text",
    [
        ">" * 1_000 + "a",
        "- " * 1_000 + "a",
        "[" * 900,
        "*a " * 2_000,
        "![" * 300 + "a" + "](b)" * 300,
        "`" * 2_000 + "a",
        "<!--" * 1_000,
        "\x00\x1b[31m\u202e\ud7ff",
    ],
    ids=["quotes", "lists", "brackets", "emphasis", "images", "ticks", "comments", "controls"],
)
def test_a_hostile_text_is_read_within_its_size(text: str) -> None:
    """Nesting is bounded, so that what is read can be encoded and drawn."""
    assert len(msgspec.json.encode(_blocks(text))) < 100 * len(text) + 1000


@pytest.fixture
def steps(monkeypatch: pytest.MonkeyPatch) -> list[int]:
    """Positions that the parser skips over in search of the end of a link."""
    found: list[int] = []
    skip = ParserInline.skipToken

    def counted(parser: ParserInline, state: StateInline) -> None:
        found.append(state.pos)
        skip(parser, state)

    monkeypatch.setattr(ParserInline, "skipToken", counted)
    return found


@pytest.mark.parametrize("hostile", ["[", "![", "[a](", "[a", "![](", "[[]", "[*"])
@pytest.mark.parametrize("size", [600, 250_000])
def test_the_work_of_reading_brackets_is_bounded(steps: list[int], hostile: str, size: int) -> None:
    """It grows with the square of their number; a lesson of 256 kB would take hours."""
    text = hostile * (size // len(hostile))

    with contextlib.suppress(DescriptionError):
        _blocks(text)

    assert len(steps) <= 1_000_000


def test_too_many_brackets_are_named_with_their_line() -> None:
    with pytest.raises(DescriptionError) as caught:
        _blocks("# T\n\n[a](b)\n\n" + "[" * 2_000)

    assert str(caught.value) == (
        "l.md:5: error: 2000 brackets '[' in 2000 characters are too many; divide the paragraph, or write a code block"
    )


def test_a_long_lesson_with_links_is_read() -> None:
    """A quarter of a megabyte, of paragraphs as in the lessons that Trundle brings."""
    paragraph = "[a](https://example.org) and [b][c] " + "some words " * 30 + "\n\n"

    assert len(_blocks(paragraph * (250_000 // len(paragraph)))) > 600
