"""Displays as rviz of ROS 2 writes them into its files."""

from collections.abc import Mapping
from typing import Any

from tests.page.picture_case import Display

_POLICIES = {
    "Depth": 5,
    "Durability Policy": "Volatile",
    "History Policy": "Keep Last",
    "Reliability Policy": "Reliable",
}
_NAMES = {"WrenchStamped": "Wrench"}
"""Displays with another name in ROS 2."""


def ros2_spelling(display: Display) -> Display:
    """Return a display of rviz as ROS 2's would save it: its class, its topics, its robot's description."""
    written: dict[str, Any] = {}
    package, _, kind = str(display["Class"]).partition("/")
    for key, value in display.items():
        match key:
            case "Class":
                written[key] = f"{_package(package, kind)}/{_NAMES.get(kind, kind)}"
            case "Displays":
                written[key] = [ros2_spelling(inner) for inner in value]
            case "Topic" | "Marker Topic":
                written["Topic"] = _topic(value)
            case "Depth Map Topic" | "Color Image Topic":
                written[key] = _topic(value)
            case "Update Topic" if kind == "InteractiveMarkers":
                written["Interactive Markers Namespace"] = str(value).removesuffix("/update")
            case "Robot Description":
                written |= {"Description Source": "Topic", "Description Topic": _topic(f"/{value}")}
            case "Queue Size":
                pass  # a topic's depth
            case _:
                written[key] = value
    return written


def _package(package: str, kind: str) -> str:
    if package != "rviz":
        return package
    return "rviz_common" if kind == "Group" else "rviz_default_plugins"


def _topic(name: object) -> Mapping[str, Any]:
    return {**_POLICIES, "Value": name}
