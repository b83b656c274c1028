"""Reader of settings of sensors other than cameras, rays, IMUs, GPS and force-torque sensors."""

import math
from collections.abc import Callable, Mapping
from typing import TypeAlias

from trundle.base.xmlnode import XmlNode
from trundle.robots.model import (
    AirPressure,
    AirSpeed,
    Altimeter,
    Instrument,
    LogicalCamera,
    Magnetometer,
    Noise,
    Sonar,
    Transceiver,
)

from .context import Context
from .noise import read_noise

_Read: TypeAlias = Callable[[XmlNode, Context], Instrument]


def read_instrument(sensor: XmlNode, type_: str, context: Context) -> Instrument | None:
    """Read the settings of a sensor, or SDF's defaults; None for a type without settings, such as rfid."""
    if type_ not in _READERS:
        return None
    tag, default, read = _READERS[type_]
    node = sensor.find(tag)
    if node is None:
        return default
    instrument = read(node, context)
    node.report_unread(context.report)
    return instrument


def _logical_camera(node: XmlNode, context: Context) -> LogicalCamera:
    report, default = context.report, LogicalCamera()
    near = node.number("near", default=default.near_m)
    far = node.number("far", default=default.far_m)
    ratio = node.number("aspect_ratio", default=default.aspect_ratio)
    fov = node.number("horizontal_fov", default=default.horizontal_fov_rad)
    if not 0.0 <= near < far:
        report.warn(node.at, f"near {near:g}, far {far:g} is not possible; 0 and 1 are used", "out-of-range")
        near, far = default.near_m, default.far_m
    if not 0.0 < fov < math.pi or not ratio > 0.0:
        fault = f"horizontal_fov {fov:g} rad with aspect_ratio {ratio:g}"
        report.warn(node.at, f"{fault} is not possible; 1 and 1 are used", "out-of-range")
        fov, ratio = default.horizontal_fov_rad, default.aspect_ratio
    return LogicalCamera(near_m=near, far_m=far, aspect_ratio=ratio, horizontal_fov_rad=fov)


def _sonar(node: XmlNode, context: Context) -> Sonar:
    report, default = context.report, Sonar()
    geometry = node.string("geometry").lower() or default.geometry
    min_m = node.number("min", default=default.min_m)
    max_m = node.number("max", default=default.max_m)
    radius = node.number("radius", default=default.radius)
    if geometry not in ("cone", "sphere"):
        report.warn(node.at, f"no sonar geometry {geometry!r}: cone or sphere; cone is used", "unknown-choice")
        geometry = default.geometry
    if not (0.0 <= min_m < max_m and radius > 0.0):
        fault = f"a sonar from {min_m:g} to {max_m:g} m of radius {radius:g} m"
        report.warn(node.at, f"{fault} is not possible; one from 0 to 1 m of radius 0.5 m is used", "out-of-range")
        return Sonar(geometry=geometry)
    return Sonar(geometry=geometry, min_m=min_m, max_m=max_m, radius=radius)


def _transceiver(node: XmlNode, context: Context) -> Transceiver:
    report, default = context.report, Transceiver()
    frequency = node.number("frequency", default=default.frequency_mhz)
    if not frequency > 0.0:
        report.warn(
            node.at, f"a frequency of {frequency:g} MHz is not possible; 1 is used, as in Gazebo", "out-of-range"
        )
        frequency = 1.0
    return Transceiver(
        essid=node.string("essid") or default.essid,
        frequency_mhz=frequency,
        lowest_mhz=node.number("min_frequency", default=default.lowest_mhz),
        highest_mhz=node.number("max_frequency", default=default.highest_mhz),
        gain_dbi=node.number("gain", default=default.gain_dbi),
        power_dbm=node.number("power", default=default.power_dbm),
        sensitivity_dbm=node.number("sensitivity", default=default.sensitivity_dbm),
    )


def _altimeter(node: XmlNode, context: Context) -> Altimeter:
    return Altimeter(
        position=_inner(node, "vertical_position", context), velocity=_inner(node, "vertical_velocity", context)
    )


def _magnetometer(node: XmlNode, context: Context) -> Magnetometer:
    return Magnetometer(field=(_inner(node, "x", context), _inner(node, "y", context), _inner(node, "z", context)))


def _air_pressure(node: XmlNode, context: Context) -> AirPressure:
    height = node.number("reference_altitude", default=0.0)
    return AirPressure(reference_altitude=height, pressure=_inner(node, "pressure", context))


def _air_speed(node: XmlNode, context: Context) -> AirSpeed:
    return AirSpeed(pressure=_inner(node, "pressure", context))


def _inner(node: XmlNode, tag: str, context: Context) -> Noise:
    """Return the noise of one quantity."""
    quantity = node.find(tag)
    return Noise() if quantity is None else read_noise(quantity.find("noise"), context)


_READERS: Mapping[str, tuple[str, Instrument, _Read]] = {
    "air_pressure": ("air_pressure", AirPressure(), _air_pressure),
    "air_speed": ("air_speed", AirSpeed(), _air_speed),
    "altimeter": ("altimeter", Altimeter(), _altimeter),
    "logical_camera": ("logical_camera", LogicalCamera(), _logical_camera),
    "magnetometer": ("magnetometer", Magnetometer(), _magnetometer),
    "sonar": ("sonar", Sonar(), _sonar),
    "wireless_receiver": ("transceiver", Transceiver(), _transceiver),
    "wireless_transmitter": ("transceiver", Transceiver(), _transceiver),
}
"""Type → settings element, default, reader."""
