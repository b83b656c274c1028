"""yocs_waypoint_provider/waypoint_provider: named waypoints and trajectories of a YAML file."""

import asyncio
from pathlib import Path
from typing import Any, cast

from trundle.base.yaml_loader import load_yaml
from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.private_parameters import private_parameters
from trundle.robots.parameters import ParamError
from trundle.ros import Node

_MAX_BYTES = 1_000_000
_ARROW, _LINE_STRIP, _TEXT = 0, 4, 9
_MARKER, _LABEL = 1000, 2000
"""First ids of the markers."""


class WaypointProvider:
    """Publishes `waypoints` and `trajectories`, latched, with markers of both; `request_waypoints` is a service.

    Parameter: filename, with the original's format: `waypoints` of name, frame_id and pose; `trajectories` of name and
    the names of their waypoints.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Publish until cancelled."""
        node = self._node
        try:
            file = Path((await private_parameters(node)).text("filename"))
            waypoints, trajectories = await asyncio.to_thread(_read, file)
        except (ParamError, OSError, ValueError) as error:
            node.log.error(f"waypoint_provider: {error}")
            return 1
        topics = {
            ("waypoints", "yocs_msgs/WaypointList"): {"waypoints": waypoints},
            ("trajectories", "yocs_msgs/TrajectoryList"): {"trajectories": trajectories},
            ("waypoint_markers", "visualization_msgs/MarkerArray"): {"markers": _waypoint_markers(waypoints)},
            ("trajectory_markers", "visualization_msgs/MarkerArray"): {"markers": _trajectory_markers(trajectories)},
        }
        for (topic, kind), fields in topics.items():
            node.advertise(topic, kind, latch=True, queue_size=5).publish(fields)
        answer = {"success": True, "waypoints": {"waypoints": waypoints}}
        node.advertise_service("request_waypoints", "yocs_msgs/WaypointListService", lambda _: answer)
        await node.closed.wait()
        return 0


def _read(file: Path) -> tuple[list[dict[str, Any]], list[dict[str, Any]]]:
    """Return the fields of the waypoints and trajectories.

    Raises:
        OSError: the file cannot be read.
        ValueError: it is not as the format says.
    """
    if file.stat().st_size > _MAX_BYTES:
        raise ValueError(f"{file} is larger than {_MAX_BYTES} bytes")
    try:
        content: Any = load_yaml(file.read_text(encoding="utf-8"))
    except Exception as error:  # PyYAML raises errors of many types for invalid text
        raise ValueError(f"{file}: {error}") from None
    waypoints: dict[str, dict[str, Any]] = {}
    for item in _list(file, content, "waypoints"):
        name = str(item.get("name", ""))
        try:
            position, turn = (
                {axis: float(item["pose"][part][axis]) for axis in axes}
                for part, axes in (("position", "xyz"), ("orientation", "xyzw"))
            )
        except (KeyError, TypeError, ValueError):
            raise ValueError(f"{file}: waypoint {name!r} has no pose of position x, y, z, orientation x … w") from None
        header = {"frame_id": str(item.get("frame_id", "map"))}
        waypoints[name] = {"header": header, "name": name, "pose": {"position": position, "orientation": turn}}
    trajectories: list[dict[str, Any]] = []
    for item in _list(file, content, "trajectories"):
        names: Any = item.get("waypoints") or []
        if missing := [str(name) for name in names if name not in waypoints]:
            known = ", ".join(waypoints) or "none"
            raise ValueError(f"{file}: trajectory {item.get('name')!r}: no waypoint {missing[0]!r}; there are: {known}")
        passed = [waypoints[name] for name in names]
        header = passed[0]["header"] if passed else {"frame_id": "map"}
        trajectories.append({"header": header, "name": str(item.get("name", "")), "waypoints": passed})
    return list(waypoints.values()), trajectories


def _list(file: Path, content: object, name: str) -> list[dict[str, Any]]:
    if not isinstance(content, dict):
        raise ValueError(f"{file} has no 'waypoints'")
    value: Any = cast("dict[str, Any]", content).get(name) or []
    if not isinstance(value, list) or not all(isinstance(item, dict) for item in cast("list[Any]", value)):
        raise ValueError(f"{file}: {name!r} is not a list of dictionaries")
    return cast("list[dict[str, Any]]", value)


def _waypoint_markers(waypoints: list[dict[str, Any]]) -> list[dict[str, Any]]:
    markers: list[dict[str, Any]] = []
    size = {"x": 0.1, "y": 0.1, "z": 0.1}
    for number, waypoint in enumerate(waypoints):
        pose = waypoint["pose"]
        above = {**pose, "position": {**pose["position"], "z": pose["position"]["z"] + 0.1}}
        common = {"header": waypoint["header"], "scale": size}
        arrow = {"ns": "waypoints", "id": _MARKER + number, "type": _ARROW, "pose": pose}
        label = {"ns": "waypoint_labels", "id": _LABEL + number, "type": _TEXT, "pose": above}
        white = {"r": 1.0, "g": 1.0, "b": 1.0, "a": 1.0}
        markers.append({**common, **arrow, "color": {"g": 1.0, "a": 1.0}})
        markers.append({**common, **label, "color": white, "text": waypoint["name"]})
    return markers


def _trajectory_markers(trajectories: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [
        {
            "header": trajectory["header"],
            "ns": "trajectories",
            "id": _MARKER + number,
            "type": _LINE_STRIP,
            "pose": {"orientation": {"w": 1.0}},
            "color": {"b": 1.0, "a": 1.0},
            "scale": {"x": 0.1},
            "points": [waypoint["pose"]["position"] for waypoint in trajectory["waypoints"]],
        }
        for number, trajectory in enumerate(trajectories)
    ]
