"""Makes wheel odometry worse: longer ways, smaller turns, noise that grows with both."""

import math
import random
from typing import Any, Self

from trundle.gazebo.plugins import Plugin
from trundle.robots.model import PluginTag
from trundle.ros import Node, Transform, TransformBroadcaster, to_nsec
from trundle.sim.simulation import ModelHandle, Simulation

_WAY, _TURN = 1.03, 0.97
_WAY_NOISE, _TURN_NOISE = 0.01, 0.02
"""Standard deviations after 1 m [m] and after 1 m or 1 rad [rad]; they grow with the root."""


class WorseOdometry(Plugin):
    """Publishes `odom` and its transform from the odometry on `wheel_odom`."""

    def __init__(self, node: Node) -> None:
        self._random = random.Random(1)
        self._last: tuple[float, float, float] | None = None
        self._pose = (0.0, 0.0, 0.0)
        self._odometry = node.advertise("/odom", "nav_msgs/Odometry", queue_size=1)
        self._broadcaster = TransformBroadcaster(node)
        node.subscribe("/wheel_odom", "nav_msgs/Odometry", self._on_odometry, queue_size=None)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Subscribe to the wheels' odometry."""
        del sim, model, tag
        assert node is not None, "the launch has a graph"
        return cls(node)

    def _on_odometry(self, message: Any) -> None:
        position, q = message.pose.pose.position, message.pose.pose.orientation
        now = (position.x, position.y, 2.0 * math.atan2(q.z, q.w))
        last = self._last or now
        self._last = now
        turned = math.remainder(now[2] - last[2], math.tau)
        middle = last[2] + turned / 2.0
        way = math.cos(middle) * (now[0] - last[0]) + math.sin(middle) * (now[1] - last[1])
        way_noise = self._random.gauss(0.0, _WAY_NOISE * math.sqrt(abs(way)))
        turn_noise = self._random.gauss(0.0, _TURN_NOISE * math.sqrt(abs(way) + abs(turned)))
        way, turned = _WAY * way + way_noise, _TURN * turned + turn_noise
        x, y, yaw = self._pose
        middle = yaw + turned / 2.0
        self._pose = x, y, yaw = x + way * math.cos(middle), y + way * math.sin(middle), yaw + turned
        self._publish(to_nsec(message.header.stamp), x, y, yaw, message.twist.twist)

    def _publish(self, stamp_ns: int, x: float, y: float, yaw: float, twist: Any) -> None:
        w, z = math.cos(yaw / 2.0), math.sin(yaw / 2.0)
        pose = {"position": {"x": x, "y": y}, "orientation": {"z": z, "w": w}}
        speed = {"linear": {"x": _WAY * twist.linear.x}, "angular": {"z": _TURN * twist.angular.z}}
        header = {"stamp": stamp_ns, "frame_id": "odom"}
        fields = {
            "header": header,
            "child_frame_id": "base_footprint",
            "pose": {"pose": pose},
            "twist": {"twist": speed},
        }
        self._odometry.publish(fields)
        self._broadcaster.send_transform(
            Transform(
                parent="odom",
                child="base_footprint",
                stamp_ns=stamp_ns,
                translation=(x, y, 0.0),
                rotation=(w, 0.0, 0.0, z),
            )
        )
