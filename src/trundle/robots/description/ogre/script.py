"""Parser of .material scripts to nested blocks.

A statement is a line of words; a block is a header line and statements in braces. Quotes group words with spaces, `//`
and `/* */` are comments.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from trundle.base.diagnostics import DescriptionError, Source

_TOKEN = re.compile(r"//[^\n]*|/\*.*?\*/|\"[^\"\n]*\"|[{}\n]|(?:(?!//|/\*)[^\s{}\"])+", re.DOTALL)
_DEEPEST = 16


@dataclass(slots=True)
class Block:
    """Block with a header such as `material Box/Side : Box/Plain`, and its statements and blocks."""

    header: tuple[str, ...]
    at: Source
    statements: list[tuple[str, ...]] = field(default_factory=list[tuple[str, ...]])
    blocks: list["Block"] = field(default_factory=list["Block"])

    def value(self, keyword: str) -> tuple[str, ...] | None:
        """Return the words after the keyword in its last statement."""
        return next((words[1:] for words in reversed(self.statements) if words[0] == keyword), None)

    def all(self, kind: str) -> list["Block"]:
        """Return the blocks whose header starts with that word."""
        return [block for block in self.blocks if block.header[0] == kind]


def parse_script(text: str, *, name: str) -> Block:
    """Parse a script; the outermost block has an empty header.

    Raises:
        DescriptionError: unbalanced braces.
    """
    top = Block(("",), Source(name, 1))
    open_blocks = [top]
    words: list[str] = []
    line = 1
    for token, line in _tokens(text):
        if token not in ("{", "}", "\n"):
            words.append(token)
            continue
        if words:
            open_blocks[-1].statements.append(tuple(words))
            words = []
        if token == "{":
            if not open_blocks[-1].statements or len(open_blocks) > _DEEPEST:
                raise DescriptionError(
                    Source(name, line), "'{' without a word before it, or nested too deeply", "material-script"
                )
            block = Block(open_blocks[-1].statements.pop(), Source(name, line))
            open_blocks[-1].blocks.append(block)
            open_blocks.append(block)
        if token == "}":
            open_blocks.pop()
            if not open_blocks:
                raise DescriptionError(Source(name, line), "'}' without a '{' before it", "material-script")
    if len(open_blocks) > 1:
        raise DescriptionError(
            open_blocks[-1].at, f"the '{{' of {open_blocks[-1].header[0]!r} is never closed", "material-script"
        )
    return top


def _tokens(text: str) -> Iterator[tuple[str, int]]:
    """Yield words, braces and line ends with their line number; comments are dropped, a last line end is added."""
    line = 1
    for match in _TOKEN.finditer(text):
        token = match[0]
        if not token.startswith(("//", "/*")):
            yield token.strip('"'), line
        line += token.count("\n")
    yield "\n", line
