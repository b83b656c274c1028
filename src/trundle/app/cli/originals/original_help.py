"""Help of ROS' and Gazebo's commands without a subcommand or after `help`, with the originals' exit codes."""

import argparse
import sys
from collections.abc import Sequence

EXIT_CODES = {
    "gz": (255, 0),
    "rosbag": (0, 0),
    "rosmsg": (0, 64),
    "rosnode": (64, 64),
    "rospack": (0, 0),
    "rosparam": (0, 0),
    "rosservice": (64, 64),
    "rossrv": (0, 64),
    "rostopic": (64, 64),
}
"""Command → exit codes without a subcommand, and after `help`."""
_GZ = "gz"
"""Commands that print their help on stderr, also for an unknown subcommand or option, such as `gz --versions`."""


def print_original_help(program: str, arguments: Sequence[str], parser: argparse.ArgumentParser) -> int | None:
    """Print help where the original does.

    Args:
        program: name of the command, a key of `EXIT_CODES`.
        arguments: arguments after its name.
        parser: parser of the command.

    Returns:
        The exit code, or None if nothing was printed and the arguments are to be parsed.
    """
    commands = _subcommands(parser)
    first, second = [*arguments, "", ""][:2]
    if first in ("-h", "--help") or first in commands:
        return None
    if first not in ("", "help") and program != _GZ:
        return None
    is_requested = first == "help"
    help_parser = commands.get(second, parser) if is_requested else parser
    help_parser.print_help(sys.stderr if program == _GZ else sys.stdout)
    return EXIT_CODES[program][is_requested]


def _subcommands(parser: argparse.ArgumentParser) -> dict[str, argparse.ArgumentParser]:
    for action in parser._actions:  # argparse has no public access to its arguments
        if isinstance(action.choices, dict):
            return action.choices
    return {}
