"""XML of ROS 1 launch files."""

from pathlib import Path

from trundle.base.diagnostics import Diagnostics, Source
from trundle.base.xmlnode import ReadBudget, XmlNode, parse_xml, read_xml
from trundle.robots.packages import refuse_ros2, refuse_ros2_language


def read_launch_file(
    file: Path, report: Diagnostics, budget: ReadBudget | None = None, at: Source | None = None
) -> XmlNode:
    """Parse a launch file; `budget` and `at` as in `read_xml`.

    Raises:
        DescriptionError: the file cannot be parsed, or is for ROS 2.
    """
    refuse_ros2_language(file, is_launch=True)
    root = read_xml(file, budget=budget, at=at)
    if root.is_declared_late:
        report.warn(
            Source(str(file), 1),
            "blank lines before <?xml …?>, for which roslaunch refuses the file",
            "blank-lines-before-xml",
        )
    refuse_ros2(root)
    return root


def parse_launch_text(text: str, name: str) -> XmlNode:
    """Parse a launch file's text; `name` is its name in messages.

    Raises:
        DescriptionError: as `read_launch_file`.
    """
    root = parse_xml(text, name=name)
    refuse_ros2(root)
    return root
