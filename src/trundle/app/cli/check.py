"""List errors and unsupported elements of a file: SDF, URDF, xacro or launch."""

import argparse
import os
import sys
from pathlib import Path

from trundle.base.diagnostics import colored
from trundle.base.garbage import no_garbage

from .options import add_allow_outside, add_lenient
from .quiet_imports import quiet_imports

EXAMPLES = """
  trundle check model.sdf                             all findings, worst first
  trundle check robot.urdf.xacro --strict             exit 1 on a warning, for continuous integration
  trundle check world.sdf --json                      the resolved model as one JSON object
  trundle check drive.launch                          a launch file, and what it includes
  trundle check robot.urdf --collisions               also the error of approximating hollow meshes
  trundle check robot.urdf --tree                     links and joints as a tree
  trundle check robot.urdf --graph robot.svg          the same as an image
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="FILE|DIR|model://NAME|-", help="file to read; commands in it are not run")
    parser.add_argument("--strict", action="store_true", help="treat warnings as errors")
    parser.add_argument("--json", action="store_true", help="print the resolved model as one JSON object")
    cut = "decompose hollow collision meshes as physics does, and report the error; may take a minute the first time"
    parser.add_argument("--collisions", action="store_true", help=cut)
    add_allow_outside(parser)
    add_lenient(parser)
    parser.add_argument("--tree", action="store_true", help="draw the kinematic tree in the terminal")
    parser.add_argument("--graph", metavar="OUT.svg", type=Path, help="write the kinematic tree as an image")


def main(args: argparse.Namespace) -> int:
    """Read and report; 1 if the file is rejected."""
    with no_garbage():
        return _check(args)


def _check(args: argparse.Namespace) -> int:
    with quiet_imports():
        from trundle.gazebo.check.check_file import check

    result = check(args.file, dict(os.environ), start=Path.cwd(), collisions=args.collisions)
    warned = any(finding.severity == "warning" for finding in result.report.findings)
    if args.graph is not None:
        from trundle.base.atomic_write import write_atomically
        from trundle.base.drawing.tree import tree_svg

        write_atomically(args.graph, tree_svg(result.trees(), title=args.file))
    if args.json:
        import json

        json.dump(result.as_json(), sys.stdout, allow_nan=False)
        print()
    else:
        if args.tree and not result.is_refused:
            from trundle.base.drawing.tree import tree_text

            print(tree_text(result.trees()))
        print(colored(result.text(), sys.stdout))
    return 1 if result.report.errors or (args.strict and warned) else 0
