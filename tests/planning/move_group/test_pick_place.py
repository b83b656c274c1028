"""The actions pickup and place, by fake controllers."""

import math
from typing import Any

from tests.planning.move_group.arm_graph import add, box, send, start_arm

_FINGERS = ["left_finger_joint"]
_NO_OBJECT, _TIMED_OUT = -19, -6


def _posture(position: float) -> dict[str, Any]:
    return {"joint_names": _FINGERS, "points": [{"positions": [position], "time_from_start": 200_000_000}]}


def _way(z: float) -> dict[str, Any]:
    direction = {"header": {"frame_id": "base_link"}, "vector": {"z": z}}
    return {"direction": direction, "min_distance": 0.05, "desired_distance": 0.1}


def _down(x: float, y: float, z: float, yaw: float = 0.0) -> dict[str, Any]:
    """Return a pose of the tool that points down."""
    c, s = math.cos(yaw / 2), math.sin(yaw / 2)
    pose = {"position": {"x": x, "y": y, "z": z}, "orientation": {"x": c, "y": s, "z": 0.0, "w": 0.0}}
    return {"header": {"frame_id": "base_link"}, "pose": pose}


def _grasp(x: float, y: float, z: float) -> dict[str, Any]:
    return {
        "grasp_pose": _down(x, y, z),
        "pre_grasp_posture": _posture(0.04),
        "grasp_posture": _posture(0.012),
        "pre_grasp_approach": _way(-1.0),
        "post_grasp_retreat": _way(1.0),
    }


def test_an_object_is_picked_from_a_table_and_placed_elsewhere(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("table", 0.45, 0.0, 0.1, (0.3, 0.9, 0.2)), box("block", 0.45, 0.1, 0.25, (0.04, 0.04, 0.1)))
    pick = {
        "target_name": "block",
        "group_name": "arm",
        "end_effector": "gripper",
        "possible_grasps": [_grasp(0.45, 0.1, 0.2), _grasp(0.45, 0.1, 0.35)],  # the first is inside the table
        "support_surface_name": "table",
        "allowed_planning_time": 20.0,
    }

    picked = send(graph, "pickup", "moveit_msgs/Pickup", pick)

    assert picked.result.error_code.val == 1, picked.status.text
    assert list(picked.result.trajectory_descriptions) == ["plan", "pre_grasp", "approach", "grasp", "retreat"]
    assert picked.result.grasp.grasp_pose.pose.position.z == 0.35
    scene = graph.call("/get_planning_scene", "moveit_msgs/GetPlanningScene", components={"components": 4}).scene
    assert [one.object.id for one in scene.robot_state.attached_collision_objects] == ["block"]

    target = {"header": {"frame_id": "base_link"}, "pose": {"position": {"x": 0.45, "y": -0.2, "z": 0.255}}}
    place = {
        "group_name": "arm",
        "attached_object_name": "block",
        "place_locations": [
            {
                "place_pose": target,
                "post_place_posture": _posture(0.04),
                "pre_place_approach": _way(-1.0),
                "post_place_retreat": _way(1.0),
            }
        ],
        "support_surface_name": "table",
        "allowed_planning_time": 20.0,
    }
    placed = send(graph, "place", "moveit_msgs/Place", place)

    assert placed.result.error_code.val == 1, placed.status.text
    scene = graph.call("/get_planning_scene", "moveit_msgs/GetPlanningScene", components={"components": 20}).scene
    assert not scene.robot_state.attached_collision_objects
    (block,) = [item for item in scene.world.collision_objects if item.id == "block"]
    position = block.pose.position
    assert math.dist((position.x, position.y, position.z), (0.45, -0.2, 0.255)) < 1e-3


def test_what_is_not_there_cannot_be_picked(graph: Any) -> None:
    start_arm(graph)

    result = send(graph, "pickup", "moveit_msgs/Pickup", {"target_name": "vase", "group_name": "arm"})

    assert result.result.error_code.val == _NO_OBJECT
    assert "The object 'vase' to pick is not in the planning scene; objects: none" in result.status.text


def test_a_pick_that_runs_out_of_time_says_how_far_it_came(graph: Any) -> None:
    start_arm(graph)
    add(graph, box("table", 0.45, 0.0, 0.1, (0.3, 0.9, 0.2)), box("block", 0.45, 0.1, 0.25, (0.04, 0.04, 0.1)))
    grasps = [_grasp(0.45, 0.1, 0.2)] * 60
    asked = {"target_name": "block", "group_name": "arm", "end_effector": "gripper", "possible_grasps": grasps}

    result = send(graph, "pickup", "moveit_msgs/Pickup", {**asked, "allowed_planning_time": 0.2})

    assert result.result.error_code.val == _TIMED_OUT
    assert "of 60 ways were tried in 0.2 s; the last: the hand does not get there" in result.status.text
