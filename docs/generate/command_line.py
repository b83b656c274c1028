"""Reference of the command line, generated from the parsers."""

import argparse
import re

from trundle.app.cli.main import COMMANDS, make_parser

from .markdown import code, html, table

_INTRO = """# Command line

Every command has `--help`, with examples first.
With `--json`, a command prints only one JSON object on standard output; its messages go to
standard error.

| exit code | meaning |
|---|---|
| 0 | success; for ROS's tools also Ctrl-C |
| 1 | the input is at fault; one sentence says where and what |
| 2 | wrong usage |
| 130 | Ctrl-C, after a clean stop |

Tab completion: `eval "$(register-python-argcomplete trundle)"`.
"""


def page() -> str:
    """Return every command with its examples, arguments and subcommands."""
    return "\n".join([_INTRO, *(_command(make_parser(name), level=2) for name in COMMANDS)])


def _command(parser: argparse.ArgumentParser, *, level: int) -> str:
    examples, _, summary = (parser.description or "").partition("\n\n")
    if not summary:
        examples, summary = "", examples
    parts = [f"{'#' * level} {parser.prog}", summary]
    subparsers = [a for a in parser._actions if isinstance(a, argparse._SubParsersAction)]
    if examples and not subparsers:  # subparsers have the examples
        parts.append(f"```bash\n{_examples(examples)}\n```")
    if not subparsers:
        parts.append(_arguments(parser))
    for action in subparsers:
        seen: set[int] = set()
        for subparser in action.choices.values():
            if id(subparser) not in seen:  # an alias
                seen.add(id(subparser))
                parts.append(_command(subparser, level=level + 1))
    return "\n\n".join(part for part in parts if part) + "\n"


def _examples(text: str) -> str:
    """Return commands below their comments, which `--help` has next to them or on the next line."""
    commands: list[tuple[str, list[str]]] = []
    for line in text.removeprefix("examples:").strip("\n").splitlines():
        command, *comment = re.split(r"\s{2,}", line.removeprefix("  "))
        if command:
            commands.append((command, comment))
        else:
            commands[-1][1].extend(comment)
    return "\n".join(f"# {' '.join(comment)}\n{command}" if comment else command for command, comment in commands)


def _arguments(parser: argparse.ArgumentParser) -> str:
    rows = [
        (_spelling(action), _help(parser, action))
        for action in parser._actions
        if action.help != argparse.SUPPRESS and not isinstance(action, argparse._HelpAction)
    ]
    return table(("argument", "meaning"), rows) if rows else ""


def _spelling(action: argparse.Action) -> str:
    choices = "{" + ", ".join(map(str, action.choices)) + "}" if action.choices else None
    value = action.metavar or choices or (action.dest.upper() if action.option_strings else action.dest)
    value = " ".join(value) if isinstance(value, tuple) else value
    takes_value = action.nargs != 0
    names = [f"{name} {value}" if takes_value else name for name in action.option_strings] or [value]
    return ", ".join(map(code, names))


def _help(parser: argparse.ArgumentParser, action: argparse.Action) -> str:
    text = (action.help or "") % {"prog": parser.prog, "default": action.default} if action.help else ""
    return html(text)
