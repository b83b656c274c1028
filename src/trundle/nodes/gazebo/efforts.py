"""/gazebo's services that push: wrenches on links, efforts on joints."""

from typing import Any

from trundle.ros import Message, Node, ns_of
from trundle.spatial import Vector3, Wrench

from ..host import Simulator
from .entities import find_joint, find_link, world_from
from .messages import answered, vector_of


def advertise_efforts(node: Node, simulator: Simulator) -> None:
    """Provide apply_body_wrench, clear_body_wrenches, apply_joint_effort and clear_joint_forces (old: efforts)."""
    efforts = _Efforts(simulator)
    node.advertise_service("~apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", answered(efforts.push, ""))
    node.advertise_service("~apply_joint_effort", "gazebo_msgs/ApplyJointEffort", answered(efforts.turn, ""))
    node.advertise_service("~clear_body_wrenches", "gazebo_msgs/BodyRequest", efforts.let_go_of_link)
    node.advertise_service("~clear_joint_forces", "gazebo_msgs/JointRequest", efforts.let_go_of_joint)
    node.advertise_service("~clear_joint_efforts", "gazebo_msgs/JointRequest", efforts.let_go_of_joint)


class _Efforts:
    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator

    def push(self, request: Message) -> dict[str, Any]:
        """Hold a wrench, given in the reference frame's axes at a point of it, for a time."""
        simulation = self._simulator.simulation
        link = find_link(simulation, request.body_name)
        frame = world_from(simulation, request.reference_frame)
        force, torque = (frame.direction(vector_of(v)) for v in (request.wrench.force, request.wrench.torque))
        at = frame.point(vector_of(request.reference_point))
        arm = _minus(at, link.pose.point(link.link.inertial.link_from_com.position))
        wrench = Wrench(force=force, torque=_plus(torque, _cross(arm, force)))
        link.apply_wrench(wrench, duration_s=_duration_s(request))
        return {}

    def turn(self, request: Message) -> dict[str, Any]:
        """Hold an effort on a joint for a time."""
        joint = find_joint(self._simulator.simulation, request.joint_name)
        joint.set_effort(request.effort, duration_s=_duration_s(request))
        return {}

    def let_go_of_link(self, request: Message) -> dict[str, Any]:
        """Apply nothing any more."""
        find_link(self._simulator.simulation, request.body_name).apply_wrench(Wrench())
        return {}

    def let_go_of_joint(self, request: Message) -> dict[str, Any]:
        """Drive it no more."""
        find_joint(self._simulator.simulation, request.joint_name).set_effort(0.0)
        return {}


def _duration_s(request: Message) -> float | None:
    """How long it is held; less than zero: for ever."""
    ns = ns_of(request.duration)
    return None if ns < 0 else ns / 1e9


def _minus(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def _plus(a: Vector3, b: Vector3) -> Vector3:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def _cross(a: Vector3, b: Vector3) -> Vector3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
