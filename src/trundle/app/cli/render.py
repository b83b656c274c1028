"""Render an image or a video of a robot or a world."""

import argparse
import os
import sys
from pathlib import Path

from .options import add_allow_outside, add_lenient, add_renderer

EXAMPLES = """
  trundle render model://rp2w -o rp2w.png             the whole robot
  trundle render world.sdf --camera my_sensor -o view.png
                                                      view of a camera sensor in the file
  trundle render robot.urdf --size 1280x720 -o robot.png
  trundle render world.sdf --at 2.5 -o later.png      after 2.5 s of simulation
  trundle render model://rp2w --orbit -o around.mp4   turntable video; .webp and .gif, too, without the extra `video`
  trundle render world.sdf --duration 10 -o run.mp4   video of 10 s of simulation
"""
_VIDEO_S = 5.0


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME", help="file to render")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.png|FILE.mp4", help="output file")
    parser.add_argument("--camera", metavar="NAME", help="camera sensor of the file (default: a view of everything)")
    parser.add_argument("--size", type=_size, metavar="WxH", help="size in pixels (800x600, or the camera's)")
    content = parser.add_mutually_exclusive_group()
    content.add_argument("--depth", action="store_true", help="render depth: 16 bit, millimetres")
    content.add_argument("--seg", action="store_true", help="render a segmentation: one color per visual")
    parser.add_argument("--at", type=_seconds, default=0.0, metavar="S", help="simulated time of the image (0)")
    parser.add_argument("--orbit", action="store_true", help="video of one turn around the scene")
    parser.add_argument("--duration", type=_seconds, metavar="S", help=f"length of a video ({_VIDEO_S:g})")
    add_renderer(parser)
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Render an image or a video."""
    from trundle.app.picture.render import PictureOptions, PictureRenderer
    from trundle.app.picture.video import simulated_frames, turntable
    from trundle.base.atomic_write import replaced_atomically
    from trundle.base.diagnostics import Diagnostics, UsageError
    from trundle.base.video_file import VIDEO_SUFFIXES, write_video

    is_video = args.output.suffix.lower() in VIDEO_SUFFIXES
    if args.orbit and (args.camera or args.duration is not None):
        raise UsageError("--orbit turns around the scene once; it excludes --camera and --duration")
    if (args.orbit or args.duration is not None) and not is_video:
        raise UsageError(f"a video's file ends in {', '.join(VIDEO_SUFFIXES)}, not in {args.output.suffix!r}")
    if is_video and args.depth:
        raise UsageError("depth needs 16 bits, which videos lack; write a .png")
    report = Diagnostics()
    content = "depth" if args.depth else "segmentation" if args.seg else "color"
    options = PictureOptions(camera=args.camera, size=args.size, content=content, at_s=args.at, renderer=args.renderer)
    try:
        renderer = PictureRenderer(args.file, dict(os.environ), report, start=Path.cwd(), options=options)
    finally:
        for warning in report.printed_warnings():
            print(warning, file=sys.stderr)
    if renderer.empty_reason:
        print(f"{args.file}: {renderer.empty_reason}", file=sys.stderr)
    if is_video:
        frames = (
            turntable(renderer)
            if args.orbit
            else simulated_frames(renderer, _VIDEO_S if args.duration is None else args.duration)
        )
        write_video(frames, args.output, report_progress=_print_progress)
        return 0
    try:
        with replaced_atomically(args.output) as file:
            renderer.render().save(file)
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write {args.output}: {getattr(error, 'strerror', None) or error}") from None
    return 0


def _print_progress(done: int) -> None:
    if sys.stderr.isatty():
        print(f"\r{done} images", end="", file=sys.stderr, flush=True)


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 0 < int(width) <= 16384 and 0 < int(height) <= 16384):
        raise argparse.ArgumentTypeError(f"{text!r} is not a size; give WIDTHxHEIGHT, such as 800x600")
    return int(width), int(height)


def _seconds(text: str) -> float:
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0.0 <= seconds <= 1e6:
        raise argparse.ArgumentTypeError(f"{text!r} is not a time; give seconds, such as 2.5")
    return seconds
