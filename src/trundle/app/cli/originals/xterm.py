"""Run a command in a terminal's window; where none can open, in this terminal.

Scripts of READMEs start each of their programs in a window: `xterm -e "roslaunch …" &`.
"""

import argparse
import os
import shlex
import sys

from trundle.base.diagnostics import UsageError

from .own_program import find_own, run_own

EXAMPLES = """
  xterm -e "roslaunch my_robot world.launch" &
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("program", choices=("xterm", "x-terminal-emulator"), help=argparse.SUPPRESS)
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="...", help="as for it; -e: the command")
    parser.set_defaults(print_help=parser.print_help)


def main(args: argparse.Namespace) -> int:
    """Become the terminal, or the command."""
    program, words = args.program, args.words
    if words[:1] in (["-h"], ["--help"]):
        args.print_help()
        return 0
    has_display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if has_display and find_own(program) is not None:
        return run_own(program, words)
    command = words[words.index("-e") + 1 :] if "-e" in words else []
    if not command:
        needs = f"there is no {program} here" if has_display else f"{program} needs a display, and there is none here"
        raise UsageError(needs)
    text = command[0] if len(command) == 1 else shlex.join(command)  # one word is for the shell, as xterm has it
    print(f"{program}: no window can open here, so this terminal has: {text}", file=sys.stderr, flush=True)
    return run_own("sh", ["-c", text])
