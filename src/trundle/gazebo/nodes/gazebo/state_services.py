"""/gazebo's services and topics that get and set states of models and links."""

from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.ros import Message, Node
from trundle.sim.simulation import LinkHandle, Simulation
from trundle.spatial import Pose, Twist

from ..host import Simulator
from .entities import find_link, find_model, is_world, world_from_entity
from .messages import advertise_status_service, expect_finite, pose_fields, read_pose, read_twist, twist_fields

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs

_CONFIGURED = "SetModelConfiguration: success"


def advertise_state_services(node: Node, simulator: Simulator) -> None:
    """Advertise the services of model and link states, and subscribe ~set_model_state and ~set_link_state."""
    states = _StateServices(simulator)
    for name, kind, handler, status_message in (
        ("get_model_state", "GetModelState", states.get_model_state, "got properties"),
        ("get_link_state", "GetLinkState", states.get_link_state, "got state"),
        ("set_model_state", "SetModelState", states.set_model_state, "set model state done"),
        ("set_link_state", "SetLinkState", states.set_link_state, "success"),
    ):
        advertise_status_service(node, name, kind, handler, f"{kind}: {status_message}")
    handler = states.set_model_configuration
    advertise_status_service(node, "set_model_configuration", "SetModelConfiguration", handler, _CONFIGURED)
    for name, kind, handler in (
        ("set_model_state", "ModelState", states.on_model_state),
        ("set_link_state", "LinkState", states.on_link_state),
    ):
        node.subscribe(
            f"~{name}", f"gazebo_msgs/{kind}", lambda message, handler=handler: _handle_or_log(node, handler, message)
        )


class _StateServices:
    def __init__(self, simulator: Simulator) -> None:
        self._simulator = simulator

    def get_model_state(self, request: "gazebo_msgs.GetModelStateRequest") -> dict[str, Any]:
        simulation = self._simulator.simulation
        model = find_model(simulation, request.model_name)
        frame = world_from_entity(simulation, request.relative_entity_name)
        twist = model.base.twist if model.links else Twist()
        return {
            "header": {"stamp": simulation.time_ns, "frame_id": request.relative_entity_name},
            "pose": pose_fields(frame.inverse() @ model.pose),
            "twist": twist_fields(_relative_twist(simulation, frame, request.relative_entity_name, model.pose, twist)),
        }

    def get_link_state(self, request: "gazebo_msgs.GetLinkStateRequest") -> dict[str, Any]:
        simulation = self._simulator.simulation
        link = find_link(simulation, request.link_name)
        frame = world_from_entity(simulation, request.reference_frame)
        twist = _relative_twist(simulation, frame, request.reference_frame, link.pose, link.twist)
        return {
            "link_state": {
                "link_name": request.link_name,
                "pose": pose_fields(frame.inverse() @ link.pose),
                "twist": twist_fields(twist),
                "reference_frame": request.reference_frame,
            }
        }

    def set_model_state(self, request: "gazebo_msgs.SetModelStateRequest") -> dict[str, Any]:
        return self.on_model_state(request.model_state)

    def set_link_state(self, request: "gazebo_msgs.SetLinkStateRequest") -> dict[str, Any]:
        return self.on_link_state(request.link_state)

    def on_model_state(self, state: "gazebo_msgs.ModelState") -> dict[str, Any]:
        simulation = self._simulator.simulation
        model = find_model(simulation, state.model_name)
        frame = world_from_entity(simulation, state.reference_frame)
        pose, twist = frame @ read_pose(state.pose), _rotate_to_world(frame, read_twist(state.twist))

        def apply(_: Simulation) -> None:
            model.set_pose(pose)
            if not model.model.static:
                model.set_link_twists(twist)

        self._simulator.do(apply)
        return {}

    def on_link_state(self, state: "gazebo_msgs.LinkState") -> dict[str, Any]:
        simulation = self._simulator.simulation
        link = find_link(simulation, state.link_name)
        frame = world_from_entity(simulation, state.reference_frame)
        pose, twist = frame @ read_pose(state.pose), _rotate_to_world(frame, read_twist(state.twist))

        def apply(_: Simulation) -> None:
            link.set_pose(pose)
            link.set_twist(twist)

        self._simulator.do(apply)
        return {}

    def set_model_configuration(self, request: "gazebo_msgs.SetModelConfigurationRequest") -> dict[str, Any]:
        model = find_model(self._simulator.simulation, request.model_name)
        if len(request.joint_names) != len(request.joint_positions):
            raise UsageError(f"{len(request.joint_names)} joints, but {len(request.joint_positions)} positions")
        expect_finite(*request.joint_positions)
        joints = {
            name.rpartition("::")[2]: float(p)
            for name, p in zip(request.joint_names, request.joint_positions, strict=True)
        }
        existing = {joint.name for joint in model.joints}

        def apply(_: Simulation) -> None:
            for name in joints.keys() & existing:
                model.joint(name).set_position(joints[name])
                model.joint(name).set_velocity(0.0)

        self._simulator.do(apply)
        missing = ", ".join(repr(name) for name in joints if name not in existing)
        note = f"{_CONFIGURED}; model {request.model_name!r} has no joint {missing}"  # which Gazebo ignores
        return {"status_message": note} if missing else {}


def _rotate_to_world(frame: Pose, twist: Twist) -> Twist:
    """Rotate a twist from a frame's axes to the world's."""
    return Twist(frame.transform_vector(twist.linear), frame.transform_vector(twist.angular))


def _relative_twist(simulation: Simulation, frame: Pose, entity: str, pose: Pose, twist: Twist) -> Twist:
    """Return a twist relative to a moving entity, in its axes."""
    reference = _reference_link(simulation, entity)
    if reference is None:
        return twist
    reference_twist = reference.twist
    arm = tuple(a - b for a, b in zip(pose.position, reference.pose.position, strict=True))
    (wx, wy, wz), (x, y, z) = reference_twist.angular, (arm[0], arm[1], arm[2])
    rotation_velocity = (wy * z - wz * y, wz * x - wx * z, wx * y - wy * x)
    linear = tuple(v - o - c for v, o, c in zip(twist.linear, reference_twist.linear, rotation_velocity, strict=True))
    angular = tuple(v - o for v, o in zip(twist.angular, reference_twist.angular, strict=True))
    entity_from_world = frame.inverse()
    return Twist(
        entity_from_world.transform_vector((linear[0], linear[1], linear[2])),
        entity_from_world.transform_vector((angular[0], angular[1], angular[2])),
    )


def _reference_link(simulation: Simulation, entity: str) -> LinkHandle | None:
    """Return the link that moves with an entity; None for the world."""
    for model in simulation.models:
        if model.name == entity:
            return model.base if model.links else None
    return None if is_world(entity) else find_link(simulation, entity)


def _handle_or_log(node: Node, handler: Any, message: Message) -> None:
    try:
        handler(message)
    except TrundleError as error:
        node.log.error(str(error))
