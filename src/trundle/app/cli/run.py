"""Simulate a robot or a world: SDF, URDF or xacro."""

import argparse
import json
import shutil
import sys
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostic, Source, TrundleError

from .options import (
    add_allow_outside,
    add_compare,
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

EXAMPLES = """
  trundle run model://rp2w                            a robot in Gazebo's model path, or shipped with Trundle
  trundle run my_robot/model.sdf                      a file; a folder with model.config works too
  trundle run robot.urdf.xacro --headless             no browser page
  trundle run --list                                  worlds, robots and launch files that come with Trundle
  trundle run world.sdf --headless --speed max --duration 10 --json
                                                      ten simulated seconds as fast as possible, the result as JSON
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME|package://PKG/FILE", help="file to simulate")
    parser.add_argument("--list", action=_ListShipped, nargs=0, help="list what comes with Trundle to be run, and exit")
    parser.add_argument("--json", action="store_true", help="print the final state as one JSON object")
    add = field_option(parser)
    add("--headless", action="store_true", help="no browser page")
    add("--port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    add("--host", help="address that the page and the ROS graph bind (127.0.0.1)")
    duration = "stop after S seconds of simulation time"
    add("--duration", type=_positive, dest="duration_s", metavar="S", help=duration)
    add("--speed", type=read_speed, metavar="X|max", help="real-time factor; max: as fast as possible (1)")
    add("--pause", action="store_true", dest="paused", help="start paused")
    add("--seed", type=int, metavar="N", help="seed of all random numbers (0)")
    add("--no-ros", action="store_false", dest="ros", help="no ROS graph, no open ports")
    add("--no-sensors", action="store_false", dest="sensors", help="switch every sensor off")
    add_renderer(parser)
    add("--strict", action="store_true", help="treat warnings about the file as errors")
    on_instability = "action when the physics diverges (pause with a page, exit without)"
    add("--on-instability", choices=("pause", "reset", "exit"), help=on_instability)
    add("--record", type=Path, metavar="FILE", help="write a state log for `trundle play`")
    add_compare(parser)
    add_timeline(parser)
    add_lesson(parser)
    add_page_access(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Simulate until the duration is over or Ctrl-C."""
    with quiet_imports():
        from trundle.live.run.run_options import RunOptions
        from trundle.live.run.run_world import run

    options = read_options(RunOptions, args, allowed=page_access(args), lesson=checked_lesson(args))
    try:
        result = run(args.file, options)
    except TrundleError as error:
        if args.json:  # an empty result, as of `check --json`, for scripts that always read one
            at, message = (
                (error.at, error.what) if isinstance(error, DescriptionError) else (Source(args.file), str(error))
            )
            refusal = {"models": [], "diagnostics": [Diagnostic("error", at, message, error.id).as_json()]}
            print(json.dumps(refusal))
        raise
    if args.json:
        json.dump(result.as_json(), sys.stdout, allow_nan=False)
        print()
    else:
        print(result.summary())
    if result.recording_failed:
        return 1
    return 130 if result.interrupted else 0


def _positive(text: str) -> float:
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text} is not a duration; give seconds, such as 10")
    return value


class _ListShipped(argparse.Action):
    """Prints what comes with Trundle, like --help."""

    def __call__(self, parser: argparse.ArgumentParser, *_: object) -> None:
        """Print it, and exit."""
        from .shipped_list import shipped_list

        print(shipped_list(shutil.get_terminal_size((120, 24)).columns))
        parser.exit()
