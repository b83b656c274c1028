"""Start a ROS 1 launch file."""

import argparse
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import UsageError
from trundle.ros import DISTROS

from .options import (
    add_allow_outside,
    add_lenient,
    add_lesson,
    add_page_access,
    add_renderer,
    add_timeline,
    checked_lesson,
    field_option,
    page_access,
    read_options,
)
from .quiet_imports import quiet_imports
from .speed import read_speed

if TYPE_CHECKING:
    from trundle.live.launch.options import LaunchOptions

EXAMPLES = """
  trundle launch smartcar_description smartcar_display.rviz.launch
                                                      a package on ROS_PACKAGE_PATH and a file in it
  trundle launch robot.launch gui:=false              a file, with an argument
  trundle launch robot.launch --headless --duration 20 --speed max
                                                      no browser page, stop after 20 s of ROS time, as fast as possible
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument(
        "words",
        nargs="*",
        metavar="[PKG] FILE [ARG:=VALUE]",
        help="launch file ('-': standard input) and its arguments",
    )
    add = field_option(parser)
    headless = "no browser page; rviz idles, a node that needs a terminal gets this one"
    add("--headless", action="store_true", help=headless)
    add("--duration", type=float, dest="duration_s", metavar="S", help="stop after S seconds of ROS time")
    add("--speed", type=read_speed, metavar="X|max", help="real-time factor (1); max: as fast as possible")
    add(
        "--record",
        type=Path,
        metavar="FILE",
        help="record all topics in a bag, or in FILE.mcap; with --speed max and all nodes within trundle, bags are "
        "reproducible byte by byte, without /rosout and topics of other programs",
    )
    add_timeline(parser)
    add_lesson(parser)
    add("--distro", choices=DISTROS, help="ROS distribution to emulate (the master's, or noetic)")
    port = "the master's port (that of ROS_MASTER_URI, 11311)"
    add("-p", "--port", type=int, dest="master_port", metavar="N", help=port)
    add("--view-port", type=int, metavar="N", help="the page's port (8080 or a free one); Gazebo's beside rviz: N + 1")
    add("--host", help="address that everything binds (127.0.0.1)")
    add("--strict", action="store_true", help="treat warnings about the file as errors")
    add("--screen", action="store_const", const="screen", dest="output", help="show the output of every node")
    log = "log the output of every node, overriding the file and --screen"
    parser.add_argument("--log", action="store_true", help=log)
    add("--required", action="store_true", dest="all_required", help="stop the launch when any node ends")
    add("--wait", action="store_true", dest="wait_for_master", help="wait for a master")
    parser.add_argument("--local", action="store_true", help="no remote nodes, as always here")
    add("--core", action="store_true", dest="core_only", help="master, parameter server and rosout only")
    add("--pid", type=Path, dest="pid_file", metavar="FILE", help="write the process id there")
    add("-q", "--quiet", action="store_true", help="print problems, and the plugins that run, only")
    add("-v", dest="verbose", action="store_true", help="print files read and parameters set")
    add("--no-summary", action="store_false", dest="summary", help="do not show parameters and nodes at the start")
    interrupt, terminate = (f"wait for a node after {signal}" for signal in ("SIGINT (15)", "SIGTERM (2)"))
    add("--sigint-timeout", type=float, dest="interrupt_s", metavar="S", help=interrupt)
    add("--sigterm-timeout", type=float, dest="terminate_s", metavar="S", help=terminate)
    only = parser.add_argument_group("print and end").add_mutually_exclusive_group()
    only.add_argument("--nodes", action="store_const", dest="only", const="nodes", help="the names of the nodes")
    only.add_argument("--find-node", metavar="NODE", help="launch file that defines a node")
    only.add_argument("--args", metavar="NODE", help="the command line of a node")
    only.add_argument("--files", action="store_const", dest="only", const="files", help="all launch files read")
    only.add_argument("--ros-args", action="store_const", dest="only", const="arguments", help="the file's arguments")
    only.add_argument("--dump-params", action="store_const", dest="only", const="params", help="the parameters as YAML")
    only.add_argument(
        "--show-translation",
        action="store_const",
        dest="only",
        const="translation",
        help="how the nodes' Python 2 programs are translated",
    )
    child = parser.add_argument_group(
        "as a child of a roslaunch on another machine",
        'The <machine>\'s env-loader is a script of two lines: shift; exec trundle launch --host 0.0.0.0 "$@"',
    )
    child.add_argument("-c", "--child", metavar="NAME", help="run what the parent sends, under this name")
    child.add_argument("-u", "--server_uri", metavar="URI", help="URI of the parent")
    child.add_argument("--run_id", metavar="ID", help="run ID of the parent's launch")
    # Options of existing scripts without effect here.
    for option in ("--skip-log-check", "--disable-title"):
        add(option, action="store_true", help=argparse.SUPPRESS)
    for option in ("-w", "--numworkers", "-t", "--timeout", "--master-logger-level"):
        add(option, dest=f"unused_{option.strip('-')}", metavar="X", help=argparse.SUPPRESS)
    parser.set_defaults(refuse=parser.error)
    add_renderer(parser)
    add_page_access(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Launch until the duration is over, a required node dies, or Ctrl-C."""
    with quiet_imports():
        from trundle.live.launch.options import LaunchOptions
        from trundle.live.launch.run_launch import launch

    options = read_options(
        LaunchOptions,
        args,
        allowed=page_access(args),
        lesson=checked_lesson(args),
        reads_keys=True,
        only="find-node" if args.find_node else "args" if args.args else args.only,
        node=args.find_node or args.args or "",
    )
    if args.log:
        options = replace(options, output="log")
    if options.quiet:
        options = replace(options, summary=False)
    if options.core_only:
        options = replace(options, headless=True)
        if args.words:
            args.refuse("--core launches no files")
    if not (options.core_only or args.words or args.child or args.server_uri or args.run_id):
        args.refuse("no launch file; name PKG FILE or a path, such as: trundle launch robot.launch")
    if not min(options.interrupt_s, options.terminate_s) > 0.0:
        raise UsageError("--sigint-timeout and --sigterm-timeout must be > 0 s")
    if args.child or args.server_uri or args.run_id:
        return _child(args, options)
    return launch(args.words, options)


def _child(args: argparse.Namespace, options: "LaunchOptions") -> int:
    if not (args.child and args.server_uri and args.run_id):
        args.refuse("--child, --server_uri and --run_id go together: roslaunch gives its children all three")
    if args.words or options.core_only or options.master_port is not None:
        args.refuse("a child launches what its parent sends, at the parent's master: no files, --core or --port")
    from trundle.live.launch.child import run_child
    from trundle.live.launch.parent import ParentLaunch

    return run_child(ParentLaunch(args.child, args.server_uri, args.run_id), options)
