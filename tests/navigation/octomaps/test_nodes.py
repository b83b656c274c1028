"""octomap_server and octomap_saver on a graph."""

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.ros import StaticTransformBroadcaster, Transform

_POINTS = "sensor_msgs/PointCloud2"


def _cloud(points: NDArray[np.float64]) -> dict[str, Any]:
    data = np.pad(points, ((0, 0), (0, 1))).astype("<f4")
    return {
        "header": {"frame_id": "velodyne", "stamp": 10**9},
        "height": 1,
        "width": len(data),
        "fields": [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyz")],
        "point_step": 16,
        "row_step": 16 * len(data),
        "data": np.frombuffer(data.tobytes(), np.uint8),
    }


def _room() -> NDArray[np.float64]:
    """Return the points of 16 rings of a lidar 0.5 m above the floor, in a room of 6 × 6 m and 2.5 m."""
    azimuths, elevations = np.radians(np.arange(0.0, 360.0, 0.5)), np.radians(np.linspace(-15.0, 15.0, 16))
    angle, slope = (values.ravel() for values in np.meshgrid(azimuths, elevations))
    rays = np.column_stack([np.cos(slope) * np.cos(angle), np.cos(slope) * np.sin(angle), np.sin(slope)])
    with np.errstate(divide="ignore"):
        reach = np.minimum(3.0 / np.abs(rays[:, :2]).max(axis=1), np.where(rays[:, 2] < 0.0, -0.5 / rays[:, 2], 9.0))
    points = rays * reach[:, None]
    points[0] = np.nan
    return points


def test_a_lidar_of_16_rings_becomes_a_map(graph: Any, tmp_path: Path) -> None:
    """The walls are occupied, the floor is free, with filter_ground; the map is saved and loaded again."""
    maps = graph.listen("/projected_map", "nav_msgs/OccupancyGrid")
    markers = graph.listen("/occupied_cells_vis_array", "visualization_msgs/MarkerArray")
    centers = graph.listen("/octomap_point_cloud_centers", _POINTS)
    settings = {
        "resolution": 0.1,
        "filter_ground": True,
        "base_frame_id": "base_link",
        "min_x_size": 8.0,
        "min_y_size": 2.0,
    }
    graph.start("octomap_server/octomap_server_node", name="octomap_server", **settings)
    broadcaster = StaticTransformBroadcaster(graph.client)
    broadcaster.send_transform(Transform(parent="map", child="base_link", translation=(1.03, 0.52, 0.0)))
    broadcaster.send_transform(Transform(parent="base_link", child="velodyne", translation=(0.0, 0.0, 0.5)))
    clouds = graph.advertise("/cloud_in", _POINTS)
    graph.until(lambda: len(maps) == 1)
    clouds.publish(_cloud(_room()))

    graph.until(lambda: len(maps) == 2)
    grid = maps[1]
    cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)
    x, y = grid.info.origin.position.x, grid.info.origin.position.y

    def at(place_x: float, place_y: float) -> int:
        return int(cells[int((place_y - y) / 0.1), int((place_x - x) / 0.1)])

    assert grid.header.frame_id == "map"
    assert grid.info.width * 0.1 >= 8.0
    assert [at(4.03, 0.5), at(-1.97, 0.5), at(1.0, 3.52)] == [100] * 3
    assert [at(1.03, 0.52), at(3.0, 2.0), at(0.0, -1.0)] == [0] * 3  # the lidar's own place, and the floor
    assert at(-2.5, 0.5) == -1
    graph.until(lambda: len(markers) == 2 and len(centers) == 2)
    count = sum(len(marker.points) for marker in markers[1].markers)
    assert count == centers[1].width > 300

    file = tmp_path / "room.bt"
    assert graph.start("octomap_server/octomap_saver", str(file)).result(60.0) == 0
    assert graph.start("octomap_server/octomap_saver", f"-f {tmp_path / 'room.ot'}").result(60.0) == 0
    assert graph.start("octomap_server/octomap_saver", f"-f {file}", name="wrong").result(60.0) == 1
    box = {"min": {"x": -5.0, "y": -5.0, "z": -1.0}, "max": {"x": 5.0, "y": 5.0, "z": 3.0}}
    graph.call("/octomap_server/clear_bbx", "octomap_msgs/BoundingBoxQuery", **box)
    graph.until(lambda: len(maps) == 3)
    assert max(maps[2].data) == 0
    graph.call("/octomap_server/reset", "std_srvs/Empty")
    graph.until(lambda: len(maps) == 4)
    assert set(maps[3].data) == {-1}

    served = graph.listen("/static/projected_map", "nav_msgs/OccupancyGrid")
    graph.start("octomap_server/octomap_server_static", f"{file} projected_map:=/static/projected_map", name="static")
    graph.until(lambda: served)
    assert _occupied(served[0]) == _occupied(grid)


def _occupied(grid: Any) -> set[tuple[int, int]]:
    """Return the occupied cells of a map, counted from the frame's origin."""
    cells = np.array(grid.data).reshape(grid.info.height, grid.info.width)
    rows, columns = np.nonzero(cells == 100)
    x, y = (round(value / 0.1) for value in (grid.info.origin.position.x, grid.info.origin.position.y))
    return set(zip((columns + x).tolist(), (rows + y).tolist(), strict=True))


def test_files_and_parameters_that_are_wrong_end_the_node(graph: Any, tmp_path: Path) -> None:
    file = tmp_path / "broken.bt"
    file.write_bytes(b"P5")
    log = graph.listen("/rosout", "rosgraph_msgs/Log")

    assert graph.start("octomap_server/octomap_server_node", str(file), name="broken").result(60.0) == 1
    model = {"sensor_model": {"hit": 0.3}}
    assert graph.start("octomap_server/octomap_server_node", name="odd", **model).result(60.0) == 1

    graph.until(lambda: any("not a file of octomap" in line.msg for line in log))
    graph.until(lambda: any("expected 0 < miss, min < 0.5 < hit, max < 1" in line.msg for line in log))
