"""The services query_planner_interface, get_planner_params and set_planner_params."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext


def offer_planner_services(context: "MoveGroupContext") -> None:
    """Advertise the three services."""
    pipelines = context.pipelines

    async def query(request: "Message") -> dict[str, Any]:
        del request
        interfaces = [
            {"name": pipeline.description, "pipeline_id": pipeline.name, "planner_ids": pipeline.planner_ids}
            for pipeline in pipelines.all
        ]
        return {"planner_interfaces": interfaces}

    async def get(request: "Message") -> dict[str, Any]:
        pipeline = pipelines.find(str(request.pipeline_id))
        if pipeline is None:
            return {"params": {}}
        settings = pipeline.planner_settings(str(request.group), str(request.planner_config))
        return {
            "params": {
                "keys": list(settings),
                "values": [str(value) for value in settings.values()],
                "descriptions": [""] * len(settings),
            }
        }

    async def change(request: "Message") -> dict[str, Any]:
        pipeline = pipelines.find(str(request.pipeline_id))
        if pipeline is not None:
            params = request.params
            values = {str(k): str(v) for k, v in zip(params.keys, params.values, strict=False)}
            config, group = str(request.planner_config), str(request.group)
            pipeline.set_planner_settings(group, config, values, replace=bool(request.replace))
        return {}

    node = context.node
    node.advertise_service("query_planner_interface", "moveit_msgs/QueryPlannerInterfaces", query)
    node.advertise_service("get_planner_params", "moveit_msgs/GetPlannerParams", get)
    node.advertise_service("set_planner_params", "moveit_msgs/SetPlannerParams", change)
