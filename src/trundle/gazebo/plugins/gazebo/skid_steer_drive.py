"""libSkidSteerDrivePlugin.so: skid-steer drive of four wheels."""

from typing import Self

from trundle.robots.model import PluginTag, model_from_joint
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..plugin import Plugin
from .bounding_box import bounding_box
from .velocity_command import VelocityCommand


class SkidSteerDrive(Plugin):
    """Wheel speeds from `/<model>/vel_cmd`.

    <right_front>, <right_rear>, <left_front> and <left_rear> name the joints (default: their own names). As in Gazebo,
    the right wheels turn with v/r + ω·separation/r and the left ones with v/r − ω·separation/r, twice what a slip-free
    turn needs. <max_force> [N·m] is 5 by default.
    """

    def __init__(self, model: ModelHandle, node: Node | None, tag: PluginTag, sim: Simulation) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self._torque = parameters.number("max_force", 5.0)
        self._right, self._left = (
            [model.joint(parameters.text(name, name)) for name in (f"{side}_front", f"{side}_rear")]
            for side in ("right", "left")
        )
        parameters.report_unread()
        right, left = (model_from_joint(model.model, wheels[0].joint).position for wheels in (self._right, self._left))
        self._separation = sum((a - b) ** 2 for a, b in zip(right, left, strict=True)) ** 0.5
        self._radius = max(bounding_box(model.link(self._right[0].joint.child).link)) / 2 or 1.0
        self._command = VelocityCommand.subscribe(model, node)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        return cls(model, node, tag, sim)

    def before_step(self, sim: Simulation) -> None:
        """Set all wheels' speeds."""
        del sim
        for wheels, sign in ((self._right, 1.0), (self._left, -1.0)):
            speed = (self._command.speed + sign * self._command.yaw_rate * self._separation) / self._radius
            for wheel in wheels:
                wheel.command_velocity(speed, max_effort=self._torque)

    def reset(self) -> None:
        """Stop."""
        self._command.stop()
