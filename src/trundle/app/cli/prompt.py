"""Prompts on standard input."""

import sys

from trundle.base.diagnostics import UsageError


def read_line() -> str:
    """Read a line.

    Raises:
        UsageError: end of standard input.
    """
    if line := sys.stdin.readline():
        return line.strip()
    raise UsageError("standard input ended before there was an answer; nothing was done")


def read_number(maximum: int) -> int:
    """Read a number from 1 to `maximum`; repeat the prompt until it is valid."""
    numbers = {str(number): number for number in range(1, maximum + 1)}
    while (answer := read_line()) not in numbers:
        print(f"ERROR: please enter a number from 1 to {maximum} (ctrl-C to cancel)", flush=True)
    return numbers[answer]


def confirm(question: str) -> bool:
    """Ask a question on the terminal; an empty answer is yes."""
    print(f"{question} [Y/n] ", end="", file=sys.stderr, flush=True)
    return read_line().lower() in ("", "y", "yes")
