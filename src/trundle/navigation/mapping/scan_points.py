"""Laser scans as points on the robot, for the mappers of pose graphs."""

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose, transform_points

from ..scan_messages import read_beams

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs


class ScanPoints(NamedTuple):
    """Ends of a scan's beams on the robot."""

    origin: tuple[float, float]
    """Of the beams [m]."""
    hits: NDArray[np.float64]
    """(n, 2) ends that hit something, in the order of the beams [m]."""
    misses: NDArray[np.float64]
    """(m, 2) ends of what is free along beams without a hit [m]."""


def read_points(
    scan: "sensor_msgs.LaserScan",
    base_from_laser: Pose,
    *,
    usable_range: float,
    min_range: float = 0.0,
    miss_range: float | None = None,
) -> ScanPoints:
    """Project the beams of a scan onto the ground.

    Args:
        scan: sensor_msgs/LaserScan; a range of at least range_max is a beam without a hit.
        base_from_laser: pose of the laser on the robot.
        usable_range: longer beams are free up to there [m].
        min_range: shorter ranges are left out [m].
        miss_range: length of beams without a hit [m]; None: as long as usable.

    Raises:
        ValueError: its angles or bounds are not finite, there are too many beams, or nothing was measured.
    """
    ranges, angles = read_beams(scan)
    count = ranges.size
    limit = min(usable_range, float(scan.range_max)) if scan.range_max > 0.0 else usable_range
    is_measured = ranges >= max(scan.range_min, min_range)  # not of NaN
    is_hit = is_measured & (ranges < limit)
    if not is_measured.any():
        raise ValueError(f"none of its {count} beams measured anything" if count else "it has no beams")
    lengths = np.where(is_hit, ranges, min(limit, limit if miss_range is None else miss_range))
    directions = np.stack([np.cos(angles), np.sin(angles), np.zeros(count)], axis=1)
    ends = transform_points(base_from_laser, lengths[:, None] * directions)[:, :2]
    x, y, _ = base_from_laser.position
    return ScanPoints(
        origin=(x, y),
        hits=np.ascontiguousarray(ends[is_hit]),
        misses=np.ascontiguousarray(ends[is_measured & ~is_hit]),
    )
