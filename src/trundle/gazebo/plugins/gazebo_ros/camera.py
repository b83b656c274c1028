"""libgazebo_ros_camera.so: images and camera_info of a camera."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from trundle.robots.parameters import TagParameters
from trundle.ros import Option, Options, ReconfigureServer
from trundle.ros.bridge import camera_info_message, image_encoder, is_compressible
from trundle.sim.sensors import CameraReading, CameraSensor

from .image_publisher import ImagePublisher
from .plugin_names import PluginNames
from .sensor_publisher import SensorPublisher

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_MAX_RATE_HZ = 1000.0
_SIDES = ["left", "right"]


def attach(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish images, raw and on IMAGE/compressed, and camera_info.

    Parameters, with gazebo_ros' defaults: <cameraName> (none), <imageTopicName> image_raw, <cameraInfoTopicName>
    camera_info, <frameName> /world, <updateRate> 0 (the sensor's), and for camera_info alone <Cx>, <Cy>,
    <focalLength> 0 (the image's), <hackBaseline> 0, <distortionK1> to <distortionT2>. Without <borderCrop> (true) a
    distorted image is not enlarged. A multicamera's <hackBaseline> is the distance of the right camera from the left
    one, by default that of the file. The service set_camera_info of the camera changes camera_info for this run.
    """
    pixels = sensor.optics.format
    attach_images(sensor, parameters, names, image_encoder(pixels), is_compressible=is_compressible(pixels))


def attach_images(
    sensor: CameraSensor,
    parameters: TagParameters,
    names: PluginNames,
    image: Callable[[CameraReading], dict[str, object]],
    *,
    is_compressible: bool = True,
) -> None:
    """Publish the messages that a function makes from readings, with the parameters of `attach`."""
    read_border_crop(sensor, parameters)
    frame, rate_hz = names.frame(parameters.text("frameName", "/world")), parameters.number("updateRate", 0.0)
    image_topic = camera_topic(sensor, parameters, "imageTopicName", "image_raw")
    images = ImagePublisher(names, image_topic, frame, image, rate_hz=rate_hz, is_compressible=is_compressible)
    info_topic = camera_topic(sensor, parameters, "cameraInfoTopicName", "camera_info")
    infos = SensorPublisher(names.advertise("sensor_msgs/CameraInfo", info_topic), frame, rate_hz=rate_hz)
    calibration = Calibration(sensor, parameters, names)
    parameters.ignore("autoDistortion", "triggerTopicName", "cameraName")

    def publish(reading: CameraReading) -> None:
        images.publish(reading)
        infos.publish(reading, calibration.message)

    sensor.listen(publish, enabled=lambda: images.has_subscribers() or infos.has_subscribers())
    offer_rate(sensor, parameters, names, rate_hz)


def attach_triggered(sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
    """Publish as `attach`, one image for each std_msgs/Empty on <triggerTopicName> (image_trigger)."""
    trigger = sensor.await_trigger()
    topic = camera_topic(sensor, parameters, "triggerTopicName", "image_trigger")
    names.subscribe(topic, "std_msgs/Empty", lambda _: trigger())
    attach(sensor, parameters, names)


class Calibration:
    """camera_info of a camera: of its image and its plugin's parameters, until set_camera_info changes it."""

    def __init__(self, sensor: CameraSensor, parameters: TagParameters, names: PluginNames) -> None:
        self._info = _read_calibration(sensor, parameters)
        service = "/".join(filter(None, (_camera_name(sensor, parameters), "set_camera_info")))
        names.node.advertise_service(names.topic(service), "sensor_msgs/SetCameraInfo", self._set)

    def message(self) -> dict[str, object]:
        """Return the fields of sensor_msgs/CameraInfo without its header."""
        return self._info

    def _set(self, request: "sensor_msgs.SetCameraInfoRequest") -> dict[str, object]:
        self._info = {name: getattr(request.camera_info, name) for name in self._info}
        return {"success": True}


def offer_rate(sensor: CameraSensor, parameters: TagParameters, names: PluginNames, plugin_rate_hz: float) -> None:
    """Offer the camera's rate as the dynamic_reconfigure option `imager_rate`.

    The option sets the sensor's rate, for all cameras of a multicamera; <updateRate> stays the limit of publishing.
    """
    rates = [rate for rate in (sensor.rate_hz, plugin_rate_hz) if rate > 0.0]

    def apply(values: Options) -> Options:
        sensor.set_rate(float(values["imager_rate"]))
        return values

    option = Option(
        name="imager_rate", value=min(rates), lower=0.1, upper=_MAX_RATE_HZ, description="Images per second"
    )
    namespace = names.topic(_camera_name(sensor, parameters)).rstrip("/")
    ReconfigureServer(names.node, [option], apply, namespace=namespace)


def read_border_crop(sensor: CameraSensor, parameters: TagParameters) -> None:
    """Apply <borderCrop>."""
    if not parameters.flag("borderCrop", default=True):
        sensor.set_crop(False)


def camera_topic(sensor: CameraSensor, parameters: TagParameters, parameter: str, default: str) -> str:
    """Return the topic below the camera's name; each camera of a multicamera has its own."""
    topic = parameters.text(parameter, default)
    return topic if topic.startswith("/") else "/".join(filter(None, (_camera_name(sensor, parameters), topic)))


def _camera_name(sensor: CameraSensor, parameters: TagParameters) -> str:
    return "/".join(filter(None, (parameters.text("cameraName", "").strip("/"), _eye(sensor))))


def _eye(sensor: CameraSensor) -> str:
    """Return a multicamera camera's name in topics: `left` or `right` if a pair's names contain these, else its own."""
    names = [camera.name for camera in sensor.sensor.cameras]
    sides = [next((side for side in _SIDES if side in name), "") for name in names]
    return sides[names.index(sensor.optics.name)] if sorted(sides) == _SIDES else sensor.optics.name


def _read_calibration(sensor: CameraSensor, parameters: TagParameters) -> dict[str, object]:
    """Make camera_info, with the plugin's overrides."""
    info: dict[str, Any] = dict(camera_info_message(sensor))
    k, p = list(info["K"]), list(info["P"])
    focal = parameters.number("focalLength", 0.0)
    cx, cy = parameters.number("Cx", 0.0), parameters.number("Cy", 0.0)
    parameters.ignore("CxPrime")  # gazebo_ros does not use it
    for index, value in ((0, focal), (4, focal), (2, cx), (5, cy)):
        if value:
            k[index] = value
            p[index + index // 3] = value
    baseline = parameters.number("hackBaseline", 0.0)
    if baseline:
        is_origin = len(sensor.sensor.cameras) > 1 and "right" not in sensor.optics.name
        p[3] = 0.0 if is_origin else -p[0] * baseline
    distortion = [parameters.number(f"distortion{name}", 0.0) for name in ("K1", "K2", "T1", "T2", "K3")]
    return {**info, "K": k, "P": p, "D": distortion if any(distortion) else info["D"]}
