"""What a package says it needs."""

import re
from pathlib import Path

from trundle.xmlnode import XmlNode, read_xml

_NEEDS = (
    "depend",
    "build_depend",
    "build_export_depend",
    "buildtool_depend",
    "buildtool_export_depend",
    "exec_depend",
    "run_depend",
    "test_depend",
)
_FOR_VERSION = re.compile(r"\$ROS_VERSION\s*==\s*['\"]?(\d)")


def needs(folder: Path) -> list[str]:
    """Names of packages, and of what the system provides, that a package depends on, in order.

    Raises:
        DescriptionError: its manifest cannot be read.
    """
    manifest = folder / "package.xml"
    if manifest.is_file():
        root = read_xml(manifest)
        named = [child.text.strip() for child in root.children if child.tag in _NEEDS and _is_for_ros_1(child)]
    else:
        root = read_xml(folder / "manifest.xml")  # rosbuild: <depend package="…"/>
        named = [child.attribute("package") or "" for child in root.all("depend")]
    return list(dict.fromkeys(name for name in named if name))


def _is_for_ros_1(child: XmlNode) -> bool:
    """Tell by `condition="$ROS_VERSION == 2"`, with which one package serves both."""
    match = _FOR_VERSION.search(child.attribute("condition") or "")
    return match is None or match[1] == "1"
