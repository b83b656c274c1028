"""Values in sensor readings that can be plotted, by the sensor's SDF type."""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Any, TypeAlias

import numpy as np

from trundle.spatial import rpy_from_quaternion

ReadingValue: TypeAlias = tuple[str, Callable[[Any], float]]
"""Unit, and the function that returns the value of a reading; NaN: the reading has none."""


def _axes(
    name: str, unit: str, part: Callable[[Any, int], float], *, names: tuple[str, str, str] = ("x", "y", "z")
) -> dict[str, ReadingValue]:
    return {f"{name}.{axis_name}": (unit, partial(_part, part, axis)) for axis, axis_name in enumerate(names)}


def _part(part: Callable[[Any, int], float], axis: int, reading: Any) -> float:
    return part(reading, axis)


def _vector(name: str, unit: str) -> dict[str, ReadingValue]:
    """Return the components of the vector at a path of attributes."""

    def part(reading: Any, axis: int) -> float:
        for attribute in name.split("."):
            reading = getattr(reading, attribute)
        return reading[axis]

    return _axes(name, unit, part)


def _angle(reading: Any, axis: int) -> float:
    return rpy_from_quaternion(reading.orientation)[axis]


def _nearest(reading: Any) -> float:
    hits = reading.ranges[np.isfinite(reading.ranges)]
    return float(hits.min()) if len(hits) else float("nan")


def _contact_force(reading: Any, axis: int) -> float:
    """Return a component of the summed force in the reading's last step."""
    last = max((record.time_ns for record in reading.contacts), default=0)
    return sum(record.wrench.force[axis] for record in reading.contacts if record.time_ns == last)


_RAYS: Mapping[str, ReadingValue] = {"ranges.min": ("m", _nearest)}
_PRESSURE: Mapping[str, ReadingValue] = {"pressure": ("Pa", lambda r: r.pressure)}
_FIX: Mapping[str, ReadingValue] = {
    "latitude": ("°", lambda r: r.latitude_deg),
    "longitude": ("°", lambda r: r.longitude_deg),
    "altitude": ("m", lambda r: r.altitude),
}
SENSOR_VALUES: Mapping[str, Mapping[str, ReadingValue]] = {
    "air_pressure": _PRESSURE,
    "air_speed": _PRESSURE,
    "altimeter": {"height": ("m", lambda r: r.height), "velocity": ("m/s", lambda r: r.velocity)},
    "contact": _axes("force", "N", _contact_force),
    "force_torque": _vector("wrench.force", "N") | _vector("wrench.torque", "N·m"),
    "gps": _FIX,
    "navsat": _FIX,
    **dict.fromkeys(("gpu_lidar", "gpu_ray", "lidar", "ray"), _RAYS),
    "imu": _axes("orientation", "rad", _angle, names=("roll", "pitch", "yaw"))
    | _vector("angular_velocity", "rad/s")
    | _vector("linear_acceleration", "m/s²"),
    "magnetometer": _vector("field", "T"),
    "sonar": {"range": ("m", lambda r: r.range_m)},
}
