"""interactive_marker_twist_server/marker_server: arrows and a ring in rviz that drive the robot."""

import math
from collections.abc import Mapping
from typing import Any

from trundle.robots.parameters import RosParameters
from trundle.ros import Node

from .host import NodeHost
from .private_parameters import private_parameters
from .rate import Rate

_TOPIC = "twist_marker_server"
_KEEP_ALIVE, _UPDATE = 0, 1
"""Types of InteractiveMarkerUpdate."""
_MOVE_AXIS, _ROTATE_AXIS = 3, 5
"""Modes of InteractiveMarkerControl."""
_HALF = math.sqrt(0.5)
_AXES = {"x": (1.0, 0.0, 0.0), "y": (0.0, 0.0, 1.0), "z": (0.0, 1.0, 0.0)}
"""Axis → vector part of the quaternion that rotates a control's x axis to this axis; w has the same value
(visualization_msgs).
"""
_KEEP_ALIVE_HZ = 2.0


class TwistMarkerServer:
    """Publishes `twist_marker_server/cmd_vel` while its marker is dragged; the marker then snaps back.

    Parameters, with the original's defaults: link_name base_link, robot_name robot, linear_scale and
    max_positive_linear_velocity 1, max_negative_linear_velocity -1 (each a number for x, or numbers for x, y, z),
    angular_scale and max_angular_velocity 2.2, marker_size_scale 1.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._update_count = 0
        """Number of updates."""

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        self._frame, robot = settings.text("link_name", "base_link"), settings.text("robot_name", "robot")
        self._name = f"{robot}_twist_marker"
        self._scales = _by_axis(settings, "linear_scale", 1.0)
        self._max_velocities = _by_axis(settings, "max_positive_linear_velocity", 1.0)
        self._min_velocities = _by_axis(settings, "max_negative_linear_velocity", -1.0)
        self._angular_scale = settings.number("angular_scale", 2.2)
        self._max_yaw_rate = settings.number("max_angular_velocity", 2.2)
        self._commands = node.advertise(f"{_TOPIC}/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        self._updates = node.advertise(f"{_TOPIC}/update", "visualization_msgs/InteractiveMarkerUpdate", queue_size=100)
        marker = self._marker(f"twist controller for {robot}", settings.number("marker_size_scale", 1.0))
        self._full_updates = node.advertise(
            f"{_TOPIC}/update_full", "visualization_msgs/InteractiveMarkerInit", queue_size=100, latch=True
        )
        self._full_updates.publish({"server_id": node.name, "seq_num": 0, "markers": [marker]})
        kind = "visualization_msgs/InteractiveMarkerFeedback"
        node.subscribe(f"{_TOPIC}/feedback", kind, self._on_feedback, queue_size=100)
        rate = Rate(node, _KEEP_ALIVE_HZ)
        while not node.closed.is_set():
            self._updates.publish({"server_id": node.name, "seq_num": self._update_count, "type": _KEEP_ALIVE})
            await rate.sleep()
        return 0

    def _marker(self, description: str, scale: float) -> dict[str, Any]:
        controls = [_control(f"move_{axis}", axis, _MOVE_AXIS) for axis in self._scales]
        return {
            "header": {"frame_id": self._frame},
            "name": self._name,
            "description": description,
            "scale": scale,
            "pose": {"orientation": {"w": 1.0}},
            "controls": [_control("rotate_z", "z", _ROTATE_AXIS), *controls],
        }

    def _on_feedback(self, feedback: Any) -> None:
        if feedback.marker_name != self._name:
            return
        position, orientation = feedback.pose.position, feedback.pose.orientation
        yaw = math.atan2(
            2.0 * (orientation.w * orientation.z + orientation.x * orientation.y),
            1.0 - 2.0 * (orientation.y * orientation.y + orientation.z * orientation.z),
        )
        values = [yaw, *(getattr(position, axis) for axis in self._scales)]
        if not all(map(math.isfinite, values)):
            return
        yaw_rate = min(max(yaw * self._angular_scale, -self._max_yaw_rate), self._max_yaw_rate)
        linear = {
            axis: min(
                max(getattr(position, axis) * scale, self._min_velocities.get(axis, -1.0)),
                self._max_velocities.get(axis, 1.0),
            )
            for axis, scale in self._scales.items()
        }
        self._commands.publish({"linear": linear, "angular": {"z": yaw_rate}})
        self._update_count += 1
        pose = {"header": {"frame_id": self._frame}, "name": self._name, "pose": {"orientation": {"w": 1.0}}}
        update = {"server_id": self._node.name, "seq_num": self._update_count, "type": _UPDATE, "poses": [pose]}
        self._updates.publish(update)


def _control(name: str, axis: str, mode: int) -> dict[str, Any]:
    x, y, z = (_HALF * value for value in _AXES[axis])
    return {"name": name, "interaction_mode": mode, "orientation": {"w": _HALF, "x": x, "y": y, "z": z}}


def _by_axis(settings: RosParameters, name: str, default: float) -> Mapping[str, float]:
    """Read a number, for x only, or a number per axis."""
    section = settings.section(name)
    if section.names():
        return {axis: section.number(axis) for axis in "xyz" if axis in section}
    return {"x": settings.number(name, default)}
