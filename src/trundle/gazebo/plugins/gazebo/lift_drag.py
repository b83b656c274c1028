"""libLiftDragPlugin.so: lift and drag of a wing, rotor blade or sail."""

import math
from typing import Self

from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.sim.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Vector3, Wrench, add, cross, dot, multiply, normalized, subtract

from ..plugin import Plugin

_MIN_AIRSPEED = 0.01
"""Airspeed [m/s] below which Gazebo's plugin applies nothing."""


class LiftDrag(Plugin):
    """Applies lift and drag in still air to <link_name> at <cp>.

    Parameters, with Gazebo's defaults: <a0> 0, <cla> 1, <cda> 0.01, <alpha_stall> π/2, <cla_stall> 0, <cda_stall> 1,
    <cp> 0 0 0 and <forward> 1 0 0, <upward> 0 0 1 in the link's frame, <area> 1 m², <air_density> 1.2041 kg/m³. Its
    pitching moment (<cma>, <cma_stall>) is always zero in Gazebo, and so here. Below stall the lift coefficient is
    cla · α and the drag coefficient |cda · α|; above it they continue with the stall's slopes. Both are multiplied by
    the squared cosine of the sweep angle. α is wrapped to ±π/2, so that a wing that flies backwards acts as if it flew
    forwards. <control_joint_rad_to_cl> (4) times the position of <control_joint_name> is added to the lift
    coefficient. With <radial_symmetry> the upward direction opposes the flow across <forward>.
    """

    def __init__(self, link: LinkHandle, flap: JointHandle | None, parameters: TagParameters) -> None:
        self._link = link
        self._flap = flap

        def direction(name: str, default: Vector3) -> Vector3:
            return normalized(parameters.vector(name, default)) or default

        self._alpha0 = parameters.number("a0", 0.0)
        self._lift, self._lift_stalled = parameters.number("cla", 1.0), parameters.number("cla_stall", 0.0)
        self._drag, self._drag_stalled = parameters.number("cda", 0.01), parameters.number("cda_stall", 1.0)
        self._stall = parameters.number("alpha_stall", math.pi / 2)
        self._area, self._density = parameters.number("area", 1.0), parameters.number("air_density", 1.2041)
        self._centre = parameters.vector("cp", (0.0, 0.0, 0.0))
        self._forward, self._upward = direction("forward", (1.0, 0.0, 0.0)), direction("upward", (0.0, 0.0, 1.0))
        self._flap_lift = parameters.number("control_joint_rad_to_cl", 4.0)
        self._is_radial = parameters.flag("radial_symmetry", default=False)
        parameters.ignore("link_name", "control_joint_name", "cma", "cma_stall")
        parameters.report_unread()

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        flap = parameters.text("control_joint_name", "")
        return cls(model.link(parameters.text("link_name")), model.joint(flap) if flap else None, parameters)

    def before_step(self, sim: Simulation) -> None:
        """Apply the forces at the current velocity."""
        del sim
        pose, twist = self._link.pose, self._link.twist
        at = pose.transform_point(self._centre)
        arm = subtract(at, pose.position)
        velocity = add(twist.linear, cross(twist.angular, arm))
        forward, upward = pose.transform_vector(self._forward), pose.transform_vector(self._upward)
        if self._is_radial:
            upward = normalized(cross(forward, cross(forward, velocity))) or upward
        span = normalized(cross(forward, upward))
        if span is None or _length(velocity) <= _MIN_AIRSPEED:
            return
        # Only the flow across the span produces lift and drag.
        across = add(velocity, multiply(span, -dot(velocity, span)))
        speed, drag_direction = _length(across), normalized(multiply(across, -1.0))
        if drag_direction is None or speed <= _MIN_AIRSPEED:
            return
        lift_direction = cross(span, across)
        alpha = self._alpha0 + math.atan2(-dot(across, upward), dot(across, forward))
        alpha = math.remainder(alpha, math.pi)
        sweep_factor = (speed / _length(velocity)) ** 2
        flap_lift = 0.0 if self._flap is None else self._flap_lift * self._flap.position
        pressure = 0.5 * self._density * speed * speed * self._area
        lift_coefficient = self._lift_coefficient(alpha) * sweep_factor + flap_lift
        lift = multiply(normalized(lift_direction) or upward, lift_coefficient * pressure)
        drag = multiply(drag_direction, self._drag_coefficient(alpha) * sweep_factor * pressure)
        self._link.add_wrench(Wrench(force=add(lift, drag)), at=at)

    def _lift_coefficient(self, alpha: float) -> float:
        if abs(alpha) <= self._stall:
            return self._lift * alpha
        sign = math.copysign(1.0, alpha)
        stalled = self._lift * self._stall + self._lift_stalled * (abs(alpha) - self._stall)
        return sign * max(0.0, stalled)

    def _drag_coefficient(self, alpha: float) -> float:
        if abs(alpha) <= self._stall:
            return abs(self._drag * alpha)
        return abs(self._drag * self._stall + self._drag_stalled * (abs(alpha) - self._stall))


def _length(a: Vector3) -> float:
    return math.hypot(*a)
