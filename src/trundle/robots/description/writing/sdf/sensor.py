"""Writer of <sensor>."""

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import EVERY_BIT, GpsNoise, ImuNoise, Noise, RangeScan, Sensor

from ..tag import Tag
from .camera import add_camera, add_noise
from .instrument import add_axes, add_instrument

_WITHOUT = frozenset({"rfid", "rfidtag"})
"""Types without settings."""


def add_sensor(home: Tag, sensor: Sensor, report: Diagnostics) -> None:
    """Append <sensor>; warn of settings that the model does not hold."""
    tag = home.add("sensor", name=sensor.name, type=sensor.type)
    tag.add_pose(sensor.link_from_sensor)
    tag.add_unless("update_rate", sensor.update_rate_hz, default=0.0)
    tag.add_unless("always_on", sensor.always_on, default=False)
    tag.add_unless("visualize", sensor.visualize, default=False)
    tag.add_unless("topic", sensor.topic, default="")
    if sensor.cameras:
        for optics in sensor.cameras:
            add_camera(tag, optics)
    elif sensor.scan is not None:
        _add_scan(tag, sensor.scan)
    elif sensor.imu is not None:
        _add_imu(tag, sensor.imu)
    elif sensor.gps is not None:
        _add_gps(tag, sensor.gps)
    elif sensor.contact_collisions is not None:
        contact = tag.add("contact")
        for name in sensor.contact_collisions:
            contact.add("collision", name)
    elif sensor.force_torque is not None:
        measured = tag.add("force_torque")
        measured.add("frame", sensor.force_torque.frame)
        direction = "parent_to_child" if sensor.force_torque.parent_to_child else "child_to_parent"
        measured.add("measure_direction", direction)
        add_axes(measured.add_optional("force"), sensor.force_torque.force)
        add_axes(measured.add_optional("torque"), sensor.force_torque.torque)
    elif sensor.instrument is not None:
        add_instrument(tag, sensor.instrument)
    elif sensor.type not in _WITHOUT:
        report.warn(
            sensor.at,
            f"sensor {sensor.name!r}: the settings of a {sensor.type} sensor are not written yet",
            "not-in-sdf",
        )
    tag.children += [plugin.node.xml() for plugin in sensor.plugins]


def _add_scan(sensor: Tag, scan: RangeScan) -> None:
    ray = sensor.add("ray")
    fans = ray.add("scan")
    for name, fan in (("horizontal", scan.horizontal), ("vertical", scan.vertical)):
        axis = fans.add(name)
        axis.add("samples", fan.samples)
        axis.add("resolution", fan.resolution)
        axis.add("min_angle", fan.min_angle)
        axis.add("max_angle", fan.max_angle)
    limits = ray.add("range")
    limits.add("min", scan.min_m)
    limits.add("max", scan.max_m)
    add_noise(ray, scan.noise)
    ray.add_unless("visibility_mask", scan.visibility_mask, default=EVERY_BIT)


def _add_imu(sensor: Tag, imu: ImuNoise) -> None:
    tag = sensor.add("imu")
    if imu.reference is not None:
        reference = tag.add("orientation_reference_frame")
        reference.add("localization", imu.reference.localization)
        reference.add("custom_rpy", imu.reference.custom_rpy, parent_frame=imu.reference.parent_frame)
        reference.add("grav_dir_x", imu.reference.gravity_x, parent_frame=imu.reference.gravity_parent_frame)
    for name, noises in (("angular_velocity", imu.angular_velocity), ("linear_acceleration", imu.linear_acceleration)):
        add_axes(tag.add_optional(name), noises)


def _add_gps(sensor: Tag, gps: GpsNoise) -> None:
    position = sensor.add("gps").add("position_sensing")
    for name, noise in (("horizontal", gps.horizontal), ("vertical", gps.vertical)):
        if noise != Noise():
            add_noise(position.add(name), noise)
