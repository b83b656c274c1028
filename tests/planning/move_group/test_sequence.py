"""Sequences of motions: one path for each group, blended around corners."""

from typing import Any

import numpy as np
import pytest
from tests.planning.arms import arm
from tests.planning.move_group.arm_graph import ARM, joint_goal, request, send, start_arm

from trundle.planning.kinematics import Kinematics

_PILZ: dict[str, Any] = {
    "planning_plugin": "pilz_industrial_motion_planner::CommandPlanner",
    "capabilities": "pilz_industrial_motion_planner/MoveGroupSequenceAction "
    "pilz_industrial_motion_planner/MoveGroupSequenceService",
}
_HOME = [0.0, 0.0, 0.0, 0.0, 0.8, 0.0]
_FIRST = [0.4, 0.3, 0.0, 0.0, 0.8, 0.0]
_SECOND = [0.8, 0.0, 0.2, 0.0, 0.8, 0.0]
_SUCCESS, _INVALID_PLAN = 1, -2


def _item(positions: list[float], radius: float = 0.0) -> dict[str, Any]:
    wanted = {
        **request(joint_goal(dict(zip(ARM, positions, strict=True)))),
        "planner_id": "PTP",
        "max_velocity_scaling_factor": 0.4,
    }
    return {"req": wanted, "blend_radius": radius}


def _plan(graph: Any, *items: dict[str, Any]) -> Any:
    return graph.call("/plan_sequence_path", "moveit_msgs/GetMotionSequence", request={"items": list(items)}).response


def _times(trajectory: Any) -> np.ndarray[Any, Any]:
    return np.array([p.time_from_start.sec + 1e-9 * p.time_from_start.nanosec for p in trajectory.points])


def _places(trajectory: Any) -> np.ndarray[Any, Any]:
    model = arm("six_axis")
    states = np.zeros((len(trajectory.points), len(model.variables)))
    states[:, model.indices(ARM)] = [point.positions for point in trajectory.points]
    row = list(model.links).index(model.groups["arm"].tips[0])
    return Kinematics(model).link_poses(states)[:, row, :3]


def test_a_sequence_is_one_trajectory_that_stops_or_blends(graph: Any) -> None:
    start_arm(graph, **_PILZ)

    stops = _plan(graph, _item(_FIRST), _item(_SECOND))
    blends = _plan(graph, _item(_FIRST, 0.1), _item(_SECOND))

    assert (stops.error_code.val, blends.error_code.val) == (_SUCCESS, _SUCCESS)
    (stopping,), (blending,) = stops.planned_trajectories, blends.planned_trajectories
    stopping, blending = stopping.joint_trajectory, blending.joint_trajectory
    assert np.all(np.diff(_times(stopping)) > 0)
    assert np.all(np.diff(_times(blending)) > 0)
    assert _times(blending)[-1] < _times(stopping)[-1] - 0.05
    for trajectory in (stopping, blending):
        np.testing.assert_allclose(trajectory.points[0].positions, _HOME, atol=1e-6)
        np.testing.assert_allclose(trajectory.points[-1].positions, _SECOND, atol=1e-3)
    at_rest = [not any(point.velocities) for point in stopping.points]
    assert sum(at_rest) == 3
    assert not any(not any(point.velocities) for point in blending.points[1:-1])
    limits = arm("six_axis").max_velocity[arm("six_axis").indices(ARM)]
    assert np.all(np.abs([point.velocities for point in blending.points]) <= limits * 1.001)
    corner = Kinematics(arm("six_axis")).link_pose(
        arm("six_axis").state_of(dict(zip(ARM, _FIRST, strict=True))), arm("six_axis").groups["arm"].tips[0]
    )
    assert 0.001 < np.linalg.norm(_places(blending) - corner.position, axis=1).min() < 0.1


@pytest.mark.parametrize(
    ("radii", "code"), [((0.0, 0.1), _INVALID_PLAN), ((-0.1, 0.0), _INVALID_PLAN), ((5.0, 0.0), _INVALID_PLAN)]
)
def test_radii_that_cannot_be_are_refused(radii: tuple[float, float], code: int, graph: Any) -> None:
    start_arm(graph, **_PILZ)

    answer = _plan(graph, _item(_FIRST, radii[0]), _item(_SECOND, radii[1]))

    assert answer.error_code.val == code
    assert not answer.planned_trajectories


def test_spheres_of_two_corners_are_apart(graph: Any, capfd: pytest.CaptureFixture[str]) -> None:
    start_arm(graph, **_PILZ)

    answer = _plan(graph, _item(_FIRST, 0.15), _item(_SECOND, 0.4), _item(_HOME))

    assert answer.error_code.val == _INVALID_PLAN
    assert "overlapping blend radii: 0.15 and 0.4 m" in capfd.readouterr().err


def test_the_action_moves_along_the_blended_path(graph: Any) -> None:
    start_arm(graph, **_PILZ)
    goal = {"request": {"items": [_item(_FIRST, 0.1), _item(_SECOND)]}}

    result = send(graph, "sequence_move_group", "moveit_msgs/MoveGroupSequence", goal)

    assert result.result.response.error_code.val == _SUCCESS
    present = graph.call("/get_planning_scene", "moveit_msgs/GetPlanningScene", components={"components": 2}).scene
    state = present.robot_state.joint_state
    at = dict(zip(state.name, state.position, strict=True))
    np.testing.assert_allclose([at[name] for name in ARM], _SECOND, atol=2e-3)
