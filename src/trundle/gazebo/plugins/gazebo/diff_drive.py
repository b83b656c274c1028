"""libDiffDrivePlugin.so: differential drive of two wheels."""

from typing import Self

from trundle.robots.model import PluginTag, model_from_joint
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation
from trundle.spatial import Pose

from ..plugin import Plugin
from .bounding_box import bounding_box
from .velocity_command import VelocityCommand


class DiffDrive(Plugin):
    """Wheel speeds from `/<model>/vel_cmd`.

    Parameters: <left_joint>, <right_joint> (required), <torque> [N·m] (5). The wheel separation is that of the
    joints' anchors, the radius half the largest side of the left wheel's bounding box. The left wheel gets
    v + ω·separation/2 and the right one v − ω·separation/2: the opposite of ROS' sense, as in Gazebo.
    """

    def __init__(self, model: ModelHandle, node: Node | None, tag: PluginTag, sim: Simulation) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._left = model.joint(parameters.text("left_joint"))
        self._right = model.joint(parameters.text("right_joint"))
        self._torque = parameters.number("torque", 5.0)
        parameters.report_unread()
        self._separation = _distance(
            model_from_joint(model.model, self._left.joint), model_from_joint(model.model, self._right.joint)
        )
        self._radius = max(bounding_box(model.link(self._left.joint.child).link)) / 2 or 1.0
        self._command = VelocityCommand.subscribe(model, node)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(model, node, tag, sim)

    def before_step(self, sim: Simulation) -> None:
        """Set both wheels' speeds."""
        del sim
        half = self._command.yaw_rate * self._separation / 2
        self._left.command_velocity((self._command.speed + half) / self._radius, max_effort=self._torque)
        self._right.command_velocity((self._command.speed - half) / self._radius, max_effort=self._torque)

    def reset(self) -> None:
        """Stop."""
        self._command.stop()


def _distance(left: Pose, right: Pose) -> float:
    return sum((a - b) ** 2 for a, b in zip(left.position, right.position, strict=True)) ** 0.5
