"""Expand a xacro file."""

import argparse
import os
import sys
from pathlib import Path

from trundle.base.garbage import no_garbage

from .options import add_allow_outside, add_lenient

EXAMPLES = """
  trundle xacro robot.urdf.xacro                      the expanded XML on standard output
  trundle xacro robot.urdf.xacro gripper:=true -o robot.urdf
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", type=Path, metavar="FILE", help="the file to expand")
    parser.add_argument("arguments", nargs="*", metavar="NAME:=VALUE", help="arguments of the file")
    parser.add_argument("-o", "--output", type=Path, metavar="FILE", help="output file")
    parser.add_argument("-i", "--inorder", action="store_true", help=argparse.SUPPRESS)  # xacro always reads in order
    add_allow_outside(parser)
    add_lenient(parser)


def main(args: argparse.Namespace) -> int:
    """Print the expanded file."""
    with no_garbage():
        return _expand(args)


def _expand(args: argparse.Namespace) -> int:
    from trundle.base.diagnostics import Diagnostics, UsageError
    from trundle.base.files import is_stream, read_stream
    from trundle.robots.description import expand_xacro
    from trundle.robots.packages import Packages

    words = [word.partition(":=") for word in args.arguments]
    for name, assigned, _ in words:
        if not assigned:
            raise UsageError(f"{name!r} is not an argument; give NAME:=VALUE")
    report = Diagnostics()
    path, data = args.file, None
    if is_stream(path):
        path, data = Path("<pipe>"), read_stream(path)
    packages = Packages(dict(os.environ), start=path)
    arguments = {name: value for name, _, value in words}
    text = expand_xacro(path, arguments, packages=packages, report=report, data=data)
    for finding in report.findings:
        print(finding, file=sys.stderr)
    if args.output is None:
        print(text, end="")
    else:
        from trundle.base.atomic_write import write_atomically

        write_atomically(args.output, text)
    return 0
