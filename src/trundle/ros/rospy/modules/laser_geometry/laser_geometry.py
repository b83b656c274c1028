"""Projection of LaserScan messages to PointCloud2."""

from typing import Any

import numpy as np
from sensor_msgs.msg import PointField

from sensor_msgs.point_cloud2 import create_cloud


class LaserProjection:
    """Turns scans into clouds in the scan's frame."""

    LASER_SCAN_INVALID = -1.0
    LASER_SCAN_MIN_RANGE = -2.0
    LASER_SCAN_MAX_RANGE = -3.0

    class ChannelOption:
        """Optional fields of the cloud, as bits of a sum; x, y and z are always present."""

        NONE = 0x00
        INTENSITY = 0x01
        INDEX = 0x02
        DISTANCE = 0x04
        TIMESTAMP = 0x08
        VIEWPOINT = 0x10
        DEFAULT = INTENSITY | INDEX

    def projectLaser(
        self, scan_in: Any, range_cutoff: float = -1.0, channel_options: int = ChannelOption.DEFAULT
    ) -> Any:
        """PointCloud2 of the valid ranges of a LaserScan.

        Args:
            scan_in: LaserScan.
            range_cutoff: maximum range, exclusive [m]; negative: the scan's range_max.
            channel_options: fields of the cloud, from ChannelOption.
        """
        ranges = np.asarray(scan_in.ranges, dtype=np.float64)
        max_range = scan_in.range_max if range_cutoff < 0 else min(range_cutoff, scan_in.range_max)
        valid = np.flatnonzero((ranges < max_range) & (ranges >= scan_in.range_min))
        angles = scan_in.angle_min + valid * scan_in.angle_increment
        ranges = ranges[valid]
        zeros = np.zeros(len(valid))
        columns = {"x": ranges * np.cos(angles), "y": ranges * np.sin(angles), "z": zeros}
        options = self.ChannelOption
        if channel_options & options.INTENSITY and len(scan_in.intensities):
            columns["intensity"] = np.asarray(scan_in.intensities)[valid]
        if channel_options & options.INDEX:
            columns["index"] = valid
        if channel_options & options.DISTANCE:
            columns["distances"] = ranges
        if channel_options & options.TIMESTAMP:
            columns["stamps"] = valid * scan_in.time_increment
        if channel_options & options.VIEWPOINT:
            columns |= {"vp_x": zeros, "vp_y": zeros, "vp_z": zeros}
        fields = [
            PointField(name, 4 * index, PointField.INT32 if name == "index" else PointField.FLOAT32, 1)
            for index, name in enumerate(columns)
        ]
        return create_cloud(scan_in.header, fields, np.column_stack(list(columns.values())))
