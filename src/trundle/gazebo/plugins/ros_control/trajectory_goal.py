"""Trajectory messages as paths of joints that continue the current paths, by the rules of ros_controllers'
initJointTrajectory.
"""

import math
from bisect import bisect_right
from collections.abc import Callable, Iterator, Sequence
from itertools import chain, pairwise
from typing import TYPE_CHECKING, TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from trundle.ros import to_nsec
from trundle.sim.control import JointSegment, JointState

from .tolerances import JointTolerances

if TYPE_CHECKING:
    from trundle.ros.message_types import trajectory_msgs

NO_GOAL = 0
"""Goal number for trajectories from the topic."""
_MAX_POINTS = 100_000
SegmentRow: TypeAlias = tuple[int, int, tuple[float, ...], int, tuple[float, float, float, float], int]
_OTHER_JOINTS = "Cannot create trajectory from message. It does not contain the expected joints."
_SIZES = "Size mismatch in trajectory point position, velocity or acceleration data."
_NO_POSITIONS = "Size mismatch between trajectory point and vector specifying whether joints wrap around."


class GoalError(ValueError):
    """Trajectory that cannot be followed; `code` is control_msgs/FollowJointTrajectoryResult's."""

    INVALID_GOAL, INVALID_JOINTS = -1, -2
    PATH_TOLERANCE_VIOLATED, GOAL_TOLERANCE_VIOLATED = -4, -5

    def __init__(self, text: str, code: int = INVALID_GOAL, *, is_late: bool = False) -> None:
        super().__init__(text)
        self.code = code
        self.is_late = is_late
        """True if the trajectory arrived too late; a warning only, since streams of commands are sometimes late."""


class PathSegment(Struct, frozen=True):
    """Segment of a joint's path."""

    segment: JointSegment
    goal: int = NO_GOAL
    """Number of the action's goal."""
    tolerances: JointTolerances = JointTolerances()
    from_start_ns: int = 0
    """time_from_start of its first point [ns]."""

    @property
    def row(self) -> SegmentRow:
        """Row for `TrajectoryLaw.set_paths`."""
        curve, path, goal = self.segment, self.tolerances.path, self.tolerances.goal
        limits = path.position, path.velocity, goal.position, goal.velocity
        return curve.start_ns, curve.end_ns, curve.coefficients, self.goal, limits, self.tolerances.time_ns


class JointPath:
    """Segments that a joint follows, in order of their starts; each ends where the next one starts."""

    def __init__(self, segments: list[PathSegment]) -> None:
        """Make a path of at least one segment."""
        self.segments = segments
        self._starts = [segment.segment.start_ns for segment in segments]

    def rows(self) -> list[SegmentRow]:
        """Return the segments for `TrajectoryLaw.set_paths`."""
        return [segment.row for segment in self.segments]

    def index_at(self, time_ns: int) -> int:
        """Return the index of the segment at a time; −1 before the first."""
        return bisect_right(self._starts, time_ns) - 1

    def at(self, time_ns: int) -> PathSegment:
        """Return the segment at a time, or the first one."""
        return self.segments[max(self.index_at(time_ns), 0)]

    def state_at(self, time_ns: int) -> JointState:
        """Return position, velocity and acceleration at a time."""
        return JointState(*self.at(time_ns).segment.sample(time_ns))


def holding_path(position: float, time_ns: int, *, goal: int = NO_GOAL) -> JointPath:
    """Return a path that holds a position from a time on."""
    held = JointState(position, 0.0, 0.0)
    return JointPath([PathSegment(JointSegment.between(time_ns, held, time_ns, held), goal)])


def stopping_path(
    position: float, velocity: float, time_ns: int, duration_ns: int, *, goal: int = NO_GOAL
) -> JointPath:
    """Return a path that decelerates from a state to rest.

    It ends at the midpoint of a segment that returns to the position with the opposite velocity after twice the time.
    """
    start, mirrored = JointState(position, velocity, 0.0), JointState(position, -velocity, 0.0)
    return_segment = JointSegment.between(time_ns, start, time_ns + 2 * duration_ns, mirrored)
    rest = JointState(*return_segment.sample(time_ns + duration_ns))
    return JointPath([PathSegment(JointSegment.between(time_ns, start, time_ns + duration_ns, rest), goal)])


class PathReader:
    """Reads trajectories for the joints of one controller."""

    def __init__(
        self, joints: Sequence[str], continuous: Sequence[bool], *, partial: bool, warn: Callable[[str], None]
    ) -> None:
        """Create a reader for a controller's joints.

        Args:
            joints: controller's joint names.
            continuous: True for each joint that turns in the shorter direction.
            partial: True if joints may be missing; missing joints stay on their current paths.
            warn: receives warnings about dropped points.
        """
        self._joints, self._continuous, self._partial, self._warn = list(joints), continuous, partial, warn

    def check_joints(self, trajectory: "trajectory_msgs.JointTrajectory", error: str, code: int) -> None:
        """Check that a trajectory has the controller's joints.

        Raises:
            GoalError: other joints; has the text and code.
        """
        expected, names = self._joints, trajectory.joint_names
        fits = len(names) == len(expected) or (self._partial and 0 < len(names) < len(expected))
        if not fits or any(name not in expected for name in names):
            received = ", ".join(map(str, names)) or "none"
            raise GoalError(f"{error} They are {', '.join(expected)}; it has {received}.", code)

    def read(
        self,
        trajectory: "trajectory_msgs.JointTrajectory",
        current: Sequence[JointPath],
        now_ns: int,
        tolerances: Sequence[JointTolerances] | None,
        goal: int,
    ) -> list[JointPath]:
        """Read a trajectory_msgs/JointTrajectory.

        Args:
            trajectory: message with at least one point.
            current: joints' current paths, followed until the trajectory starts.
            now_ns: time of the next update; points up to it are dropped.
            tolerances: tolerances of the action's goal; None: a trajectory from the topic.
            goal: number of the action's goal.

        Raises:
            GoalError: other joints, or an invalid trajectory.
        """
        points = trajectory.points
        if len(points) > _MAX_POINTS:
            raise GoalError(f"{len(points)} points are more than {_MAX_POINTS}")
        begin_ns = to_nsec(trajectory.header.stamp) or now_ns
        times = [begin_ns + to_nsec(point.time_from_start) for point in points]
        if any(b <= a for a, b in pairwise(times)):
            raise GoalError("Trajectory message contains waypoints that are not strictly increasing in time.")
        self.check_joints(trajectory, _OTHER_JOINTS, GoalError.INVALID_GOAL)
        columns = [self._joints.index(name) for name in trajectory.joint_names]
        dropped = bisect_right(times, now_ns)
        self._check_dropped(times, dropped, now_ns, stamped=to_nsec(trajectory.header.stamp) != 0)
        paths = [_with_goal(path, now_ns, goal) for path in current]
        for column, joint in enumerate(columns):
            states = (
                _state(point, column, first=number == 0, width=len(columns))
                for number, point in enumerate(points[dropped:])
            )
            make = _SegmentMaker(goal, JointTolerances() if tolerances is None else tolerances[joint])
            paths[joint] = _continued(
                current[joint], now_ns, begin_ns, times[dropped:], states, make, wraps=self._continuous[joint]
            )
        return paths

    def _check_dropped(self, times: Sequence[int], dropped: int, now_ns: int, *, stamped: bool) -> None:
        """Warn of dropped points, except a first point for the current time."""
        if dropped == len(times):
            late_s = (now_ns - times[-1]) / 1e9
            raise GoalError(
                f"Dropping all {dropped} trajectory point(s), as they occur before the current time.\n"
                f"Last point is {late_s:.6f}s in the past.",
                is_late=True,
            )
        if dropped == 0 or (dropped == 1 and times[0] == now_ns and not stamped):
            return
        self._warn(
            f"Dropping first {dropped} trajectory point(s) out of {len(times)}, as they occur before the current "
            f"time.\nFirst valid point will be reached in {(times[dropped] - now_ns) / 1e9:.3f}s."
        )


class _SegmentMaker(Struct, frozen=True):
    """Makes the segments of one joint and goal."""

    goal: int
    tolerances: JointTolerances

    def between(
        self, start_ns: int, start: JointState, end_ns: int, end: JointState, *, from_start_ns: int = 0
    ) -> PathSegment:
        try:
            segment = JointSegment.between(start_ns, start, end_ns, end)
        except ValueError as error:
            raise GoalError(f"Quintic spline segment can't be constructed: {error}.") from None
        return PathSegment(segment, self.goal, self.tolerances, from_start_ns)


def _with_goal(path: JointPath, now_ns: int, goal: int) -> JointPath:
    """Return the path as part of a goal that does not name the path's joint."""
    first = path.index_at(now_ns)
    if first < 0:
        return path
    return JointPath([*path.segments[:first], *(replace(segment, goal=goal) for segment in path.segments[first:])])


def _continued(
    current: JointPath,
    now_ns: int,
    begin_ns: int,
    times: Sequence[int],
    states: Iterator[JointState],
    make: _SegmentMaker,
    *,
    wraps: bool,
) -> JointPath:
    """Return the current path up to the trajectory's start, a segment to its first point, and the other segments."""
    leave_ns = max(begin_ns, now_ns)
    left, first = current.state_at(leave_ns), next(states)
    turns = _wraparound(left.position, first.position) if wraps else 0.0
    first = replace(first, position=first.position + turns)
    segments = current.segments[max(current.index_at(now_ns), 0) : current.index_at(leave_ns) + 1]
    segments.append(make.between(leave_ns, left, times[0], first))
    ends = (
        (time, replace(state, position=state.position + turns)) for time, state in zip(times[1:], states, strict=True)
    )
    for (a_ns, a), (b_ns, b) in pairwise(chain([(times[0], first)], ends)):
        segments.append(make.between(a_ns, a, b_ns, b, from_start_ns=a_ns - begin_ns))
    return JointPath(segments)


def _wraparound(start: float, end: float) -> float:
    """Return the full turns to add to an end position for the shorter rotation; half a turn keeps its direction."""
    change = math.remainder(end - start, math.tau)
    if abs(abs(change) - math.pi) < 1e-9:
        change = math.copysign(change, end - start)
    return start + change - end


def _state(point: "trajectory_msgs.JointTrajectoryPoint", column: int, *, first: bool, width: int) -> JointState:
    """Read a joint's state at a point; surplus positions are ignored."""
    count = len(point.positions)
    if any(len(values) not in (0, count) for values in (point.velocities, point.accelerations)):
        raise GoalError(_SIZES)
    if not count:
        start_end = "Can't construct segment from ROS message: Start/end points data size mismatch."
        raise GoalError(_NO_POSITIONS if first else start_end)
    if count < width:
        raise GoalError(_SIZES)
    values = [float(row[column]) for row in (point.positions, point.velocities, point.accelerations) if len(row)]
    if not all(map(math.isfinite, values)):
        raise GoalError("A trajectory point has a value that is not finite.")
    velocity = float(point.velocities[column]) if len(point.velocities) else None
    acceleration = float(point.accelerations[column]) if len(point.accelerations) else None
    return JointState(float(point.positions[column]), velocity, acceleration)
