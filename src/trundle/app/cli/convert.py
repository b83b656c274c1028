"""Convert a robot or world to SDF, URDF, MJCF or GLB, a recorded run to GLB or HTML."""

import argparse
import os
import sys
from pathlib import Path

from .options import add_allow_outside, add_lenient
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle convert robot.urdf.xacro --to sdf           Gazebo's conversion, on standard output
  trundle convert model.sdf --to urdf -o robot.urdf   meshes are copied into meshes/ beside it
  trundle convert world.sdf --to mjcf -o world.xml    for MuJoCo: simulated shapes and joints
  trundle convert robot.urdf --to glb -o robot.glb    with textures and lights, for Blender and the web
  trundle convert run.log --to html -o run.html       a recorded run as a page that opens without Trundle
  trundle convert run.log --to glb -o run.glb         the same as an animation
  trundle convert old.sdf --to sdf | trundle check -  the same model in SDF 1.11
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME|-", help="file to read; commands in it are not run")
    parser.add_argument("--to", choices=("sdf", "urdf", "mjcf", "glb", "html"), required=True, help="output format")
    parser.add_argument("-o", "--output", type=Path, metavar="OUT", help="output file (standard output)")
    parser.add_argument("--strict", action="store_true", help="treat warnings as errors")
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Read and write; losses are reported on standard error."""
    with quiet_imports():
        from trundle.app.convert import convert
        from trundle.base.diagnostics import Diagnostics, UsageError

    if args.to == "glb" and args.output is None and sys.stdout.isatty():
        raise UsageError("a GLB is binary, and standard output is a terminal; name a file with -o")
    report = Diagnostics(strict=args.strict)
    content = convert(args.file, args.to, dict(os.environ), report, start=Path.cwd(), output=args.output)
    for warning in report.printed_warnings():
        print(warning, file=sys.stderr)
    if args.output is None and isinstance(content, bytes):
        sys.stdout.buffer.write(content)
    elif args.output is None:
        print(content, end="")
    return 0
