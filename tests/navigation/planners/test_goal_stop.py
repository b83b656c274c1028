"""The end of a plan: when the robot is at the goal."""

import math
from collections import deque
from typing import Any

import pytest

from trundle.navigation.planners.goal_stop import GoalStop, Velocity
from trundle.navigation.planners.interfaces import Pose2D
from trundle.navigation.planners.motion import approach
from trundle.navigation.planners.trajectory_planner import TrajectorySettings

GOAL = Pose2D(1.0, 0.0, 0.0)
STANDING = (0.0, 0.0, 0.0)


def stop(**limits: Any) -> GoalStop:
    node: Any = None
    settings = TrajectorySettings(xy_goal_tolerance=0.1, yaw_goal_tolerance=0.1, **limits)
    return GoalStop(node, settings, stopped_speed=0.01, stopped_turn=0.01)


def command(goal_stop: GoalStop, pose: Pose2D, velocity: Velocity) -> Velocity:
    found = goal_stop.command(pose, GOAL, velocity, least_turn=0.1, most_turn=1.0, period_s=0.1, is_free=lambda _: True)
    assert found is not None
    return found


@pytest.mark.parametrize(("is_latched", "at_last"), [(False, False), (True, True)])
def test_a_robot_that_turns_at_the_goal_stays_there_while_its_localization_jitters(
    is_latched: bool, at_last: bool
) -> None:
    """Otherwise it turns to the goal's direction and back to the way, again and again."""
    goal_stop = stop(latch_xy_goal_tolerance=is_latched)
    there: list[bool] = []

    for beside in (0.12, 0.09, 0.11, 0.14, 0.16, 0.14):
        pose = Pose2D(1.0 - beside, 0.0, 2.0)
        there.append(goal_stop.is_at_position(pose, GOAL))
        if there[-1]:
            assert command(goal_stop, pose, STANDING)[2] < 0.0

    assert there == [False, True, True, True, at_last, at_last]


def test_a_robot_that_turns_about_a_point_before_its_origin_is_at_the_goal_meanwhile() -> None:
    """It brakes while it begins to turn, and its origin moves sideways from then on."""
    goal_stop = stop()
    for beside, velocity in ((0.09, (0.2, 0.0, 0.0)), (0.09, (0.0, 0.05, -1.0)), (0.12, (0.0, 0.05, -1.0))):
        pose = Pose2D(1.0 - beside, 0.0, 2.0)
        assert goal_stop.has_arrived(pose, GOAL, velocity)
        assert command(goal_stop, pose, velocity)[2] < 0.0


def test_a_robot_that_rolls_out_of_the_tolerance_has_not_reached_the_goal() -> None:
    goal_stop = stop()

    assert goal_stop.is_at_position(Pose2D(0.91, 0.0, 0.0), GOAL)
    assert 0.0 < command(goal_stop, Pose2D(0.91, 0.0, 2.0), (0.5, 0.0, 0.0))[0] < 0.5

    assert not goal_stop.is_reached(Pose2D(1.12, 0.0, 0.0), GOAL, STANDING)


def _drifting_stop(**limits: float) -> GoalStop:
    """Return a stop whose robot has left the goal's tolerance by a turn."""
    goal_stop = stop(**limits)
    assert goal_stop.has_arrived(Pose2D(1.0 - 0.09, 0.0, 2.0), GOAL, STANDING)
    command(goal_stop, Pose2D(1.0 - 0.09, 0.0, 2.0), STANDING)
    assert not goal_stop.has_arrived(Pose2D(1.0 - 0.16, 0.0, 1.0), GOAL, STANDING)
    return goal_stop


def test_a_robot_that_a_turn_moves_drives_on_while_it_comes_nearer() -> None:
    """An axle behind the robot's origin moves it when it turns: it leaves a goal at whose edge it stops."""
    goal_stop = _drifting_stop()
    arrived = [
        goal_stop.has_arrived(Pose2D(1.0 - beside, 0.0, 2.0), GOAL, (0.1, 0.0, 0.0))
        for beside in (0.11, 0.09, 0.06, 0.03, 0.03)
    ]
    assert arrived == [False, False, False, False, True]
    command(goal_stop, Pose2D(0.97, 0.0, 2.0), STANDING)

    assert goal_stop.has_arrived(Pose2D(1.13, 0.0, 1.0), GOAL, STANDING)
    assert not goal_stop.has_arrived(Pose2D(1.16, 0.0, 1.0), GOAL, STANDING)


def test_a_robot_brakes_in_time_for_its_goal() -> None:
    goal_stop = _drifting_stop(acc_lim_x=1.0)

    assert not goal_stop.has_arrived(Pose2D(0.92, 0.0, 0.0), GOAL, (0.3, 0.0, 0.0))
    assert goal_stop.has_arrived(Pose2D(0.96, 0.0, 0.0), GOAL, (0.3, 0.0, 0.0))


def test_a_new_goal_is_reached_within_the_tolerance_alone() -> None:
    goal_stop = stop()
    assert goal_stop.is_reached(GOAL, GOAL, STANDING)
    goal_stop.reset(is_new_goal=True)

    assert not goal_stop.is_at_position(Pose2D(1.12, 0.0, 0.0), GOAL)


@pytest.mark.parametrize(("acceleration", "period_s", "delay"), [(2.0, 0.05, 3), (2.0, 0.2, 1), (1.0, 0.2, 1)])
def test_a_base_that_is_slower_than_its_limits_say_ends_its_turn(
    acceleration: float, period_s: float, delay: int
) -> None:
    """Otherwise it swings past the goal's direction, and back, for ever."""
    settings = TrajectorySettings(yaw_goal_tolerance=0.16, acc_lim_theta=20.0)
    goal_stop = GoalStop(node=None, limits=settings, stopped_speed=0.01, stopped_turn=0.01)  # type: ignore[arg-type]
    yaw, turn, seconds = 3.1, 0.0, 0.0
    commands = deque([0.0] * delay)

    while not goal_stop.is_reached(Pose2D(1.0, 0.0, yaw), GOAL, (0.0, 0.0, turn)):
        found = goal_stop.command(
            Pose2D(1.0, 0.0, yaw),
            GOAL,
            (0.0, 0.0, turn),
            least_turn=0.3,
            most_turn=1.57,
            period_s=period_s,
            is_free=lambda _: True,
        )
        assert found is not None
        commands.append(found[2])
        turn = approach(turn, commands.popleft(), acceleration * period_s)
        yaw = math.remainder(yaw + turn * period_s, math.tau)
        seconds += period_s
        assert seconds < 10.0
