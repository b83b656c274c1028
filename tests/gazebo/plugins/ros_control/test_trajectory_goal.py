"""Edge cases of trajectory messages, by the rules of ros_controllers' initJointTrajectory."""

import math
from typing import Any

import pytest

from trundle.gazebo.plugins.ros_control.tolerances import (
    JointTolerances,
    StateTolerance,
    goal_tolerances,
    read_tolerances,
)
from trundle.gazebo.plugins.ros_control.trajectory_goal import (
    NO_GOAL,
    GoalError,
    JointPath,
    PathReader,
    PathSegment,
    holding_path,
    stopping_path,
)
from trundle.robots.parameters import RosParameters
from trundle.ros import Messages
from trundle.sim.control import JointSegment, JointState

_NOW_S = 10.0
_TYPES = Messages()


def _time(seconds: float) -> dict[str, int]:
    ns = round(seconds * 1e9)
    return {"sec": ns // 10**9, "nanosec": ns % 10**9}


def _ns(seconds: float) -> int:
    return round(seconds * 1e9)


def _point(at_s: float, *positions: float, **fields: list[float]) -> dict[str, Any]:
    return {"positions": list(positions), "time_from_start": _time(at_s), **fields}


class _Joints:
    """Two joints, a and b, that hold 0 or follow the trajectory read last."""

    def __init__(self, *, continuous: bool = False, partial: bool = False) -> None:
        self.warnings: list[str] = []
        self.reader = PathReader(["a", "b"], [continuous] * 2, partial=partial, warn=self.warnings.append)
        self.paths = [holding_path(0.0, 0), holding_path(0.0, 0)]

    def follow(
        self,
        *points: dict[str, Any],
        names: str = "ab",
        stamp_s: float = 0.0,
        now_s: float = _NOW_S,
        goal: int = NO_GOAL,
        tolerances: list[JointTolerances] | None = None,
    ) -> None:
        fields = {"header": {"stamp": _time(stamp_s)}, "joint_names": list(names), "points": list(points)}
        message: Any = _TYPES.new("trajectory_msgs/JointTrajectory", fields)
        self.paths = self.reader.read(message, self.paths, _ns(now_s), tolerances, goal)

    def refuse(self, *points: dict[str, Any], **fields: Any) -> str:
        """Read a trajectory that is refused; return the error's text. The paths stay."""
        before = self.paths
        with pytest.raises(GoalError) as error:
            self.follow(*points, **fields)
        assert self.paths is before
        assert error.value.code == GoalError.INVALID_GOAL
        assert error.value.is_late == str(error.value).startswith("Dropping all")
        return str(error.value)

    def sample(self, time_s: float, joint: int = 0) -> tuple[float, float, float]:
        return self.paths[joint].at(_ns(time_s)).segment.sample(_ns(time_s))


# -- times


def test_a_trajectory_starts_with_the_next_update_at_the_current_positions() -> None:
    joints = _Joints()
    joints.follow(_point(1.0, 1.0, -1.0), _point(2.0, 1.0, 3.0))
    assert [joints.sample(at)[0] for at in (9.0, 10.0, 10.5, 11.0, 11.5, 12.0, 99.0)] == [0, 0, 0.5, 1, 1, 1, 1]
    assert [joints.sample(at, 1)[0] for at in (10.5, 11.5, 12.0)] == [-0.5, 1.0, 3.0]
    assert joints.warnings == []


def test_one_point_at_time_zero_is_refused() -> None:
    text = _Joints().refuse(_point(0.0, 1.0, 1.0))
    assert text == (
        "Dropping all 1 trajectory point(s), as they occur before the current time.\n"
        "Last point is 0.000000s in the past."
    )


def test_a_first_point_at_time_zero_is_dropped_silently() -> None:
    joints = _Joints()
    joints.follow(_point(0.0, 7.0, 7.0), _point(1.0, 1.0, 1.0))
    assert joints.sample(10.5) == (0.5, 1.0, 0.0)
    assert joints.warnings == []


def test_points_at_or_before_now_are_dropped_with_a_warning() -> None:
    joints = _Joints()
    joints.follow(_point(0.0, 7.0, 7.0), _point(0.5, 8.0, 8.0), _point(2.5, 2.0, 2.0), stamp_s=9.5)
    assert joints.sample(11.0) == (1.0, 1.0, 0.0)
    assert joints.warnings == [
        "Dropping first 2 trajectory point(s) out of 3, as they occur before the current time.\n"
        "First valid point will be reached in 2.000s."
    ]
    joints.follow(_point(0.0, 7.0, 7.0), _point(1.0, 0.0, 0.0), stamp_s=12.0, now_s=12.0)
    assert joints.warnings[1].startswith("Dropping first 1 trajectory point(s) out of 2")


def test_a_trajectory_in_the_past_is_refused() -> None:
    text = _Joints().refuse(_point(0.5, 1.0, 1.0), _point(1.0, 1.0, 1.0), stamp_s=8.75)
    assert text == (
        "Dropping all 2 trajectory point(s), as they occur before the current time.\n"
        "Last point is 0.250000s in the past."
    )


def test_a_future_trajectory_starts_at_its_stamp_and_the_current_one_runs_until_then() -> None:
    joints = _Joints()
    joints.follow(_point(4.0, 4.0, 4.0))
    joints.follow(_point(1.0, 0.0, 5.0), stamp_s=12.0, now_s=11.0, goal=3)
    assert [joints.sample(at)[0] for at in (11.0, 11.5, 12.0, 12.5, 13.0, 20.0)] == [1.0, 1.5, 2.0, 1.0, 0.0, 0.0]
    assert [joints.paths[0].at(_ns(at)).goal for at in (11.5, 12.5)] == [NO_GOAL, 3]


def test_a_first_point_at_a_future_stamp_jumps_to_its_position() -> None:
    joints = _Joints()
    joints.follow(_point(0.0, 5.0, 5.0), _point(1.0, 6.0, 6.0), stamp_s=12.0)
    assert [joints.sample(at)[0] for at in (11.999, 12.0, 12.5)] == [0.0, 5.0, 5.5]


def test_a_single_point_at_a_future_stamp_is_never_followed() -> None:
    """The original's segment has no duration and stays at its start."""
    joints = _Joints()
    joints.follow(_point(0.0, 5.0, 5.0), stamp_s=12.0)
    assert [joints.sample(at)[0] for at in (11.0, 12.0, 13.0)] == [0.0, 0.0, 0.0]


def test_a_first_point_between_now_and_the_stamp_is_refused() -> None:
    text = _Joints().refuse(_point(-1.0, 1.0, 1.0), _point(1.0, 1.0, 1.0), stamp_s=12.0)
    assert text == "Quintic spline segment can't be constructed: end_time < start_time."


@pytest.mark.parametrize("times", [(1.0, 1.0), (2.0, 1.0), (0.0, -1.0)])
def test_times_that_do_not_increase_are_refused(times: tuple[float, float]) -> None:
    text = _Joints().refuse(*(_point(at, 1.0, 1.0) for at in times))
    assert text == "Trajectory message contains waypoints that are not strictly increasing in time."


def test_a_replaced_trajectory_is_left_at_its_velocity() -> None:
    """If the first point has a velocity; else on a straight line."""
    joints = _Joints()
    joints.follow(_point(4.0, 4.0, 4.0))
    joints.follow(_point(1.0, 1.0, 1.0, velocities=[0.0, 0.0]), now_s=11.0)
    assert joints.sample(11.0) == (1.0, 1.0, pytest.approx(-4.0))
    assert joints.sample(12.0) == pytest.approx((1.0, 0.0, 2.0))
    joints.follow(_point(1.0, 3.0, 3.0), now_s=12.0)
    assert joints.sample(12.5) == (2.0, 2.0, 0.0)
    assert len(joints.paths[0].segments) == 2


# -- joints


@pytest.mark.parametrize("names", ["", "a", "ax", "abx", "aba"])
def test_other_joints_are_refused(names: str) -> None:
    text = _Joints().refuse(_point(1.0, *[1.0] * len(names)), names=names)
    assert text.startswith("Cannot create trajectory from message. It does not contain the expected joints.")


def test_joints_may_come_in_any_order() -> None:
    joints = _Joints()
    joints.follow(_point(1.0, 1.0, 2.0, velocities=[0.5, 0.25]), names="ba")
    assert [joints.sample(11.0, joint)[:2] for joint in (0, 1)] == [(2.0, 0.25), (1.0, 0.5)]


def test_a_joint_named_twice_follows_its_last_column() -> None:
    joints = _Joints()
    joints.follow(_point(1.0, 1.0, 2.0), names="aa", goal=1)
    assert [joints.sample(11.0, joint)[0] for joint in (0, 1)] == [2.0, 0.0]


@pytest.mark.parametrize("names", ["", "x", "aba"])
def test_partial_trajectories_name_joints_of_the_controller(names: str) -> None:
    text = _Joints(partial=True).refuse(_point(1.0, *[1.0] * len(names)), names=names)
    assert text.startswith("Cannot create trajectory from message.")


def test_a_joint_missing_in_a_partial_trajectory_goes_on_as_part_of_the_goal() -> None:
    joints = _Joints(partial=True)
    tolerances = [JointTolerances(goal=StateTolerance(0.1)), JointTolerances(goal=StateTolerance(0.2))]
    joints.follow(_point(4.0, 4.0, 4.0), _point(5.0, 0.0, 0.0), goal=1, tolerances=tolerances)
    joints.follow(_point(1.0, -1.0), names="b", now_s=11.0, goal=2, tolerances=[JointTolerances()] * 2)
    assert [joints.sample(at)[0] for at in (12.0, 14.0, 14.5)] == [2.0, 4.0, 2.0]
    assert [joints.sample(at, 1)[0] for at in (11.0, 12.0, 14.5)] == [1.0, -1.0, -1.0]
    assert [path.at(_ns(12.0)).goal for path in joints.paths] == [2, 2]
    assert [path.at(_ns(14.5)).tolerances.goal.position for path in joints.paths] == [0.1, 0.0]
    assert joints.paths[0].at(_ns(9.0)).goal == NO_GOAL


# -- values

_SIZES = "Size mismatch in trajectory point position, velocity or acceleration data."


@pytest.mark.parametrize(
    ("points", "text"),
    [
        ([_point(1.0, 1.0)], _SIZES),
        ([_point(1.0, 1.0, 1.0, velocities=[1.0])], _SIZES),
        ([_point(1.0, 1.0, 1.0, accelerations=[1.0] * 3)], _SIZES),
        ([_point(1.0, velocities=[1.0, 1.0])], _SIZES),
        ([_point(1.0, 1.0, 1.0), _point(2.0, 1.0, 1.0, velocities=[1.0])], _SIZES),
        ([_point(1.0)], "Size mismatch between trajectory point and vector specifying whether joints wrap around."),
        (
            [_point(1.0, 1.0, 1.0), _point(2.0)],
            "Can't construct segment from ROS message: Start/end points data size mismatch.",
        ),
        ([_point(1.0, 1.0, math.nan)], "A trajectory point has a value that is not finite."),
        ([_point(1.0, 1.0, 1.0, velocities=[0.0, math.inf])], "A trajectory point has a value that is not finite."),
    ],
)
def test_points_of_wrong_sizes_are_refused(points: list[dict[str, Any]], text: str) -> None:
    assert _Joints().refuse(*points) == text


def test_dropped_points_may_have_any_size() -> None:
    joints = _Joints()
    joints.follow(_point(0.0), _point(1.0, 1.0, 1.0))
    assert joints.sample(11.0)[0] == 1.0


def test_surplus_values_are_ignored() -> None:
    joints = _Joints()
    joints.follow(_point(1.0, 1.0, 2.0, 3.0))
    assert [joints.sample(11.0, joint)[0] for joint in (0, 1)] == [1.0, 2.0]


def test_velocities_count_between_points_that_both_have_them() -> None:
    joints = _Joints()
    moving = [1.0, 1.0]
    joints.follow(
        _point(1.0, 1.0, 1.0, velocities=moving), _point(2.0, 0.0, 0.0), _point(3.0, 1.0, 1.0, accelerations=[0.0, 0.0])
    )
    assert joints.sample(11.0 - 1e-9)[1] == pytest.approx(1.0)
    assert [joints.sample(at)[1] for at in (11.5, 12.5)] == [-1.0, 1.0]


# -- continuous joints


@pytest.mark.parametrize(
    ("start", "targets", "expected"),
    [
        (0.0, [2.0 + math.tau], [2.0]),
        (3.0, [-3.0], [-3.0 + math.tau]),
        (-7.0, [0.5, 0.5 + math.tau, -8.0], [0.5 - math.tau, 0.5, -8.0 - math.tau]),
        (0.0, [math.pi], [math.pi]),
        (0.0, [-math.pi], [-math.pi]),
        (math.pi, [0.0], [0.0]),
        (0.0, [3 * math.pi], [math.pi]),
    ],
)
def test_a_continuous_joint_turns_in_the_shorter_direction_to_its_first_point(
    start: float, targets: list[float], expected: list[float]
) -> None:
    joints = _Joints(continuous=True)
    joints.paths = [holding_path(start, 0)] * 2
    joints.follow(*(_point(1.0 + i, target, target) for i, target in enumerate(targets)))
    assert [joints.sample(11.0 + i)[0] for i in range(len(targets))] == pytest.approx(expected)


def test_a_joint_with_limits_moves_to_the_given_position() -> None:
    joints = _Joints()
    joints.follow(_point(1.0, 6.5, -6.5))
    assert [joints.sample(11.0, joint)[0] for joint in (0, 1)] == [6.5, -6.5]


# -- holding and stopping


def test_a_held_position_is_a_finished_goal() -> None:
    path = holding_path(1.5, _ns(10.0), goal=4)
    assert (path.at(_ns(10.001)).goal, path.at(_ns(10.001)).segment.end_ns) == (4, _ns(10.0))
    assert path.at(_ns(10.001)).segment.sample(_ns(10.001)) == (1.5, 0.0, 0.0)


def test_a_stop_has_its_duration() -> None:
    """The quintic p + v (t − t³/2 + t⁴/8) of 2 s is at rest after 1 s, 0.625 m further, where the path ends."""
    path = stopping_path(2.0, 1.0, _ns(10.0), _ns(1.0), goal=4)
    segment = path.at(_ns(10.5)).segment
    assert segment.sample(_ns(10.0)) == (2.0, 1.0, 0.0)
    assert segment.sample(_ns(10.5)) == pytest.approx((2.0 + 0.5 - 0.5**4 + 0.5**7, 1 - 1.5 * 0.25 + 0.0625, -1.125))
    assert segment.sample(_ns(11.0)) == pytest.approx((2.625, 0.0, -1.5))
    assert segment.sample(_ns(12.0)) == pytest.approx((2.625, 0.0, 0.0))


# -- tolerances


def test_tolerances_of_a_goal_replace_disable_or_keep_the_defaults() -> None:
    constraints = RosParameters({"goal_time": 0.5, "a": {"trajectory": 0.1, "goal": 0.2}, "b": {"goal": 0.3}}, "c")
    defaults = read_tolerances(constraints, ["a", "b"])
    assert defaults[0] == JointTolerances(StateTolerance(0.1), StateTolerance(0.2, 0.01), _ns(0.5))
    assert defaults[1] == JointTolerances(StateTolerance(0.0), StateTolerance(0.3, 0.01), _ns(0.5))

    def merged(**fields: Any) -> list[JointTolerances]:
        goal: Any = _TYPES.new("control_msgs/FollowJointTrajectoryGoal", fields)
        return goal_tolerances(defaults, goal, ["a", "b"])

    assert merged() == defaults
    path = [
        {"name": "a", "position": -1.0, "velocity": 2.0},
        {"name": "b", "position": 7.0, "velocity": math.nan},
        {"name": "b", "position": 8.0},
        {"name": "x", "position": 9.0},
    ]
    end = [{"name": "a", "position": 0.0, "velocity": -1.0}]
    updated = merged(path_tolerance=path, goal_tolerance=end, goal_time_tolerance=_time(2.0))
    assert updated[0] == JointTolerances(StateTolerance(0.0, 2.0), StateTolerance(0.2, 0.0), _ns(2.0))
    assert updated[1] == JointTolerances(StateTolerance(8.0), StateTolerance(0.3, 0.01), _ns(2.0))
    assert merged(goal_time_tolerance=_time(-1.0))[0].time_ns == 0


@pytest.mark.parametrize(
    ("errors", "allowed"), [((0.1, 0.2), True), ((-0.1, -0.2), True), ((0.11, 0.0), False), ((0.0, -0.21), False)]
)
def test_errors_within_a_tolerance_are_allowed(errors: tuple[float, float], allowed: bool) -> None:
    assert StateTolerance(0.1, 0.2).allows(*errors) is allowed
    assert StateTolerance().allows(1e9, 1e9)


def test_a_path_is_constant_before_its_start() -> None:
    segment = JointSegment.between(_ns(5.0), JointState(1.0), _ns(6.0), JointState(2.0))
    path = JointPath([PathSegment(segment)])
    assert (path.index_at(_ns(4.0)), path.state_at(_ns(4.0))) == (-1, JointState(1.0, 0.0, 0.0))
