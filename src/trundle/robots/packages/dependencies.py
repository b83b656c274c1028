"""Dependencies of a package."""

import os
import re
from pathlib import Path

from trundle.base.xmlnode import XmlNode, read_xml

_RUN_DEPENDS = ("run_depend", "exec_depend", "depend")
"""Tags of run dependencies, in rospack's order."""
_BUILD_DEPENDS = ("buildtool_depend", "build_depend", "build_export_depend", "depend", "run_depend", "exec_depend")
"""Tags of dependencies by which catkin sorts packages for a build."""
_FOR_VERSION = re.compile(r"\$ROS_VERSION\s*==\s*['\"]?(\d)")


def run_dependencies(folder: Path) -> list[str]:
    """Return the names of a package's run dependencies, packages and system libraries, in order.

    Raises:
        DescriptionError: its manifest cannot be read.
    """
    return _dependencies(folder, _RUN_DEPENDS)


def build_dependencies(folder: Path) -> list[str]:
    """Return the names of the packages and system libraries to build before a package.

    Raises:
        DescriptionError: its manifest cannot be read.
    """
    return _dependencies(folder, _BUILD_DEPENDS)


def _dependencies(folder: Path, tags: tuple[str, ...]) -> list[str]:
    manifest = folder / "package.xml"
    if os.path.exists(manifest):
        root = read_xml(manifest)
        names = [node.text.strip() for tag in tags for node in root.all(tag) if _is_for_ros_1(node)]
    else:
        root = read_xml(folder / "manifest.xml")  # rosbuild: <depend package="…"/>
        names = [child.attribute("package") or "" for child in root.all("depend")]
    return list(dict.fromkeys(name for name in names if name))


def _is_for_ros_1(child: XmlNode) -> bool:
    """True unless `condition="$ROS_VERSION == 2"`, as in packages for both ROS versions."""
    match = _FOR_VERSION.search(child.attribute("condition") or "")
    return match is None or match[1] == "1"
