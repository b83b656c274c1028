"""Simulate a robot or a world: SDF, URDF or xacro."""

import argparse
import json
import sys
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostic, Source, TrundleError

from .options import add_allow_outside, add_lenient, add_page_access, add_renderer, page_access
from .quiet_imports import quiet_imports
from .speed import read_speed

EXAMPLES = """
  trundle run model://rp2w                            a robot in Gazebo's model path, or shipped with Trundle
  trundle run my_robot/model.sdf                      a file; a folder with model.config works too
  trundle run robot.urdf.xacro --headless             no browser page
  trundle run world.sdf --headless --speed max --duration 10 --json
                                                      ten simulated seconds as fast as possible, the result as JSON
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME|package://PKG/FILE", help="file to simulate")
    parser.add_argument("--headless", action="store_true", help="no browser page")
    parser.add_argument("--port", type=int, metavar="N", help="the page's port (8080, or the next free one)")
    parser.add_argument("--host", default="127.0.0.1", help="address that the page and the ROS graph bind (127.0.0.1)")
    parser.add_argument("--duration", type=_positive, metavar="S", help="stop after S seconds of simulation time")
    parser.add_argument(
        "--speed", type=read_speed, default=1.0, metavar="X|max", help="real-time factor; max: as fast as possible (1)"
    )
    parser.add_argument("--pause", action="store_true", help="start paused")
    parser.add_argument("--seed", type=int, default=0, metavar="N", help="seed of all random numbers (0)")
    parser.add_argument("--no-ros", action="store_true", help="no ROS graph, no open ports")
    parser.add_argument("--no-sensors", action="store_true", help="switch every sensor off")
    add_renderer(parser)
    parser.add_argument("--strict", action="store_true", help="treat warnings about the file as errors")
    parser.add_argument(
        "--on-instability",
        choices=("pause", "reset", "exit"),
        help="action when the physics diverges (pause with a page, exit without)",
    )
    parser.add_argument("--record", type=Path, metavar="FILE", help="write a state log for `trundle play`")
    parser.add_argument(
        "--timeline",
        type=_megabytes,
        default=256,
        metavar="MB",
        help="memory for the last minutes, which the page goes back to; 0: none (256)",
    )
    parser.add_argument("--json", action="store_true", help="print the final state as one JSON object")
    add_page_access(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Simulate until the duration is over or Ctrl-C."""
    with quiet_imports():
        from trundle.live.run.run import run
        from trundle.live.run.run_options import RunOptions

    options = RunOptions(
        headless=args.headless,
        host=args.host,
        allowed=page_access(args),
        view_only=args.view_only,
        opens_browser=not args.no_browser,
        port=args.port,
        duration_s=args.duration,
        speed=args.speed,
        paused=args.pause,
        seed=args.seed,
        ros=not args.no_ros,
        sensors=not args.no_sensors,
        renderer=args.renderer,
        strict=args.strict,
        record=args.record,
        timeline_mb=args.timeline,
        on_instability=args.on_instability,
    )
    try:
        outcome = run(args.file, options)
    except TrundleError as error:
        if args.json:  # as `check --json`, for scripts that read it whatever happens
            at, what = (
                (error.at, error.what) if isinstance(error, DescriptionError) else (Source(args.file), str(error))
            )
            refusal = {"models": [], "diagnostics": [Diagnostic("error", at, what).as_json()]}
            print(json.dumps(refusal))
        raise
    if args.json:
        json.dump(outcome.as_json(), sys.stdout, allow_nan=False)
        print()
    else:
        print(outcome.summary())
    if outcome.recording_broke_off:
        return 1
    return 130 if outcome.interrupted else 0


def _positive(text: str) -> float:
    value = float(text)
    if not value > 0:
        raise argparse.ArgumentTypeError(f"{text} is not a duration; give seconds, such as 10")
    return value


def _megabytes(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text} is not a size; give megabytes, such as 256")
    return value
