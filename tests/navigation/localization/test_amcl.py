"""The amcl node on a graph: its map, its scans, its initial poses and services."""

import math
from collections.abc import Callable
from typing import Any

import pytest
from tests.navigation.house import house_cells, house_map, map_fields, ranges_at, scan_fields

from trundle.ros import StaticTransformBroadcaster, Transform, TransformBroadcaster, TransformListener, to_nsec

POSE = "geometry_msgs/PoseWithCovarianceStamped"
WORLD = house_map()
DRIFT = (0.3, -0.2, 0.4)
"""Where the odometry began, in the map."""


class Robot:
    """A robot in the house: publishes its scans and its odometry."""

    def __init__(self, graph: Any) -> None:
        self._graph = graph
        self._scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
        self._odometry = TransformBroadcaster(graph.client)
        self.static = StaticTransformBroadcaster(graph.client)
        self.static.send_transform(Transform(parent="base_link", child="base_scan"))
        graph.until(lambda: self._odometry.has_subscribers)
        self.stamp_ns = 10**9

    def measure(self, pose: tuple[float, float, float]) -> None:
        """Publish a scan at a pose in the map, and the odometry around it."""
        dx, dy, yaw = pose[0] - DRIFT[0], pose[1] - DRIFT[1], DRIFT[2]
        translation = (math.cos(yaw) * dx + math.sin(yaw) * dy, math.cos(yaw) * dy - math.sin(yaw) * dx, 0.0)
        turn = (pose[2] - yaw) / 2.0
        self.stamp_ns += 10**8
        self._scans.publish(scan_fields(ranges_at(WORLD, pose), self.stamp_ns))
        self._odometry.send_transform(
            Transform(
                parent="odom",
                child="base_link",
                stamp_ns=self.stamp_ns,
                translation=translation,
                rotation=(math.cos(turn), 0.0, 0.0, math.sin(turn)),
            )
        )

    def measure_until(self, pose: tuple[float, float, float], condition: Callable[[], object]) -> None:
        """Measure at a pose again and again: connections of tf may come late."""

        def is_true() -> bool:
            self.measure(pose)
            return bool(condition())

        self._graph.until(is_true)


def initial_pose(x: float, y: float, yaw: float, *, frame: str = "map", deviation: float = 0.2) -> dict[str, Any]:
    covariance = [0.0] * 36
    covariance[0] = covariance[7] = covariance[35] = deviation**2
    pose = {"position": {"x": x, "y": y}, "orientation": {"z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}}
    return {"header": {"frame_id": frame}, "pose": {"pose": pose, "covariance": covariance}}


@pytest.fixture
def robot(graph) -> Robot:
    """A robot whose amcl has the map from static_map."""
    graph.client.advertise_service("static_map", "nav_msgs/GetMap", lambda _: {"map": map_fields(house_cells())})
    graph.start(
        "amcl/amcl",
        initial_pose_x=1.2,
        initial_pose_y=0.8,
        initial_cov_xx=0.04,
        initial_cov_yy=0.04,
        resample_interval=1,
    )
    return Robot(graph)


def test_a_robot_is_localized_as_it_drives_and_odom_is_placed_in_the_map(graph, robot: Robot) -> None:
    poses, clouds = graph.listen("/amcl_pose", POSE), graph.listen("/particlecloud", "geometry_msgs/PoseArray")
    status = graph.listen("/diagnostics", "diagnostic_msgs/DiagnosticArray")
    buffer = TransformListener(graph.client).buffer
    graph.until(lambda: graph.linked("/amcl_pose") and graph.linked("/particlecloud"))
    graph.until(lambda: graph.linked("/diagnostics") and graph.linked("/tf"))
    for step in range(12):
        robot.measure_until((1.0 + 0.25 * step, 1.0, 0.05 * step), lambda number=step: len(poses) > number)

    pose = poses[-1]
    assert (pose.pose.pose.position.x, pose.pose.pose.position.y) == pytest.approx((3.75, 1.0), abs=0.03)
    assert 2 * math.asin(pose.pose.pose.orientation.z) == pytest.approx(0.55, abs=math.radians(1.0))
    assert 10**9 < to_nsec(pose.header.stamp) <= robot.stamp_ns
    assert pose.header.frame_id == clouds[-1].header.frame_id == "map"
    assert 100 <= len(clouds[-1].poses) <= 5000
    assert status[0].status[0].name == "amcl: Standard deviation"
    graph.until(lambda: buffer.can_transform("map", "odom"))
    assert pose.pose.covariance[0] > 0.0
    map_from_odom = buffer.lookup_transform("map", "odom")
    assert map_from_odom.pose.position[:2] == pytest.approx(DRIFT[:2], abs=0.05)
    assert map_from_odom.pose.rpy[2] == pytest.approx(DRIFT[2], abs=math.radians(1.0))


def test_a_late_listener_sees_the_particles_where_they_are_now(graph, robot: Robot) -> None:
    """Though the robot rests, and particles that nobody sees are not published."""
    poses = graph.listen("/amcl_pose", POSE)
    graph.until(lambda: graph.linked("/amcl_pose"))
    for step in range(9):
        robot.measure_until((1.0 + 0.25 * step, 1.0, 0.0), lambda number=step: len(poses) > number)

    clouds = graph.listen("/particlecloud", "geometry_msgs/PoseArray")
    graph.until(lambda: clouds)

    assert sum(pose.position.x for pose in clouds[0].poses) / len(clouds[0].poses) == pytest.approx(3.0, abs=0.1)


def test_a_resting_robot_updates_only_on_request(graph, robot: Robot) -> None:
    poses = graph.listen("/amcl_pose", POSE)
    buffer = TransformListener(graph.client).buffer
    graph.until(lambda: graph.linked("/amcl_pose") and graph.linked("/tf"))
    robot.measure_until((1.0, 1.0, 0.0), lambda: poses and buffer.can_transform("map", "odom"))
    robot.measure((1.0, 1.0, 0.0))
    graph.until(lambda: buffer.can_transform("map", "odom", robot.stamp_ns + 10**8))  # transform_tolerance
    assert len(poses) == 1

    graph.call("/request_nomotion_update", "std_srvs/Empty")
    robot.measure_until((1.0, 1.0, 0.0), lambda: len(poses) == 2)


def test_initial_poses_move_the_particles_in_the_maps_frame_only(graph, robot: Robot) -> None:
    poses = graph.listen("/amcl_pose", POSE)
    initial = graph.advertise("/initialpose", POSE)
    graph.until(lambda: graph.linked("/amcl_pose"))
    initial.publish(initial_pose(2.0, 2.0, 0.0, frame="odom"))
    robot.measure_until((1.0, 1.0, 0.0), lambda: len(poses) == 1)
    assert poses[0].pose.pose.position.x == pytest.approx(1.0, abs=0.2)

    initial.publish(initial_pose(5.0, 1.0, 0.0))
    robot.measure_until((5.0, 1.0, 0.0), lambda: poses[-1].pose.pose.position.x == pytest.approx(5.0, abs=0.1))
    initial.publish(initial_pose(math.nan, 1.0, 0.0))
    robot.measure_until((5.5, 1.0, 0.0), lambda: poses[-1].pose.pose.position.x == pytest.approx(5.5, abs=0.1))


def test_global_localization_spreads_the_particles_over_the_free_cells(graph, robot: Robot) -> None:
    clouds = graph.listen("/particlecloud", "geometry_msgs/PoseArray")
    graph.until(lambda: graph.linked("/particlecloud"))
    robot.measure_until((1.0, 1.0, 0.0), lambda: clouds)
    config = {"ints": [{"name": "resample_interval", "value": 2}]}  # the next scan does not resample
    graph.call("/amcl/set_parameters", "dynamic_reconfigure/Reconfigure", config=config)
    graph.call("/global_localization", "std_srvs/Empty")
    count = len(clouds)
    robot.measure_until((1.0, 1.0, 0.0), lambda: len(clouds) > count)

    places = {(round(pose.position.x), round(pose.position.y)) for pose in clouds[count].poses}
    assert len(places) > 20
    assert len(clouds[count].poses) == 5000


def test_a_map_on_the_topic_is_used_and_a_later_one_unless_only_the_first_is_wanted(graph) -> None:
    maps = graph.advertise("/map", "nav_msgs/OccupancyGrid", latch=True)
    graph.start("amcl/amcl", use_map_topic=True, first_map_only=True, initial_pose_x=1.0, initial_pose_y=1.0)
    maps.publish(map_fields(house_cells()))
    robot, poses = Robot(graph), graph.listen("/amcl_pose", POSE)
    graph.until(lambda: graph.linked("/amcl_pose"))
    robot.measure_until((1.0, 1.0, 0.0), lambda: poses)
    answer = graph.call(
        "/set_map", "nav_msgs/SetMap", map=map_fields(house_cells()), initial_pose=initial_pose(5.0, 1.0, 0.0)
    )
    assert answer.success
    robot.measure_until((5.0, 1.0, 0.0), lambda: poses[-1].pose.pose.position.x == pytest.approx(5.0, abs=0.2))
    broken = {**map_fields(house_cells()), "data": [0]}
    assert not graph.call("/set_map", "nav_msgs/SetMap", map=broken, initial_pose=initial_pose(1, 1, 0)).success


def test_scans_of_a_laser_mounted_upside_down_are_read(graph, robot: Robot) -> None:
    """Its beams run clockwise as seen from above."""
    poses = graph.listen("/amcl_pose", POSE)
    robot.static.send_transform(Transform(parent="base_link", child="below", rotation=(0.0, 1.0, 0.0, 0.0)))
    graph.until(lambda: graph.linked("/amcl_pose"))
    scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
    initial = graph.advertise("/initialpose", POSE)
    initial.publish(initial_pose(1.0, 1.0, 0.4, deviation=0.1))
    robot.measure_until((1.0, 1.0, 0.3), lambda: poses)
    ranges = ranges_at(WORLD, (1.0, 1.0, 0.3))
    mirrored = scan_fields(ranges[[0, *range(len(ranges) - 1, 0, -1)]], robot.stamp_ns)
    mirrored["header"]["frame_id"] = "below"
    for count in range(len(poses), len(poses) + 10):
        graph.call("/request_nomotion_update", "std_srvs/Empty")
        scans.publish(mirrored)
        graph.until(lambda before=count: len(poses) > before)
    assert 2 * math.asin(poses[-1].pose.pose.orientation.z) == pytest.approx(0.3, abs=0.03)


def test_unknown_models_become_the_defaults_and_arguments_are_refused(graph) -> None:
    logs = graph.listen("/rosout", "rosgraph_msgs/Log")
    ended = graph.start("amcl/amcl", "--run-from-bag x.bag")
    assert ended.result(30.0) == 1
    graph.start("amcl/amcl", name="second", laser_model_type="beams", initial_pose_x=math.nan)
    graph.until(lambda: [log for log in logs if "no laser_model_type 'beams'" in log.msg])
    graph.until(lambda: [log for log in logs if "initial_pose_x" in log.msg])
