"""Services of the planning scene: get_planning_scene, apply_planning_scene, clear_octomap."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext


def offer_get_planning_scene(context: "MoveGroupContext") -> None:
    """Advertise get_planning_scene."""

    async def answer(request: "Message") -> dict[str, Any]:
        return {"scene": context.monitor.fields(int(request.components.components))}

    context.node.advertise_service("get_planning_scene", "moveit_msgs/GetPlanningScene", answer)


def offer_apply_planning_scene(context: "MoveGroupContext") -> None:
    """Advertise apply_planning_scene."""

    async def answer(request: "Message") -> dict[str, Any]:
        return {"success": context.monitor.apply(request.scene)}

    context.node.advertise_service("apply_planning_scene", "moveit_msgs/ApplyPlanningScene", answer)


def offer_clear_octomap(context: "MoveGroupContext") -> None:
    """Advertise clear_octomap."""

    async def answer(request: "Message") -> dict[str, Any]:
        del request
        context.node.log.info("Clearing octomap...")
        context.monitor.clear_octomap()
        context.node.log.info("Octomap cleared.")
        return {}

    context.node.advertise_service("clear_octomap", "std_srvs/Empty", answer)
