"""`--help` of every command and subcommand has valid examples."""

import argparse
import re
import shlex
from collections.abc import Iterator

import pytest

from trundle.app.cli.main import COMMANDS, make_parser

WITHOUT_EXAMPLES = {"trundle bag decrypt", "trundle bag encrypt"}
"""Subcommands that are not supported."""


def _parsers(parser: argparse.ArgumentParser) -> Iterator[argparse.ArgumentParser]:
    """The parser and the parsers of its subcommands."""
    yield parser
    for action in parser._actions:
        if isinstance(action, argparse._SubParsersAction):
            yield from action.choices.values()


def _examples(parser: argparse.ArgumentParser) -> list[list[str]]:
    """Words of each example, without comments and pipes."""
    text = (parser.description or "").partition("\n\n")[0]
    lines = text.removeprefix("examples:").strip("\n").splitlines() if text.startswith("examples:") else []
    commands = [re.split(r"\s{2,}", line.removeprefix("  "))[0].partition(" | ")[0] for line in lines]
    return [shlex.split(command) for command in commands if command]


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_examples(name: str) -> None:
    assert {parser.prog for parser in _parsers(make_parser(name)) if not _examples(parser)} <= WITHOUT_EXAMPLES


@pytest.mark.parametrize("name", COMMANDS)
def test_examples_of_a_subcommand_run_it(name: str) -> None:
    _, *subcommands = _parsers(make_parser(name))
    for parser in subcommands:
        assert all(" ".join(words).startswith(parser.prog) for words in _examples(parser))


@pytest.mark.parametrize("name", [name for name in COMMANDS if name != "activate"])  # its example starts with `eval`
def test_examples_are_accepted_by_the_parser(name: str) -> None:
    for program, command, *words in _examples(make_parser(name)):
        assert program == "trundle"
        if words != ["--list"]:  # prints and exits
            assert make_parser(command).parse_known_args(words)[1] == [], words
