"""Every camera type, from the file to the messages."""

import math
from typing import Any

import numpy as np
import pytest

IMAGE, INFO = "sensor_msgs/Image", "sensor_msgs/CameraInfo"
F = 64 / (2 * math.tan(0.5))
"""Focal length of the cameras [px]."""


def camera_robot(type_: str, *, inside: str = "", more: str = "", cameras: str = "") -> str:
    """Static robot with a camera of 64 by 48 pixels that looks along x from the origin."""
    shape = "<image><width>64</width><height>48</height></image><clip><near>0.1</near><far>9</far></clip>"
    camera = f"<camera><horizontal_fov>1</horizontal_fov>{shape}{inside}</camera>"
    sensor = f'<sensor name="eye" type="{type_}"><update_rate>20</update_rate>{more}{cameras or camera}</sensor>'
    return f'<model name="bot"><static>1</static><link name="head">{sensor}</link></model>'


def box(name: str, position: str, *, size: str = "1 1 1", mark: str = "") -> str:
    visual = f'<visual name="v"><geometry><box><size>{size}</size></box></geometry>{mark}</visual>'
    return f'<model name="{name}"><static>1</static><pose>{position} 0 0 0</pose><link name="l">{visual}</link></model>'


def label(number: int) -> str:
    return f'<plugin filename="gz-sim-label-system" name="gz::sim::systems::Label"><label>{number}</label></plugin>'


WALL = box("wall", "3.5 0 0", size="1 2 2")
"""Wall with its face 3 m ahead."""


@pytest.mark.parametrize("type_", ["depth", "depth_camera", "rgbd", "rgbd_camera"])
def test_a_depth_camera_publishes_metres_and_nan_out_of_range(receive: Any, type_: str) -> None:
    topics = {
        "/bot/head/eye/image_raw": IMAGE,
        "/bot/head/eye/camera_info": INFO,
        "/bot/head/eye/depth/image_raw": IMAGE,
        "/bot/head/eye/depth/camera_info": INFO,
        "/bot/head/eye/points": "sensor_msgs/PointCloud2",
    }
    received, frames = receive(camera_robot(type_) + WALL, topics)
    colors, info, depths, depth_info, cloud = (received[topic] for topic in topics)

    assert (colors.encoding, depths.encoding, depths.step) == ("rgb8", "32FC1", 64 * 4)
    depth = np.frombuffer(depths.data.tobytes(), dtype="<f4").reshape(48, 64)
    assert depth[24, 32] == pytest.approx(3.0, abs=1e-5)
    assert np.isnan(depth[0, 0])
    # The face is 2 m wide, 3 m ahead.
    assert np.count_nonzero(np.isfinite(depth[24])) == pytest.approx(2 * F / 3, abs=1)
    assert list(depth_info.K) == list(info.K)
    assert {m.header.frame_id for m in received.values()} == {"bot/eye_optical"}
    assert "bot/eye_optical" in frames
    assert {m.header.stamp.nanosec for m in received.values()} == {50_000_000}

    assert (cloud.height, cloud.width, cloud.is_dense) == (48, 64, False)
    raw = np.frombuffer(cloud.data.tobytes(), dtype="<f4").reshape(48, 64, cloud.point_step // 4)
    x, y, z = raw[24, 40, :3]
    assert (x, y, z) == pytest.approx((3 * 8.5 / F, 3 * 0.5 / F, 3.0), abs=1e-4)
    offsets = {field.name: field.offset for field in cloud.fields}
    b, g, r = cloud.data.reshape(48, 64, -1)[24, 40, offsets["rgb"] : offsets["rgb"] + 3]
    assert [r, g, b] == list(colors.data.reshape(48, 64, 3)[24, 40])


def test_depths_have_their_own_clip_range(receive: Any) -> None:
    topic = "/bot/head/eye/depth/image_raw"
    clip = "<depth_camera><clip><near>0.5</near><far>2.9</far></clip></depth_camera>"
    received, _ = receive(camera_robot("depth", inside=clip) + WALL, {topic: IMAGE})

    assert np.isnan(np.frombuffer(received[topic].data.tobytes(), dtype="<f4")).all()


def test_a_segmentation_camera_publishes_labels(receive: Any) -> None:
    """A model's label applies to all its visuals; visuals without a label are background."""
    whole = box("right", "3.5 -1 0", mark="").replace("</model>", label(7) + "</model>")
    world = (
        camera_robot("segmentation")
        + box("left", "3.5 1 0", mark=label(40))
        + whole
        + box("none", "3.5 0 1", size="1 0.2 0.2")
    )
    topics = {"/bot/head/eye/labels_map": IMAGE, "/bot/head/eye/colored_map": IMAGE}
    received, _ = receive(world, topics)
    labels, colors = (received[topic] for topic in topics)

    assert (labels.encoding, colors.encoding) == ("mono8", "rgb8")
    row = labels.data.reshape(48, 64)[24]
    assert (row[32 - int(F / 3)], row[32], row[32 + int(F / 3)]) == (40, 0, 7)
    assert set(labels.data) == {0, 7, 40}
    color_row = colors.data.reshape(48, 64, 3)[24]
    assert tuple(color_row[32]) == (0, 0, 0)
    assert tuple(color_row[32 - int(F / 3)]) != tuple(color_row[32 + int(F / 3)])


def test_a_panoptic_camera_numbers_instances_of_a_label(receive: Any) -> None:
    world = box("a", "3.5 1 0", mark=label(3)) + box("b", "3.5 -1 0", mark=label(3))
    topic = "/bot/head/eye/labels_map"
    kind = "<segmentation_type>instance</segmentation_type>"
    received, _ = receive(camera_robot("segmentation_camera", inside=kind) + world, {topic: IMAGE})

    assert received[topic].encoding == "32SC1"
    row = np.frombuffer(received[topic].data.tobytes(), dtype="<i4").reshape(48, 64)[24]
    assert (row[32 - int(F / 3)], row[32 + int(F / 3)]) == (3 * 65536 + 1, 3 * 65536 + 2)


@pytest.mark.parametrize(("kind", "width"), [("visible_2d", F / 6), ("full_2d", F / 3)])
def test_boxes_enclose_the_visible_part_or_the_whole_object(receive: Any, kind: str, width: float) -> None:
    """A board hides the left half of a face of 1 m, 3 m ahead."""
    topic = "/bot/head/eye/boxes"
    board = box("board", "2 0.5 0", size="0.01 1 3")
    world = box("thing", "3.5 0 0", mark=label(9)) + board
    inside = f"<box_type>{kind}</box_type>"
    received, _ = receive(camera_robot("boundingbox", inside=inside) + world, {topic: "vision_msgs/Detection2DArray"})

    (detection,) = received[topic].detections
    assert received[topic].header.frame_id == "bot/eye_optical"
    assert (detection.results[0].id, detection.results[0].score) == (9, 1.0)
    assert detection.bbox.size_x == pytest.approx(width, abs=2)
    assert detection.bbox.size_y == pytest.approx(F / 3, abs=2)
    assert detection.bbox.center.x + detection.bbox.size_x / 2 == pytest.approx(32 + F / 6, abs=1)


def test_3d_boxes_are_in_the_optical_frame(receive: Any) -> None:
    topic = "/bot/head/eye/boxes"
    world = box("thing", "4 1 0.5", size="1 0.5 0.25", mark=label(9))
    inside = "<box_type>3d</box_type>"
    received, _ = receive(
        camera_robot("boundingbox_camera", inside=inside) + world, {topic: "vision_msgs/Detection3DArray"}
    )

    (detection,) = received[topic].detections
    middle, size = detection.bbox.center.position, detection.bbox.size
    assert (middle.x, middle.y, middle.z) == pytest.approx((-1, -0.5, 4))
    assert (size.x, size.y, size.z) == pytest.approx((1, 0.5, 0.25))


def test_a_thermal_camera_publishes_temperatures(receive: Any) -> None:
    warm = '<plugin filename="gz-sim-thermal-system" name="gz::sim::systems::Thermal"><temperature>310.5</temperature>'
    topic = "/bot/head/eye/image_raw"
    received, _ = receive(camera_robot("thermal") + box("hot", "3.5 0 0", mark=warm + "</plugin>"), {topic: IMAGE})

    assert received[topic].encoding == "mono16"
    counts = np.frombuffer(received[topic].data.tobytes(), dtype="<u2").reshape(48, 64)
    assert (counts[24, 32], counts[0, 0]) == (31050, 28815)  # hundredths of a kelvin; the air has 288.15 K


def test_a_multicameras_right_camera_has_the_baseline_in_its_projection(receive: Any) -> None:
    def one(name: str, y: float) -> str:
        image = "<image><width>64</width><height>48</height></image>"
        return f'<camera name="{name}"><pose>0 {y} 0 0 0 0</pose><horizontal_fov>1</horizontal_fov>{image}</camera>'

    world = camera_robot("multicamera", cameras=one("left", 0.06) + one("right", -0.06)) + WALL
    topics = {
        f"/bot/head/eye/{side}/{output}": type_
        for side in ("left", "right")
        for output, type_ in (("image_raw", IMAGE), ("camera_info", INFO))
    }
    received, frames = receive(world, topics)

    left, right = (received[f"/bot/head/eye/{side}/camera_info"] for side in ("left", "right"))
    assert (left.P[3], right.P[3]) == (0.0, pytest.approx(-F * 0.12))
    assert {"bot/eye/left_optical", "bot/eye/right_optical"} <= frames
    images = [received[f"/bot/head/eye/{side}/image_raw"] for side in ("left", "right")]
    assert images[0].header.stamp == images[1].header.stamp
    edges = [int(np.flatnonzero(np.diff(p.data.reshape(48, 64, 3)[24, :, 0].astype(int)))[0]) for p in images]
    assert edges[0] - edges[1] == pytest.approx(F * 0.12 / 3, abs=1)


def test_images_are_published_on_the_topic_in_the_file(receive: Any) -> None:
    topics = {"/front/picture": IMAGE, "/front/camera_info": INFO}
    received, _ = receive(camera_robot("camera", more="<topic>front/picture</topic>"), topics)

    assert received["/front/picture"].width == received["/front/camera_info"].width == 64


@pytest.mark.parametrize(("mask", "expected"), [(2, 2.0), (3, 2.0), (0xFFFFFFFD, 3.0), (1, 3.0)])
def test_a_visibility_mask_selects_visuals_by_common_bits(receive: Any, mask: int, expected: float) -> None:
    """The near box has only the flag 2."""
    near = box("near", "2.5 0 0").replace("</visual>", "<visibility_flags>2</visibility_flags></visual>")
    world = camera_robot("depth", inside=f"<visibility_mask>{mask}</visibility_mask>") + near + WALL
    received, _ = receive(world, {"/bot/head/eye/depth/image_raw": IMAGE})

    depths = np.frombuffer(bytes(received["/bot/head/eye/depth/image_raw"].data), "<f4").reshape(48, 64)
    assert depths[24, 32] == pytest.approx(expected, abs=1e-4)


def test_the_file_sets_the_camera_info_topic_and_the_optical_frame(receive: Any) -> None:
    settings = "<camera_info_topic>/here/info</camera_info_topic><optical_frame_id>lens</optical_frame_id>"
    received, frames = receive(
        camera_robot("camera", inside=settings) + WALL, {"/here/info": INFO, "/bot/head/eye/image_raw": IMAGE}
    )

    assert {message.header.frame_id for message in received.values()} == {"lens"}
    assert "lens" in frames


def test_an_optical_frame_that_is_a_link_is_not_broadcast(receive: Any) -> None:
    """The link's transform is published already."""
    world = camera_robot("camera", inside="<optical_frame_id>lens</optical_frame_id>")
    world = world.replace("</model>", '<link name="lens"><pose>0 0 1 0 0 0</pose></link></model>')
    received, frames = receive(world, {"/bot/head/eye/image_raw": IMAGE})

    assert received["/bot/head/eye/image_raw"].header.frame_id == "bot/lens"
    assert "bot/lens" not in frames  # not broadcast as a sensor's frame
