"""A URDF's text as its own tree."""

from trundle.diagnostics import Diagnostics
from trundle.robot import Robot, read_robot
from trundle.xmlnode import parse_xml


def read_urdf_text(text: str, *, name: str, report: Diagnostics) -> Robot:
    """Read an expanded URDF; `name` is how messages call it.

    Raises:
        DescriptionError: no XML, or no robot that urdfdom would take.
    """
    return read_robot(parse_xml(text, name=name, report=report), report)
