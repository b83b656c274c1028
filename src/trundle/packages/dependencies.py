"""What a package says it needs."""

import os
import re
from pathlib import Path

from trundle.xmlnode import XmlNode, read_xml

_RUN_DEPENDS = ("run_depend", "exec_depend", "depend")
"""Rospack's, and in its order: what a package needs when it is built or tested is left out."""
_FOR_VERSION = re.compile(r"\$ROS_VERSION\s*==\s*['\"]?(\d)")


def run_dependencies(folder: Path) -> list[str]:
    """Names of packages, and of what the system provides, that a package needs to run, in order.

    Raises:
        DescriptionError: its manifest cannot be read.
    """
    manifest = folder / "package.xml"
    if os.path.exists(manifest):
        root = read_xml(manifest)
        named = [each.text.strip() for tag in _RUN_DEPENDS for each in root.all(tag) if _is_for_ros_1(each)]
    else:
        root = read_xml(folder / "manifest.xml")  # rosbuild: <depend package="…"/>
        named = [child.attribute("package") or "" for child in root.all("depend")]
    return list(dict.fromkeys(name for name in named if name))


def _is_for_ros_1(child: XmlNode) -> bool:
    """Tell by `condition="$ROS_VERSION == 2"`, with which one package serves both."""
    match = _FOR_VERSION.search(child.attribute("condition") or "")
    return match is None or match[1] == "1"
