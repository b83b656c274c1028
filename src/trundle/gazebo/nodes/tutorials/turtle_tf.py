"""Nodes of turtle_tf and turtle_tf2: frames of turtles, and a turtle that follows another by tf."""

import math
from typing import TYPE_CHECKING

from trundle.ros import Node, Transform, TransformBroadcaster, TransformError, TransformListener
from trundle.spatial import quaternion_from_rpy

from ..host import NodeHost
from ..private_parameters import private_parameters
from ..rate import Rate

if TYPE_CHECKING:
    from trundle.ros.message_types import turtlesim

_WORLD, _LEADER, _FOLLOWER = "world", "turtle1", "turtle2"
_SPAWN = {"x": 4.0, "y": 2.0, "theta": 0.0, "name": _FOLLOWER}
_TURN_GAIN, _SPEED_GAIN = 4.0, 0.5
_RATE_HZ = 10.0


class TurtleBroadcaster:
    """Publishes a turtle's pose as a transform from `world`; its name is the parameter `turtle` or an argument."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del host
        self._node = node
        self._arguments = arguments

    async def run(self) -> int:
        """Broadcast until cancelled."""
        node = self._node
        turtle = (await private_parameters(node)).text("turtle", next(iter(self._arguments), _LEADER)).strip("/")
        broadcaster = TransformBroadcaster(node)

        def on_pose(pose: "turtlesim.Pose") -> None:
            transform = Transform(
                parent=_WORLD,
                child=turtle,
                stamp_ns=node.clock.now_ns(),
                translation=(pose.x, pose.y, 0.0),
                rotation=quaternion_from_rpy(0.0, 0.0, pose.theta),
            )
            broadcaster.send_transform(transform)

        node.subscribe(f"/{turtle}/pose", "turtlesim/Pose", on_pose, queue_size=1)
        await node.closed.wait()
        return 0


class TurtleFollower:
    """Spawns turtle2, which drives towards turtle1."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Follow until cancelled."""
        node = self._node
        buffer = TransformListener(node).buffer
        await node.wait_for_service("spawn")
        await node.call_service("spawn", "turtlesim/Spawn", _SPAWN)
        commands = node.advertise(f"{_FOLLOWER}/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        rate = Rate(node, _RATE_HZ)
        while not node.closed.is_set():
            try:
                x, y, _ = buffer.lookup_transform(_FOLLOWER, _LEADER).translation
            except TransformError:
                pass  # the transforms are not broadcast yet
            else:
                yaw_rate, speed = _TURN_GAIN * math.atan2(y, x), _SPEED_GAIN * math.hypot(x, y)
                commands.publish({"linear": {"x": speed}, "angular": {"z": yaw_rate}})
            await rate.sleep()
        return 0
