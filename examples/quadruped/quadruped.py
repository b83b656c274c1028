"""Trots: moves the eight joints of the quadruped beside this file.

    /cmd_vel       geometry_msgs/Twist     linear.x [m/s] forwards, angular.z [rad/s] to the left
    /joint_states  sensor_msgs/JointState  every joint

Diagonal legs step together. A foot on the ground moves backwards at the speed of the robot, the others swing to the
front; the angles of hip and knee follow from the place of the foot. Parameters of <plugin>, all optional: <speed>
0 m/s, until the first command; <period> 0.3 s, of two steps; <height> 0.25 m, of the hips; <lift> 0.03 m, of a foot.
"""

import math

from trundle import ModelHandle, Plugin, PluginTag, Simulation, TagParameters, ros
from trundle.ros import bridge

PERIOD_S = 0.01
LENGTH = 0.15
"""Of thigh and shank, each [m]."""
HALF_WIDTH = 0.4
"""Lever of a leg when turning [m]: feet that cannot step sideways slip, and need three times their real lever."""
TORQUE, MAX_SPEED = 20.0, 20.0
"""Of a joint's motor [N·m], [rad/s]."""
REACHED_S = 0.02
"""Time in which a joint reaches its angle [s]."""
STEPPING_SPEED = 0.05
"""Speed from which feet are lifted to their full height [m/s]."""
LEGS = {
    "front_left": (0.0, 1.0),
    "back_right": (0.0, -1.0),
    "front_right": (0.5, -1.0),
    "back_left": (0.5, 1.0),
}
"""Leg → its part of the period, and its side: 1 is left."""


class Trot(Plugin):
    """Places the feet of four legs."""

    period_ns = round(PERIOD_S * 1e9)

    def __init__(self, sim: Simulation, model: ModelHandle, node: "ros.Node | None", tag: PluginTag) -> None:
        parameters = TagParameters(tag.node, sim.report)
        self.first = (parameters.number("speed", 0.0), 0.0)
        self.gait_s = parameters.number("period", 0.3, above=0.0)
        self.height = parameters.number("height", 0.25, above=0.0)
        self.lift = parameters.number("lift", 0.03)
        parameters.report_unread()
        self.joints = {leg: (model.joint(f"{leg}_hip"), model.joint(f"{leg}_knee")) for leg in LEGS}
        self.reset()
        if node is not None:
            node.subscribe("/cmd_vel", "geometry_msgs/Twist", self.take)
            states = bridge.JointStatesTopic(node, model)
            sim.add_hook(states, period_ns=states.period_ns, enabled=states.enabled)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: "ros.Node | None", tag: PluginTag) -> "Trot":
        return cls(sim, model, node, tag)

    def reset(self) -> None:
        self.command = self.first
        self.phase = 0.0

    def take(self, twist) -> None:
        if math.isfinite(twist.linear.x) and math.isfinite(twist.angular.z):
            self.command = (max(-0.6, min(twist.linear.x, 0.6)), max(-1.0, min(twist.angular.z, 1.0)))

    def before_step(self, _sim: Simulation) -> None:
        forward, turning = self.command
        self.phase = (self.phase + PERIOD_S / self.gait_s) % 1.0
        for leg, (offset, side) in LEGS.items():
            foot = self.foot((self.phase + offset) % 1.0, forward - side * turning * HALF_WIDTH)
            for joint, angle in zip(self.joints[leg], angles(*foot), strict=True):
                speed = (angle - joint.position) / REACHED_S
                joint.command_velocity(max(-MAX_SPEED, min(speed, MAX_SPEED)), max_effort=TORQUE)

    def foot(self, phase: float, speed: float) -> tuple[float, float]:
        """Return where a foot is, forwards and upwards of its hip [m]: half of the period on the ground."""
        stride = speed * self.gait_s / 2
        if phase < 0.5:
            return stride * (0.5 - 2 * phase), -self.height
        swing = 2 * phase - 1
        lift = self.lift * min(1.0, abs(speed) / STEPPING_SPEED)
        return stride * (swing - 0.5), lift * math.sin(math.pi * swing) ** 2 - self.height


def angles(x: float, z: float) -> tuple[float, float]:
    """Return the angles of hip and knee that place the foot [rad]; out of reach, the leg is straight."""
    distance = min(math.hypot(x, z), 2 * LENGTH)
    knee = -2 * math.acos(distance / (2 * LENGTH))
    return math.atan2(-x, -z) - knee / 2, knee
