"""All planning pipelines of a node, and what they share: scenes, kinematics, times."""

import asyncio
import math
import time
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.planning.kinematics import InverseKinematics, Kinematics, KinematicsSettings, read_kinematics
from trundle.planning.planners import (
    CartesianLimits,
    Constraints,
    ErrorCode,
    MotionPlan,
    MotionPlanRequest,
    PlanningFailure,
    WorkspaceBounds,
    is_path_valid,
    joint_goal,
    plan,
)
from trundle.planning.planning_scene import AllowedCollisionMatrix, PlanningScene
from trundle.planning.trajectories import Method, motion_limits, parameterize, unwound
from trundle.robots.parameters import RosParameters
from trundle.ros import Node
from trundle.spatial import Pose

from .constraint_messages import constraints_of, known_constraints
from .controllers import JointPath
from .pipeline import Pipeline
from .plan_outcome import PlanOutcome
from .planning_scene_monitor import PlanningSceneMonitor
from .robot_description import RobotDescription
from .scene import FrameError, SceneChanges, SceneContents, SceneMirror

if TYPE_CHECKING:
    from trundle.ros import Message

_DEFAULT_TIME_S = 5.0
_MAX_TIME_S = 600.0
_MAX_STEP = 0.05
"""Greatest step of a joint between points of a trajectory [rad] or [m]."""
_UNCONSTRAINED = Constraints()


class Pipelines:
    """All pipelines, and what they share: scenes, kinematics, times."""

    def __init__(self, node: Node, root: RosParameters, description: RobotDescription, mirror: SceneMirror) -> None:
        """Read ~planning_pipelines; without it, the node's own namespace is the only one (as in Melodic)."""
        self._node = node
        self._description = description
        self._mirror = mirror
        self.model = description.model
        self.kinematics = Kinematics(description.model)
        report = Diagnostics()
        self._ik_settings = read_kinematics(description.kinematics, description.model.groups, report)
        for finding in report.findings:
            node.log.warn(finding.what)
        self._cartesian_limits = _cartesian_limits(node, description)
        self._solvers: dict[tuple[str, str | None], InverseKinematics] = {}
        self._pipelines: dict[str, Pipeline] = {}
        space = root.section("planning_pipelines")
        for name in space.names():
            if space.section(name).names():
                self._pipelines[name] = Pipeline(node, name, space.section(name), description)
        wanted = root.text("default_planning_pipeline", "")
        if not self._pipelines:
            self._pipelines[wanted or "ompl"] = Pipeline(node, wanted or "ompl", root, description)
        if wanted and wanted not in self._pipelines:
            node.log.warn(
                f"parameter default_planning_pipeline: no pipeline '{wanted}'; '{next(iter(self._pipelines))}' is used"
            )
        self.default = self._pipelines.get(wanted) or next(iter(self._pipelines.values()))
        for pipeline in self.all:
            if pipeline.note:
                (node.log.warn if pipeline is self.default else node.log.info)(pipeline.note)
        self._seed = 0

    @property
    def all(self) -> list[Pipeline]:
        """All pipelines, the default one first."""
        return [self.default, *(one for one in self._pipelines.values() if one is not self.default)]

    def find(self, name: str) -> Pipeline | None:
        """Return a pipeline; the empty name is the default's; None with a sentence: there is none."""
        if not name:
            return self.default
        if name not in self._pipelines:
            known = ", ".join(self._pipelines)
            self._node.log.warn(f"Couldn't find requested planning pipeline '{name}'; pipelines: {known}")
        return self._pipelines.get(name)

    def capabilities(self) -> list[str]:
        """Return the capabilities that pipelines ask for."""
        return [name for pipeline in self._pipelines.values() for name in pipeline.capabilities()]

    def scene(self, contents: SceneContents, positions: np.ndarray) -> PlanningScene:
        """Return an independent scene of contents and a state."""
        return self._mirror.scene(contents, positions)

    # -- kinematics

    def ik_timeout_s(self, group: str) -> float:
        """Return the timeout of kinematics.yaml [s]; 0: none is set."""
        settings = self._ik_settings.get(group)
        return 0.0 if settings is None else settings.timeout

    def solve(
        self,
        group: str,
        targets: Sequence[tuple[str | None, Pose]],
        seed: np.ndarray,
        timeout_s: float,
        is_valid: Callable[[np.ndarray], bool],
    ) -> np.ndarray | None:
        """Return a state with tips at poses; with several, each is solved by its own subgroup or alone.

        Args:
            group: group of the joints that may move.
            targets: link (None: the group's tip) → pose in the model's frame.
            seed: state vector.
            timeout_s: for each target.
            is_valid: accepts a state.
        """
        state: np.ndarray | None = np.array(seed, dtype=np.float64)
        for index, (link, pose) in enumerate(targets):
            accept = is_valid if index == len(targets) - 1 else None
            try:
                solver = self._solver(self._owner(group, link, len(targets)), link)
            except UsageError as error:
                self._node.log.error(str(error))
                return None
            if state is None:
                return None
            state = solver.solve(pose, state, timeout=timeout_s, valid=accept)
        return state

    def _owner(self, group: str, link: str | None, count: int) -> str:
        """Return the subgroup that moves a link, if several links are to be moved."""
        if count == 1 or link is None:
            return group
        for name in self.model.groups[group].subgroups:
            if link in self.model.groups[name].tips:
                return name
        return group

    def _solver(self, group: str, link: str | None) -> InverseKinematics:
        key = group, link
        if key not in self._solvers:
            settings = self._ik_settings.get(group, KinematicsSettings())
            self._solvers[key] = InverseKinematics(self.kinematics, group, link, settings=settings)
        return self._solvers[key]

    # -- plans

    async def plan(
        self, monitor: PlanningSceneMonitor, request: "Message", contents: SceneContents, *, from_present: bool = False
    ) -> PlanOutcome:
        """Answer a moveit_msgs/MotionPlanRequest in a scene; `from_present`: its start state is not asked."""
        began = time.monotonic()
        positions = monitor.positions()
        name = str(request.group_name)
        pipeline = self.find(str(request.pipeline_id))
        if pipeline is None:
            return PlanOutcome(code=ErrorCode.FAILURE, start=positions, group=name, sentence="no such pipeline")
        try:
            start = positions if from_present else await monitor.start_positions(request.start_state)
            frames = monitor.frames(start, contents)
            goals = tuple(constraints_of(goal, self.model, frames) for goal in request.goal_constraints)
            path_constraints = known_constraints(request.path_constraints, self.model, frames, self._node.log.warn)
            contents = self._with_attached(monitor, contents, request.start_state, from_present)
        except FrameError as error:
            return self._failed(
                PlanOutcome(code=ErrorCode.FRAME_TRANSFORM_FAILURE, start=positions, sentence=str(error))
            )
        except (TrundleError, ValueError) as error:
            return self._failed(PlanOutcome(code=ErrorCode.INVALID_ROBOT_STATE, start=positions, sentence=str(error)))
        planner, settings = pipeline.choose(name, str(request.planner_id))
        self._seed += 1
        own: dict[str, Any] = {} if settings is None else {"settings": settings}
        wanted = MotionPlanRequest(
            group=name,
            goals=goals,
            start=start,
            path_constraints=path_constraints,
            planner=planner,
            start_fixes=pipeline.fixes,
            workspace=_workspace(request.workspace_parameters),
            allowed_time=min(float(request.allowed_planning_time) or _DEFAULT_TIME_S, _MAX_TIME_S),
            attempts=max(1, int(request.num_planning_attempts)),
            velocity_scaling=_scaling(request.max_velocity_scaling_factor),
            acceleration_scaling=_scaling(request.max_acceleration_scaling_factor),
            cartesian_limits=self._cartesian_limits,
            seed=self._seed,
            **own,
        )
        scene = self.scene(contents, start)
        with self._node.loop.work.pending("a plan"):
            try:
                outcome = await asyncio.to_thread(self._plan, scene, wanted, pipeline)
            except asyncio.CancelledError:
                wanted.cancel.cancel()
                raise
        outcome = PlanOutcome(
            code=outcome.code,
            start=outcome.start,
            group=name,
            path=outcome.path,
            planning_time_s=time.monotonic() - began,
            sentence=outcome.sentence,
        )
        return self._failed(outcome)

    def _with_attached(
        self, monitor: PlanningSceneMonitor, contents: SceneContents, state: "Message", from_present: bool
    ) -> SceneContents:
        """Return contents with what the start state carries."""
        if from_present or not len(state.attached_collision_objects):
            return contents
        changed = contents.copy()
        changes = SceneChanges(changed, monitor.frames(contents=changed), self.model.has_link)
        changes.apply_state_objects(state, is_diff=bool(state.is_diff))
        return changed

    def _failed(self, outcome: PlanOutcome) -> PlanOutcome:
        if not outcome.is_success:
            self._node.log.warn(f"{outcome.code.name}: {outcome.sentence}")
        return outcome

    def _plan(self, scene: PlanningScene, request: MotionPlanRequest, pipeline: Pipeline) -> PlanOutcome:
        """Plan, and add times; runs beside the loop."""
        start = np.array(scene.positions if request.start is None else request.start)
        try:
            found = plan(scene, request)
        except TrundleError as error:
            return PlanOutcome(code=ErrorCode.FAILURE, start=start, sentence=str(error))
        if isinstance(found, PlanningFailure):
            return PlanOutcome(code=found.error_code, start=start, sentence=found.sentence)
        for note in found.notes:
            self._node.log.info(note)
        return PlanOutcome(
            code=ErrorCode.SUCCESS,
            start=start,
            path=self._path(scene, found, request, pipeline.timing),
        )

    def _path(self, scene: PlanningScene, found: MotionPlan, request: MotionPlanRequest, timing: Method) -> JointPath:
        """Return a plan with times; where rounded corners would collide, the path keeps its waypoints."""
        variables = self.model.groups[found.group].variables
        indices = self.model.indices(variables)
        if found.trajectory is not None:
            made = found.trajectory
            return JointPath(
                joints=tuple(variables),
                times_s=made.times,
                positions=made.positions[:, indices],
                velocities=made.velocities[:, indices],
                accelerations=made.accelerations[:, indices],
            )
        shares = request.velocity_scaling, request.acceleration_scaling
        path = self.timed(found.group, found.waypoints, *shares, timing)
        constraints = request.path_constraints
        if timing == "time_optimal" and not self._is_valid(scene, path, found.waypoints[0], found.group, constraints):
            path = self.timed(found.group, found.waypoints, *shares)
        return path

    def _is_valid(
        self,
        scene: PlanningScene,
        path: JointPath,
        start: np.ndarray,
        group: str,
        constraints: Constraints = _UNCONSTRAINED,
    ) -> bool:
        """True if nothing touches along a path, also between its points, and constraints hold."""
        states = np.tile(start, (len(path.times_s), 1))
        states[:, self.model.indices(path.joints)] = path.positions
        states = self.model.with_mimics(states)
        if group in self.model.groups:
            variables = self.model.groups[group].variables
            if set(path.joints) <= set(variables):
                values = states[:, self.model.indices(variables)]
                return is_path_valid(scene, group, values, reference=start, path_constraints=constraints)
        return all(scene.is_free(state) for state in states)  # a hand that is no group

    def timed(
        self,
        group: str,
        states: np.ndarray,
        velocity_scaling: float = 1.0,
        acceleration_scaling: float = 1.0,
        method: Method = "iterative_parabolic",
    ) -> JointPath:
        """Return a path through states (n, variables of the model) with times.

        Args:
            group: whose variables are the path's.
            states: waypoints.
            velocity_scaling: share of the greatest velocities.
            acceleration_scaling: share of the greatest accelerations.
            method: of `parameterize`.
        """
        variables = self.model.groups[group].variables
        indices = self.model.indices(variables)
        positions = unwound(np.asarray(states)[:, indices], self._turning(variables))
        if len(positions) < 2 or np.allclose(positions, positions[0], atol=1e-9):
            return JointPath(joints=tuple(variables), times_s=np.zeros(1), positions=positions[:1])
        made = parameterize(
            _dense(positions) if method == "iterative_parabolic" else positions,
            motion_limits(self.model, variables),
            velocity_scaling=velocity_scaling,
            acceleration_scaling=acceleration_scaling,
            method=method,
        )
        return JointPath(
            joints=tuple(variables),
            times_s=made.times,
            positions=made.positions,
            velocities=made.velocities,
            accelerations=made.accelerations,
        )

    def _turning(self, variables: Sequence[str]) -> NDArray[np.bool_]:
        """Return for each variable whether it turns without end."""
        model = self.model
        return np.array([model.has_joint(name) and model.joint(name).type == "continuous" for name in variables])

    def plan_to_state(
        self,
        scene: PlanningScene,
        group: str,
        start: np.ndarray,
        goal: np.ndarray,
        *,
        planner_id: str = "",
        time_s: float = _DEFAULT_TIME_S,
    ) -> PlanOutcome:
        """Plan a group to the positions of a state; runs beside the loop."""
        pipeline = self.default
        planner, settings = pipeline.choose(group, planner_id)
        own: dict[str, Any] = {} if settings is None else {"settings": settings}
        variables = self.model.groups[group].variables
        target = {name: float(goal[self.model.variable_index(name)]) for name in variables}
        request = MotionPlanRequest(
            group=group,
            goals=(joint_goal(target),),
            start=start,
            planner=planner,
            start_fixes=pipeline.fixes,
            allowed_time=min(time_s, _MAX_TIME_S),
            **own,
        )
        return self._plan(scene, request, pipeline)

    async def is_path_valid(
        self,
        monitor: PlanningSceneMonitor,
        path: JointPath,
        start: np.ndarray,
        group: str,
        allowed: AllowedCollisionMatrix | None = None,
    ) -> bool:
        """True if no state of a path is in collision in the present scene; `allowed` replaces its matrix."""
        contents = monitor.contents
        if allowed is not None:
            contents = contents.copy()
            contents.allowed = allowed
        scene = self.scene(contents, start)
        return await asyncio.to_thread(self._is_valid, scene, path, start, group)


def _dense(positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a path (n, joints) with points between, as the original has: controllers draw splines through them, which
    leave the straight ways of far points.
    """
    parts = [positions[:1]]
    for before, after in pairwise(positions):
        count = max(1, int(np.ceil(np.abs(after - before).max() / _MAX_STEP)))
        shares = np.arange(1, count + 1)[:, None] / count
        parts.append(before + shares * (after - before))
    return np.vstack(parts)


def _cartesian_limits(node: Node, description: RobotDescription) -> CartesianLimits:
    """Return the limits of pilz' lines and arcs: NAME_planning/cartesian_limits."""
    name = f"{description.name}_planning/cartesian_limits"
    try:
        limits = msgspec.convert(description.planning.get("cartesian_limits", {}), CartesianLimits, strict=False)
    except msgspec.ValidationError as error:
        node.log.warn(f"parameter {name}: {error}; the defaults hold")
        return CartesianLimits()
    sizes = limits.max_trans_vel, limits.max_trans_acc, abs(limits.max_trans_dec), limits.max_rot_vel
    if not all(0.0 < size < math.inf for size in sizes):
        node.log.warn(f"parameter {name}: limits are finite and above 0, got {limits}; the defaults hold")
        return CartesianLimits()
    return limits


def _scaling(value: float) -> float:
    """Return a factor in (0, 1]; outside of it, 1, as in the original."""
    return float(value) if 0.0 < value <= 1.0 else 1.0


def _workspace(message: "Message") -> WorkspaceBounds:
    low, high = message.min_corner, message.max_corner
    corners = ((low.x, low.y, low.z), (high.x, high.y, high.z))
    if corners[0] == corners[1] or not np.all(np.isfinite(corners)):
        return WorkspaceBounds()
    return WorkspaceBounds(*corners)
