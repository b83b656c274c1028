"""Detection of ROS 2 launch files, which are not supported, by suffix and ROS 2 syntax."""

import re
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.diagnostics import DescriptionError, Source

if TYPE_CHECKING:
    from trundle.base.xmlnode import XmlNode

_IN_OTHER_LANGUAGES = {".py": "in Python", ".yaml": "in YAML", ".yml": "in YAML"}
_NAME = re.compile(r"(.*[._])?launch\.\w+")
"""ROS 2's pattern of launch file names; other files of these suffixes may be anything."""
_SUBSTITUTION = re.compile(r"\$\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec)\s")
_READ_HERE = "only ROS 1 launch files are supported"


def refuse_ros2_language(file: Path, *, is_launch: bool) -> None:
    """Refuse a launch file in Python or YAML; with `is_launch`, whatever its name.

    Raises:
        DescriptionError: the file is a ROS 2 launch file.
    """
    language = _IN_OTHER_LANGUAGES.get(file.suffix)
    if language is not None and (is_launch or _NAME.fullmatch(file.name)):
        raise DescriptionError(
            Source(str(file)), f"a launch file {language} is one of ROS 2; {_READ_HERE}", "ros2-file"
        )


def refuse_ros2(node: "XmlNode") -> None:
    """Refuse ROS 2 syntax.

    Raises:
        DescriptionError: an element uses it.
    """
    if shown := _shown_by(node):
        raise DescriptionError(node.at, f"{shown}: this is a launch file of ROS 2; {_READ_HERE}", "ros2-file")
    for child in node.children:
        refuse_ros2(child)


def _shown_by(node: "XmlNode") -> str | None:
    if node.tag == "node" and node.attribute("exec") is not None and node.attribute("type") is None:
        return "<node exec>"
    for name in node.attributes():
        if match := _SUBSTITUTION.search(node.attribute(name) or ""):
            return f"$({match[1]} …)"
    return None
