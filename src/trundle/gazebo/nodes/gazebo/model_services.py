"""/gazebo's services that spawn and delete models."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.ros import Message, Node

from ..host import Simulator
from .entities import world_from_entity
from .messages import advertise_status_service, read_pose

if TYPE_CHECKING:
    from trundle.ros.message_types import gazebo_msgs


def advertise_model_services(node: Node, simulator: Simulator) -> None:
    """Advertise spawn_urdf_model, spawn_sdf_model and delete_model."""
    for name in ("spawn_urdf_model", "spawn_sdf_model"):
        advertise_status_service(
            node, name, "SpawnModel", _spawn(node, simulator), "SpawnModel: Successfully spawned entity"
        )

    def delete(request: "gazebo_msgs.DeleteModelRequest") -> dict[str, Any]:
        simulator.delete(request.model_name)
        return {}

    advertise_status_service(node, "delete_model", "DeleteModel", delete, "DeleteModel: successfully deleted model")


def _spawn(node: Node, simulator: Simulator) -> Callable[[Message], dict[str, Any]]:
    def spawn(request: "gazebo_msgs.SpawnModelRequest") -> dict[str, Any]:
        pose = world_from_entity(simulator.simulation, request.reference_frame) @ read_pose(request.initial_pose)
        simulator.spawn(
            request.model_xml, name=request.model_name, world_from_model=pose, namespace=request.robot_namespace
        )
        node.log.info(f"spawned {request.model_name}")
        return {}

    return spawn
