"""libLiftDragPlugin.so: what air does to a wing, rotor blade or sail."""

import math
from typing import Self

from trundle.model import PluginTag
from trundle.ros import Node
from trundle.simulation import JointHandle, LinkHandle, ModelHandle, Simulation
from trundle.spatial import Vector3, Wrench, add, cross, dot, multiply, normalized, subtract

from ..plugin import Plugin

_SLOWEST = 0.01
"""[m/s] Below it Gazebo's plugin does nothing."""


class LiftDrag(Plugin):
    """Pushes <link_name> at <cp> by its speed through still air.

    Parameters, with Gazebo's defaults: <a0> 0, <cla> 1, <cda> 0.01, <alpha_stall> π/2, <cla_stall> 0, <cda_stall> 1,
    <cp> 0 0 0 and <forward> 1 0 0, <upward> 0 0 1 in the link's frame, <area> 1 m², <air_density> 1.2041 kg/m³. Its
    pitching moment (<cma>, <cma_stall>) is always zero there, and so here. Up to the stall the lift coefficient is
    cla · α and the drag coefficient |cda · α|; beyond it they go on with the stall's slopes. Both lose what the air
    blows along the span: the square of the sweep's cosine is left. A wing that flies backwards is one that flies
    forwards: α is within a quarter turn. The position of <control_joint_name> adds <control_joint_rad_to_cl> (4) times
    itself to the lift coefficient. With <radial_symmetry> a rod has its upward side against whatever blows across it.
    """

    def __init__(self, link: LinkHandle, flap: JointHandle | None, tag: PluginTag, sim: Simulation) -> None:
        self._link = link
        self._flap = flap
        parameters, report = tag.node, sim.report

        def number(name: str, default: float) -> float:
            return parameters.number(name, default=default, report=report)

        def direction(name: str, default: Vector3) -> Vector3:
            return normalized(parameters.vector(name, default=default, report=report)) or default

        self._alpha0 = number("a0", 0.0)
        self._lift, self._lift_stalled = number("cla", 1.0), number("cla_stall", 0.0)
        self._drag, self._drag_stalled = number("cda", 0.01), number("cda_stall", 1.0)
        self._stall = number("alpha_stall", math.pi / 2)
        self._area, self._density = number("area", 1.0), number("air_density", 1.2041)
        self._centre = parameters.vector("cp", default=(0.0, 0.0, 0.0), report=report)
        self._forward, self._upward = direction("forward", (1.0, 0.0, 0.0)), direction("upward", (0.0, 0.0, 1.0))
        self._flap_lift = number("control_joint_rad_to_cl", 4.0)
        self._is_round = parameters.flag("radial_symmetry", default=False, report=report)
        for name in ("link_name", "control_joint_name", "cma", "cma_stall"):
            parameters.find(name)
        parameters.report_unread(report)

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """See `Plugin.load`."""
        del node
        flap = tag.node.string("control_joint_name")
        return cls(model.link(tag.node.string("link_name")), model.joint(flap) if flap else None, tag, sim)

    def before_step(self, sim: Simulation) -> None:
        """Push by the speed of now."""
        del sim
        pose, twist = self._link.pose, self._link.twist
        at = pose.transform_point(self._centre)
        arm = subtract(at, pose.position)
        velocity = add(twist.linear, cross(twist.angular, arm))
        forward, upward = pose.transform_vector(self._forward), pose.transform_vector(self._upward)
        if self._is_round:
            upward = normalized(cross(forward, cross(forward, velocity))) or upward
        span = normalized(cross(forward, upward))
        if span is None or _length(velocity) <= _SLOWEST:
            return
        # Only what blows across the span lifts and drags.
        across = add(velocity, multiply(span, -dot(velocity, span)))
        speed, drag_direction = _length(across), normalized(multiply(across, -1.0))
        if drag_direction is None or speed <= _SLOWEST:
            return
        lift_direction = cross(span, across)
        alpha = self._alpha0 + math.atan2(-dot(across, upward), dot(across, forward))
        alpha = math.remainder(alpha, math.pi)
        unswept = (speed / _length(velocity)) ** 2
        flapped = 0.0 if self._flap is None else self._flap_lift * self._flap.position
        pressure = 0.5 * self._density * speed * speed * self._area
        lifting = self._lift_coefficient(alpha) * unswept + flapped
        lift = multiply(normalized(lift_direction) or upward, lifting * pressure)
        drag = multiply(drag_direction, self._drag_coefficient(alpha) * unswept * pressure)
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
