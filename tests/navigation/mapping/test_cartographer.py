"""cartographer_node and cartographer_occupancy_grid_node on a graph."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.navigation.house import scan_fields
from tests.navigation.laser_drive import relative, scans, smooth_drive

from trundle.navigation.mapping.submap_textures import pack_texture, paint, unpack_texture
from trundle.ros import (
    Messages,
    StaticTransformBroadcaster,
    Transform,
    TransformBroadcaster,
    TransformListener,
)
from trundle.spatial import Pose

OPTIONS = """
include "map_builder.lua"
include "trajectory_builder.lua"
options = {{
  map_builder = MAP_BUILDER, trajectory_builder = TRAJECTORY_BUILDER, map_frame = "map", odom_frame = "odom",
  tracking_frame = "base_link", num_laser_scans = 1,
  submap_publish_period_sec = 0.01, {options}
}}
MAP_BUILDER.use_trajectory_builder_2d = true
TRAJECTORY_BUILDER_2D.use_imu_data = false
return options
"""
DRIVE = smooth_drive(step_m=0.08)[:50]


def start(graph: Any, folder: Path, options: str) -> TransformListener:
    (folder / "robot.lua").write_text(OPTIONS.format(options=options))
    graph.start(
        "cartographer_ros/cartographer_node",
        f"-configuration_directory {folder} -configuration_basename robot.lua",
    )
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="base_scan"))
    return TransformListener(graph.client)


def test_a_house_is_mapped_without_odometry(graph, tmp_path: Path) -> None:
    """The node publishes both frames; the grid is that of its submap, and has its walls."""
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    tracked = graph.listen("/tracked_pose", "geometry_msgs/PoseStamped")
    options = 'published_frame = "base_link", provide_odom_frame = true, publish_tracked_pose = true'
    buffer = start(graph, tmp_path, options).buffer
    graph.start("cartographer_ros/cartographer_occupancy_grid_node", "-resolution 0.1 -publish_period_sec=0.1")
    topic = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/tracked_pose"))
    for number, ranges in enumerate(scans(DRIVE), start=1):
        topic.publish(scan_fields(ranges, 10**9 + number * 10**8))
        graph.until(lambda number=number: len(tracked) == number)

    end, position = relative(DRIVE[-1], DRIVE[0]), tracked[-1].pose.position
    assert (position.x, position.y) == pytest.approx(end[:2], abs=0.06)
    graph.until(lambda: maps and 100 in maps[-1].data)
    graph.until(lambda: buffer.can_transform("map", "odom") and buffer.can_transform("odom", "base_link"))
    trajectory = graph.call("/trajectory_query", "cartographer_ros_msgs/TrajectoryQuery").trajectory
    assert len(trajectory) > 5
    info = maps[-1].info
    assert info.resolution == pytest.approx(0.1)
    assert info.width * info.resolution == pytest.approx(4.0, abs=0.5)  # across: the robot looked along y
    kind = "cartographer_ros_msgs/SubmapQuery"
    assert graph.call("/submap_query", kind, trajectory_id=3).status.code == 5
    finished = graph.call("/finish_trajectory", "cartographer_ros_msgs/FinishTrajectory")
    assert (finished.status.code, finished.status.message) == (0, "trajectory 0 is finished")
    state = graph.call("/write_state", "cartographer_ros_msgs/WriteState", filename=str(tmp_path / "state"))
    assert state.status.code == 0
    assert (tmp_path / "state.posegraph").is_file()


def test_the_map_is_the_parent_of_an_odometry_frame_that_others_publish(graph, tmp_path: Path) -> None:
    """use_odometry; published_frame is odom: map → odom takes the odometry's error."""
    buffer = start(graph, tmp_path, 'published_frame = "odom", provide_odom_frame = false, use_odometry = true').buffer
    scan, odometry = graph.advertise("/scan", "sensor_msgs/LaserScan"), graph.advertise("/odom", "nav_msgs/Odometry")
    broadcaster = TransformBroadcaster(graph.client)
    stamp_ns = 10**9
    x = 0.0

    def is_corrected() -> bool:
        nonlocal stamp_ns, x
        stamp_ns += 10**8
        x = min(x + 0.1, 1.5) if buffer.can_transform("map", "odom") else 0.0
        ranges = scans([(1.0 + x, 1.0, 0.0)])[0]
        measured = 1.06 * x
        broadcaster.send_transform(
            Transform(parent="odom", child="base_link", stamp_ns=stamp_ns, translation=(measured, 0.0, 0.0))
        )
        pose = {"position": {"x": measured}, "orientation": {"w": 1.0}}
        header = {"stamp": stamp_ns, "frame_id": "odom"}
        odometry.publish({"header": header, "child_frame_id": "base_link", "pose": {"pose": pose}})
        scan.publish(scan_fields(ranges, stamp_ns))
        if x < 1.5:
            return False
        return abs(buffer.lookup_transform("map", "odom").pose.position[0] + 0.09) < 0.04

    graph.until(is_corrected)


def test_a_wrong_command_line_ends_in_a_sentence(graph, tmp_path: Path) -> None:
    logs = graph.listen("/rosout", "rosgraph_msgs/Log")
    (tmp_path / "robot.lua").write_text("return")
    folder = f"-configuration_directory {tmp_path} -configuration_basename"

    for arguments in ("", f"{folder} none.lua", f"{folder} robot.lua"):
        assert graph.start("cartographer_ros/cartographer_node", arguments).result(30.0) == 1
    assert graph.start("cartographer_ros/cartographer_occupancy_grid_node", "-resolution 0").result(30.0) == 1
    graph.until(lambda: len([log for log in logs if log.level == 16]) == 4)


def test_a_picture_of_a_submap_becomes_the_same_grid(messages: Messages) -> None:
    """Turned by 90°, its rows become columns."""
    cells = np.full((6, 4), -1, dtype=np.int8)
    cells[1:5, 1] = 0
    cells[5, 2] = 100
    info = {"width": 4, "height": 6, "resolution": 0.5, "origin": {"position": {"x": -1.0, "y": 2.0}}}
    kind = "cartographer_ros_msgs/SubmapTexture"
    fields = pack_texture({"info": info, "data": cells.reshape(-1)})
    texture = unpack_texture(messages.deserialize(messages.serialize(messages.new(kind, fields)), kind))

    same = paint([(Pose(), texture)], 0.5)
    turned = paint([(Pose((0.0, 0.0, 0.0), (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))), texture)], 0.5)

    assert same is not None
    assert (same["info"]["width"], same["info"]["origin"]["position"]) == (4, {"x": -1.0, "y": 2.0})
    np.testing.assert_array_equal(same["data"].reshape(6, 4), cells)
    assert turned is not None
    np.testing.assert_array_equal(turned["data"].reshape(4, 6), cells.T[:, ::-1])


@pytest.mark.parametrize("change", [{"width": 10**9}, {"width": 5}, {"resolution": 0.0}, {"cells": b"no gzip"}])
def test_a_damaged_picture_is_refused(messages: Messages, change: dict[str, Any]) -> None:
    kind = "cartographer_ros_msgs/SubmapTexture"
    info = {"width": 2, "height": 2, "resolution": 0.5, "origin": {"position": {"x": 0.0, "y": 0.0}}}
    fields = {**pack_texture({"info": info, "data": np.zeros(4, dtype=np.int8)}), **change}
    with pytest.raises(ValueError, match="a picture"):
        unpack_texture(messages.deserialize(messages.serialize(messages.new(kind, fields)), kind))
