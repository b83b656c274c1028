"""The services compute_ik and compute_fk."""

import asyncio
from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.planning.planners import ErrorCode
from trundle.ros import to_nsec
from trundle.spatial import NS_PER_S, Pose

from ..constraint_messages import constraint_check
from ..scene import pose_fields, pose_of

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

_TIMEOUT_S = 0.05


def offer_kinematics(context: "MoveGroupContext") -> None:
    """Advertise compute_ik and compute_fk."""

    async def ik(request: "Message") -> dict[str, Any]:
        code, solution = await _solve(context, request.ik_request)
        fields: dict[str, Any] = {"error_code": {"val": int(code)}}
        if solution is not None:
            fields["solution"] = context.state_fields(solution)
        return fields

    async def fk(request: "Message") -> dict[str, Any]:
        return await _link_poses(context, request)

    context.node.advertise_service("compute_ik", "moveit_msgs/GetPositionIK", ik)
    context.node.advertise_service("compute_fk", "moveit_msgs/GetPositionFK", fk)


async def _solve(context: "MoveGroupContext", request: "Message") -> tuple[ErrorCode, np.ndarray | None]:
    monitor, model = context.monitor, context.monitor.model
    group = model.groups.get(str(request.group_name))
    if group is None:
        return ErrorCode.INVALID_GROUP_NAME, None
    targets = list(request.pose_stamped_vector) or [request.pose_stamped]
    links = (
        [str(name) for name in request.ik_link_names]
        if len(request.pose_stamped_vector)
        else [str(request.ik_link_name)]
    )
    if len(targets) > 1 and len(links) != len(targets):
        return ErrorCode.INVALID_LINK_NAME, None
    try:
        start = await context.monitor.start_positions(request.robot_state)
        frames = monitor.frames(start)
        poses = [frames.find(str(one.header.frame_id)) @ pose_of(one.pose) for one in targets]
        needs_scene = request.avoid_collisions or len(request.constraints.visibility_constraints)
        scene = context.pipelines.scene(monitor.contents, start) if needs_scene else None
        is_satisfied = constraint_check(monitor.kinematics, request.constraints, frames, scene, context.node.log.warn)
    except ValueError as error:
        context.node.log.error(f"compute_ik: {error}")
        return ErrorCode.INVALID_ROBOT_STATE, None
    except TrundleError as error:
        context.node.log.error(f"compute_ik: {error}")
        return ErrorCode.FRAME_TRANSFORM_FAILURE, None
    wanted = [name or None for name in links] or [None]
    for name in wanted:
        if name is not None and not model.has_link(name):
            return ErrorCode.INVALID_LINK_NAME, None
    timeout_s = to_nsec(request.timeout) / NS_PER_S or context.pipelines.ik_timeout_s(group.name) or _TIMEOUT_S
    checked = scene if request.avoid_collisions else None

    def is_valid(positions: np.ndarray) -> bool:
        return (checked is None or checked.is_free(positions, group=group.name)) and is_satisfied(positions)

    found = await asyncio.to_thread(
        context.pipelines.solve, group.name, list(zip(wanted, poses, strict=False)), start, timeout_s, is_valid
    )
    return (ErrorCode.NO_IK_SOLUTION, None) if found is None else (ErrorCode.SUCCESS, found)


async def _link_poses(context: "MoveGroupContext", request: "Message") -> dict[str, Any]:
    monitor = context.monitor
    names = [str(name) for name in request.fk_link_names]
    if not names:
        context.node.log.error("No links specified for FK request")
        return {"error_code": {"val": int(ErrorCode.INVALID_LINK_NAME)}}
    known = [name for name in names if monitor.model.has_link(name)]
    frame = str(request.header.frame_id).lstrip("/") or monitor.model.model_frame
    try:
        positions = await context.monitor.start_positions(request.robot_state)
        frames = monitor.frames(positions)
        frame_from_model: Pose = frames.find(frame).inverse()
    except ValueError as error:
        context.node.log.error(f"compute_fk: {error}")
        return {"error_code": {"val": int(ErrorCode.INVALID_ROBOT_STATE)}}
    except TrundleError as error:
        context.node.log.error(f"compute_fk: {error}")
        return {"error_code": {"val": int(ErrorCode.FRAME_TRANSFORM_FAILURE)}}
    header = {"frame_id": frame, "stamp": context.node.clock.now_ns()}
    stamped = [{"header": header, "pose": pose_fields(frame_from_model @ frames.link(name))} for name in known]
    code = ErrorCode.SUCCESS if len(known) == len(names) else ErrorCode.INVALID_LINK_NAME
    return {"pose_stamped": stamped, "fk_link_names": known, "error_code": {"val": int(code)}}
