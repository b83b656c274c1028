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
    """Renderer of an image with known bytes."""

    def update(self, poses: Any) -> None:
        """Ignore the poses."""

    def set_vertices(self, shape: int, vertices: Any) -> None:
        """Ignore the vertices."""

    def render(
        self, views: Sequence[tuple[Pose, Intrinsics]], *, depth: bool = False, segmentation: bool = False
    ) -> list[Picture]:
        """Return images whose bytes count up, row by row."""
        assert ([world_from_camera.position for world_from_camera, _ in views], depth, segmentation) == (
            [(0.1, 0.0, 0.2)],
            False,
            False,
        )
        shapes = [(intrinsics.height_px, intrinsics.width_px, 3) for _, intrinsics in views]
        return [Picture(np.arange(math.prod(shape), dtype=np.uint8).reshape(shape)) for shape in shapes]


def snapshot(time_ns: int) -> Snapshot:
    empty = np.zeros(0)
    poses = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    one_link: Any = SimpleNamespace(
        poses=poses, twists=np.zeros((1, 6)), axis_positions=empty, axis_velocities=empty, axis_efforts=empty
    )
    return Snapshot(time_ns=time_ns, instant=one_link, first_axes=np.zeros(0, dtype=np.intp))


@pytest.fixture
def camera_setup() -> Iterator[SimpleNamespace]:
    """Camera of a single robot, on its own graph."""
    optics = CameraOptics(width_px=4, height_px=3, horizontal_fov_rad=1.0)
    sensor = Sensor(name="my eye", type="camera", at=AT, link_from_sensor=Pose((0.1, 0.0, 0.2)), cameras=(optics,))
    link = Link(name="head", at=AT, sensors=(sensor,))
    model = Model(name="bot", at=AT, links=(link,))
    world = World(name="w", at=AT, models=(model,))
    scene = CameraScene(Simulation(world, Diagnostics()), lambda _: Ramp())
    camera = CameraSensor(SensorMount(model, link, sensor, 0, (0,)), optics, scene=scene)
    with running_graph() as running:
        node, viewer = running.node("sim"), running.node("viewer")
        topics = CameraTopics(node, StaticTransformBroadcaster(node), camera, FrameNames.from_world(world))
        running.ready(node)
        yield SimpleNamespace(camera=camera, viewer=viewer, loop=running.loop, topics=topics)
        for running_node in (viewer, node):
            running.loop.run(running_node.shutdown(), PATIENCE_S)


def test_a_camera_without_subscribers_is_disabled(camera_setup: SimpleNamespace) -> None:
    assert not camera_setup.camera.enabled()


def test_an_image_arrives_with_its_bytes_stamp_and_frame(camera_setup: SimpleNamespace) -> None:
    images: list[Any] = []
    camera_setup.viewer.subscribe("/bot/head/my_eye/image_raw", "sensor_msgs/Image", images.append)
    until(camera_setup.camera.enabled)
    camera_setup.camera.after_step(snapshot(12_034_000_000))
    until(lambda: images)
    (image,) = images
    # 12.034 s is not a multiple of /clock's period: the stamp is the image's time.
    assert (image.header.stamp.sec, image.header.stamp.nanosec) == (12, 34_000_000)
    assert image.header.frame_id == camera_setup.topics.frame
    assert image.header.frame_id.endswith("my_eye_optical")
    assert (image.height, image.width, image.encoding, image.step) == (3, 4, "rgb8", 12)
    assert bytes(image.data) == bytes(range(36))


def test_the_calibration_equals_gazebo_ros_and_has_the_images_stamp(camera_setup: SimpleNamespace) -> None:
    infos: list[Any] = []
    camera_setup.viewer.subscribe("/bot/head/my_eye/camera_info", "sensor_msgs/CameraInfo", infos.append)
    until(camera_setup.camera.enabled)
    camera_setup.camera.after_step(snapshot(1_500_000_000))
    until(lambda: infos)
    (info,) = infos
    f = 4 / (2 * math.tan(0.5))
    assert (info.header.stamp.sec, info.header.stamp.nanosec) == (1, 500_000_000)
    assert info.header.frame_id == camera_setup.topics.frame
    assert list(info.K) == pytest.approx([f, 0, 2.5, 0, f, 2.0, 0, 0, 1])
    assert list(info.P) == pytest.approx([f, 0, 2.5, 0, 0, f, 2.0, 0, 0, 0, 1, 0])
    assert list(info.D) == [0.0] * 5
    assert (info.width, info.height, info.distortion_model) == (4, 3, "plumb_bob")


def test_an_optical_frame_has_z_forward_x_right_and_y_down() -> None:
    assert CAMERA_FROM_OPTICAL.transform_vector((0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0))
    assert CAMERA_FROM_OPTICAL.transform_vector((1.0, 0.0, 0.0)) == pytest.approx((0.0, -1.0, 0.0))
    assert CAMERA_FROM_OPTICAL.transform_vector((0.0, 1.0, 0.0)) == pytest.approx((0.0, 0.0, -1.0))
