"""Run a command in a terminal window; if none can open, in this terminal.

Scripts in READMEs start each program in a window: `xterm -e "roslaunch …" &`.
"""

import argparse
import os
import shlex
import sys

from trundle.base.diagnostics import UsageError

from .system_program import find_system_program, run_system_program

EXAMPLES = """
  xterm -e "roslaunch my_robot world.launch" &
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("program", choices=("xterm", "x-terminal-emulator"), help=argparse.SUPPRESS)
    parser.add_argument(
        "words", nargs=argparse.REMAINDER, metavar="...", help="arguments of the program; -e: the command"
    )
    parser.set_defaults(print_help=parser.print_help)


def main(args: argparse.Namespace) -> int:
    """Replace this process by the terminal emulator, or by the command."""
    program, words = args.program, args.words
    if words[:1] in (["-h"], ["--help"]):
        args.print_help()
        return 0
    has_display = os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")
    if has_display and find_system_program(program) is not None:
        return run_system_program(program, words)
    command = words[words.index("-e") + 1 :] if "-e" in words else []
    if not command:
        reason = f"there is no {program} here" if has_display else f"{program} needs a display, and there is none here"
        raise UsageError(reason)
    text = command[0] if len(command) == 1 else shlex.join(command)  # xterm passes a single word to the shell
    print(f"{program}: no window can open here; running in this terminal: {text}", file=sys.stderr, flush=True)
    return run_system_program("sh", ["-c", text])
