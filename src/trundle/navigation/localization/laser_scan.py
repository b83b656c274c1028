"""Scans as seen from the robot."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.ros import TransformBuffer, TransformError, to_nsec
from trundle.spatial import Pose

from ..scan_messages import read_ranges
from .amcl_settings import AmclSettings

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs


@dataclass(frozen=True, slots=True, kw_only=True)
class Beams:
    """Ranges of a scan and their directions from the robot."""

    ranges: NDArray[np.float64]
    """(n,) [m]; a range of range_max_m or more hit nothing."""
    bearings: NDArray[np.float64]
    """(n,) in the robot's frame [rad]."""
    range_max_m: float
    x: float
    """Position of the laser on the robot [m]."""
    y: float


class ScanReader:
    """Reads scans of lasers anywhere on the robot, upside down too."""

    def __init__(self, buffer: TransformBuffer, settings: AmclSettings) -> None:
        self._buffer = buffer
        self._settings = settings
        self.fault = ""
        """Why the last scan could not be read."""

    def read(self, scan: "sensor_msgs.LaserScan") -> Beams | None:
        """Return the beams; None: `fault` says why not."""
        settings = self._settings
        try:
            base_from_laser = self._buffer.lookup_transform(
                settings.base_frame_id, scan.header.frame_id, to_nsec(scan.header.stamp)
            ).pose
        except TransformError as error:
            self.fault = str(error)
            return None
        range_max_m, range_min_m = float(scan.range_max), float(scan.range_min)
        if settings.laser_max_range > 0.0:
            range_max_m = min(range_max_m, settings.laser_max_range)
        if settings.laser_min_range > 0.0:
            range_min_m = max(range_min_m, settings.laser_min_range)
        numbers = (scan.angle_min, scan.angle_increment, range_min_m, range_max_m)
        if not all(math.isfinite(number) for number in numbers) or range_max_m <= 0.0:
            self.fault = "its angles or ranges are not finite, or its maximum range is not positive"
            return None
        ranges = read_ranges(scan)
        ranges[ranges <= range_min_m] = range_max_m  # a range below the minimum means that nothing was measured
        first = _bearing(base_from_laser, scan.angle_min)
        second = _bearing(base_from_laser, scan.angle_min + scan.angle_increment)
        increment = math.remainder(second - first, math.tau)
        x, y, _ = base_from_laser.position
        return Beams(
            ranges=ranges,
            bearings=first + increment * np.arange(ranges.size, dtype=np.float64),
            range_max_m=range_max_m,
            x=x,
            y=y,
        )


def _bearing(base_from_laser: Pose, angle: float) -> float:
    """Return the direction of a beam in the robot's frame [rad]."""
    x, y, _ = base_from_laser.transform_vector((math.cos(angle), math.sin(angle), 0.0))
    return math.atan2(y, x)
