"""A RealSense in front of a wall at 2 m."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests.gazebo.plugins.plugin_world import BODY, FakeNode, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.sim.renderers import RENDERERS
from trundle.sim.sensors import mount_cameras
from trundle.sim.simulation import Simulation

FOV, WIDTH, HEIGHT = 1.0, 32, 24
CAMERA = (
    f"<camera><horizontal_fov>{FOV}</horizontal_fov><image><width>{WIDTH}</width><height>{HEIGHT}</height>"
    "<format>{}</format></image><clip><near>0.1</near><far>20</far></clip></camera>"
)
STREAMS = "".join(
    f"<{name}TopicName>{topic}/image_raw</{name}TopicName>"
    f"<{name}OpticalframeName>{name}_optical</{name}OpticalframeName>"
    for name, topic in (("color", "color"), ("infrared1", "infra1"), ("infrared2", "infra2"), ("depth", "depth"))
)
WALL = (
    '<link name="wall"><pose>2.5 0 0 0 0 0</pose><visual name="v"><geometry><box><size>1 10 10</size></box></geometry>'
    f"</visual>{BODY.format(1)}</link>"
)


def sensor(name: str, kind: str = "camera", format_: str = "RGB_INT8") -> str:
    update = "<update_rate>10</update_rate>"
    return f'<sensor name="{name}" type="{kind}">{update}{CAMERA.format(format_)}</sensor>'


def run_realsense(folder: Path, parameters: str = "") -> tuple[Simulation, FakeNode, list[str]]:
    """Return the world after 0.25 s, the node and the sensors with default topics."""
    sensors = sensor("d_color") + sensor("d_depth", "depth") + sensor("d_ired1", format_="L_INT8") + sensor("other")
    plugin = f'<plugin name="camera" filename="librealsense_gazebo_plugin.so"><prefix>d_</prefix>{STREAMS}{parameters}'
    node: Any = FakeNode()
    sim = load(folder, f'<link name="head">{BODY.format(1)}{sensors}</link>{WALL}{plugin}</plugin>', node=node)
    cameras = mount_cameras(sim, RENDERERS["cpu"])
    silent = attach_sensor_plugins(cameras, node, sim)
    for camera in cameras:
        camera.start(sim)
    sim.run(0.25)
    return sim, node, [camera.name for camera in silent]


def test_each_stream_has_its_topic_and_frame(tmp_path: Path) -> None:
    sim, node, silent = run_realsense(tmp_path, "<rangeMaxDepth>10</rangeMaxDepth>")
    color, grey = node.published["/camera/color/image_raw"][-1], node.published["/camera/infra1/image_raw"][-1]
    depth, info = node.published["/camera/depth/image_raw"][-1], node.published["/camera/depth/camera_info"][-1]

    assert (color.header.frame_id, color.encoding, color.width) == ("color_optical", "rgb8", WIDTH)
    assert (grey.header.frame_id, grey.encoding) == ("infrared1_optical", "8UC1")
    assert (depth.header.frame_id, depth.encoding) == ("depth_optical", "16UC1")
    assert np.frombuffer(bytes(depth.data), "<u2") == pytest.approx([2000] * (WIDTH * HEIGHT), abs=2)
    assert info.K[0] == pytest.approx(0.5 * WIDTH / math.tan(FOV / 2))
    assert (info.K[2], info.K[5]) == (WIDTH / 2, HEIGHT / 2)
    assert silent == ["other"]
    assert len(sim.report.warnings) == 1
    assert "no sensor 'd_ired2'; sensors here: 'd_color', 'd_depth', 'd_ired1', 'other'" in sim.report.warnings[0]


def test_depths_out_of_range_are_zero_and_nan_points(tmp_path: Path) -> None:
    points = "<pointCloud>true</pointCloud><pointCloudTopicName>depth/points</pointCloudTopicName>"
    _, node, _ = run_realsense(
        tmp_path, f"<rangeMaxDepth>1</rangeMaxDepth>{points}<pointCloudCutoff>2.5</pointCloudCutoff>"
    )

    assert not any(bytes(node.published["/camera/depth/image_raw"][-1].data))
    cloud = node.published["/camera/depth/points"][-1]
    assert (cloud.header.frame_id, cloud.width, cloud.height) == ("depth_optical", WIDTH, HEIGHT)
    assert np.isnan(np.frombuffer(bytes(cloud.data), "<f4").reshape(-1, cloud.point_step // 4)[:, :3]).all()
