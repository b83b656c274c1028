"""librealsense_gazebo_plugin.so: colour, infrared and depth of a RealSense, on the topics of its driver."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Self

import numpy as np

from trundle.bridge import image_encoder, point_cloud_encoder
from trundle.diagnostics import Diagnostics, UsageError
from trundle.model import PluginTag
from trundle.ros import Node
from trundle.sensors import CameraReading, CameraSensor, DepthCameraSensor
from trundle.simulation import ModelHandle, Simulation

from .gazebo_ros.namespaces import mark_read
from .gazebo_ros.sensor_publisher import SensorPublisher
from .plugin import Plugin

if TYPE_CHECKING:
    from numpy.typing import NDArray

_STREAMS = {"color": "color", "ired1": "infrared1", "ired2": "infrared2", "depth": "depth"}
"""Suffix of a sensor's name → prefix of its parameters."""
_UNUSED = ("depthUpdateRate", "colorUpdateRate", "infraredUpdateRate")
_PARAMETERS = ("TopicName", "CameraInfoTopicName", "OpticalframeName")
_OF_POINTS = ("rangeMinDepth", "rangeMaxDepth", "pointCloud", "pointCloudTopicName", "pointCloudCutoff",
              "pointCloudCutoffMax")  # fmt: skip
_FARTHEST_MM = 65535


class RealSense(Plugin):
    """Publishes the images of the model's sensors <prefix>color, <prefix>ired1, <prefix>ired2 and <prefix>depth.

    Parameters: <prefix> (none); for `color`, `infrared1`, `infrared2` and `depth` each <…TopicName>, below the plugin's
    name, and <…OpticalframeName>; <rangeMinDepth> 0 and <rangeMaxDepth> (none) [m] of the depth image, 16UC1 in
    millimetres, 0 elsewhere; <pointCloud> false, <pointCloudTopicName>, <pointCloudCutoff> 0 and <pointCloudCutoffMax>
    5 [m]. As in the original, camera_info is beside each image, and <…CameraInfoTopicName> and <…UpdateRate> are
    ignored. Points have the depth camera's colours.
    """

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Report missing sensors; those there are publish by `attach`."""
        del node
        parameters = tag.node
        there = {sensor.name for link in model.model.links for sensor in link.sensors}
        wanted = [f"{parameters.string('prefix')}{end}" for end in _STREAMS]
        missing = [name for name in wanted if name not in there]
        if missing:
            names = ", ".join(map(repr, sorted(there))) or "none"
            sim.report.warn(tag.at, f"plugin {tag.name!r}: no sensor {missing[0]!r}; sensors here: {names}")
        names = [f"{start}{what}" for start in _STREAMS.values() for what in _PARAMETERS]
        mark_read(parameters, *_UNUSED, *_OF_POINTS, *names)
        parameters.report_unread(sim.report)
        return cls()


def find_attach(tag: PluginTag, sensor: str) -> "Callable[[CameraSensor, Node, PluginTag, Diagnostics], None] | None":
    """Return `attach` if the name is that of one of the RealSense's sensors, else None."""
    ends = {f"{tag.node.string('prefix')}{end}" for end in _STREAMS}
    return attach if sensor in ends else None


def attach(sensor: CameraSensor, node: Node, tag: PluginTag, report: Diagnostics) -> None:
    """Publish one of the four streams; see `RealSense`."""
    stream = _STREAMS[sensor.name.removeprefix(tag.node.string("prefix"))]
    image = image_encoder(sensor.optics.format)
    if stream == "depth":
        if not isinstance(sensor, DepthCameraSensor):
            raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a depth sensor is needed")
        image = _depth_maker(tag, report)
    topic, frame = _topic(tag, tag.node.string(f"{stream}TopicName")), tag.node.string(f"{stream}OpticalframeName")
    images = SensorPublisher(node, topic, "sensor_msgs/Image", frame)
    infos = SensorPublisher(node, f"{topic.rpartition('/')[0]}/camera_info", "sensor_msgs/CameraInfo", frame)
    outlets, calibration = [images, infos], _calibration(sensor)

    def publish(reading: CameraReading) -> None:
        images.publish(reading, lambda: _as_bytes(image(reading)))
        infos.publish(reading, lambda: calibration)

    sensor.listen(publish, enabled=lambda: any(outlet.has_subscribers() for outlet in outlets))
    if stream == "depth" and tag.node.flag("pointCloud", default=False, report=report):
        _publish_points(sensor, node, tag, report, frame)


def _topic(tag: PluginTag, name: str) -> str:
    return name if name.startswith("/") else f"/{tag.name}/{name}"


def _as_bytes(image: dict[str, object]) -> dict[str, object]:
    """Image message with the original's encoding of grey, 8UC1."""
    return {**image, "encoding": "8UC1"} if image["encoding"] == "mono8" else image


def _publish_points(sensor: CameraSensor, node: Node, tag: PluginTag, report: Diagnostics, frame: str) -> None:
    near = tag.node.number("pointCloudCutoff", default=0.0, report=report)
    far = tag.node.number("pointCloudCutoffMax", default=5.0, report=report)
    topic = _topic(tag, tag.node.string("pointCloudTopicName"))
    points, cloud = SensorPublisher(node, topic, "sensor_msgs/PointCloud2", frame), point_cloud_encoder(sensor)

    def cut(reading: CameraReading) -> CameraReading:
        depth = _depth(reading)
        with np.errstate(invalid="ignore"):
            kept = np.where((depth > near) & (depth < far), depth, np.float32(np.nan))
        return CameraReading(time_ns=reading.time_ns, rgb=reading.rgb, depth=kept)

    def publish(reading: CameraReading) -> None:
        points.publish(reading, lambda: cloud(cut(reading)))

    sensor.listen(publish, enabled=points.has_subscribers)


def _depth_maker(tag: PluginTag, report: Diagnostics) -> Callable[[CameraReading], dict[str, object]]:
    near = tag.node.number("rangeMinDepth", default=0.0, report=report)
    far = tag.node.number("rangeMaxDepth", default=math.inf, report=report)

    def make(reading: CameraReading) -> dict[str, object]:
        depth = _depth(reading)
        millimetres = depth * 1000.0
        with np.errstate(invalid="ignore"):
            is_seen = (depth >= near) & (depth <= far) & (millimetres <= _FARTHEST_MM)
        counts = np.where(is_seen, millimetres, 0.0).astype("<u2")
        height, width = counts.shape
        data = np.ascontiguousarray(counts).reshape(-1).view(np.uint8)
        return {"height": height, "width": width, "encoding": "16UC1", "step": 2 * width, "data": data}

    return make


def _depth(reading: CameraReading) -> "NDArray[np.float32]":
    assert reading.depth is not None
    return reading.depth


def _calibration(sensor: CameraSensor) -> dict[str, object]:
    """camera_info of a pinhole with the principal point in the middle; R is the identity (zero in the original)."""
    optics = sensor.optics
    focal = 0.5 * optics.width_px / math.tan(0.5 * optics.horizontal_fov_rad)
    cx, cy = 0.5 * optics.width_px, 0.5 * optics.height_px
    return {
        "height": optics.height_px,
        "width": optics.width_px,
        "distortion_model": "plumb_bob",
        "D": [0.0] * 5,
        "K": [focal, 0.0, cx, 0.0, focal, cy, 0.0, 0.0, 1.0],
        "R": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0],
        "P": [focal, 0.0, cx, 0.0, 0.0, focal, cy, 0.0, 0.0, 0.0, 1.0, 0.0],
    }
