"""Parser of a CMakeLists.txt into commands, blocks and conditions."""

import os
import re
from collections.abc import Mapping, Sequence
from typing import NamedTuple

_COMMENT = re.compile(r"#\[\[.*?\]\]|#[^\n]*", re.DOTALL)
_COMMAND = re.compile(r"\b(\w+)\s*\(((?:[^()]|\([^()]*\))*)\)")
_WORD = re.compile(r'"((?:[^"\\]|\\.)*)"|([^\s";]+)', re.DOTALL)
_ENDS = {"if": "endif", "foreach": "endforeach"}
_TRUE = frozenset({"1", "ON", "YES", "TRUE", "Y"})
_FALSE = frozenset({"", "0", "OFF", "NO", "FALSE", "N", "IGNORE", "NOTFOUND"})


class Word(NamedTuple):
    """Argument as written."""

    text: str
    is_quoted: bool


class Command(NamedTuple):
    """One command of a file."""

    name: str
    """In lower case."""
    words: list[Word]
    line: int


def parse_commands(text: str) -> list[Command]:
    """Return the commands of a file in order; comments and other text are skipped."""
    text = _COMMENT.sub(lambda match: "\n" * match[0].count("\n"), text)
    commands: list[Command] = []
    line, counted = 1, 0
    for match in _COMMAND.finditer(text):
        line, counted = line + text.count("\n", counted, match.start()), match.start()
        words = [Word(quoted or plain, not plain) for quoted, plain in _WORD.findall(match[2])]
        commands.append(Command(match[1].lower(), words, line))
    return commands


def block_end(commands: Sequence[Command], start: int) -> int:
    """Return the index of the command that ends the block at `start`, or the number of commands."""
    begin = commands[start].name
    depth = 0
    for index in range(start, len(commands)):
        depth += (commands[index].name == begin) - (commands[index].name == _ENDS[begin])
        if depth == 0:
            return index
    return len(commands)


def branches(block: Sequence[Command]) -> list[tuple[Command, Sequence[Command]]]:
    """Return the branches of an if block, each with its first command: if, elseif, else."""
    depth, starts = 0, [0]
    for index, command in enumerate(block):
        depth += (command.name == "if") - (command.name == "endif")
        if depth == 1 and command.name in ("elseif", "else"):
            starts.append(index)
    return [
        (block[start], block[start + 1 : end]) for start, end in zip(starts, [*starts[1:], len(block)], strict=True)
    ]


def is_true(words: Sequence[str], variables: Mapping[str, Sequence[str]]) -> bool | None:
    """Evaluate a condition; None if only CMake can, as with parentheses."""
    for operator, absorbing in (("OR", True), ("AND", False)):
        if operator in words:
            at = len(words) - 1 - words[::-1].index(operator)
            values = is_true(words[:at], variables), is_true(words[at + 1 :], variables)
            return absorbing if absorbing in values else None if None in values else not absorbing
    match words:
        case ["NOT", *rest]:
            value = is_true(rest, variables)
            return None if value is None else not value
        case ["TARGET", _]:
            return True  # a target of this package, or of a package that it needs
        case ["EXISTS", path] if os.path.isabs(path):
            return os.path.exists(path)
        case ["DEFINED", name]:
            return True if name in variables else None
        case [left, "STREQUAL", right] if "$" not in left + right:
            return left == right
        case [word]:
            return _truth(word, variables)
        case _:
            return None


def _truth(word: str, variables: Mapping[str, Sequence[str]]) -> bool | None:
    value = ";".join(variables.get(word, [word]))
    if value.upper() in _TRUE:
        return True
    if value.upper() in _FALSE or value.endswith("-NOTFOUND"):
        return False
    return True if word in variables else None
