"""hector_mapping: a small house is mapped from scans alone."""

import math
import time
from typing import Any

import numpy as np
import pytest
from tests.navigation.house import RESOLUTION, house_cells, scan_fields
from tests.navigation.laser_drive import ends, relative, scans, smooth_drive

from trundle.navigation.mapping import _mapping
from trundle.navigation.mapping.hector_settings import HectorSettings
from trundle.ros import StaticTransformBroadcaster, Transform, TransformBroadcaster, TransformListener

SIZE = 256


def hector(**more: Any) -> _mapping.HectorSlam:
    defaults = {"map_resolution": RESOLUTION, "map_size": SIZE, "map_update_distance_thresh": 0.1}
    return _mapping.HectorSlam(HectorSettings(**{**defaults, **more}).slam_options())


def test_a_house_is_mapped_without_odometry() -> None:
    """The map's frame begins at the robot; errors of the pose and the walls are within a cell."""
    poses = smooth_drive()
    slam, worst, worst_yaw = hector(map_update_angle_thresh=0.2), 0.0, 0.0
    for pose, ranges in zip(poses, scans(poses), strict=True):
        slam.update(slam.pose, (0.0, 0.0), ends(ranges))
        x, y, yaw = relative(pose, poses[0])
        worst = max(worst, math.hypot(slam.pose[0] - x, slam.pose[1] - y))
        worst_yaw = max(worst_yaw, abs(math.remainder(slam.pose[2] - yaw, math.tau)))
    assert worst < 0.05
    assert math.degrees(worst_yaw) < 2.0

    rows, columns = np.nonzero(slam.cells() == 100)
    x, y = ((numbers + 0.5) * RESOLUTION - SIZE * RESOLUTION / 2.0 for numbers in (columns, rows))
    start_x, start_y, turn = poses[0]
    world_x = start_x + math.cos(turn) * x - math.sin(turn) * y
    world_y = start_y + math.sin(turn) * x + math.cos(turn) * y
    true = np.pad(house_cells() == 100, 2)
    near = np.zeros_like(true)
    for i in (-1, 0, 1):
        for j in (-1, 0, 1):
            near |= np.roll(true, (i, j), axis=(0, 1))
    inside = near[
        np.clip((world_y / RESOLUTION).astype(int) + 2, 0, true.shape[0] - 1),
        np.clip((world_x / RESOLUTION).astype(int) + 2, 0, true.shape[1] - 1),
    ]
    assert len(rows) > 250
    assert inside.mean() > 0.95


def test_the_same_scans_give_the_same_map() -> None:
    poses = smooth_drive()[:60]
    drawn: list[bytes] = []
    for _ in range(2):
        slam = hector()
        for ranges in scans(poses):
            slam.update(slam.pose, (0.0, 0.0), ends(ranges))
        drawn.append(slam.cells().tobytes())
    assert drawn[0] == drawn[1]


def test_a_map_of_known_poses_is_exact_and_a_reset_forgets_it() -> None:
    poses = smooth_drive()[::10]
    slam = hector()
    for pose, ranges in zip(poses, scans(poses, 0.0), strict=True):
        assert slam.update(relative(pose, poses[0]), (0.0, 0.0), ends(ranges), is_known=True)
        assert slam.pose == pytest.approx(relative(pose, poses[0]))
    assert slam.score > 0.7
    slam.reset()
    assert (slam.cells() == -1).all()
    assert slam.pose == (0.0, 0.0, 0.0)


def test_hostile_scans_and_options_change_nothing() -> None:
    slam = hector(map_size=3, map_multi_res_levels=9)
    wild = np.array([[math.nan, 1.0], [1e300, -1e300], [math.inf, 0.0], [0.01, 0.0]])
    for _ in range(3):
        slam.update(slam.pose, (0.0, 0.0), wild)
        slam.update((1e9, -1e9, 7.0), (1e12, 0.0), wild)
    assert slam.cells().shape == (3, 3)
    assert not slam.update((0.0, 0.0, 0.0), (0.0, 0.0), np.zeros((0, 2)))
    with pytest.raises(ValueError, match="finite"):
        slam.update((math.nan, 0.0, 0.0), (0.0, 0.0), wild)
    options = _mapping.HectorOptions()
    options.size = 10**9
    with pytest.raises(ValueError, match="size"):
        _mapping.HectorSlam(options)


def test_the_node_publishes_map_poses_and_transforms_and_obeys_commands(graph: Any) -> None:
    """The laser is 0.2 m before the robot's center; nobody publishes odometry but for a resting frame."""
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    updates = graph.listen("/poseupdate", "geometry_msgs/PoseWithCovarianceStamped")
    poses_out = graph.listen("/slam_out_pose", "geometry_msgs/PoseStamped")
    buffer = TransformListener(graph.client).buffer
    params = {"map_resolution": RESOLUTION, "map_size": SIZE, "map_pub_period": 0.05, "laser_min_dist": 0.1}
    graph.start("hector_mapping/hector_mapping", **params, map_update_distance_thresh=0.05)
    static = StaticTransformBroadcaster(graph.client)
    static.send_transform(Transform(parent="base_link", child="base_scan", translation=(0.2, 0.0, 0.0)))
    static.send_transform(Transform(parent="odom", child="base_link", translation=(3.0, 0.0, 0.0)))
    scans_in = graph.advertise("/scan", "sensor_msgs/LaserScan")
    commands = graph.advertise("/syscommand", "std_msgs/String")
    graph.until(lambda: graph.linked("/slam_out_pose") and graph.linked("/poseupdate"))
    drive = [(1.0, 1.0 + 0.04 * step, math.pi / 2) for step in range(20)]
    for number, ranges in enumerate(scans(drive)):
        scans_in.publish(scan_fields(ranges, 10**9 + number * 10**8))
        graph.until(lambda count=number + 1: len(poses_out) >= count)

    assert poses_out[-1].header.frame_id == "map"
    assert poses_out[-1].pose.position.x == pytest.approx(0.76, abs=0.04)
    graph.until(lambda: updates and updates[-1].pose.covariance[0] > 0.0)
    graph.until(lambda: buffer.can_transform("map", "odom") and buffer.can_transform("map", "scanmatcher_frame"))
    assert buffer.lookup_transform("map", "scanmatcher_frame").translation[0] == pytest.approx(0.76, abs=0.05)
    assert buffer.lookup_transform("map", "odom").translation[0] == pytest.approx(0.76 - 3.0, abs=0.05)
    graph.until(lambda: maps and 100 in np.array(maps[-1].data))
    assert maps[-1].info.origin.position.x == pytest.approx(-SIZE * RESOLUTION / 2.0)
    answer = graph.call("/dynamic_map", "nav_msgs/GetMap")
    assert answer.map.info.width == SIZE

    graph.call("/pause_mapping", "std_srvs/SetBool", data=True)
    commands.publish({"data": "reset"})
    graph.until(lambda: not (np.array(maps[-1].data) != -1).any())
    pose = {"position": {"x": 2.0, "y": 1.0}, "orientation": {"w": 1.0}}
    graph.call("/restart_mapping_with_new_pose", "hector_mapping/ResetMapping", initial_pose=pose)
    before = len(poses_out)
    scans_in.publish(scan_fields(scans(drive)[0], 10**10))
    graph.until(lambda: len(poses_out) > before)
    position = poses_out[-1].pose.position
    assert (position.x, position.y) == pytest.approx((2.0, 1.0))


def test_a_scan_waits_for_the_odometry_of_its_time(graph: Any) -> None:
    """The odometry's frame stays where it is, though odometry comes after the scans."""
    poses_out = graph.listen("/slam_out_pose", "geometry_msgs/PoseStamped")
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    buffer = TransformListener(graph.client).buffer
    params = {"map_resolution": RESOLUTION, "map_size": SIZE, "laser_min_dist": 0.1}
    graph.start("hector_mapping/hector_mapping", **params, map_update_distance_thresh=0.05)
    StaticTransformBroadcaster(graph.client).send_transform(Transform(parent="base_link", child="base_scan"))
    odometry = TransformBroadcaster(graph.client)

    def send(number: int) -> None:
        place = (3.0 + 0.04 * number, 0.0, 0.0)
        stamp_ns = 10**9 + number * 10**8
        odometry.send_transform(Transform(parent="odom", child="base_link", stamp_ns=stamp_ns, translation=place))

    scans_in = graph.advertise("/scan", "sensor_msgs/LaserScan")
    graph.until(lambda: graph.linked("/slam_out_pose") and graph.linked("/tf"))
    send(-1)
    graph.until(lambda: buffer.can_transform("odom", "base_link"))
    drive = [(1.0, 1.0 + 0.04 * step, math.pi / 2) for step in range(10)]
    for number, ranges in enumerate(scans(drive)):
        scans_in.publish(scan_fields(ranges, 10**9 + number * 10**8))
        time.sleep(0.05)  # the scan is there, and nothing comes of it
        send(number)
        graph.until(lambda count=number + 1: len(poses_out) >= count)

    graph.until(lambda: buffer.can_transform("map", "odom"))
    assert buffer.lookup_transform("map", "odom").translation[0] == pytest.approx(-3.0, abs=0.05)
    assert not [line.msg for line in log if "assumed to be at rest" in line.msg]


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [("map_size", 10**7, "map_size must be"), ("update_factor_free", 1.5, "update_factor_free must be")],
)
def test_impossible_parameters_end_it_with_a_sentence(graph: Any, name: str, value: Any, message: str) -> None:
    log = graph.listen("/rosout", "rosgraph_msgs/Log")
    assert graph.start("hector_mapping/hector_mapping", **{name: value}).result(60.0) == 1
    graph.until(lambda: any(message in str(line.msg) for line in log))
