"""Filters that treat each beam alone."""

from typing import Annotated

import numpy as np
from msgspec import Meta, Struct

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer

from .filter import ScanFilter
from .scan import Scan

_Threshold = Annotated[float, Meta(ge=0.0, le=100_000.0)]
_Angle = Annotated[float, Meta(ge=-np.pi, le=np.pi)]
_INTERPOLATION_MARGIN_M = 0.01


class RangeSettings(Struct):
    """[m]"""

    lower_threshold: _Threshold = 0.0
    upper_threshold: _Threshold = 100_000.0
    use_message_range_limits: bool = False
    lower_replacement_value: float = 0.0
    upper_replacement_value: float = 100_000.0


class LaserScanRangeFilter(ScanFilter):
    """Replaces ranges at or beyond two thresholds."""

    Settings = RangeSettings

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        settings: RangeSettings = self.settings
        lower, upper = settings.lower_threshold, settings.upper_threshold
        if settings.use_message_range_limits:
            lower, upper = scan.range_min, scan.range_max
        is_low, is_high = scan.ranges <= lower, scan.ranges >= upper
        scan.ranges[is_high] = settings.upper_replacement_value
        scan.ranges[is_low] = settings.lower_replacement_value
        return True


class IntensitySettings(Struct):
    lower_threshold: _Threshold = 8000.0
    upper_threshold: _Threshold = 100_000.0
    invert: bool = False
    filter_override_range: bool = True
    filter_override_intensity: bool = False


class LaserScanIntensityFilter(ScanFilter):
    """Removes beams whose intensity is at or beyond two thresholds."""

    Settings = IntensitySettings

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        settings: IntensitySettings = self.settings
        count = min(scan.ranges.size, scan.intensities.size)
        intensities = scan.intensities[:count]
        is_out = (intensities <= settings.lower_threshold) | (intensities >= settings.upper_threshold)
        is_out ^= settings.invert
        if settings.filter_override_range:
            scan.ranges[:count][is_out] = np.nan
        if settings.filter_override_intensity:
            scan.intensities[:count] = np.where(is_out, 0.0, 1.0)
        return True


class BoundsSettings(Struct):
    """[rad]"""

    lower_angle: float = 0.0
    upper_angle: float = 0.0


class LaserScanAngularBoundsFilter(ScanFilter):
    """Keeps the beams between two angles, and drops all others."""

    Settings = BoundsSettings
    required = ("lower_angle", "upper_angle")
    is_reconfigurable = False

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        angles = scan.angles
        kept = np.flatnonzero((angles >= self.settings.lower_angle) & (angles <= self.settings.upper_angle))
        first, end = (int(kept[0]), int(kept[-1]) + 1) if kept.size else (0, 0)
        scan.ranges, scan.intensities = scan.ranges[first:end], scan.intensities[first:end]
        scan.angle_min += first * scan.angle_increment
        scan.stamp_ns += round(first * scan.time_increment * 1e9)
        return True


class LaserScanAngularBoundsFilterInPlace(ScanFilter):
    """Sets the ranges between two angles to 1 m more than the maximum."""

    Settings = BoundsSettings
    required = ("lower_angle", "upper_angle")
    is_reconfigurable = False

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        angles = scan.angles
        _clear(scan, (angles > self.settings.lower_angle) & (angles < self.settings.upper_angle))
        return True


class SectorSettings(Struct):
    """[rad], [m]"""

    angle_min: _Angle = 0.0
    angle_max: _Angle = 0.0
    range_min: _Threshold = 0.0
    range_max: _Threshold = 100_000.0
    clear_inside: bool = True
    invert: bool = False


class LaserScanSectorFilter(ScanFilter):
    """Sets the ranges inside or outside a sector of a ring to 1 m more than the maximum."""

    Settings = SectorSettings

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        settings: SectorSettings = self.settings
        width, offsets = settings.angle_max - settings.angle_min, scan.angles - settings.angle_min
        if width < 0.0:
            width += 2.0 * np.pi
            offsets[offsets < 0.0] += 2.0 * np.pi
        is_inside = (offsets > 0.0) & (offsets < width)
        is_inside &= (scan.ranges > settings.range_min) & (scan.ranges < settings.range_max)
        _clear(scan, is_inside == (settings.clear_inside and not settings.invert))
        return True


def _clear(scan: Scan, is_cleared: np.ndarray) -> None:
    scan.ranges[is_cleared] = scan.range_max + 1.0
    scan.intensities[is_cleared[: scan.intensities.size].nonzero()] = 0.0


class InterpolationSettings(Struct):
    """No parameters."""


class InterpolationFilter(ScanFilter):
    """Fills ranges that were not measured with the mean of the nearest measured ones on both sides.

    At an end of the scan, the maximum range minus 0.01 m counts as the neighbor, as in the original.
    """

    Settings = InterpolationSettings
    is_reconfigurable = False

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        is_measured = (scan.ranges > scan.range_min) & (scan.ranges < scan.range_max)
        edge = scan.range_max - _INTERPOLATION_MARGIN_M
        padded = np.concatenate(([edge], scan.ranges.astype(np.float64), [edge]))
        places = np.flatnonzero(np.concatenate(([True], is_measured, [True])))
        gaps = np.flatnonzero(~is_measured) + 1
        after = np.searchsorted(places, gaps)
        scan.ranges[gaps - 1] = (padded[places[after - 1]] + padded[places[after]]) / 2.0
        return True


class LaserScanMaskFilter(ScanFilter):
    """Removes beams by their numbers, which `masks` lists for each frame."""

    Settings = InterpolationSettings
    is_reconfigurable = False

    def __init__(self, name: str, parameters: RosParameters, node: Node, buffer: TransformBuffer) -> None:
        super().__init__(name, parameters, node, buffer)
        masks = parameters.section("masks")
        if not masks.names():
            raise ParamError(f"parameter {masks.namespace} is not set; it maps frames to lists of beams' numbers")
        self._masks = {frame.lstrip("/"): _numbers(masks, frame) for frame in masks.names()}

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        numbers = self._masks.get(scan.frame, np.zeros(0, dtype=int))
        scan.ranges[numbers[numbers < scan.ranges.size]] = np.nan
        return True


def _numbers(masks: RosParameters, frame: str) -> np.ndarray:
    numbers = masks.items(frame)
    if not all(isinstance(number, int) and number >= 0 for number in numbers):
        raise ParamError(f"parameter {masks.namespace}/{frame} is not a list of beams' numbers")
    return np.array(numbers, dtype=int)
