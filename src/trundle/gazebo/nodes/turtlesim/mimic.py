"""turtlesim/mimic: drives one turtle like another."""

from typing import TYPE_CHECKING

from trundle.ros import Node

from ..host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import turtlesim


class Mimic:
    """Republishes the velocities of `input/pose` on `output/cmd_vel`."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Mimic until cancelled."""
        node = self._node
        commands = node.advertise("output/cmd_vel", "geometry_msgs/Twist", queue_size=1)

        def on_pose(pose: "turtlesim.Pose") -> None:
            commands.publish({"linear": {"x": pose.linear_velocity}, "angular": {"z": pose.angular_velocity}})

        node.subscribe("input/pose", "turtlesim/Pose", on_pose, queue_size=1)
        await node.closed.wait()
        return 0
