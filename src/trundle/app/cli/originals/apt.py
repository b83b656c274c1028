"""Fetch the packages of `apt install ros-DISTRO-NAME`; the machine's apt handles everything else.

`sudo apt …` and `sudo rosdep …` work too, as in tutorials; the machine's sudo handles everything else.
"""

import argparse
import re
from collections.abc import Iterable, Sequence

from trundle.robots.checkouts import BUILT_IN
from trundle.robots.packages import STOCK
from trundle.robots.repositories import ROSDISTROS, shipped_index

from ..fetching import defaults, fetch_packages
from .system_program import run_system_program

EXAMPLES = """
  apt install ros-noetic-turtlebot3-gazebo
  sudo apt-get install -y ros-kinetic-ros-control ros-kinetic-ros-controllers
"""
_NAME = re.compile(rf"ros-({'|'.join(ROSDISTROS)})-([a-z0-9+.-]+)")


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("program", choices=("apt", "apt-get", "sudo"), help=argparse.SUPPRESS)
    parser.add_argument("words", nargs=argparse.REMAINDER, metavar="...", help="as for apt")
    parser.set_defaults(print_help=parser.print_help)


def main(args: argparse.Namespace) -> int:
    """Fetch the named ROS packages, and pass the others on."""
    program, words = args.program, args.words
    if words[:1] in (["-h"], ["--help"]):
        args.print_help()
        return 0
    if program == "sudo":
        command = [word for word in words if word not in ("-E", "-H")]
        if command[:1] == ["rosdep"]:
            return int(args.run_command(["originals.rosdep"], command[1:]))
        if command[:1] not in (["apt"], ["apt-get"]) or not any(map(_NAME.fullmatch, command)):
            return run_system_program(program, words)
        program, *words = command
    ros = [match for match in map(_NAME.fullmatch, words) if match is not None]
    if "install" not in words or not ros:
        return run_system_program(program, words)
    code = fetch_packages(_package_names(match[2] for match in ros), _options(words, ros[0][1]))
    others = [word for word in words if not _NAME.fullmatch(word)]
    if any(not word.startswith("-") for word in others[others.index("install") + 1 :]):
        return run_system_program(args.program, [*(["apt-get"] if args.program == "sudo" else []), *others]) or code
    return code


def _options(words: Sequence[str], distro: str) -> argparse.Namespace:
    yes = any(word in ("-y", "--yes", "-qy", "-yq", "-qqy", "--assume-yes") for word in words)
    return argparse.Namespace(**{**defaults(), "yes": yes, "distro": distro})


def _package_names(names: Iterable[str]) -> list[str]:
    """Return the names of packages, in which apt replaces _ by -."""
    known = {name.replace("_", "-"): name for name in (*shipped_index().names(), *STOCK, *BUILT_IN)}
    return [known.get(name, name.replace("-", "_")) for name in names]
