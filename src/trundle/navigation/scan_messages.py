"""Scans in messages."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_MAX_BEAMS = 100_000


def read_ranges(scan: "sensor_msgs.LaserScan") -> NDArray[np.float64]:
    """Return a copy of the ranges [m]."""
    with np.errstate(invalid="ignore"):  # of a signaling NaN
        return np.array(scan.ranges, dtype=np.float64)


def read_beams(scan: "sensor_msgs.LaserScan") -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the ranges [m] and the angles [rad] of the beams.

    Raises:
        ValueError: its angles or the lower bound of its ranges are not finite, or there are too many beams.
    """
    ranges = read_ranges(scan)
    if ranges.size > _MAX_BEAMS:
        raise ValueError(f"it has {ranges.size} beams, more than {_MAX_BEAMS}")
    if not np.isfinite(scan.angle_min + scan.angle_increment + scan.range_min):
        raise ValueError("its angles or the bounds of its ranges are not finite")
    return ranges, scan.angle_min + scan.angle_increment * np.arange(ranges.size, dtype=np.float64)


def beam_ends(scan: "sensor_msgs.LaserScan") -> NDArray[np.float64]:
    """Return the ends (n, 2) of the measured beams in the laser's frame [m], in their order.

    Raises:
        ValueError: as `read_beams`.
    """
    ranges, angles = read_beams(scan)
    is_measured = np.isfinite(ranges) & (ranges > scan.range_min) & (ranges < scan.range_max)
    ranges, angles = ranges[is_measured], angles[is_measured]
    return np.stack([ranges * np.cos(angles), ranges * np.sin(angles)], axis=1)
