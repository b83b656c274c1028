"""libJointTrajectoryPlugin.so: swings the arm of Gazebo's simple_arm_gripper."""

import math
from typing import Self

from trundle.robots.model import PluginTag
from trundle.ros import Node
from trundle.sim.simulation import JointHandle, ModelHandle, Simulation

from ..plugin import Plugin

_SWINGS = {
    "arm_shoulder_pan_joint": (0.0, 1.0, 1.0),
    "arm_elbow_pan_joint": (0.0, -1.0, 1.0),
    "arm_wrist_lift_joint": (-0.35, 0.45, 0.5),
    "arm_wrist_roll_joint": (0.0, -2.9, 3.0),
}
"""Joint → mean [rad or m], amplitude [rad or m] and angular frequency [rad/s] of its cosine."""


class JointTrajectory(Plugin):
    """Sets four joints, by name, to cosines of simulation time; no parameters.

    Gazebo moves only simple_arm_gripper; Trundle moves any model with such joints.
    """

    def __init__(self, joints: list[tuple[JointHandle, float, float, float]]) -> None:
        self._joints = joints

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        joints = [
            (joint, *_SWINGS[name])
            for joint in model.joints
            if (name := joint.name.split("::")[-1]) in _SWINGS and joint.is_driven
        ]
        if not joints:
            message = f"plugin {tag.name!r} moves the joints {', '.join(_SWINGS)} only; the model has none of them"
            sim.report.warn(tag.at, message, "plugin-without-joints")
        tag.node.report_unread(sim.report)
        return cls(joints)

    def before_step(self, sim: Simulation) -> None:
        """Set the positions."""
        time_s = sim.time_ns / 1e9
        for joint, middle, amplitude, rate in self._joints:
            joint.set_position(middle + amplitude * math.cos(rate * time_s))
            joint.set_velocity(0.0)
