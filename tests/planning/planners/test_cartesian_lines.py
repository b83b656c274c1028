"""Straight lines of a link, as computeCartesianPath."""

import numpy as np
import pytest
from tests.planning.scenes import ready, scene_with, thing

from trundle.planning.planners import ErrorCode, JumpBounds, RequestError, cartesian_path
from trundle.planning.planning_scene import PlanningScene
from trundle.robots.model import Box
from trundle.spatial import Pose, quaternion_from_rpy


def _moved(scene: PlanningScene, x: float, y: float, z: float) -> Pose:
    pose = scene.link_pose("flange")
    return Pose((pose.position[0] + x, pose.position[1] + y, pose.position[2] + z), pose.quaternion)


def test_the_flange_goes_straight_with_small_steps() -> None:
    scene = scene_with()
    first, second = _moved(scene, 0.0, 0.15, 0.0), _moved(scene, 0.0, 0.15, -0.1)

    path = cartesian_path(scene, "arm", [first, second], max_step=0.005)

    assert (path.fraction, path.end) == (1.0, "done")
    assert path.waypoints[0] == pytest.approx(ready())
    assert len(path.waypoints) == 30 + 20 + 1
    positions = np.array([scene.link_pose("flange", state).position for state in path.waypoints])
    assert np.linalg.norm(np.diff(positions, axis=0), axis=1).max() <= 0.005 + 1e-5
    assert positions[30] == pytest.approx(first.position, abs=1e-5)
    assert positions[-1] == pytest.approx(second.position, abs=1e-5)
    assert np.abs(positions[:31, 2] - positions[0, 2]).max() < 1e-5


def test_turns_are_divided_too() -> None:
    scene = scene_with()
    pose = scene.link_pose("flange") @ Pose(quaternion=quaternion_from_rpy(0.0, 0.0, 0.7))

    path = cartesian_path(scene, "arm", [pose], max_step=0.01)

    assert path.fraction == 1.0
    assert len(path.waypoints) == int(np.ceil(0.7 / 0.035)) + 1


def test_it_stops_before_an_obstacle_unless_collisions_are_not_avoided() -> None:
    scene = scene_with()
    x, y, z = scene.link_pose("flange").position
    scene.add(thing("wall", Box((1.0, 0.02, 1.0)), x, y + 0.3, z))
    target = _moved(scene, 0.0, 0.4, 0.0)

    stopped = cartesian_path(scene, "arm", [target])
    through = cartesian_path(scene, "arm", [target], avoid_collisions=False)

    assert 0.2 < stopped.fraction < 0.8
    assert stopped.end == "invalid"
    assert all(scene.is_free(state) for state in stopped.waypoints)
    assert through.fraction > stopped.fraction


def test_it_stops_where_the_arm_ends() -> None:
    scene = scene_with()

    path = cartesian_path(scene, "arm", [_moved(scene, 3.0, 0.0, 0.0)], max_step=0.02)

    assert 0.0 < path.fraction < 0.5
    assert path.end == "unreachable"
    assert len(path.waypoints) == round(path.fraction * 150) + 1


def test_bounds_of_jumps_end_it() -> None:
    scene = scene_with()
    target = _moved(scene, 0.0, 0.2, 0.0)

    absolute = cartesian_path(scene, "arm", [target], jumps=JumpBounds(revolute=1e-4))
    relative = cartesian_path(scene, "arm", [target], jumps=JumpBounds(relative=0.5))
    free = cartesian_path(scene, "arm", [target], jumps=JumpBounds(relative=50.0, revolute=1.0))

    assert (absolute.fraction, absolute.end) == (0.0, "jump")
    assert relative.end == "jump"
    assert free.fraction == 1.0


@pytest.mark.parametrize(
    ("options", "code"),
    [
        ({"group": "legs"}, ErrorCode.INVALID_GROUP_NAME),
        ({"link": "hand"}, ErrorCode.INVALID_LINK_NAME),
        ({"max_step": 0.0}, ErrorCode.INVALID_GOAL_CONSTRAINTS),
        ({"max_step": 1e-9}, ErrorCode.INVALID_GOAL_CONSTRAINTS),
        ({"poses": [Pose((np.nan, 0.0, 0.0))]}, ErrorCode.INVALID_GOAL_CONSTRAINTS),
        ({"start": np.zeros(3)}, ErrorCode.INVALID_ROBOT_STATE),
    ],
)
def test_what_is_no_path_is_refused(options: dict[str, object], code: ErrorCode) -> None:
    scene = scene_with()
    arguments: dict[str, object] = {"group": "arm", "poses": [_moved(scene, 0.0, 0.2, 0.0)], **options}

    with pytest.raises(RequestError) as caught:
        cartesian_path(scene, **arguments)  # pyright: ignore[reportArgumentType]
    assert caught.value.failure.error_code is code
