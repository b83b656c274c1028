"""The interactive marker that drives a robot, and robot_pose_publisher."""

import math
from typing import Any

import pytest

from trundle.ros import StaticTransformBroadcaster, Transform

FEEDBACK = "visualization_msgs/InteractiveMarkerFeedback"


def drag(x: float, y: float, yaw: float, *, name: str = "robot_twist_marker") -> dict[str, Any]:
    orientation = {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    return {"marker_name": name, "pose": {"position": {"x": x, "y": y}, "orientation": orientation}}


def test_a_dragged_marker_drives_within_limits_and_snaps_back(graph) -> None:
    full = graph.listen("/twist_marker_server/update_full", "visualization_msgs/InteractiveMarkerInit")
    updates = graph.listen("/twist_marker_server/update", "visualization_msgs/InteractiveMarkerUpdate")
    commands = graph.listen("/twist_marker_server/cmd_vel", "geometry_msgs/Twist")
    graph.start(
        "interactive_marker_twist_server/marker_server",
        linear_scale={"x": 2.0, "y": 1.0},
        max_positive_linear_velocity={"x": 1.5, "y": 1.0},
        max_negative_linear_velocity={"x": -1.0, "y": -0.5},
    )
    graph.until(lambda: full and updates and graph.linked("/twist_marker_server/cmd_vel"))
    (marker,) = full[0].markers
    assert (marker.header.frame_id, marker.name) == ("base_link", "robot_twist_marker")
    assert [control.name for control in marker.controls] == ["rotate_z", "move_x", "move_y"]

    feedback = graph.advertise("/twist_marker_server/feedback", FEEDBACK)
    feedback.publish(drag(1.0, 0.0, 0.0, name="another"))
    feedback.publish(drag(0.5, -3.0, 0.5))
    graph.until(lambda: len(commands) == 1)
    feedback.publish(drag(9.0, 0.0, -2.0))

    graph.until(lambda: len(commands) == 2)
    first, second = commands
    assert (first.linear.x, first.linear.y, first.angular.z) == pytest.approx((1.0, -0.5, 1.1))
    assert (second.linear.x, second.angular.z) == pytest.approx((1.5, -2.2))
    graph.until(lambda: [update for update in updates if update.poses])
    back = next(update for update in updates if update.poses)
    assert (back.seq_num, back.poses[0].name, back.poses[0].pose.position.x) == (1, "robot_twist_marker", 0.0)


@pytest.mark.parametrize("is_stamped", [False, True])
def test_the_robot_pose_is_published_when_the_map_transform_exists(graph, is_stamped: bool) -> None:
    poses = graph.listen("/robot_pose", f"geometry_msgs/Pose{'Stamped' if is_stamped else ''}")
    graph.start("robot_pose_publisher/robot_pose_publisher", is_stamped=is_stamped, map_frame="/map")
    graph.until(lambda: graph.linked("/robot_pose"))
    assert poses == []
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="map", child="base_link", translation=(1.0, 2.0, 0.0)))

    graph.until(lambda: poses)
    pose = poses[0].pose if is_stamped else poses[0]
    assert (pose.position.x, pose.position.y, pose.orientation.w) == (1.0, 2.0, 1.0)
