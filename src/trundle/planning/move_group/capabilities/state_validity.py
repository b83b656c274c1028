"""The service check_state_validity; contacts are shown as markers as well."""

import asyncio
from typing import TYPE_CHECKING, Any

from trundle.base.diagnostics import TrundleError

from ..constraint_messages import evaluate

if TYPE_CHECKING:
    from trundle.planning.planning_scene import Contact
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

_TYPES = {"robot_link": 0, "world_object": 1, "robot_attached": 2}
_MAX_CONTACTS = 100


def offer_state_validity(context: "MoveGroupContext") -> None:
    """Advertise check_state_validity."""

    async def answer(request: "Message") -> dict[str, Any]:
        try:
            positions = await context.monitor.start_positions(request.robot_state)
            frames = context.monitor.frames(positions)
            scene = context.pipelines.scene(context.monitor.contents, positions)
            results = evaluate(
                context.monitor.kinematics, request.constraints, frames, positions, scene, context.node.log.warn
            )
        except (ValueError, TrundleError) as error:
            context.node.log.error(f"check_state_validity: {error}")
            return {"valid": False}
        group = str(request.group_name) or None
        if group is not None and group not in context.monitor.model.groups:
            context.node.log.error(f"check_state_validity: there is no group '{group}'")
            return {"valid": False}
        contacts = await asyncio.to_thread(scene.check, positions, group=group, max_contacts=_MAX_CONTACTS)
        frame = context.monitor.model.model_frame
        return {
            "valid": not contacts and all(is_met for is_met, _ in results),
            "contacts": [contact_fields(contact, frame) for contact in contacts],
            "constraint_result": [{"result": is_met, "distance": distance} for is_met, distance in results],
        }

    context.node.advertise_service("check_state_validity", "moveit_msgs/GetStateValidity", answer)


def contact_fields(contact: "Contact", frame: str) -> dict[str, Any]:
    """Return the fields of a moveit_msgs/ContactInformation."""
    px, py, pz = contact.position
    nx, ny, nz = contact.normal
    return {
        "header": {"frame_id": frame},
        "position": {"x": px, "y": py, "z": pz},
        "normal": {"x": nx, "y": ny, "z": nz},
        "depth": contact.depth,
        "contact_body_1": contact.body_1,
        "body_type_1": _TYPES[contact.type_1],
        "contact_body_2": contact.body_2,
        "body_type_2": _TYPES[contact.type_2],
    }
