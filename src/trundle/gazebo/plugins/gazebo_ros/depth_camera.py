"""libgazebo_ros_openni_kinect.so and libgazebo_ros_depth_camera.so: images, depths and points of one camera."""

import math
from functools import lru_cache

import numpy as np

from trundle.base.diagnostics import UsageError
from trundle.robots.parameters import TagParameters
from trundle.ros.bridge import depth_image, image_encoder, is_compressible, point_cloud_encoder
from trundle.sim.render import clip_depths
from trundle.sim.sensors import CameraReading, CameraSensor, DepthCameraSensor

from .camera import Calibration, camera_topic, offer_rate, read_border_crop
from .image_publisher import ImagePublisher
from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher

_IMAGE, _INFO, _POINTS = "sensor_msgs/Image", "sensor_msgs/CameraInfo", "sensor_msgs/PointCloud2"


def attach(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish images, depth images, point clouds and camera_info.

    Parameters, with gazebo_ros' defaults: those of libgazebo_ros_camera.so (<imageTopicName> is image_raw), and
    <depthImageTopicName> depth/image_raw, <depthImageCameraInfoTopicName> depth/camera_info, <pointCloudTopicName>
    points, <pointCloudCutoff> 0.4 and <pointCloudCutoffMax> 5 [m] (of depths and points), <useDepth16UC1Format> false
    (true: depths are 16UC1 [mm]).
    """
    _attach(sensor, parameters, names, max_depth=parameters.number("pointCloudCutoffMax", 5.0))


def attach_depth_camera(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish as `attach`, without a largest depth: libgazebo_ros_depth_camera.so has no <pointCloudCutoffMax>."""
    parameters.ignore("pointCloudCutoffMax", "normalsTopicName", "reduceNormals")
    _attach(sensor, parameters, names, max_depth=math.inf)


def _attach(sensor: CameraSensor, parameters: TagParameters, names: PluginNames, *, max_depth: float) -> None:
    if not isinstance(sensor, DepthCameraSensor):
        raise UsageError(f"sensor {sensor.name!r} is of type {sensor.sensor.type}; a depth sensor is needed")
    read_border_crop(sensor, parameters)
    frame, rate_hz = names.frame(parameters.text("frameName", "/world")), parameters.number("updateRate", 0.0)
    near = parameters.number("pointCloudCutoff", 0.4)
    in_millimetres = parameters.flag("useDepth16UC1Format", default=False)

    def advertise(parameter: str, default: str, kind: str) -> SensorPublisher:
        topic = names.advertise(kind, camera_topic(sensor, parameters, parameter, default))
        return SensorPublisher(topic, frame, rate_hz=rate_hz)

    pixels = sensor.optics.format
    images = ImagePublisher(
        names,
        camera_topic(sensor, parameters, "imageTopicName", "image_raw"),
        frame,
        image_encoder(pixels),
        rate_hz=rate_hz,
        is_compressible=is_compressible(pixels),
    )
    infos = advertise("cameraInfoTopicName", "camera_info", _INFO)
    depths = advertise("depthImageTopicName", "depth/image_raw", _IMAGE)
    depth_infos = advertise("depthImageCameraInfoTopicName", "depth/camera_info", _INFO)
    points = advertise("pointCloudTopicName", "points", _POINTS)
    calibration, cloud = Calibration(sensor, parameters, names), point_cloud_encoder(sensor)
    parameters.ignore("autoDistortion", "cameraName", "depthImageInfoTopicName", "reflectanceTopicName")

    @lru_cache(maxsize=1)  # depths and points share a reading
    def clip(reading: CameraReading) -> CameraReading:
        assert reading.depth is not None
        depth = clip_depths(reading.depth, near_m=near, far_m=max_depth)
        return CameraReading(time_ns=reading.time_ns, rgb=reading.rgb, depth=depth)

    def depth_message(reading: CameraReading) -> dict[str, object]:
        return _millimetres(clip(reading)) if in_millimetres else depth_image(clip(reading))

    def publish(reading: CameraReading) -> None:
        images.publish(reading)
        infos.publish(reading, calibration.message)
        depths.publish(reading, lambda: depth_message(reading))
        depth_infos.publish(reading, calibration.message)
        points.publish(reading, lambda: cloud(clip(reading)))

    publishers = (images, infos, depths, depth_infos, points)
    sensor.listen(publish, enabled=lambda: any(publisher.has_subscribers() for publisher in publishers))
    offer_rate(sensor, parameters, names, rate_hz)


def _millimetres(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image 16UC1 [mm]; 0: no depth."""
    assert reading.depth is not None
    counts = np.nan_to_num(reading.depth * 1000.0, nan=0.0).astype("<u2")
    height, width = counts.shape
    data = np.ascontiguousarray(counts).reshape(-1).view(np.uint8)
    return {"height": height, "width": width, "encoding": "16UC1", "step": 2 * width, "data": data}
