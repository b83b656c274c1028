"""turtlesim/draw_square: drives turtle1 around a square, endlessly."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from trundle.ros import Message, Node

from ..host import NodeHost
from ..rate import Rate

if TYPE_CHECKING:
    from trundle.ros.message_types import turtlesim

_SIDE_M = 2.0
_RATE_HZ = 62.5


class DrawSquare:
    """Drives two metres, turns by 90 degrees, and repeats."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._pose: Message | None = None

    async def run(self) -> int:
        """Draw until cancelled."""
        node = self._node
        self._commands = node.advertise("turtle1/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        node.subscribe("turtle1/pose", "turtlesim/Pose", self._on_pose, queue_size=1)
        await node.wait_for_service("reset")
        await node.call_service("reset", "std_srvs/Empty")
        rate = Rate(node, _RATE_HZ)
        while self._pose is None:
            await rate.sleep()
        while True:
            start = self._pose
            target = (start.x + _SIDE_M * math.cos(start.theta), start.y + _SIDE_M * math.sin(start.theta))
            await self._until(rate, lambda p, to=target: math.dist((p.x, p.y), to) < 0.1, linear=1.0)
            heading = math.remainder(start.theta + math.pi / 2.0, math.tau)
            await self._until(
                rate, lambda p, to=heading: abs(math.remainder(p.theta - to, math.tau)) < 0.01, angular=0.4
            )

    async def _until(
        self, rate: Rate, reached: Callable[[Message], bool], *, linear: float = 0.0, angular: float = 0.0
    ) -> None:
        """Drive until a goal is reached, then stop and wait for rest."""
        while not reached(self._pose):
            self._commands.publish({"linear": {"x": linear}, "angular": {"z": angular}})
            await rate.sleep()
        while self._pose is not None and (self._pose.linear_velocity or self._pose.angular_velocity):
            self._commands.publish({})
            await rate.sleep()

    def _on_pose(self, pose: "turtlesim.Pose") -> None:
        self._pose = pose
