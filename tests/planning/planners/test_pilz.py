"""PTP, LIN and CIRC as those of pilz_industrial_motion_planner."""

from typing import Any

import numpy as np
import pytest
from tests.planning.scenes import ready, scene_with, thing

from trundle.planning.planners import (
    CartesianLimits,
    Constraints,
    ErrorCode,
    MotionPlan,
    MotionPlanRequest,
    PlanningFailure,
    PositionConstraint,
    RequestError,
    blended,
    joined,
    joint_goal,
    plan,
    pose_goal,
)
from trundle.planning.planning_scene import PlacedShape, PlanningScene
from trundle.planning.trajectories import Trajectory
from trundle.robots.model import Box, Sphere
from trundle.spatial import Pose


def _trajectory(scene: PlanningScene, **request: Any) -> Trajectory:
    result = plan(scene, MotionPlanRequest(group="arm", **request))
    assert isinstance(result, MotionPlan), result
    assert result.trajectory is not None
    assert result.planner == request["planner"]
    return result.trajectory


def _beside(scene: PlanningScene, x: float, y: float, z: float) -> Pose:
    pose = scene.link_pose("flange")
    return Pose((pose.position[0] + x, pose.position[1] + y, pose.position[2] + z), pose.quaternion)


def _positions(scene: PlanningScene, trajectory: Trajectory) -> np.ndarray[Any, np.dtype[np.float64]]:
    return np.array([scene.link_pose("flange", state).position for state in trajectory.positions])


def test_ptp_moves_all_joints_at_once_within_their_limits() -> None:
    scene = scene_with()
    goal = joint_goal({"joint_1": 1.0, "joint_2": 0.2})

    full = _trajectory(scene, planner="PTP", goals=(goal,))
    slow = _trajectory(scene, planner="PTP", goals=(goal,), velocity_scaling=0.1)

    assert full.positions[0] == pytest.approx(ready())
    assert full.positions[-1][:2] == pytest.approx([1.0, 0.2], abs=1e-3)
    assert np.abs(full.velocities).max() <= 2.0
    assert slow.duration > 2.0 * full.duration
    moving = full.positions[1:-1]
    assert (moving[:, 0] - 0.0) / 1.0 == pytest.approx((moving[:, 1] - 0.4) / -0.2, abs=1e-3)


def test_lin_is_a_line_with_a_trapezoid_of_velocity() -> None:
    scene = scene_with()
    limits = CartesianLimits(max_trans_vel=0.1, max_trans_acc=0.5, max_trans_dec=-0.5)
    goal = pose_goal("flange", _beside(scene, 0.0, 0.2, 0.0))

    trajectory = _trajectory(scene, planner="LIN", goals=(goal,), cartesian_limits=limits)

    positions = _positions(scene, trajectory)
    assert np.abs(positions[:, [0, 2]] - positions[0, [0, 2]]).max() < 1e-4
    assert positions[-1, 1] - positions[0, 1] == pytest.approx(0.2, abs=1e-3)
    speeds = np.linalg.norm(np.diff(positions, axis=0), axis=1) / np.diff(trajectory.times)
    assert speeds.max() == pytest.approx(0.1, rel=0.01)
    assert trajectory.duration == pytest.approx(0.2 / 0.1 + 0.1 / 0.5, rel=0.01)
    assert not trajectory.velocities[[0, -1]].any()


def test_lin_that_only_turns_takes_the_time_of_the_turn() -> None:
    scene = scene_with()
    pose = scene.link_pose("flange") @ Pose.from_rpy(0, 0, 0, 0, 0, 0.5)
    limits = CartesianLimits(max_rot_vel=0.5)

    trajectory = _trajectory(scene, planner="LIN", goals=(pose_goal("flange", pose),), cartesian_limits=limits)

    assert trajectory.duration > 1.0


@pytest.mark.parametrize("name", ["interim", "center"])
def test_circ_is_an_arc(name: str) -> None:
    scene = scene_with()
    x, y, z = scene.link_pose("flange").position
    center = np.array([x, y + 0.1, z])
    point = center if name == "center" else center - np.array([0.0, 0.0, 0.1])
    goal = pose_goal("flange", _beside(scene, 0.0, 0.1 if name == "center" else 0.2, -0.1 if name == "center" else 0.0))
    constraint = PositionConstraint(link="flange", region=(PlacedShape(Sphere(0.001), Pose(tuple(point.tolist()))),))

    trajectory = _trajectory(
        scene,
        planner="CIRC",
        goals=(goal,),
        path_constraints=Constraints(name=name, positions=(constraint,)),
        velocity_scaling=0.2,
    )

    positions = _positions(scene, trajectory)
    assert np.linalg.norm(positions - center, axis=1) == pytest.approx(np.full(len(positions), 0.1), abs=1e-4)
    assert positions[:, 2].min() == pytest.approx(z - 0.1, abs=3e-3)


@pytest.mark.parametrize(
    ("request_of", "code", "message"),
    [
        ({"planner": "LIN", "goal": (3.0, 0.0, 0.0)}, ErrorCode.NO_IK_SOLUTION, "LIN: after"),
        ({"planner": "LIN", "goal": (0.0, 0.4, 0.0)}, ErrorCode.INVALID_MOTION_PLAN, "in collision"),
        ({"planner": "PTP", "goal": (3.0, 0.0, 0.0)}, ErrorCode.NO_IK_SOLUTION, "no valid state of the goal"),
        ({"planner": "PTP", "goal": (0.0, 0.4, 0.0)}, ErrorCode.INVALID_MOTION_PLAN, "PTP: the goal is in collision"),
        ({"planner": "CIRC", "goal": (0.0, 0.1, 0.0)}, ErrorCode.INVALID_MOTION_PLAN, "CIRC needs path constraints"),
        ({"planner": "LIN", "goal": (0.0, 0.1, 0.0), "velocity_scaling": 0.0}, ErrorCode.INVALID_MOTION_PLAN, "scal"),
    ],
)
def test_what_is_no_motion_is_told(request_of: dict[str, Any], code: ErrorCode, message: str) -> None:
    scene = scene_with()
    x, y, z = scene.link_pose("flange").position
    scene.add(thing("wall", Box((1.0, 0.02, 2.0)), x, y + 0.25, z))
    arguments = dict(request_of)
    goal = pose_goal("flange", _beside(scene, *arguments.pop("goal")))

    result = plan(scene, MotionPlanRequest(group="arm", goals=(goal,), **arguments))

    assert isinstance(result, PlanningFailure)
    assert result.error_code is code
    assert message in result.sentence


def test_ptp_avoids_nothing() -> None:
    scene = scene_with()
    turned = scene.model.state_of({"joint_1": 0.5}, base=ready())
    x, y, _ = scene.link_pose("link_4", turned).position
    scene.add(thing("pole", Box((0.02, 0.02, 3.0)), x, y))

    result = plan(scene, MotionPlanRequest(group="arm", planner="PTP", goals=(joint_goal({"joint_1": 1.0}),)))

    assert isinstance(result, PlanningFailure)
    assert result.error_code is ErrorCode.INVALID_MOTION_PLAN
    assert result.sentence == "PTP: the motion is in collision; it avoids nothing"


def _group_part(scene: PlanningScene, trajectory: Trajectory) -> Trajectory:
    indices = scene.model.indices(scene.model.group("arm").variables)
    return Trajectory(
        times=trajectory.times,
        positions=trajectory.positions[:, indices],
        velocities=trajectory.velocities[:, indices],
        accelerations=trajectory.accelerations[:, indices],
    )


def _corner() -> tuple[PlanningScene, Trajectory, Trajectory]:
    """Return two lines of 0.2 m at a right angle."""
    scene = scene_with()
    limits = CartesianLimits(max_trans_vel=0.2, max_trans_acc=0.5, max_trans_dec=-0.5)
    first = _trajectory(
        scene, planner="LIN", goals=(pose_goal("flange", _beside(scene, 0.0, 0.2, 0.0)),), cartesian_limits=limits
    )
    start = first.positions[-1]
    pose = scene.link_pose("flange", start)
    x, y, z = pose.position
    goal = pose_goal("flange", Pose((x, y, z - 0.2), pose.quaternion))
    second = _trajectory(scene, planner="LIN", start=start, goals=(goal,), cartesian_limits=limits)
    return scene, _group_part(scene, first), _group_part(scene, second)


def test_a_blended_corner_does_not_stop_and_stays_in_its_sphere() -> None:
    scene, first, second = _corner()

    stops = joined(scene, "arm", first, second)
    whole = blended(scene, "arm", ready(), first, second, 0.05)

    model = scene.model
    states = np.tile(ready(), (len(whole.times), 1))
    states[:, model.indices(model.group("arm").variables)] = whole.positions
    places = np.array([scene.link_pose("flange", state).position for state in states])
    corner = places[0] + (0.0, 0.2, 0.0)
    off = np.minimum(
        np.linalg.norm(places[:, [0, 2]] - corner[[0, 2]], axis=1), np.linalg.norm(places[:, :2] - corner[:2], axis=1)
    )
    inside = np.linalg.norm(places - corner, axis=1) <= 0.05 * 1.1
    speeds = np.linalg.norm(np.diff(places, axis=0), axis=1) / np.diff(whole.times)
    assert stops.duration == pytest.approx(first.duration + second.duration)
    assert whole.duration < stops.duration - 0.1
    assert off[~inside].max() < 1e-3
    assert off[inside].max() > 0.005
    assert speeds[3:-3].min() > 0.05
    assert np.linalg.norm(places[-1] - corner - (0.0, 0.0, -0.2)) < 1e-3
    steps = np.diff(whole.positions, axis=0)
    means = (whole.velocities[1:] + whole.velocities[:-1]) / 2 * np.diff(whole.times)[:, None]
    assert steps == pytest.approx(means, abs=0.02)
    assert np.all(np.diff(whole.times) > 0)


def test_corners_that_cannot_be_blended_are_refused() -> None:
    scene, first, second = _corner()

    with pytest.raises(RequestError, match="before the corner does not leave the sphere"):
        blended(scene, "arm", ready(), first, second, 0.3)
    middle = _beside(scene, 0.0, 0.19, -0.01).position
    scene.add(thing("pin", Sphere(0.01), *middle))
    with pytest.raises(RequestError, match="in collision"):
        blended(scene, "arm", ready(), first, second, 0.05)
