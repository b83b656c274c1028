"""Simulate a world on the ROS graph: gazebo with its window, a browser page; gzserver without."""

import argparse
import os
import sys

from trundle import __version__
from trundle.robots.names import parse_arguments

from ..graph_command import interrupted_by_signals
from ..quiet_imports import quiet_imports

EXAMPLES = """
  gazebo                        an empty world
  gazebo worlds/shapes.world    a world in Gazebo's resource path, or a file
  gazebo -u my.world            paused at the start
  gzserver my.world             without a window, until a gzclient asks for it
"""
_SERVER = "gzserver"
_UNSUPPORTED = {
    "iters": "a number of iterations",
    "seed": "a seed",
    "gui_plugin": "a plugin of the window",
    "initial_sim_time": "an initial time",
}
_PROVIDED = ("libgazebo_ros_",)
"""Prefix of gazebo_ros' plugins, which this command replaces."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    add = parser.add_argument
    add("world", nargs="?", default="worlds/empty.world", metavar="WORLD_FILE", help="world (worlds/empty.world)")
    add("-v", "--version", action="version", version=f"Gazebo's command, in Trundle {__version__}")
    add("-u", "--pause", action="store_true", help="start paused")
    add("-r", "--record", action="store_true", help="write a state log")
    add("--record_path", metavar="DIR", help="folder of the state log")
    add("-p", "--play", metavar="FILE", help="play a state log")
    server_plugin = "load a plugin of the system, compiled with the development kit"
    add("-s", "--server-plugin", action="append", default=[], metavar="LIBRARY", help=server_plugin)
    add("-g", "--gui-plugin", action="append", default=[], help=argparse.SUPPRESS)
    for option in ("--seed", "--iters", "--initial_sim_time"):
        add(option, help=argparse.SUPPRESS)
    # Options without effect: there is one physics engine, and it prints what matters.
    for option in (("-e", "--physics"), ("-o", "--profile"), ("--record_period",), ("--record_filter",)):
        add(*option, dest="unused_value", help=argparse.SUPPRESS)
    for option in (("--verbose",), ("-q", "--quiet"), ("--record_encoding",), ("--lockstep",), ("--minimal_comms",)):
        add(*option, dest="unused", action="store_true", help=argparse.SUPPRESS)
    add("remappings", nargs="*", help=argparse.SUPPRESS)
    parser.set_defaults(program=parser.prog)


def main(args: argparse.Namespace) -> int:
    """Simulate until Ctrl-C."""
    if args.play is not None:
        return args.run_command(("play",), [args.play])
    for option, description in _UNSUPPORTED.items():
        value = getattr(args, option)
        names = value if isinstance(value, list) else [value] if value else []
        for name in names:
            if not str(name).startswith(_PROVIDED):
                print(f"{args.program}: {description} ({name}) is not supported, and ignored", file=sys.stderr)
    words = parse_arguments([args.world, *args.remappings]).rest
    options = ["-u"] if args.pause else []
    options += [f"--server-plugin={name}" for name in args.server_plugin]
    options += ["--record_path", args.record_path] if args.record_path else ["-r"] if args.record else []
    with quiet_imports():
        from trundle.live.gazebo.standalone import run_gazebo
        from trundle.live.launch.logs import log_folder

    with interrupted_by_signals():
        logs = log_folder(os.environ, "gazebo")
        return run_gazebo([*options, *words[:1]], os.environ, logs=logs, window=args.program != _SERVER)
