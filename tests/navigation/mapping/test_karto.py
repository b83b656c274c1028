"""The slam_karto and slam_toolbox nodes on a graph."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.navigation.house import house_map, ranges_at, scan_fields

from trundle.gazebo.nodes.map_server.occupancy_grid import read_map
from trundle.navigation.mapping.karto_settings import unused_parameters
from trundle.navigation.mapping.slam_karto import SlamKartoSettings
from trundle.navigation.settings import read_settings
from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import RosError, StaticTransformBroadcaster, Transform, TransformBroadcaster, TransformListener

WORLD = house_map()
TOOLBOX = {"base_frame": "base_link", "minimum_travel_distance": 0.3, "minimum_time_interval": 0.0}


class Robot:
    """Publishes scans of the small house, and an odometry that is 4 % too long, from (1, 1) on."""

    def __init__(self, graph: Any) -> None:
        self.graph = graph
        self.buffer = TransformListener(graph.client).buffer
        self._static, self._odometry = StaticTransformBroadcaster(graph.client), TransformBroadcaster(graph.client)
        self._static.send_transform(Transform(parent="base_link", child="base_scan"))
        self._scans = graph.advertise("/scan", "sensor_msgs/LaserScan")
        self._stamp_ns = 10**9

    def scan(self, x: float, **changes: Any) -> None:
        """Publish a scan at (x, 1) and its odometry."""
        self._stamp_ns += 10**8
        odometry = (1.0 + 1.04 * (x - 1.0), 1.0, 0.0)
        self._odometry.send_transform(
            Transform(parent="odom", child="base_link", stamp_ns=self._stamp_ns, translation=odometry)
        )
        self._scans.publish({**scan_fields(ranges_at(WORLD, (x, 1.0, 0.0)), self._stamp_ns), **changes})

    def drive(self, start: float, end: float, condition: Any) -> None:
        """Drive in steps of 0.1 m, then stand until a condition holds."""
        steps = iter(np.arange(start, end, 0.1).tolist())

        def is_true() -> bool:
            x = next(steps, None)
            self.scan(end if x is None else x)
            return x is None and bool(condition())

        self.graph.until(is_true)


def cells_of(message: Any) -> Any:
    return np.array(message.data, dtype=np.int8).reshape(message.info.height, message.info.width)


def wall_at(message: Any, x: float) -> bool:
    """Tell whether the map has a wall at (x, 1)."""
    info = message.info
    row = round((1.0 - info.origin.position.y) / info.resolution)
    column = math.floor((x - info.origin.position.x) / info.resolution)
    return 100 in cells_of(message)[row, column - 1 : column + 2]


def test_slam_karto_maps_and_corrects_the_odometry(graph) -> None:
    """The map's frame is the odometry's at first; in it, the robot starts at (1, 1)."""
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    metadata = graph.listen("/map_metadata", "nav_msgs/MapMetaData")
    markers = graph.listen("/visualization_marker_array", "visualization_msgs/MarkerArray")
    graph.start("slam_karto/slam_karto", map_update_interval=0.0, vis_publish_period=0.05, solver_type="SPASolver")
    robot = Robot(graph)

    robot.drive(1.0, 1.0, lambda: maps)
    robot.drive(1.0, 2.0, lambda: len(maps) >= 2 and metadata and markers)

    def offset() -> tuple[float, ...]:
        return (
            robot.buffer.lookup_transform("map", "odom").pose.position
            if robot.buffer.can_transform("map", "odom")
            else ()
        )

    graph.until(lambda: offset() == pytest.approx((-0.04, 0.0, 0.0), abs=0.02))
    assert maps[-1].header.frame_id == "map"
    assert set(np.unique(cells_of(maps[-1]))) == {-1, 0, 100}
    assert wall_at(maps[-1], 3.525)
    assert not wall_at(maps[-1], 2.5)
    assert graph.call("/dynamic_map", "nav_msgs/GetMap").map.info.width == maps[-1].info.width
    assert [len(marker.points) > 1 for marker in markers[-1].markers] == [True, True]


def test_hostile_scans_are_skipped_with_a_sentence(graph) -> None:
    """A good one is mapped after them."""
    logs = graph.listen("/rosout", "rosgraph_msgs/Log")
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    graph.start("slam_karto/slam_karto", map_update_interval=0.0)
    robot = Robot(graph)
    nan = math.nan

    def is_told() -> bool:
        for change in ({"ranges": []}, {"angle_increment": nan}, {"ranges": [nan] * 360}, {"ranges": [0.0] * 100_001}):
            robot.scan(1.0, **change)
        return any("a scan is skipped: it has no beams" in log.msg for log in logs)

    graph.until(is_told)
    assert not maps
    robot.drive(1.0, 1.0, lambda: maps)


def test_slam_toolbox_saves_its_map_and_graph_and_goes_on_from_it(graph, tmp_path: Path) -> None:
    maps = graph.listen("/map", "nav_msgs/OccupancyGrid")
    poses = graph.listen("/slam_toolbox/pose", "geometry_msgs/PoseWithCovarianceStamped")
    graph.start("slam_toolbox/async_slam_toolbox_node", name="/slam_toolbox", map_update_interval=0.0, **TOOLBOX)
    robot = Robot(graph)

    robot.drive(1.0, 1.0, lambda: maps)
    robot.drive(1.0, 2.5, lambda: len(maps) >= 2 and poses and poses[-1].pose.pose.position.x > 2.3)
    graph.call("/slam_toolbox/save_map", "slam_toolbox_msgs/SaveMap", name={"data": str(tmp_path / "house")})
    graph.call("/slam_toolbox/serialize_map", "slam_toolbox_msgs/SerializePoseGraph", filename=str(tmp_path / "graph"))

    assert 0.0 < poses[-1].pose.covariance[0] < 0.01
    assert (read_map(tmp_path / "house.yaml").cells == 100).sum() > 100
    assert (tmp_path / "graph.posegraph").is_file()
    answer = graph.call("/slam_toolbox/pause_new_measurements", "slam_toolbox_msgs/Pause")
    assert answer.status

    graph.stop()
    del maps[:]
    kind = "slam_toolbox_msgs/DeserializePoseGraph"
    graph.start("slam_toolbox/sync_slam_toolbox_node", name="/again", **TOOLBOX)
    start = {"x": 2.6, "y": 1.1, "theta": 0.1}
    graph.call("/again/deserialize_map", kind, filename=str(tmp_path / "graph"), match_type=2, initial_pose=start)
    graph.until(lambda: maps)
    assert wall_at(maps[-1], 3.525)
    later = graph.listen("/again/pose", "geometry_msgs/PoseWithCovarianceStamped")
    robot.drive(2.5, 2.5, lambda: later)
    assert later[0].pose.pose.position.x == pytest.approx(2.5, abs=0.04)
    assert later[0].pose.pose.position.y == pytest.approx(1.0, abs=0.04)


def test_a_file_that_is_no_graph_is_refused_in_a_sentence(graph, tmp_path: Path) -> None:
    logs = graph.listen("/rosout", "rosgraph_msgs/Log")
    (tmp_path / "other.posegraph").write_bytes(b"serialization::archive 17")
    graph.start("slam_toolbox/async_slam_toolbox_node", name="/slam_toolbox", map_file_name=str(tmp_path / "other"))
    kind = "slam_toolbox_msgs/DeserializePoseGraph"

    with pytest.raises(RosError):
        graph.call("/slam_toolbox/deserialize_map", kind, filename=str(tmp_path / "none"))

    graph.until(lambda: any("of the original slam_toolbox cannot be read" in log.msg for log in logs))


def test_localization_finds_the_robot_in_a_saved_graph_that_it_does_not_change(graph, tmp_path: Path) -> None:
    poses = graph.listen("/slam_toolbox/pose", "geometry_msgs/PoseWithCovarianceStamped")
    graph.start("slam_toolbox/sync_slam_toolbox_node", name="/slam_toolbox", **TOOLBOX)
    robot = Robot(graph)
    robot.drive(1.0, 1.0, lambda: poses)
    robot.drive(1.0, 2.5, lambda: poses[-1].pose.pose.position.x > 2.3)
    file = str(tmp_path / "graph")
    graph.call("/slam_toolbox/serialize_map", "slam_toolbox_msgs/SerializePoseGraph", filename=file)
    graph.stop()
    del poses[:]

    graph.start(
        "slam_toolbox/localization_slam_toolbox_node",
        name="/slam_toolbox",
        map_file_name=file,
        map_start_pose=[1.3, 0.8, 0.1],
        **TOOLBOX,
    )
    robot.drive(1.0, 1.0, lambda: poses)

    assert poses[0].pose.pose.position.x == pytest.approx(1.0, abs=0.05)
    assert poses[0].pose.pose.position.y == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"resolution": 0.0}, "resolution must be ≥ 0.001"),
        ({"loop_search_space_dimension": 1e9}, "must be ≤ 40"),
        ({"coarse_angle_resolution": -1.0}, "must be ≥ 0.001"),
        ({"scan_buffer_size": 0}, "must be ≥ 1"),
        ({"map_update_interval": math.inf}, "map_update_interval"),
    ],
)
def test_impossible_parameters_are_refused_in_a_sentence(values: dict[str, Any], message: str) -> None:
    with pytest.raises(ParamError, match=message):
        read_settings(SlamKartoSettings, RosParameters(values, "/slam_karto"))


def test_parameters_without_effect_are_named() -> None:
    parameters = RosParameters({"solver_plugin": "CeresSolver", "resolution": 0.1}, "/slam_toolbox")

    assert unused_parameters(parameters, {"resolution"}) == "parameters without effect here: solver_plugin"
