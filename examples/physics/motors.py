"""Drives the joints of the worlds in this folder, like a controller or a ROS node.

Each <motor> of <plugin filename="libmotors.so"> has the name of a <joint>, and any of <speed> [rad/s or m/s], which a
motor keeps, <effort> [N·m or N], its limit, and <start> [rad/s or m/s], the joint's initial speed. The physics engine
does the rest: no code runs at a step.
"""

import math

from trundle import ModelHandle, Plugin, PluginTag, Simulation, TagParameters, ros


class Motors(Plugin):
    """Joints with an initial or a constant speed."""

    period_ns = 1 << 62  # never again

    def __init__(self, sim: Simulation, model: ModelHandle, tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self.motors = parameters.sections("motor")
        self.model = model
        self.reset()
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: "ros.Node | None", tag: PluginTag) -> "Motors":
        del node  # motors have no commands
        return cls(sim, model, tag)

    def reset(self) -> None:
        for motor in self.motors:
            joint = self.model.joint(motor.text("joint"))
            effort = motor.number("effort", math.inf)
            if "start" in motor:
                joint.set_velocity(motor.number("start"))
            if "speed" in motor:
                joint.command_velocity(motor.number("speed"), max_effort=effort)
