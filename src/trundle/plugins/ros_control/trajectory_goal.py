"""Trajectory messages as splines of joints with tolerances."""

import math
from collections.abc import Sequence
from itertools import pairwise
from typing import TYPE_CHECKING

from msgspec import Struct
from msgspec.structs import replace

from trundle.control import JointPoint, JointSpline
from trundle.parameters import RosParameters
from trundle.ros import Message, to_nsec

if TYPE_CHECKING:
    from trundle.ros.message_types import control_msgs, trajectory_msgs

_STOPPED = 0.01
"""Default stopped_velocity_tolerance of the original [rad/s or m/s]."""
_MAX_POINTS = 100_000


class GoalError(ValueError):
    """Trajectory that cannot be followed; `code` is control_msgs/FollowJointTrajectoryResult's."""

    INVALID_GOAL, INVALID_JOINTS, OLD_HEADER_TIMESTAMP = -1, -2, -3
    PATH_TOLERANCE_VIOLATED, GOAL_TOLERANCE_VIOLATED = -4, -5

    def __init__(self, code: int, text: str) -> None:
        super().__init__(text)
        self.code = code


class Tolerances(Struct, frozen=True, kw_only=True):
    """Tolerances of a trajectory; 0: none is checked."""

    path: tuple[float, ...]
    """Error of each joint on the path [rad or m]."""
    goal: tuple[float, ...]
    """Error of each joint at the goal [rad or m]."""
    stopped: float
    """Velocity of every joint at the goal [rad/s or m/s]."""
    time_s: float
    """Delay of reaching the goal [s]."""

    def with_goal(self, goal: "control_msgs.FollowJointTrajectoryGoal", joints: Sequence[str]) -> "Tolerances":
        """Replace tolerances by those of an action's goal; a negative one is not checked."""

        def merged(usual: tuple[float, ...], asked: Sequence[Message]) -> tuple[float, ...]:
            named = {str(item.name): float(item.position) for item in asked}
            values = (named.get(joint, 0.0) or ours for joint, ours in zip(joints, usual, strict=True))
            return tuple(max(value, 0.0) for value in values)

        time_s = to_nsec(goal.goal_time_tolerance) / 1e9
        return replace(
            self,
            path=merged(self.path, goal.path_tolerance),
            goal=merged(self.goal, goal.goal_tolerance),
            time_s=time_s if time_s > 0.0 else self.time_s,
        )


def read_tolerances(constraints: RosParameters, joints: Sequence[str]) -> Tolerances:
    """Read the parameters `constraints`."""
    own = [constraints.section(joint) for joint in joints]
    return Tolerances(
        path=tuple(each.number("trajectory", 0.0) for each in own),
        goal=tuple(each.number("goal", 0.0) for each in own),
        stopped=constraints.number("stopped_velocity_tolerance", _STOPPED),
        time_s=constraints.number("goal_time", 0.0),
    )


class SampledTrajectory:
    """Splines of all joints from a start time."""

    def __init__(self, points: list[list[JointPoint]], start_ns: int, tolerances: Tolerances) -> None:
        """Fit splines to the points of each joint; their times count from `start_ns`."""
        self._points = points
        self._splines = [JointSpline(each) for each in points]
        self._start_ns = start_ns
        self.tolerances = tolerances

    @classmethod
    def hold_position(cls, positions: Sequence[float], start_ns: int, tolerances: Tolerances) -> "SampledTrajectory":
        """Hold positions."""
        return cls([[JointPoint(0.0, position)] for position in positions], start_ns, tolerances)

    @property
    def end_ns(self) -> int:
        """End time of the longest spline [ns]."""
        return self._start_ns + round(max(spline.end_s for spline in self._splines) * 1e9)

    def sample(self, time_ns: int) -> list[tuple[float, float, float]]:
        """Position, velocity and acceleration of each joint."""
        time_s = (time_ns - self._start_ns) / 1e9
        return [spline.sample(time_s) for spline in self._splines]

    def unwind(self, number: int) -> None:
        """Shift a continuous joint by whole turns, so that it takes the shorter way to its first point."""
        start, *rest = self._points[number]
        if not rest:
            return
        turns = round((start.position - rest[0].position) / math.tau) * math.tau
        self._points[number] = [start, *(replace(point, position=point.position + turns) for point in rest)]
        self._splines[number] = JointSpline(self._points[number])


def read_trajectory(
    trajectory: "trajectory_msgs.JointTrajectory",
    joints: Sequence[str],
    now: Sequence[tuple[float, float, float]],
    now_ns: int,
    tolerances: Tolerances,
    *,
    partial: bool,
) -> SampledTrajectory:
    """Read a trajectory_msgs/JointTrajectory.

    Args:
        trajectory: the message, with at least one point.
        joints: of the controller.
        now: desired position, velocity and acceleration of each joint now.
        now_ns: current time [ns].
        tolerances: of the trajectory.
        partial: True if joints may be missing; these hold.

    Raises:
        GoalError: other joints, or an invalid trajectory.
    """
    names = [str(name) for name in trajectory.joint_names]
    missing, unknown = [j for j in joints if j not in names], [n for n in names if n not in joints]
    if unknown or (missing and not partial) or len(set(names)) != len(names):
        wanted, got = ", ".join(joints), ", ".join(names) or "none"
        raise GoalError(
            GoalError.INVALID_JOINTS, f"the joints of this controller are {wanted}; the trajectory has {got}"
        )
    begin_ns = to_nsec(trajectory.header.stamp) or now_ns
    times = [(begin_ns - now_ns + to_nsec(point.time_from_start)) / 1e9 for point in trajectory.points]
    if len(times) > _MAX_POINTS:
        raise GoalError(GoalError.INVALID_GOAL, f"{len(times)} points are more than {_MAX_POINTS}")
    if any(b <= a for a, b in pairwise(times)):
        raise GoalError(GoalError.INVALID_GOAL, "time_from_start must grow from point to point")
    if times[-1] < 0.0:
        raise GoalError(GoalError.OLD_HEADER_TIMESTAMP, "the whole trajectory lies in the past")
    columns: list[list[JointPoint]] = []
    for joint, (position, velocity, acceleration) in zip(joints, now, strict=True):
        start = [JointPoint(0.0, position, velocity, acceleration)]
        if joint not in names:
            columns.append([JointPoint(0.0, position)])
            continue
        if begin_ns > now_ns:  # hold until the trajectory begins
            start = [JointPoint(0.0, position), JointPoint((begin_ns - now_ns) / 1e9, position, 0.0, 0.0)]
        column = names.index(joint)
        points = [
            _point(time_s, point, column, len(names))
            for time_s, point in zip(times, trajectory.points, strict=True)
            if time_s > start[-1].time_s
        ]
        if not points:  # all points are in the past
            start = []
            points = [_point(0.0, trajectory.points[-1], column, len(names))]
        columns.append([*start, *points])
    return SampledTrajectory(columns, now_ns, tolerances)


def _point(time_s: float, point: "trajectory_msgs.JointTrajectoryPoint", column: int, width: int) -> JointPoint:
    def value(what: str) -> float | None:
        values = getattr(point, what)
        if len(values) == 0:
            return None
        if len(values) != width or not math.isfinite(values[column]):
            raise GoalError(GoalError.INVALID_GOAL, f"{what} of a point are not {width} finite numbers")
        return float(values[column])

    position = value("positions")
    if position is None:
        raise GoalError(
            GoalError.INVALID_GOAL, "a point has no positions; trajectories of velocities only are not supported"
        )
    return JointPoint(time_s, position, value("velocities"), value("accelerations"))
