"""A laser scan as arrays."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from trundle.ros import to_nsec
from trundle.spatial import Pose, transform_points

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs


@dataclass(slots=True, kw_only=True)
class Scan:
    """A sensor_msgs/LaserScan; filters change it in place."""

    stamp_ns: int
    frame: str
    angle_min: float
    """[rad]"""
    angle_increment: float
    """[rad]"""
    time_increment: float
    """[s]"""
    scan_time: float
    """[s]"""
    range_min: float
    """[m]"""
    range_max: float
    """[m]"""
    ranges: NDArray[np.float32]
    """(n,) [m]"""
    intensities: NDArray[np.float32]
    """(n,); shorter if the laser measures no intensities."""

    @classmethod
    def read(cls, message: "sensor_msgs.LaserScan") -> Self:
        """Copy a message.

        Raises:
            ValueError: an angle or a bound of the ranges is not finite.
        """
        scan = cls(
            stamp_ns=to_nsec(message.header.stamp),
            frame=message.header.frame_id.lstrip("/"),
            angle_min=float(message.angle_min),
            angle_increment=float(message.angle_increment),
            time_increment=float(message.time_increment),
            scan_time=float(message.scan_time),
            range_min=float(message.range_min),
            range_max=float(message.range_max),
            ranges=np.array(message.ranges, dtype=np.float32),
            intensities=np.array(message.intensities, dtype=np.float32),
        )
        if not math.isfinite(scan.angle_min + scan.angle_increment + scan.range_min) or math.isnan(scan.range_max):
            raise ValueError("its angles or the bounds of its ranges are not finite")
        scan.ranges[np.isnan(scan.ranges)] = np.nan  # not a signaling one, of which NumPy warns
        return scan

    @property
    def angles(self) -> NDArray[np.float64]:
        """Direction of each beam in the laser's frame [rad]."""
        return self.angle_min + self.angle_increment * np.arange(self.ranges.size, dtype=np.float64)

    @property
    def is_measured(self) -> NDArray[np.bool_]:
        """True for each range within the laser's bounds."""
        return (self.ranges >= self.range_min) & (self.ranges < self.range_max)

    def points(self, target_from_laser: Pose) -> NDArray[np.float64]:
        """Return the end of each beam in a frame: (n, 3) [m]; not finite where nothing was measured."""
        angles, ranges = self.angles, self.ranges.astype(np.float64)
        ranges[~self.is_measured] = np.nan
        return transform_points(
            target_from_laser, np.stack([ranges * np.cos(angles), ranges * np.sin(angles), 0.0 * ranges], axis=1)
        )

    def fields(self) -> dict[str, Any]:
        """Return the message's fields."""
        return {
            "header": {"stamp": self.stamp_ns, "frame_id": self.frame},
            "angle_min": self.angle_min,
            "angle_max": self.angle_min + self.angle_increment * max(self.ranges.size - 1, 0),
            "angle_increment": self.angle_increment,
            "time_increment": self.time_increment,
            "scan_time": self.scan_time,
            "range_min": self.range_min,
            "range_max": self.range_max,
            "ranges": self.ranges,
            "intensities": self.intensities,
        }
