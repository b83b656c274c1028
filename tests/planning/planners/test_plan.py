"""Plans of the seven-axis arm: valid, to the goal, and the same for the same request."""

from collections.abc import Callable
from itertools import combinations, pairwise
from typing import Any

import msgspec
import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from numpy.typing import NDArray
from tests.planning.arms import arm
from tests.planning.scenes import ready, scene_with, seven_axis, thing

from trundle.base.diagnostics import UsageError
from trundle.planning.kinematics import Kinematics
from trundle.planning.planners import (
    Constraints,
    ErrorCode,
    JointConstraint,
    MotionPlan,
    MotionPlanRequest,
    OrientationConstraint,
    PlannerSettings,
    PlanningFailure,
    PositionConstraint,
    StartStateFixes,
    VisibilityConstraint,
    is_path_valid,
    is_visible,
    joint_goal,
    ompl_settings,
    plan,
    pose_goal,
)
from trundle.planning.planning_scene import AttachedObject, PlacedShape, PlanningScene
from trundle.robots.model import Box, Cylinder, Sphere
from trundle.spatial import Pose, quaternion_from_rpy

_FINE = 150
"""States between waypoints that the tests check."""


def _table_and_wall() -> PlanningScene:
    return scene_with(
        thing("table", Box((1.0, 1.6, 0.04)), 0.8, 0.0, 0.3), thing("wall", Box((0.5, 0.04, 0.6)), 0.6, 0.0, 0.6)
    )


def _sides(scene: PlanningScene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return states on both sides of the wall."""
    model = scene.model
    left = model.state_of({"joint_1": 0.7, "joint_2": 0.9, "joint_4": 0.9, "joint_6": 0.8})
    right = model.state_of({"joint_1": -0.7}, base=left)
    assert scene.is_free(left)
    assert scene.is_free(right)
    return left, right


def _assert_valid(scene: PlanningScene, waypoints: NDArray[np.float64]) -> None:
    for a, b in pairwise(waypoints):
        for t in np.linspace(0.0, 1.0, max(2, int(_FINE * np.abs(b - a).max()))):
            state = a + t * (b - a)
            assert scene.model.is_within_bounds(state, margin=1e-9)
            assert all(contact.depth < 0.001 for contact in scene.check(state))


def _planned(scene: PlanningScene, request: MotionPlanRequest) -> MotionPlan:
    result = plan(scene, request)
    assert isinstance(result, MotionPlan), result
    return result


@pytest.mark.parametrize("planner", ["", "RRT", "RRTstar", "PRM", "PRMstar"])
def test_each_planner_leads_around_the_wall(planner: str) -> None:
    scene = _table_and_wall()
    start, goal = _sides(scene)
    assert not scene.is_free((start + goal) / 2)
    request = MotionPlanRequest(
        group="arm",
        goals=(joint_goal(dict(zip(scene.model.variables, goal, strict=True))),),
        start=start,
        planner=planner,
        settings=PlannerSettings(max_iterations=1500 if planner.endswith("star") else 100_000),
        allowed_time=60.0,
        seed=3,
    )

    result = _planned(scene, request)

    assert result.planner == (planner or "RRTConnect")
    assert result.waypoints[0] == pytest.approx(start)
    assert result.waypoints[-1] == pytest.approx(goal, abs=1e-3)
    _assert_valid(scene, result.waypoints)


def test_the_same_request_has_the_same_path_and_another_seed_another() -> None:
    scene = _table_and_wall()
    start, goal = _sides(scene)
    constraints = joint_goal(dict(zip(scene.model.variables, goal, strict=True)))

    def path(seed: int) -> NDArray[np.float64]:
        request = MotionPlanRequest(group="arm", goals=(constraints,), start=start, seed=seed, allowed_time=60.0)
        return _planned(scene, request).waypoints

    assert np.array_equal(path(1), path(1))
    assert path(1).shape != path(2).shape or not np.allclose(path(1), path(2))


@settings(max_examples=6, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_paths_between_random_states_are_valid(seed: int) -> None:
    scene = _table_and_wall()
    model, rng = scene.model, np.random.default_rng(seed)
    states: list[NDArray[np.float64]] = []
    while len(states) < 2:
        state = rng.uniform(model.lower, model.upper)
        states += [state] if scene.is_free(state) else []
    goal = joint_goal(dict(zip(model.variables, states[1], strict=True)))

    result = plan(scene, MotionPlanRequest(group="arm", goals=(goal,), start=states[0], seed=seed, allowed_time=20.0))

    if isinstance(result, MotionPlan):
        assert result.waypoints[0] == pytest.approx(states[0])
        assert result.waypoints[-1] == pytest.approx(states[1], abs=1e-3)
        _assert_valid(scene, result.waypoints)


def test_a_pose_is_reached_within_its_tolerances() -> None:
    scene = _table_and_wall()
    target = Pose((0.5, 0.3, 0.6), quaternion_from_rpy(np.pi, 0.0, 0.3))
    request = MotionPlanRequest(group="arm", goals=(pose_goal("flange", target),), seed=1, allowed_time=30.0)

    result = _planned(scene, request)

    reached = target.inverse() @ scene.link_pose("flange", result.waypoints[-1])
    assert np.linalg.norm(reached.position) < 2e-4
    assert np.abs(reached.rpy).max() < 2e-3
    assert result.waypoints[0] == pytest.approx(ready())
    _assert_valid(scene, result.waypoints)


def test_a_path_is_checked_between_its_points_too() -> None:
    scene = _table_and_wall()
    sides = np.array(_sides(scene))[:, scene.model.indices(scene.model.group("arm").variables)]

    assert not is_path_valid(scene, "arm", sides)
    assert is_path_valid(scene, "arm", sides[[0, 0]])
    assert is_path_valid(PlanningScene(scene.model), "arm", sides)
    bound = JointConstraint(variable="joint_1", position=0.7, tolerance_above=0.1, tolerance_below=0.1)
    held = Constraints(joints=(bound,))
    assert not is_path_valid(PlanningScene(scene.model), "arm", sides, path_constraints=held)


@pytest.mark.parametrize("name", ["scara", "four_axis"])
def test_an_arm_of_four_joints_reaches_poses_within_their_tolerances(name: str) -> None:
    """It reaches none of the poses in the tolerances exactly, but the one that was asked for."""
    scene = PlanningScene(arm(name))
    model, kinematics = scene.model, Kinematics(scene.model)
    matrix = scene.allowed_collisions
    for pair in combinations(model.links, 2):
        matrix.set_entry(*pair, True)
    scene.allowed_collisions = matrix
    group = model.groups["arm"]
    indices, tip = model.indices(group.variables), group.tips[0]
    random = np.random.default_rng(3)
    for number in range(20):
        state = model.default_positions()
        state[indices] = random.uniform(model.lower[indices], model.upper[indices])
        pose = kinematics.link_pose(model.with_mimics(state), tip)
        goals = (pose_goal(tip, pose),)
        planned = _planned(scene, MotionPlanRequest(group="arm", goals=goals, seed=number, allowed_time=60.0))
        reached = pose.inverse() @ kinematics.link_pose(planned.waypoints[-1], tip)
        assert np.linalg.norm(reached.position) < 2e-4
        assert np.abs(reached.rpy).max() < 2e-3


def test_a_pose_in_the_frame_of_an_object() -> None:
    scene = scene_with(thing("table", Box((0.4, 0.4, 0.04)), 0.6, 0.0, 0.3))
    above = Pose((0.0, 0.0, 0.2), quaternion_from_rpy(np.pi, 0.0, 0.0))
    goal = pose_goal("flange", above, frame="table")

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(goal,), allowed_time=30.0))

    assert scene.link_pose("flange", result.waypoints[-1]).position == pytest.approx((0.6, 0.0, 0.5), abs=1e-3)


def test_one_of_several_goals_is_reached() -> None:
    scene = _table_and_wall()
    inside = pose_goal("flange", Pose((0.8, 0.0, 0.3)))  # in the table
    far = pose_goal("flange", Pose((5.0, 0.0, 0.3)))
    good = joint_goal({"joint_1": -0.5})

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(far, inside, good), allowed_time=30.0))

    assert result.waypoints[-1][0] == pytest.approx(-0.5, abs=1e-3)


def test_the_tool_stays_upright_along_the_path() -> None:
    scene = scene_with(thing("post", Cylinder(0.05, 1.0), 0.55, 0.0, 0.5))
    upright = OrientationConstraint(
        link="flange", orientation=quaternion_from_rpy(np.pi, 0.0, 0.0), tolerances=(0.1, 0.1, 4.0)
    )
    down = quaternion_from_rpy(np.pi, 0.0, 0.0)
    reach = _planned(
        scene,
        MotionPlanRequest(group="arm", goals=(pose_goal("flange", Pose((0.45, 0.3, 0.5), down)),), allowed_time=30.0),
    )

    result = _planned(
        scene,
        MotionPlanRequest(
            group="arm",
            start=reach.waypoints[-1],
            goals=(pose_goal("flange", Pose((0.45, -0.3, 0.5), down)),),
            path_constraints=Constraints(orientations=(upright,)),
            allowed_time=60.0,
            seed=2,
        ),
    )

    _assert_valid(scene, result.waypoints)
    for a, b in pairwise(result.waypoints):
        for t in (0.0, 0.5, 1.0):
            pose = scene.link_pose("flange", a + t * (b - a))
            axis = pose.transform_vector((0.0, 0.0, 1.0))
            assert np.arccos(-axis[2]) < 0.16  # two angles of 0.1 rad together are 0.141


def test_path_constraints_of_joints_and_positions_hold() -> None:
    scene = scene_with()
    start = scene.model.state_of({"joint_1": 0.6}, base=ready())
    keep = Constraints(
        joints=joint_goal({"joint_3": 0.0}, tolerance=0.2).joints,
        positions=(
            PositionConstraint(
                link="flange",
                region=(PlacedShape(Box((4.0, 4.0, 0.1)), Pose(scene.link_pose("flange", start).position)),),
            ),
        ),
    )
    goal = joint_goal({"joint_1": -1.5, "joint_3": 0.1, "joint_2": 0.4, "joint_4": 1.2, "joint_5": 0.0})

    result = _planned(
        scene,
        MotionPlanRequest(group="arm", start=start, goals=(goal,), path_constraints=keep, allowed_time=60.0),
    )

    height = scene.link_pose("flange", start).position[2]
    for state in result.waypoints:
        assert abs(state[2]) <= 0.2 + 1e-9
        assert abs(scene.link_pose("flange", state).position[2] - height) <= 0.05 + 1e-4


def test_visibility_as_a_goal() -> None:
    scene = scene_with()
    look = VisibilityConstraint(
        target_radius=0.05,
        target_pose=Pose((0.9, 0.0, 0.2)),
        sensor_frame="flange",
        sensor_pose=Pose((0.0, 0.0, 0.07)),
        max_range_angle=0.5,
        cone_sides=8,
    )
    goal = Constraints(
        visibilities=(look,),
        orientations=(
            OrientationConstraint(
                link="flange", orientation=quaternion_from_rpy(np.pi, 0.0, 0.0), tolerances=(0.5, 0.5, 4.0)
            ),
        ),
        positions=(PositionConstraint(link="flange", region=(PlacedShape(Sphere(0.2), Pose((0.6, 0.0, 0.6))),)),),
    )

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(goal,), allowed_time=60.0, seed=5))

    pose = scene.link_pose("flange", result.waypoints[-1])
    sight = np.subtract((0.9, 0.0, 0.2), pose.position)
    axis = pose.transform_vector((0.0, 0.0, 1.0))
    assert np.arccos(np.dot(sight, axis) / np.linalg.norm(sight)) <= 0.5 + 1e-6
    assert is_visible(scene, look, result.waypoints[-1])
    assert not is_visible(scene, look, scene.model.state_of({"joint_6": 0.5}, base=result.waypoints[-1]))
    with pytest.raises(UsageError, match="no frame 'nowhere'"):
        is_visible(scene, msgspec.structs.replace(look, sensor_frame="nowhere"), result.waypoints[-1])


def test_what_is_carried_does_not_collide_either() -> None:
    scene = _table_and_wall()
    start, goal = _sides(scene)
    pole = thing("pole", Cylinder(0.02, 0.3))
    touch = frozenset({"link_5", "link_6", "link_7"})
    scene.attach(AttachedObject(object=pole, link="flange", touch_links=touch))
    if not scene.is_free(start) or not scene.is_free(goal):
        pytest.fail("the pole touches at the start or the goal")
    constraints = joint_goal(dict(zip(scene.model.variables, goal, strict=True)))

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(constraints,), start=start, allowed_time=60.0))

    _assert_valid(scene, result.waypoints)


def test_a_goal_of_a_joint_beyond_its_limits_is_the_limit() -> None:
    """As in MoveIt's constraints: TIAGo's tutorial asks for 2.7 rad where the safety limit is 2.68."""
    scene = scene_with()

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(joint_goal({"joint_1": 9.0}),)))

    upper = scene.model.upper[0]
    assert result.waypoints[-1][0] == pytest.approx(upper)
    assert f"'joint_1': the goal 9 is beyond the limits {scene.model.lower[0]:g} … {upper:g}" in result.notes[0]


def test_a_start_a_little_beyond_its_limits_or_in_a_thing_is_mended() -> None:
    scene = scene_with()
    model = scene.model
    beyond = model.state_of({"joint_1": model.upper[0] + 0.01}, base=ready())
    goal = joint_goal({"joint_1": 1.0})

    result = _planned(scene, MotionPlanRequest(group="arm", goals=(goal,), start=beyond))

    assert result.waypoints[0] == pytest.approx(beyond)
    assert result.waypoints[1][0] == pytest.approx(model.upper[0])
    assert "beyond its limits" in result.notes[0]
    x, y, z = scene.link_pose("link_7").position
    distance = 0.0
    while scene.is_free():
        scene.add(thing("post", Sphere(0.05), x + 0.2 - distance, y, z))
        distance += 0.002
    mended = _planned(scene, MotionPlanRequest(group="arm", goals=(goal,)))
    assert "the path begins beside it" in mended.notes[0]
    assert scene.is_free(mended.waypoints[1])


@pytest.mark.parametrize(
    ("request_of", "code", "message"),
    [
        (lambda: {"group": "legs", "goals": (joint_goal({"joint_1": 0.0}),)}, ErrorCode.INVALID_GROUP_NAME, "no group"),
        (lambda: {"goals": ()}, ErrorCode.INVALID_GOAL_CONSTRAINTS, "a request needs a goal"),
        (lambda: {"goals": (joint_goal({"x": 9.0}),)}, ErrorCode.INVALID_GOAL_CONSTRAINTS, "no variable 'x'"),
        (lambda: {"goals": (joint_goal({"joint_1": np.nan}),)}, ErrorCode.INVALID_GOAL_CONSTRAINTS, "finite numbers"),
        (lambda: {"goals": (pose_goal("hand", Pose()),)}, ErrorCode.INVALID_LINK_NAME, "no link 'hand'"),
        (lambda: {"goals": (pose_goal("flange", Pose(), frame="x"),)}, ErrorCode.FRAME_TRANSFORM_FAILURE, "no frame"),
        (lambda: {"goals": (pose_goal("flange", Pose((9.0, 0, 0))),)}, ErrorCode.PLANNING_FAILED, "none satisfied it"),
        (lambda: {"goals": (pose_goal("flange", Pose((np.nan, 0, 0))),)}, ErrorCode.INVALID_GOAL_CONSTRAINTS, "finite"),
        (lambda: {"goals": (_inside(),)}, ErrorCode.PLANNING_FAILED, "were in collision"),
        (lambda: {"start": np.zeros(2)}, ErrorCode.INVALID_ROBOT_STATE, "a start has 7 finite numbers"),
        (lambda: {"start": np.full(7, 9.0)}, ErrorCode.INVALID_ROBOT_STATE, "beyond its limits"),
        (
            lambda: {
                "start": seven_axis().state_of({"joint_2": 1.3}),
                "start_fixes": StartStateFixes(jiggle_fraction=0),
            },
            ErrorCode.START_STATE_IN_COLLISION,
            "the start is in collision: 'link_",
        ),
    ],
)
def test_what_cannot_be_planned_is_told(
    request_of: Callable[[], dict[str, Any]], code: ErrorCode, message: str
) -> None:
    scene = _table_and_wall()
    scene.add(thing("block", Box((0.3, 0.3, 0.3)), 0.2, 0.6, 0.5))
    request: dict[str, Any] = {
        "group": "arm",
        "goals": (joint_goal({"joint_1": 0.5}),),
        "allowed_time": 2.0,
        **request_of(),
    }

    result = plan(scene, MotionPlanRequest(**request))

    assert isinstance(result, PlanningFailure)
    assert result.error_code is code
    assert message in result.sentence


def _inside() -> Constraints:
    return pose_goal("flange", Pose((0.2, 0.6, 0.5)), orientation_tolerance=4.0)


def test_a_search_ends_when_it_is_cancelled() -> None:
    scene = _table_and_wall()
    start, goal = _sides(scene)
    constraints = joint_goal(dict(zip(scene.model.variables, goal, strict=True)))
    request = MotionPlanRequest(group="arm", goals=(constraints,), start=start, allowed_time=600.0)
    request.cancel.cancel()

    result = plan(scene, request)

    assert isinstance(result, PlanningFailure)
    assert result.error_code is ErrorCode.PREEMPTED


@pytest.mark.parametrize(
    ("name", "planner", "note"),
    [
        ("RRTConnectkConfigDefault", "RRTConnect", ""),
        ("geometric::RRTConnect", "RRTConnect", ""),
        ("geometric::KPIECE", "RRTConnect", "there is no KPIECE; RRTConnect planned"),
        ("PRMstarkConfigDefault", "PRMstar", ""),
        ("STOMP", "RRTConnect", "there is no STOMP"),
        ("Magic", "RRTConnect", "no planner 'Magic'"),
    ],
)
def test_names_of_other_planners_are_answered_by_the_nearest(name: str, planner: str, note: str) -> None:
    scene = scene_with()
    request = MotionPlanRequest(group="arm", goals=(joint_goal({"joint_1": 0.4}),), planner=name, allowed_time=1.0,
                                settings=PlannerSettings(max_iterations=50))  # fmt: skip

    result = _planned(scene, request)

    assert result.planner == planner
    assert any(note in text for text in result.notes) if note else result.notes == ()


def test_settings_are_those_of_ompl_planning_yaml() -> None:
    config = {
        "planner_configs": {
            "Quick": {"type": "geometric::RRTConnect", "range": 0.3},
            "Odd": {"type": "geometric::RRT", "range": "a lot"},
        },
        "arm": {
            "default_planner_config": "Quick",
            "planner_configs": ["Quick", "Odd"],
            "longest_valid_segment_fraction": 0.002,
        },
    }

    planner, found = ompl_settings(config, "arm", "")
    other, odd = ompl_settings(config, "arm", "arm[Odd]")

    assert (planner, found.range, found.longest_valid_segment_fraction) == ("geometric::RRTConnect", 0.3, 0.002)
    assert (other, odd.range) == ("geometric::RRT", 0.0)
    assert ompl_settings({}, "arm", "")[0] == "RRTConnect"
