"""Make a picture of a robot or a world."""

import argparse
import os
import sys
from pathlib import Path

from .main import add_allow_outside

EXAMPLES = """
  trundle render model://rp2w -o rp2w.png             the whole robot from a good side
  trundle render world.sdf --camera my_sensor -o view.png
                                                      what a camera sensor of the file sees
  trundle render robot.urdf --size 1280x720 -o robot.png
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME", help="what to draw")
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="FILE.png", help="where to write to")
    parser.add_argument("--camera", metavar="NAME", help="a camera sensor of the file (a view of everything)")
    parser.add_argument("--size", type=_size, metavar="WxH", help="in pixels (800x600, or the camera's)")
    parser.add_argument("--depth", action="store_true", help="distances instead: 16 bit, millimetres")
    add_allow_outside(parser)


def main(args: argparse.Namespace) -> int:
    """Draw one picture."""
    from trundle.bringup.picture import picture_of
    from trundle.diagnostics import Diagnostics, UsageError

    report = Diagnostics()
    image = picture_of(
        args.file, dict(os.environ), report, start=Path.cwd(), camera=args.camera, size=args.size, depth=args.depth
    )
    for warning in report.warnings:
        print(warning, file=sys.stderr)
    try:
        image.save(args.output)
    except (OSError, ValueError) as error:
        raise UsageError(f"cannot write {args.output}: {error}") from None
    return 0


def _size(text: str) -> tuple[int, int]:
    width, _, height = text.partition("x")
    if not (width.isdecimal() and height.isdecimal() and 0 < int(width) <= 16384 and 0 < int(height) <= 16384):
        raise argparse.ArgumentTypeError(f"{text!r} is no size; say WIDTHxHEIGHT, such as 800x600")
    return int(width), int(height)
