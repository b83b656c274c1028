"""Make a picture, or a film, of a robot or a world."""

import argparse
import os
import sys
from pathlib import Path

from .options import add_allow_outside, add_lenient, add_renderer

EXAMPLES = """
  trundle render model://rp2w -o rp2w.png             the whole robot from a good side
  trundle render world.sdf --camera my_sensor -o view.png
                                                      what a camera sensor of the file sees
  trundle render robot.urdf --size 1280x720 -o robot.png
  trundle render world.sdf --at 2.5 -o later.png      after 2.5 s of simulation
  trundle render model://rp2w --orbit -o around.mp4   once around it (.webp and .gif too)
  trundle render world.sdf --duration 10 -o run.mp4   what happens in 10 s
"""
_VIDEO_S = 5.0


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME", help="what to draw")
    parser.add_argument(
        "-o", "--output", type=Path, required=True, metavar="FILE.png|FILE.mp4", help="where to write to"
    )
    parser.add_argument("--camera", metavar="NAME", help="a camera sensor of the file (a view of everything)")
    parser.add_argument("--size", type=_size, metavar="WxH", help="in pixels (800x600, or the camera's)")
    content = parser.add_mutually_exclusive_group()
    content.add_argument("--depth", action="store_true", help="distances instead: 16 bit, millimetres")
    content.add_argument("--seg", action="store_true", help="a colour for each visual instead")
    parser.add_argument("--at", type=_seconds, default=0.0, metavar="S", help="after so much simulated time (0)")
    parser.add_argument("--orbit", action="store_true", help="a film once around everything")
    parser.add_argument("--duration", type=_seconds, metavar="S", help=f"how long a film lasts ({_VIDEO_S:g})")
    add_renderer(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Draw one picture, or many."""
    from trundle.bringup.picture.render import PictureOptions, PictureRenderer
    from trundle.bringup.picture.video import VIDEO_SUFFIXES, simulated_frames, turntable, write_video
    from trundle.diagnostics import Diagnostics, UsageError

    moves = args.output.suffix.lower() in VIDEO_SUFFIXES
    if args.orbit and (args.camera or args.duration is not None):
        raise UsageError("--orbit goes once around everything: it takes neither --camera nor --duration")
    if (args.orbit or args.duration is not None) and not moves:
        raise UsageError(f"that is a film: its file ends in {', '.join(VIDEO_SUFFIXES)}, not in {args.output.suffix!r}")
    if moves and args.depth:
        raise UsageError("depth has 16 bits, which films have not; write a .png")
    report = Diagnostics()
    content = "depth" if args.depth else "segmentation" if args.seg else "colour"
    options = PictureOptions(camera=args.camera, size=args.size, content=content, at_s=args.at, renderer=args.renderer)
    try:
        studio = PictureRenderer(args.file, dict(os.environ), report, start=Path.cwd(), options=options)
    finally:
        for warning in report.warnings:
            print(warning, file=sys.stderr)
    if studio.empty_reason:
        print(f"{args.file}: {studio.empty_reason}", file=sys.stderr)
    if moves:
        frames = (
            turntable(studio)
            if args.orbit
            else simulated_frames(studio, _VIDEO_S if args.duration is None else args.duration)
        )
        write_video(frames, args.output, report_progress=_print_progress)
        return 0
    try:
        studio.render().save(args.output)
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write {args.output}: {error}") from None
    return 0


def _print_progress(done: int) -> None:
    if sys.stderr.isatty():
        print(f"\r{done} pictures", end="", file=sys.stderr, flush=True)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 0 < int(width) <= 16384 and 0 < int(height) <= 16384):
        raise argparse.ArgumentTypeError(f"{text!r} is no size; say WIDTHxHEIGHT, such as 800x600")
    return int(width), int(height)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.0 <= seconds <= 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is no time; say seconds, such as 2.5")
    return seconds
