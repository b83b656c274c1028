"""Reader of <sensor>: simulated types completely, others by name and type."""

from collections.abc import Iterable
from itertools import count

from msgspec.structs import replace

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import MEASURING, PluginTag, Sensor

from .camera import CAMERA_TYPES, read_cameras
from .context import Context, read_pose, warn_ignored
from .frames import FrameGraph


def read_sensor(node: XmlNode, owner: str, graph: FrameGraph, context: Context) -> Sensor:
    """Read one sensor, posed in its owner's frame: a link's or a joint's."""
    report = context.report
    type_ = node.attribute("type") or "none"
    sensor = Sensor(
        name=node.attribute("name") or type_,
        type=type_,
        at=node.at,
        link_from_sensor=graph.pose_in(owner, read_pose(node, context), node.at),
        update_rate_hz=_rate(node, context),
        always_on=node.flag("always_on", default=False),
        visualize=node.flag("visualize", default=False),
        topic=_topic(node, type_),
        cameras=read_cameras(node, type_, context) if type_ in CAMERA_TYPES else (),
        plugins=tuple(read_plugin(tag) for tag in node.all("plugin")),
    )
    if type_ in MEASURING:
        from .sensor_elements import with_settings  # imported only for worlds with such sensors

        sensor = with_settings(sensor, node, context)
    if type_ in MEASURING | CAMERA_TYPES:
        node.report_unread(report)
    else:
        warn_ignored(node, [child.tag for child in node.unread()], f"of type {type_!r} is not read yet", context)
    return sensor


def with_unique_names(sensors: Iterable[Sensor], link: str, context: Context) -> tuple[Sensor, ...]:
    """Return the sensors of a link; duplicate names get a number, with a warning."""
    by_name: dict[str, Sensor] = {}
    for sensor in sensors:
        name = sensor.name
        if name in by_name:
            number = next(i for i in count(2) if f"{name}_{i}" not in by_name)
            message = f"link {link!r} has a second sensor {name!r}; it is renamed '{name}_{number}'"
            context.report.warn(sensor.at, message, "duplicate-name")
            sensor = replace(sensor, name=f"{name}_{number}")
        by_name[sensor.name] = sensor
    return tuple(by_name.values())


def _topic(node: XmlNode, type_: str) -> str:
    """Return the topic; an IMU or contact sensor may name it in its settings element."""
    settings = node.find(type_) if type_ in ("imu", "contact") else None
    return node.string("topic") or ("" if settings is None else settings.string("topic"))


def _rate(node: XmlNode, context: Context) -> float:
    rate = node.number("update_rate", default=0.0)
    if rate >= 0.0:
        return rate
    context.report.warn(
        node.at, f"an update_rate of {rate:g} Hz is not possible; 0 (every step) is used", "out-of-range"
    )
    return 0.0


def read_plugin(node: XmlNode) -> PluginTag:
    """Read a <plugin>; its parameters stay XML."""
    return PluginTag(
        name=node.attribute("name") or "", filename=node.attribute("filename") or "", at=node.at, node=node
    )
