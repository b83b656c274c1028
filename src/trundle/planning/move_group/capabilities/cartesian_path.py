"""The service compute_cartesian_path."""

import asyncio
from typing import TYPE_CHECKING, Any

import numpy as np

from trundle.base.diagnostics import TrundleError
from trundle.planning.planners import ErrorCode, JumpBounds, RequestError, cartesian_path

from ..constraint_messages import known_constraints
from ..controllers import JointPath
from ..scene import pose_of

if TYPE_CHECKING:
    from trundle.ros import Message

    from ..move_group_context import MoveGroupContext

_MAX_WAYPOINTS = 10_000
_MIN_STEP_M = 1e-4


def offer_cartesian_path(context: "MoveGroupContext") -> None:
    """Advertise compute_cartesian_path."""

    async def answer(request: "Message") -> dict[str, Any]:
        context.node.log.info("Received request to compute Cartesian path")
        try:
            return await _follow(context, request)
        except ValueError as error:
            return _refused(context, ErrorCode.INVALID_ROBOT_STATE, str(error))
        except RequestError as error:
            return _refused(context, error.failure.error_code, str(error))
        except TrundleError as error:
            return _refused(context, ErrorCode.FRAME_TRANSFORM_FAILURE, str(error))

    context.node.advertise_service("compute_cartesian_path", "moveit_msgs/GetCartesianPath", answer)


def _refused(context: "MoveGroupContext", code: ErrorCode, sentence: str) -> dict[str, Any]:
    context.node.log.error(f"compute_cartesian_path: {sentence}")
    return {"error_code": {"val": int(code)}}


async def _follow(context: "MoveGroupContext", request: "Message") -> dict[str, Any]:
    monitor, pipelines = context.monitor, context.pipelines
    model = monitor.model
    group = model.groups.get(str(request.group_name))
    if group is None:
        known = ", ".join(model.groups)
        return _refused(
            context, ErrorCode.INVALID_GROUP_NAME, f"there is no group '{request.group_name}'; groups: {known}"
        )
    if not request.max_step >= _MIN_STEP_M:
        what = "Maximum step to take between consecutive configurations along Cartesian path was not specified"
        return _refused(context, ErrorCode.FAILURE, f"{what} (this value needs to be > 0)")
    if len(request.waypoints) > _MAX_WAYPOINTS:
        return _refused(context, ErrorCode.FAILURE, f"{len(request.waypoints)} waypoints; at most {_MAX_WAYPOINTS}")
    link = str(request.link_name) or (group.links[-1] if group.links else "")
    if not model.has_link(link):
        return _refused(context, ErrorCode.INVALID_LINK_NAME, f"Unknown frame: {link}")
    start = await context.monitor.start_positions(request.start_state)
    frames = monitor.frames(start)
    header = str(request.header.frame_id).lstrip("/")
    base = frames.link(link) if header == link else frames.find(header)
    poses = [base @ pose_of(waypoint) for waypoint in request.waypoints]
    jumps = JumpBounds(
        relative=float(request.jump_threshold),
        revolute=float(request.revolute_jump_threshold),
        prismatic=float(request.prismatic_jump_threshold),
    )
    path_constraints = known_constraints(request.path_constraints, model, frames, context.node.log.warn)
    contents = monitor.contents
    scene = pipelines.scene(contents, start)

    def compute() -> tuple[JointPath, float, int]:
        found = cartesian_path(
            scene,
            group.name,
            poses,
            link=link,
            start=start,
            max_step=float(request.max_step),
            jumps=jumps,
            avoid_collisions=bool(request.avoid_collisions),
            path_constraints=path_constraints,
        )
        path = pipelines.timed(group.name, found.waypoints)
        if request.max_cartesian_speed > 0.0:
            path = _limited(context, path, start, str(request.cartesian_speed_limited_link) or link, request)
        return path, found.fraction, len(found.waypoints)

    context.node.log.info(
        f"Attempting to follow {len(poses)} waypoints for link '{link}' using a step of {request.max_step:f} m and "
        f"jump threshold {request.jump_threshold:f} (in {'link' if header == link else 'global'} reference frame)"
    )
    with context.node.loop.work.pending("a plan"):
        path, share, count = await asyncio.to_thread(compute)
    context.node.log.info(
        f"Computed Cartesian path with {count} points (followed {share * 100.0:f}% of requested trajectory)"
    )
    context.show(path, start, contents)
    return {
        "start_state": context.state_fields(start, contents),
        "solution": context.trajectory_fields(path),
        "fraction": share,
        "error_code": {"val": int(ErrorCode.SUCCESS)},
    }


def _limited(
    context: "MoveGroupContext", path: JointPath, start: np.ndarray, link: str, request: "Message"
) -> JointPath:
    """Return a path on which a link is no faster than asked for."""
    model, kinematics = context.monitor.model, context.monitor.kinematics
    states = np.repeat(start[None, :], len(path.times_s), axis=0)
    states[:, model.indices(path.joints)] = path.positions
    row = list(model.links).index(link)
    points = kinematics.link_poses(model.with_mimics(states))[:, row, :3]
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    needed = np.maximum(np.diff(path.times_s), lengths / float(request.max_cartesian_speed))
    times = np.concatenate([[0.0], np.cumsum(needed)])
    return JointPath(joints=path.joints, times_s=times, positions=path.positions)
