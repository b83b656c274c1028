"""Points of ray sensors in front of a wall: the plugins of velodyne_gazebo_plugins, and gazebo_ros' block laser."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.sim.sensors import mount_sensors

_FAN = "<samples>{}</samples><min_angle>-{}</min_angle><max_angle>{}</max_angle>"
_RAYS = f"""<ray><scan><horizontal>{_FAN.format(3, 0.2, 0.2)}</horizontal>
<vertical>{_FAN.format(2, 0.1, 0.1)}</vertical></scan><range><min>0.1</min><max>9</max></range></ray>"""
_WALL = """<model name="wall"><static>1</static><link name="l"><pose>2.5 {} 0 0 0 0</pose><collision name="c">
<laser_retro>7</laser_retro><geometry><box><size>1 10 10</size></box></geometry></collision></link></model>"""
_POINT = np.dtype([("x", "<f4"), ("y", "<f4"), ("z", "<f4"), ("intensity", "<f4"), ("ring", "<u2"), ("time", "<f4")])


def _message(folder: Path, plugin: str, tags: str, *, wall_y: float = 0.0) -> Any:
    """Return the first message; with the wall at y = 5 the rays to the left and ahead hit it."""
    sensor = f"""<sensor name="s" type="ray"><update_rate>50</update_rate>{_RAYS}
<plugin name="p" filename="libgazebo_ros_{plugin}.so"><topicName>points</topicName>{tags}</plugin></sensor>"""
    node: Any = FakeNode()
    body = f'<link name="head">{BODY.format(1)}{sensor}</link>'
    sim = load(folder, body, other_models=_WALL.format(wall_y))
    sensors = mount_sensors(sim)
    assert attach_sensor_plugins(sensors, node, sim) == []
    for sensor in sensors:
        sensor.start(sim)
    sim.run(0.05)
    assert sim.report.warnings == []
    return node.published["/points"][0]


def _points(cloud: Any) -> np.ndarray[Any, Any]:
    assert [(f.name, f.offset, f.datatype) for f in cloud.fields] == [
        *((name, 4 * number, 7) for number, name in enumerate(("x", "y", "z", "intensity"))),
        ("ring", 16, 4),
        ("time", 18, 7),
    ]
    assert (cloud.point_step, cloud.row_step) == (22, 22 * cloud.width)
    return np.frombuffer(bytes(cloud.data), _POINT)


def test_velodyne_points_have_rings_in_column_order(tmp_path: Path) -> None:
    cloud = _message(tmp_path, "velodyne_laser", "")
    points = _points(cloud)

    assert (cloud.height, cloud.width, cloud.is_dense) == (1, 6, True)
    assert points["x"] == pytest.approx([2.0] * 6, abs=1e-3)
    assert points["y"] == pytest.approx(np.repeat(2.0 * np.tan([-0.2, 0.0, 0.2]), 2), abs=1e-3)
    assert points["ring"].tolist() == [0, 1] * 3
    assert points["intensity"].tolist() == [7.0] * 6
    assert points["time"].tolist() == [0.0] * 6


@pytest.mark.parametrize(
    ("tags", "width"),
    [
        ("<max_range>2.03</max_range>", 2),
        ("<min_range>2.03</min_range>", 4),
        ("<min_intensity>8</min_intensity>", 0),
        ("<min_intensity>7</min_intensity>", 6),
    ],
)
def test_a_velodyne_drops_points_out_of_range_or_intensity(tmp_path: Path, tags: str, width: int) -> None:
    """The rays ahead hit the wall at 2.01 m, the others at 2.05 m."""
    assert _message(tmp_path, "velodyne_laser", tags).width == width


def test_an_organized_cloud_has_a_row_for_each_column_of_rays(tmp_path: Path) -> None:
    tags = "<organize_cloud>true</organize_cloud><max_range>2.03</max_range>"
    cloud = _message(tmp_path, "velodyne_laser", tags)

    assert (cloud.height, cloud.width, cloud.is_dense) == (3, 2, False)
    assert np.isnan(_points(cloud)["x"]).tolist() == [True, True, False, False, True, True]


def test_velodyne_noise_is_along_the_rays(tmp_path: Path) -> None:
    points = _points(_message(tmp_path, "velodyne_laser", "<gaussianNoise>0.1</gaussianNoise>"))
    points_xyz = np.column_stack([points["x"], points["y"], points["z"]])

    assert np.linalg.norm(points_xyz, axis=1).std() > 0.03
    assert np.arctan2(points_xyz[:, 1], points_xyz[:, 0]) == pytest.approx(np.repeat([-0.2, 0.0, 0.2], 2), abs=1e-4)


def test_a_block_laser_has_a_point_for_each_ray(tmp_path: Path) -> None:
    """Rays without a hit have the maximum range, as in Gazebo."""
    cloud = _message(tmp_path, "block_laser", "", wall_y=5.0)

    ranges = [math.hypot(point.x, point.y, point.z) for point in cloud.points]
    assert [range_ > 8.9 for range_ in ranges] == [True, False, False] * 2
    (channel,) = cloud.channels
    assert list(channel.values) == [0.0, 7.0, 7.0] * 2
