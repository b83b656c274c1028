"""/gazebo's services that apply wrenches to links and efforts to joints."""

from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import UsageError
from trundle.ros import Message, Node, to_nsec
from trundle.sim.simulation import JointHandle, LinkHandle
from trundle.spatial import Wrench, cross

from ..host import Simulator
from .entities import find_joint, find_link, is_world, world_from_entity
from .messages import advertise_status_service, expect_finite, read_vector
from .timed_loads import TimedLoads

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs


def advertise_load_services(node: Node, simulator: Simulator) -> None:
    """Advertise apply_body_wrench, clear_body_wrenches, apply_joint_effort, clear_joint_forces (or _efforts)."""
    services = _LoadServices(node, simulator)
    advertise_status_service(node, "apply_body_wrench", "ApplyBodyWrench", services.apply_body_wrench, "")
    advertise_status_service(
        node, "apply_joint_effort", "ApplyJointEffort", services.apply_joint_effort, "ApplyJointEffort: effort set"
    )
    node.advertise_service("~clear_body_wrenches", "gazebo_msgs/BodyRequest", services.clear_body_wrenches)
    node.advertise_service("~clear_joint_forces", "gazebo_msgs/JointRequest", services.clear_joint_forces)
    node.advertise_service("~clear_joint_efforts", "gazebo_msgs/JointRequest", services.clear_joint_forces)


class _LoadServices:
    def __init__(self, node: Node, simulator: Simulator) -> None:
        self._node = node
        self._simulator = simulator
        self._wrenches = TimedLoads[LinkHandle, Wrench](simulator.simulation, _apply_newest_wrench)
        self._efforts = TimedLoads[JointHandle, float](simulator.simulation, _apply_effort_sum)
        for loads in (self._wrenches, self._efforts):
            simulator.post(loads.start)

    def apply_body_wrench(self, request: "gazebo_msgs.ApplyBodyWrenchRequest") -> dict[str, Any]:
        """Apply a wrench for a duration: force at the centre of mass, plus its moment from the reference point.

        The lever arm goes from the link's origin to the reference point, or from the world's origin if the frame is the
        world, as in gazebo_ros; a request without a point thus has no torque. Unlike gazebo_ros (gazebo_ros_pkgs#310),
        the wrench is rotated from the reference frame to the world.
        """
        simulation = self._simulator.simulation
        link = find_link(simulation, request.body_name)
        frame = world_from_entity(simulation, request.reference_frame)
        force, torque = (frame.transform_vector(read_vector(v)) for v in (request.wrench.force, request.wrench.torque))
        arm = frame.transform_point(read_vector(request.reference_point))
        if not is_world(request.reference_frame):
            x, y, z = link.pose.position
            arm = (arm[0] - x, arm[1] - y, arm[2] - z)
        wrench = Wrench(force=force, torque=torque) + Wrench(torque=cross(arm, force))
        self._simulator.do(lambda _: self._wrenches.add(link, wrench, **_times(request)))
        return {}

    def apply_joint_effort(self, request: "gazebo_msgs.ApplyJointEffortRequest") -> dict[str, Any]:
        """Apply an effort to a joint for a duration."""
        joint = find_joint(self._simulator.simulation, request.joint_name)
        expect_finite(request.effort)
        if not joint.axes:
            raise UsageError(f"joint {joint.name!r} cannot move")
        self._simulator.do(lambda _: self._efforts.add(joint, float(request.effort), **_times(request)))
        return {}

    def clear_body_wrenches(self, request: "gazebo_msgs.BodyRequestRequest") -> dict[str, Any]:
        """Remove the wrenches of a link; like gazebo_ros, report success for unknown links."""
        try:
            link = find_link(self._simulator.simulation, request.body_name)
            self._simulator.do(lambda _: self._wrenches.clear(link))
        except UsageError as error:
            self._node.log.warn(str(error))
        return {}

    def clear_joint_forces(self, request: "gazebo_msgs.JointRequestRequest") -> dict[str, Any]:
        """Remove the efforts of a joint."""
        try:
            joint = find_joint(self._simulator.simulation, request.joint_name)
            self._simulator.do(lambda _: self._efforts.clear(joint))
        except UsageError as error:
            self._node.log.warn(str(error))
        return {}


def _apply_newest_wrench(link: LinkHandle, wrenches: list[Wrench]) -> None:
    """Apply the newest wrench only, as Link::SetForce does."""
    link.apply_wrench(wrenches[-1] if wrenches else Wrench())


def _apply_effort_sum(joint: JointHandle, efforts: list[float]) -> None:
    """Apply the sum of efforts, as Joint::SetForce does."""
    joint.command_effort(sum(efforts))


def _times(request: Message) -> dict[str, int]:
    return {"start_ns": to_nsec(request.start_time), "duration_ns": to_nsec(request.duration)}
