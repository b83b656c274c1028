"""One way to pick or to place, from the state before to the end of the retreat."""

from typing import TYPE_CHECKING

import numpy as np
from msgspec import Struct

from trundle.planning.planners import ErrorCode, cartesian_path
from trundle.spatial import Pose, Vector3

from ..controllers import JointPath
from ..scene import SceneContents

if TYPE_CHECKING:
    from trundle.planning.planning_scene import PlanningScene

    from ..move_group_context import MoveGroupContext

_IK_TIMEOUT_S = 0.2
_STEP_M = 0.01
"""Distance between the points of an approach or retreat."""
_MIN_POSTURE_S = 0.3
_WAYS = 4
"""Solutions of inverse kinematics that are tried for one pose of the hand."""


class Translation(Struct, frozen=True, kw_only=True):
    """A straight motion of the hand."""

    direction: Vector3
    """Unit vector in the model's frame; (0, 0, 0): no motion."""
    desired_m: float
    min_m: float


class ManipulationGoal(Struct, frozen=True, kw_only=True, eq=False):
    """What is asked of the arm."""

    number: int
    """Index of the grasp or place location in the goal."""
    group: str
    hand_link: str
    hand_group: str
    model_from_hand: Pose
    """Pose of `hand_link` where the hand closes or opens."""
    approach: Translation
    retreat: Translation
    approach_posture: JointPath | None
    """Positions of the hand on the way; None: as they are."""
    closing_posture: JointPath | None
    """Positions of the hand at the end: closed to pick, open to place."""
    before: SceneContents
    """The scene up to the grasp, with what the hand may touch."""
    after: SceneContents
    """The scene from the grasp on: with the object attached, or placed."""
    names: tuple[str, str]
    """Descriptions of the two postures' stages."""


class Stage(Struct, frozen=True, kw_only=True, eq=False):
    """A part of the motion."""

    description: str
    path: JointPath
    start: np.ndarray
    group: str
    changes_scene: bool = False
    """True: the scene is `after` from the end of this stage on."""


class Failure(Struct, frozen=True, kw_only=True):
    """Why a manipulation is no way."""

    code: ErrorCode
    sentence: str


def plan_manipulation(
    context: "MoveGroupContext",
    manipulation: ManipulationGoal,
    start: np.ndarray,
    *,
    planner_id: str,
    planning_time_s: float,
) -> list[Stage] | Failure:
    """Compute all stages of a manipulation; runs beside the loop.

    Args:
        context: node.
        manipulation: what is asked.
        start: present state vector.
        planner_id: planner of the way to the approach; empty: the default.
        planning_time_s: its time.
    """
    pipelines, model = context.pipelines, context.monitor.model
    before = pipelines.scene(manipulation.before, start)
    open_state = _with_posture(context, start, manipulation.approach_posture)
    failure = Failure(code=ErrorCode.NO_IK_SOLUTION, sentence="the hand does not get there")
    seeds = [open_state]
    generator = np.random.default_rng(manipulation.number)
    indices = model.indices(model.group(manipulation.group).variables)
    for _ in range(_WAYS - 1):
        seed = open_state.copy()
        lower, upper = np.maximum(model.lower[indices], -np.pi), np.minimum(model.upper[indices], np.pi)
        seed[indices] = generator.uniform(lower, upper)
        seeds.append(seed)
    for seed in seeds:
        grasp = pipelines.solve(
            manipulation.group,
            [(manipulation.hand_link, manipulation.model_from_hand)],
            seed,
            _IK_TIMEOUT_S,
            lambda state: before.is_free(state, group=manipulation.group),
        )
        if grasp is None:
            break  # the search has been through thousands of random states
        way_in = _straight(context, before, manipulation, grasp, manipulation.approach, backwards=True)
        if isinstance(way_in, Failure):
            failure = way_in
            continue
        closed = _with_posture(context, grasp, manipulation.closing_posture)
        after = pipelines.scene(manipulation.after, closed)
        way_out = _straight(context, after, manipulation, closed, manipulation.retreat, backwards=False)
        if isinstance(way_out, Failure):
            failure = way_out
            continue
        first = way_in[-1].copy()
        fingers = model.indices(model.group(manipulation.hand_group).variables if manipulation.hand_group else ())
        first[fingers] = start[fingers]  # the hand opens when it is there
        plan = pipelines.plan_to_state(
            pipelines.scene(manipulation.before, start),
            manipulation.group,
            start,
            first,
            planner_id=planner_id,
            time_s=planning_time_s,
        )
        if not plan.is_success or plan.path is None:
            failure = Failure(code=plan.code, sentence=plan.sentence or "no way to where the approach begins")
            continue
        return _stages(context, manipulation, start, plan.path, way_in[::-1], closed, way_out)
    return failure


def _with_posture(context: "MoveGroupContext", state: np.ndarray, posture: JointPath | None) -> np.ndarray:
    """Return a state with the last positions of a posture."""
    if posture is None:
        return state.copy()
    values = state.copy()
    for name, position in zip(posture.joints, posture.positions[-1], strict=True):
        values[context.monitor.model.variable_index(name)] = position
    return context.monitor.model.with_mimics(values)


def _straight(
    context: "MoveGroupContext",
    scene: "PlanningScene",
    manipulation: ManipulationGoal,
    start: np.ndarray,
    translation: Translation,
    *,
    backwards: bool,
) -> np.ndarray | Failure:
    """Return the states (n, variables) of a translation from a state, at least its smallest distance long."""
    if translation.desired_m <= 0.0 or translation.direction == (0.0, 0.0, 0.0):
        return start[None, :]
    sign = -1.0 if backwards else 1.0
    x, y, z = (sign * translation.desired_m * part for part in translation.direction)
    here = context.monitor.kinematics.link_pose(start, manipulation.hand_link)
    there = Pose((here.position[0] + x, here.position[1] + y, here.position[2] + z), here.quaternion)
    found = cartesian_path(
        scene, manipulation.group, [there], link=manipulation.hand_link, start=start, max_step=_STEP_M
    )
    reached_m = found.fraction * translation.desired_m
    if reached_m + 1e-6 < translation.min_m:
        what = "approach" if backwards else "retreat"
        return Failure(
            code=ErrorCode.PLANNING_FAILED,
            sentence=f"the {what} is possible over {reached_m:.3f} m of at least {translation.min_m:.3f} m",
        )
    return found.waypoints


def _stages(
    context: "MoveGroupContext",
    manipulation: ManipulationGoal,
    start: np.ndarray,
    plan: JointPath,
    way_in: np.ndarray,
    closed: np.ndarray,
    way_out: np.ndarray,
) -> list[Stage]:
    pipelines = context.pipelines
    stages = [Stage(description="plan", path=plan, start=start, group=manipulation.group)]
    opening, closing = manipulation.names
    if manipulation.approach_posture is not None:
        path = _posture_path(context, start, manipulation.approach_posture)
        stages.append(Stage(description=opening, path=path, start=way_in[0], group=manipulation.hand_group))
    if len(way_in) > 1:
        path = pipelines.timed(manipulation.group, way_in)
        stages.append(Stage(description="approach", path=path, start=way_in[0], group=manipulation.group))
    if manipulation.closing_posture is not None:
        path = _posture_path(context, way_in[-1], manipulation.closing_posture)
        stages.append(
            Stage(description=closing, path=path, start=way_in[-1], group=manipulation.hand_group, changes_scene=True)
        )
    else:
        last = stages[-1]
        stages[-1] = Stage(
            description=last.description, path=last.path, start=last.start, group=last.group, changes_scene=True
        )
    if len(way_out) > 1:
        path = pipelines.timed(manipulation.group, way_out)
        stages.append(Stage(description="retreat", path=path, start=closed, group=manipulation.group))
    return stages


def _posture_path(context: "MoveGroupContext", state: np.ndarray, posture: JointPath) -> JointPath:
    """Return the hand's path from a state to a posture, in the posture's time or as fast as the joints allow."""
    model = context.monitor.model
    now = np.array([state[model.variable_index(name)] for name in posture.joints])
    last = posture.positions[-1]
    duration_s = posture.duration_s
    if duration_s <= 0.0:
        speeds = np.array([model.max_velocity[model.variable_index(name)] for name in posture.joints])
        speeds = np.where(np.isfinite(speeds) & (speeds > 0.0), speeds, 1.0)
        duration_s = max(_MIN_POSTURE_S, 2.0 * float(np.max(np.abs(last - now) / speeds, initial=0.0)))
    return JointPath(joints=posture.joints, times_s=np.array([0.0, duration_s]), positions=np.vstack([now, last]))
