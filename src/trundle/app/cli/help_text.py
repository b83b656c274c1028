"""Text of `--help`: examples, then the description of the command."""

import argparse


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Prints descriptions as they are written, within 100 columns."""

    def __init__(self, prog: str) -> None:
        super().__init__(prog, max_help_position=30, width=100)


def describe(parser: argparse.ArgumentParser, examples: str, summary: str) -> None:
    """Set the description of a command and of its subcommands, each with the examples that run it.

    Args:
        parser: parser with declared arguments.
        examples: one command per line, with the program's name as in `parser.prog`.
        summary: description of the command.
    """
    parser.description = _description(examples, summary)
    for action in parser._actions:  # argparse has no public access to its arguments
        if isinstance(action, argparse._SubParsersAction):  # pyright: ignore[reportPrivateUsage]
            for choice in action._choices_actions:
                subparser = action.choices[choice.dest]
                own_examples = [
                    line for line in examples.splitlines() if f"{line.strip()} ".startswith(f"{subparser.prog} ")
                ]
                summary = subparser.description or _sentence(choice.help or "")
                subparser.description = _description("\n".join(own_examples), summary)
                subparser.formatter_class = HelpFormatter


def _description(examples: str, summary: str) -> str:
    return f"examples:\n{examples}\n\n{summary}" if examples else summary


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."
