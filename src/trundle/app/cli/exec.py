"""Run a node of a package, as rosrun does."""

import argparse
import asyncio
import os
import shlex
import sys
from contextlib import ExitStack, closing, contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError

from .graph_command import interrupted_by_signals
from .prompt import read_number

if TYPE_CHECKING:
    from collections.abc import Generator

    from trundle.base.console import Console
    from trundle.gazebo.nodes import BuiltinReplacement
    from trundle.live.gazebo.world import GazeboWorld
    from trundle.page.graph_page import GraphPage
    from trundle.page.shared_page import SharedPage
    from trundle.ros import Node

EXAMPLES = """
  trundle exec --list                                 nodes that run without ROS
  trundle exec robot_state_publisher robot_state_publisher
  trundle exec tf static_transform_publisher 0 0 0.1 0 0 0 base_link laser 100
  trundle exec my_robot drive.py _rate:=20 cmd_vel:=/base/cmd_vel
"""
_NO_PACKAGE, _NO_PROGRAM = 2, 3
"""Exit codes, as in rosrun."""
_POLL_S = 0.5


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("--prefix", default="", metavar="COMMAND", help="command to run it with: 'gdb -ex run --args'")
    parser.add_argument("--debug", action="store_true", help="print where the program is searched and what runs")
    parser.add_argument("--show-translation", action="store_true", help="print how a Python 2 program is translated")
    parser.add_argument("--list", action=_List, help="the stock nodes that run without ROS")
    parser.add_argument("package", help="name of the package")
    parser.add_argument("executable", help="a program anywhere in the package, or a stock node")
    parser.add_argument("arguments", nargs=argparse.REMAINDER, metavar="...", help="for the node; a:=b remaps names")


def main(args: argparse.Namespace) -> int:
    """Exec the program, or run a built-in node until Ctrl-C."""
    from trundle.gazebo.nodes import (
        BuiltinReplacement,
        Executable,
        MissingNode,
        command_prefix,
        find_node,
        lacks_rospy,
        missing_rospy_advice,
        same_named_programs,
        script_fault,
    )
    from trundle.robots.packages import Packages
    from trundle.ros.rospy.environment import with_finder

    packages = Packages(os.environ, start=Path.cwd())
    for variables in packages.hook_variables().values():  # as `source devel/setup.bash` does
        os.environ.update(variables)
    folder = packages.find_package(args.package)
    workspace = None if folder is None else packages.workspace_of(folder)
    if workspace is not None:
        print(f"using the workspace {workspace}", file=sys.stderr)
    if args.debug:
        print(f"[rosrun] Looking in rospack dir: {folder or 'none'}")
    match find_node(args.package, args.executable, packages.find_package, env=os.environ):
        case MissingNode(reason):
            print(f"trundle exec: error: {reason}", file=sys.stderr)
            return _NO_PACKAGE if folder is None else _NO_PROGRAM
        case Executable(path):
            if folder is not None and "/" not in args.executable:
                path = _choose_program(path, same_named_programs(folder, path))
            if args.show_translation:
                return _show_translation(path)
            command = [*shlex.split(args.prefix), *command_prefix(path, os.environ), str(path), *args.arguments]
            if fault := script_fault(path):
                print(f"trundle exec: warning: {path} {fault}", file=sys.stderr)
            if args.debug:
                print(f"[rosrun] Running {args.prefix} {path}")
            sys.stdout.flush()
            if lacks_rospy(path, with_finder(os.environ)):
                print(f"trundle exec: {path}: {missing_rospy_advice('rospy')}", file=sys.stderr, flush=True)
            try:
                os.execvpe(command[0], command, with_finder(os.environ, packages.package_folders()))
            except OSError as error:
                raise UsageError(f"{command[0]} cannot be run: {error.strerror}") from None
        case BuiltinReplacement() as stand_in:
            if args.show_translation:
                raise UsageError(f"{args.package}/{args.executable} is a stand-in; there is nothing to translate")
            if args.prefix:
                raise UsageError(f"--prefix is for programs; {args.package}/{args.executable} runs in this process")
            command = stand_in.command
            return _run_stand_in(args, stand_in) if command is None else args.run_command(command, args.arguments)


def _show_translation(program: Path) -> int:
    """Print the translation of a Python 2 program."""
    from trundle.ros.rospy.python2.cache import changes

    print(changes(program) or f"{program} is not a Python 2 program; it runs unchanged")
    return 0


def _choose_program(first: Path, programs: list[Path]) -> Path:
    """Return the program to run among several of the same name: the user's choice at a terminal, else the first."""
    if len(programs) < 2:
        return first
    if not sys.stdin.isatty():
        others = ", ".join(str(path) for path in programs if path != first)
        print(f"[rosrun] Running {first}; others of this name: {others}", file=sys.stderr)
        return first
    print("[rosrun] You have chosen a non-unique executable, please pick one of the following:")
    print("\n".join(f"{i}) {path}" for i, path in enumerate(programs, 1)))
    print("#? ", end="", flush=True)
    return programs[read_number(len(programs)) - 1]


class _List(argparse.Action):
    """Prints the built-in nodes and exits, like --help."""

    def __init__(self, option_strings: list[str], dest: str, help: str) -> None:
        super().__init__(option_strings, dest, nargs=0, help=help)

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        from trundle.gazebo.nodes import BUILTIN_NODES

        print("\n".join(f"{package} {executable}" for package, executable in sorted(BUILTIN_NODES)))
        parser.exit()


def _run_stand_in(args: argparse.Namespace, stand_in: "BuiltinReplacement") -> int:
    import yaml

    from trundle.gazebo.nodes import CLIENTS, ROSCPP, WINDOWS, WORLDS, NodeHost, default_name, run_builtin_node
    from trundle.robots.names import parse_arguments
    from trundle.ros import GraphLoop, Loggers, Node, master_uri_from_env

    words = parse_arguments(args.arguments)
    key = (args.package, args.executable)
    with interrupted_by_signals(), GraphLoop() as loop:
        node = Node(
            words.name or default_name(*key, words.rest),
            loop=loop,
            master_uri=words.master_uri or master_uri_from_env(),
            namespace=words.namespace or os.environ.get("ROS_NAMESPACE", "/"),
            remappings=words.remappings,
            params={name: yaml.safe_load(text) for name, text in words.params.items()},
            host=words.host,
        )
        if key in ROSCPP:
            node.log.loggers = Loggers.for_roscpp(args.package)
        with ExitStack() as stack:
            page = stack.enter_context(closing(_page(node))) if key in WINDOWS | CLIENTS else None
            display = _display(page) if page is not None and key in WINDOWS else None
            world = stack.enter_context(_world(node, page)) if key in WORLDS else None
            host = NodeHost(display=display, simulator=world)
            return loop.run(run_builtin_node(stand_in, node, list(words.rest), host), None)


@contextmanager
def _world(node: "Node", page: "SharedPage | None") -> "Generator[GazeboWorld]":
    """Yield the simulated world of a gzserver node, and print its findings."""
    from trundle.base.console import Console
    from trundle.base.diagnostics import Diagnostics
    from trundle.live.gazebo.world import GazeboWorld
    from trundle.live.graph import Graph
    from trundle.live.launch.logs import log_folder

    report = Diagnostics()
    show = Console(sys.stderr, report)
    loopback = "127.0.0.1"
    world = GazeboWorld(
        graph=Graph(node.loop, node.master_uri, None, loopback),
        start=Path.cwd(),
        env=os.environ,
        report=report,
        folder=log_folder(os.environ, "gazebo") / "spawned",
        say=show.line,
        page=page,
    )
    printing = node.loop.spawn(_show_findings(show))
    try:
        yield world
    finally:
        printing.cancel()
        world.close()
        show.findings()


async def _show_findings(show: "Console") -> None:
    while True:
        show.findings()
        await asyncio.sleep(_POLL_S)


def _page(node: "Node") -> "SharedPage":
    """Return the page of a node with a window."""
    from trundle.page import GraphAddress
    from trundle.page.shared_page import SharedPage

    return SharedPage(say=lambda text: print(text, flush=True), graph=GraphAddress(master_uri=node.master_uri))


def _display(page: "SharedPage") -> "GraphPage":
    from trundle.page.graph_page import GraphPage

    return GraphPage(page)
