"""libgazebo_ros_camera.so: pictures and their calibration, where the plugin says."""

from collections.abc import Sequence
from typing import Any

from trundle.bridge import calibration_of, image_maker
from trundle.diagnostics import Diagnostics
from trundle.model import PluginTag
from trundle.ros import Node, Option, Options, ReconfigureServer
from trundle.sensors import CameraReading, CameraSensor

from .place import ignore, namespace_of, topic_in
from .sensor import Outlet, frame_of

_FASTEST_HZ = 1000.0


def attach(sensor: CameraSensor, node: Node, tag: PluginTag, report: Diagnostics) -> None:
    """Publish what a camera sees.

    Parameters, with gazebo_ros' defaults: <cameraName> (none), <imageTopicName> image_raw, <cameraInfoTopicName>
    camera_info, <frameName> world, <updateRate> 0 (the sensor's), and for camera_info alone <CxPrime>, <Cx>, <Cy>,
    <focalLength> 0 (the picture's), <hackBaseline> 0, <distortionK1> to <distortionT2>. Where <borderCrop> (true) is
    false, a distorted picture is not enlarged.
    """
    keep_borders_if_told(sensor, tag, report)
    frame, rate_hz = frame_of(tag, "world"), _number(tag, "updateRate", report)
    pictures = Outlet(node, camera_topic(sensor, tag, "imageTopicName", "image_raw"), "sensor_msgs/Image", frame,
                      rate_hz=rate_hz)  # fmt: skip
    infos = Outlet(node, camera_topic(sensor, tag, "cameraInfoTopicName", "camera_info"), "sensor_msgs/CameraInfo",
                   frame, rate_hz=rate_hz)  # fmt: skip
    calibration, image = told_calibration(sensor, tag, report), image_maker(sensor.optics.format)
    ignore(tag.node, "autoDistortion", "triggerTopicName", "cameraName")
    tag.node.report_unread(report)

    def publish(reading: CameraReading) -> None:
        pictures.publish(reading, lambda: image(reading))
        infos.publish(reading, lambda: calibration)

    sensor.listen(publish, wanted=lambda: pictures.wanted() or infos.wanted())
    offer_rate(sensor, node, tag, (pictures, infos), rate_hz)


def offer_rate(
    sensor: CameraSensor, node: Node, tag: PluginTag, outlets: Sequence[Outlet], plugin_rate_hz: float
) -> None:
    """Let users change how often pictures are taken, as dynamic_reconfigure's `imager_rate` of the camera.

    Of a multicamera's pictures, which share one clock, the rate stays.
    """
    if sensor.optics.name:
        return
    rates = [rate for rate in (sensor.rate_hz, plugin_rate_hz) if rate > 0.0]

    def apply(values: Options) -> Options:
        rate_hz = float(values["imager_rate"])
        sensor.set_rate(rate_hz)
        for outlet in outlets:
            outlet.throttle.set_rate(0.0)
        return values

    option = Option(name="imager_rate", value=min(rates), lower=0.1, upper=_FASTEST_HZ, description="Pictures a second")
    ReconfigureServer(node, [option], apply, namespace=topic_in(_space(sensor, tag), "").rstrip("/"))


def keep_borders_if_told(sensor: CameraSensor, tag: PluginTag, report: Diagnostics) -> None:
    """Heed <borderCrop>."""
    if not tag.node.flag("borderCrop", default=True, report=report):
        sensor.keep_borders()


def camera_topic(sensor: CameraSensor, tag: PluginTag, parameter: str, default: str) -> str:
    """A topic below the robot's namespace and the camera's name; a multicamera's have a name each."""
    return topic_in(_space(sensor, tag), tag.node.string(parameter, default=default))


def _space(sensor: CameraSensor, tag: PluginTag) -> str:
    name = tag.node.string("cameraName").strip("/")
    return "/".join(part for part in (namespace_of(tag, sensor.model.name), name, sensor.optics.name) if part)


def told_calibration(sensor: CameraSensor, tag: PluginTag, report: Diagnostics) -> dict[str, object]:
    """What camera_info says, with what the plugin has otherwise."""
    found: dict[str, Any] = dict(calibration_of(sensor))
    k, p = list(found["K"]), list(found["P"])
    focal = _number(tag, "focalLength", report)
    cx, cy = _number(tag, "Cx", report) or _number(tag, "CxPrime", report), _number(tag, "Cy", report)
    for index, value in ((0, focal), (4, focal), (2, cx), (5, cy)):
        if value:
            k[index] = value
            p[index + index // 3] = value
    p[3] -= p[0] * _number(tag, "hackBaseline", report)
    bends = [_number(tag, f"distortion{name}", report) for name in ("K1", "K2", "T1", "T2", "K3")]
    return {**found, "K": k, "P": p, "D": bends if any(bends) else found["D"]}


def _number(tag: PluginTag, name: str, report: Diagnostics) -> float:
    return tag.node.number(name, default=0.0, report=report)
