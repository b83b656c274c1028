"""Images and camera_info as ROS nodes receive them."""

import math
from collections.abc import Iterator, Sequence
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.graphs import PATIENCE_S, running_graph, until

from trundle.base.diagnostics import Diagnostics, Source
from trundle.robots.model import CameraOptics, Link, Model, Sensor, World
from trundle.ros import StaticTransformBroadcaster
from trundle.ros.bridge import CameraTopics, FrameNames
from trundle.ros.bridge.camera_topics import CAMERA_FROM_OPTICAL
from trundle.sim.render import Intrinsics, Picture
from trundle.sim.sensors import CameraScene, CameraSensor, SensorMount
from trundle.sim.simulation import Simulation, Snapshot
from trundle.spatial import Pose

AT = Source("robot.sdf", 1)


class Ramp:
    """Renderer of a picture with known bytes."""

    def update(self, poses: Any) -> None:
        """Ignore the poses."""

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """Count up, row by row."""
        assert ([eye.position for eye, _ in views], depth, segmentation) == ([(0.1, 0.0, 0.2)], False, False)
        shapes = [(lens.height_px, lens.width_px, 3) for _, lens in views]
        return [Picture(np.arange(math.prod(shape), dtype=np.uint8).reshape(shape)) for shape in shapes]


def snapshot(time_ns: int) -> Snapshot:
    none = np.zeros(0)
    poses = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    one_link: Any = SimpleNamespace(
        poses=poses, twists=np.zeros((1, 6)), axis_positions=none, axis_velocities=none, axis_efforts=none
    )
    return Snapshot(time_ns=time_ns, instant=one_link, first_axes=np.zeros(0, dtype=np.intp))


@pytest.fixture
def stage() -> Iterator[SimpleNamespace]:
    """Camera on a single robot, on a graph of its own."""
    optics = CameraOptics(width_px=4, height_px=3, horizontal_fov_rad=1.0)
    sensor = Sensor(name="my eye", type="camera", at=AT, link_from_sensor=Pose((0.1, 0.0, 0.2)), cameras=(optics,))
    link = Link(name="head", at=AT, sensors=(sensor,))
    model = Model(name="bot", at=AT, links=(link,))
    world = World(name="w", at=AT, models=(model,))
    scenery = CameraScene(Simulation(world, Diagnostics()), lambda _: Ramp())
    camera = CameraSensor(SensorMount(model, link, sensor, 0, (0,)), optics, scene=scenery)
    with running_graph() as running:
        node, viewer = running.node("sim"), running.node("viewer")
        topics = CameraTopics(node, StaticTransformBroadcaster(node), camera, FrameNames.from_world(world))
        running.ready(node)
        yield SimpleNamespace(camera=camera, viewer=viewer, loop=running.loop, topics=topics)
        for one in (viewer, node):
            running.loop.run(one.shutdown(), PATIENCE_S)


def test_a_camera_without_subscribers_is_not_wanted(stage: SimpleNamespace) -> None:
    assert not stage.camera.enabled()


def test_a_picture_arrives_with_its_bytes_its_instant_and_its_frame(stage: SimpleNamespace) -> None:
    images: list[Any] = []
    stage.viewer.subscribe("/bot/head/my_eye/image_raw", "sensor_msgs/Image", images.append)
    until(stage.camera.enabled)
    stage.camera.after_step(snapshot(12_034_000_000))
    until(lambda: images)
    (image,) = images
    # 12.034 s is not a multiple of /clock's period: the stamp is the picture's own time.
    assert (image.header.stamp.sec, image.header.stamp.nanosec) == (12, 34_000_000)
    assert image.header.frame_id == stage.topics.frame
    assert image.header.frame_id.endswith("my_eye_optical")
    assert (image.height, image.width, image.encoding, image.step) == (3, 4, "rgb8", 12)
    assert bytes(image.data) == bytes(range(36))


def test_the_calibration_is_that_of_gazebo_ros_and_comes_with_the_picture(stage: SimpleNamespace) -> None:
    infos: list[Any] = []
    stage.viewer.subscribe("/bot/head/my_eye/camera_info", "sensor_msgs/CameraInfo", infos.append)
    until(stage.camera.enabled)
    stage.camera.after_step(snapshot(1_500_000_000))
    until(lambda: infos)
    (info,) = infos
    f = 4 / (2 * math.tan(0.5))
    assert (info.header.stamp.sec, info.header.stamp.nanosec) == (1, 500_000_000)
    assert info.header.frame_id == stage.topics.frame
    assert list(info.K) == pytest.approx([f, 0, 2.5, 0, f, 2.0, 0, 0, 1])
    assert list(info.P) == pytest.approx([f, 0, 2.5, 0, 0, f, 2.0, 0, 0, 0, 1, 0])
    assert list(info.D) == [0.0] * 5
    assert (info.width, info.height, info.distortion_model) == (4, 3, "plumb_bob")


def test_an_optical_frame_has_z_ahead_x_to_the_right_and_y_down() -> None:
    assert CAMERA_FROM_OPTICAL.transform_vector((0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0))
    assert CAMERA_FROM_OPTICAL.transform_vector((1.0, 0.0, 0.0)) == pytest.approx((0.0, -1.0, 0.0))
    assert CAMERA_FROM_OPTICAL.transform_vector((0.0, 1.0, 0.0)) == pytest.approx((0.0, 0.0, -1.0))
