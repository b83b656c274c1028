"""librealsense_gazebo_plugin.so: color, infrared and depth of a RealSense, on the topics of its driver."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Self

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.robots.model import PluginTag
from trundle.robots.parameters import TagParameters
from trundle.ros import Node
from trundle.ros.bridge import image_encoder, point_cloud_encoder
from trundle.sim.sensors import CameraReading, CameraSensor, DepthCameraSensor
from trundle.sim.simulation import ModelHandle, Simulation

from .gazebo_ros.plugin_names import PluginNames
from .gazebo_ros.sensor_publisher import SensorPublisher
from .plugin import Plugin

if TYPE_CHECKING:
    from numpy.typing import NDArray

_STREAMS = {"color": "color", "ired1": "infrared1", "ired2": "infrared2", "depth": "depth"}
"""Suffix of a sensor's name → prefix of its parameters."""
_IGNORED = ("depthUpdateRate", "colorUpdateRate", "infraredUpdateRate")
_PARAMETERS = ("TopicName", "CameraInfoTopicName", "OpticalframeName")
_POINT_PARAMETERS = ("rangeMinDepth", "rangeMaxDepth", "pointCloud", "pointCloudTopicName", "pointCloudCutoff",
              "pointCloudCutoffMax")  # fmt: skip
_MAX_DEPTH_MM = 65535


class RealSense(Plugin):
    """Publishes the images of the model's sensors <prefix>color, <prefix>ired1, <prefix>ired2 and <prefix>depth.

    Parameters: <prefix> (none); for `color`, `infrared1`, `infrared2` and `depth` each <…TopicName>, below the plugin's
    name, and <…OpticalframeName>; <rangeMinDepth> 0 and <rangeMaxDepth> (none) [m] of the depth image, 16UC1 in
    millimetres, 0 elsewhere; <pointCloud> false, <pointCloudTopicName>, <pointCloudCutoff> 0 and <pointCloudCutoffMax>
    5 [m]. As in the original, camera_info is beside each image, and <…CameraInfoTopicName> and <…UpdateRate> are
    ignored. Points have the depth camera's colors.
    """

    @classmethod
    def load(cls, sim: Simulation, model: ModelHandle, node: Node | None, tag: PluginTag) -> Self:
        """Report missing sensors; `attach` publishes the others."""
        del node
        parameters = TagParameters(tag.node, sim.report)
        sensors = {sensor.name for link in model.model.links for sensor in link.sensors}
        expected = [f"{parameters.text('prefix', '')}{suffix}" for suffix in _STREAMS]
        missing = [name for name in expected if name not in sensors]
        if missing:
            names = ", ".join(map(repr, sorted(sensors))) or "none"
            parameters.warn(f"plugin {tag.name!r}: no sensor {missing[0]!r}; sensors here: {names}")
        names = [f"{prefix}{parameter}" for prefix in _STREAMS.values() for parameter in _PARAMETERS]
        parameters.ignore(*_IGNORED, *_POINT_PARAMETERS, *names)
        parameters.report_unread()
        return cls()


def find_attach(tag: PluginTag, sensor: str) -> "Callable[[CameraSensor, TagParameters, PluginNames], None] | None":
    """Return `attach` for a sensor of the RealSense, else None."""
    names = {f"{tag.node.string('prefix')}{suffix}" for suffix in _STREAMS}
    return attach if sensor in names else None


def attach(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish one of the four streams; see `RealSense`."""
    stream = _STREAMS[sensor.name.removeprefix(parameters.text("prefix", ""))]
    image = image_encoder(sensor.optics.format)
    if stream == "depth":
        if not isinstance(sensor, DepthCameraSensor):
            raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a depth sensor is needed")
        image = _depth_encoder(parameters)
    topic, frame = (
        _topic(parameters, parameters.text(f"{stream}TopicName", "")),
        parameters.text(f"{stream}OpticalframeName", ""),
    )
    images = SensorPublisher(names.advertise("sensor_msgs/Image", topic), frame)
    info_topic = f"{topic.rpartition('/')[0]}/camera_info"
    infos = SensorPublisher(names.advertise("sensor_msgs/CameraInfo", info_topic), frame)
    publishers, calibration = [images, infos], _calibration(sensor)

    def publish(reading: CameraReading) -> None:
        images.publish(reading, lambda: _as_bytes(image(reading)))
        infos.publish(reading, lambda: calibration)

    sensor.listen(publish, enabled=lambda: any(publisher.has_subscribers() for publisher in publishers))
    if stream == "depth" and parameters.flag("pointCloud", default=False):
        _publish_points(sensor, names, parameters, frame)


def _topic(parameters: TagParameters, name: str) -> str:
    return name if name.startswith("/") else f"/{parameters.attribute('name')}/{name}"


def _as_bytes(image: dict[str, object]) -> dict[str, object]:
    """Image message with the original's encoding of grey, 8UC1."""
    return {**image, "encoding": "8UC1"} if image["encoding"] == "mono8" else image


def _publish_points(sensor: CameraSensor, names: PluginNames, parameters: TagParameters, frame: str) -> None:
    near = parameters.number("pointCloudCutoff", 0.0)
    far = parameters.number("pointCloudCutoffMax", 5.0)
    topic = _topic(parameters, parameters.text("pointCloudTopicName", ""))
    points = SensorPublisher(names.advertise("sensor_msgs/PointCloud2", topic), frame)
    cloud = point_cloud_encoder(sensor)

    def clip(reading: CameraReading) -> CameraReading:
        depth = _depth(reading)
        with np.errstate(invalid="ignore"):
            clipped = np.where((depth > near) & (depth < far), depth, np.float32(np.nan))
        return CameraReading(time_ns=reading.time_ns, rgb=reading.rgb, depth=clipped)

    def publish(reading: CameraReading) -> None:
        points.publish(reading, lambda: cloud(clip(reading)))

    sensor.listen(publish, enabled=points.has_subscribers)


def _depth_encoder(parameters: TagParameters) -> Callable[[CameraReading], dict[str, object]]:
    near = parameters.number("rangeMinDepth", 0.0)
    far = parameters.number("rangeMaxDepth", math.inf)

    def make(reading: CameraReading) -> dict[str, object]:
        depth = _depth(reading)
        millimetres = depth * 1000.0
        with np.errstate(invalid="ignore"):
            in_range = (depth >= near) & (depth <= far) & (millimetres <= _MAX_DEPTH_MM)
        counts = np.where(in_range, millimetres, 0.0).astype("<u2")
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
