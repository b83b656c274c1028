"""Draw the links and joints of a URDF, as urdfdom's urdf_to_graphiz does: a .gv file, and with Graphviz a .pdf."""

import argparse
import shutil
import subprocess
from pathlib import Path
from typing import TYPE_CHECKING

from .check_urdf import read_urdf

if TYPE_CHECKING:
    from trundle.robots.robot import Robot

EXAMPLES = """
  urdf_to_graphiz robot.urdf
"""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("file", metavar="URDF_FILE", help="a URDF")
    parser.add_argument("output", nargs="?", metavar="NAME", help="name of the written files (the robot's)")


def main(args: argparse.Namespace) -> int:
    """Write NAME.gv, and with Graphviz NAME.pdf, else NAME.svg."""
    from trundle.base.atomic_write import write_atomically

    robot = read_urdf(args.file)
    name = args.output or robot.name.replace("/", "_")
    source = Path(f"{name}.gv")
    write_atomically(source, graphviz_text(robot))
    print(f"Created file {source}")
    if (dot := shutil.which("dot")) is not None:
        subprocess.run([dot, "-Tpdf", str(source), "-o", f"{name}.pdf"], check=True)
        print(f"Created file {name}.pdf")
        return 0
    args.run_command(("check",), [args.file, "--graph", f"{name}.svg"])
    print(f"Created file {name}.svg (a PDF needs Graphviz)")
    return 0


def graphviz_text(robot: "Robot") -> str:
    """Return links as boxes and joints as ellipses with their origins [m, rad], in DOT."""
    lines = ["digraph G {", "node [shape=box];"]
    lines += [f'"{_quoted(link.name)}" [label="{_quoted(link.name)}"];' for link in robot.links]
    lines.append("node [shape=ellipse, color=blue, fontcolor=blue];")
    for joint in robot.joints:
        pose = joint.parent_from_joint
        xyz = " ".join(f"{value:g}" for value in pose.position)
        rpy = " ".join(f"{value:g}" for value in pose.rpy)
        parent, child, name = map(_quoted, (joint.parent, joint.child, joint.name))
        lines.append(f'"{parent}" -> "{name}" [label="xyz: {xyz} \\nrpy: {rpy}"]')
        lines.append(f'"{name}" -> "{child}"')
    return "\n".join([*lines, "}", ""])


def _quoted(text: str) -> str:
    return text.replace("\\", "\\\\").replace('"', '\\"')
