"""Reads the XML of launch files; those of ROS 2 are told from those of ROS 1, which alone are read."""

import re
from pathlib import Path

from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.xmlnode import XmlNode, read_xml

_IN_OTHER_LANGUAGES = {".py": "in Python", ".yaml": "in YAML", ".yml": "in YAML"}
_SUBSTITUTION = re.compile(r"\$\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec)\s")
_READ_HERE = "those of ROS 1 are read here"


def read_launch_file(file: Path, report: Diagnostics) -> XmlNode:
    """Read the XML of a launch file.

    Raises:
        DescriptionError: it cannot be read, or is one of ROS 2.
    """
    if language := _IN_OTHER_LANGUAGES.get(file.suffix):
        raise DescriptionError(Source(str(file)), f"a launch file {language} is one of ROS 2; {_READ_HERE}")
    root = read_xml(file)
    if root.is_declared_late:
        report.warn(Source(str(file), 1), "blank lines before <?xml …?>, for which roslaunch refuses the file")
    refuse_ros2(root)
    return root


def refuse_ros2(node: XmlNode) -> None:
    """Refuse what only ROS 2 has.

    Raises:
        DescriptionError: at the first place that shows it.
    """
    if shown := _shown_by(node):
        raise DescriptionError(node.at, f"{shown}: this is a launch file of ROS 2; {_READ_HERE}")
    for child in node.children:
        refuse_ros2(child)


def _shown_by(node: XmlNode) -> str | None:
    if node.tag == "node" and node.attribute("exec") is not None and node.attribute("type") is None:
        return "<node exec>"
    for name in node.attributes():
        if found := _SUBSTITUTION.search(node.attribute(name) or ""):
            return f"$({found[1]} …)"
    return None
