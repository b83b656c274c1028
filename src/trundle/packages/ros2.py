"""Launch files of ROS 2, which are not read: told by their endings, and by what only ROS 2 has."""

import re
from pathlib import Path

from trundle.diagnostics import DescriptionError, Source
from trundle.xmlnode import XmlNode

_IN_OTHER_LANGUAGES = {".py": "in Python", ".yaml": "in YAML", ".yml": "in YAML"}
_NAME = re.compile(r"(.*[._])?launch\.\w+")
"""By what ROS 2 asks of the names of such files; others of these endings may be anything."""
_SUBSTITUTION = re.compile(r"\$\((var|find-pkg-share|find-pkg-prefix|exec-in-pkg|find-exec)\s")
_READ_HERE = "those of ROS 1 are read here"


def refuse_ros2_language(file: Path, *, is_launch: bool) -> None:
    """Refuse a launch file in a language of ROS 2 alone; `is_launch`: it was named as a launch file, whatever its name.

    Raises:
        DescriptionError: it is one.
    """
    language = _IN_OTHER_LANGUAGES.get(file.suffix)
    if language is not None and (is_launch or _NAME.fullmatch(file.name)):
        raise DescriptionError(Source(str(file)), f"a launch file {language} is one of ROS 2; {_READ_HERE}")


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
