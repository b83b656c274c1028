"""Filters that compare a beam with the beams beside it."""

from typing import Annotated

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.robots.parameters import RosParameters
from trundle.ros import Node, TransformBuffer

from .filter import ScanFilter
from .scan import Scan

_Count = Annotated[int, Meta(ge=0, le=100)]
_Length = Annotated[float, Meta(ge=0.0, le=100.0)]
_MAX_CELLS = 50_000_000
"""Maximum number of comparisons between beams and neighbors; a scan that needs more is refused."""


class ShadowsSettings(Struct):
    """Angles [°]."""

    min_angle: Annotated[float, Meta(ge=0.0, le=360.0)] = 10.0
    max_angle: Annotated[float, Meta(ge=0.0, le=360.0)] = 170.0
    window: _Count = 1
    neighbors: _Count = 20
    remove_shadow_start_point: bool = False


class ScanShadowsFilter(ScanFilter):
    """Removes beams that graze an edge: the line to a neighbor makes a small angle with the beam.

    If a beam has such a neighbor within `window`, those of the `neighbors` beams beside it that are farther away than
    the beam are removed.
    """

    Settings = ShadowsSettings
    required = ("min_angle", "max_angle", "window")

    def __init__(self, name: str, parameters: RosParameters, node: Node, buffer: TransformBuffer) -> None:
        without = {"neighbors": 0, "remove_shadow_start_point": False}
        super().__init__(name, parameters.with_defaults(without), node, buffer)

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        settings: ShadowsSettings = self.settings
        min_tangent = abs(np.tan(np.radians(min(settings.min_angle, 90.0))))
        max_tangent = -abs(np.tan(np.radians(min(max(settings.max_angle, 90.0), 180.0))))
        ranges = scan.ranges.astype(np.float64)
        grazes = np.zeros(ranges.size, dtype=bool)
        with np.errstate(divide="ignore", invalid="ignore"):
            for offset in _offsets(settings.window):
                there, here = _shifted(ranges.size, offset)
                angle = abs(offset * scan.angle_increment)
                across = np.abs(ranges[there] * np.sin(angle))
                tangent = across / (ranges[here] - ranges[there] * np.cos(angle))
                grazes[here] |= np.where(tangent > 0.0, tangent < min_tangent, tangent > max_tangent)
        for offset in _offsets(settings.neighbors):
            there, here = _shifted(ranges.size, offset)
            scan.ranges[there][grazes[here] & (ranges[here] < ranges[there])] = np.nan
        if settings.remove_shadow_start_point:
            scan.ranges[grazes] = np.nan
        return True


class SpeckleSettings(Struct):
    filter_type: Annotated[int, Meta(ge=0, le=1)] = 0
    """0: beams of a window have similar ranges; 1: points have neighbors within a radius."""
    max_range: _Length = 2.0
    """[m]; beyond it nothing is removed."""
    max_range_difference: _Length = 0.4
    """[m]"""
    filter_window: _Count = 4


class LaserScanSpeckleFilter(ScanFilter):
    """Removes beams without enough neighbors, such as those that hit dust."""

    Settings = SpeckleSettings

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        settings: SpeckleSettings = self.settings
        ranges, window = scan.ranges.astype(np.float64), settings.filter_window
        if ranges.size <= window + 1:
            self.fault = f"it has {ranges.size} beams, not more than filter_window + 1"
            return False
        if ranges.size * window > _MAX_CELLS:
            self.fault = f"{ranges.size} beams are too many"
            return False
        is_kept = ranges > settings.max_range
        with np.errstate(invalid="ignore"):
            if settings.filter_type == 0:
                is_kept |= _in_windows(ranges, max(window, 1), settings.max_range_difference)
            else:
                count = np.zeros(ranges.size, dtype=int)
                for offset in _offsets(window):
                    there, here = _shifted(ranges.size, offset)
                    product = ranges[here] * ranges[there] * np.cos(offset * scan.angle_increment)
                    square = ranges[here] ** 2 + ranges[there] ** 2 - 2.0 * product
                    count[here] += square <= settings.max_range_difference**2
                is_kept |= count >= window
        scan.ranges[~is_kept] = np.nan
        return True


def _in_windows(ranges: NDArray[np.float64], window: int, max_difference: float) -> NDArray[np.bool_]:
    """Return True for the beams of each window whose ranges differ little from its first."""
    windows = np.lib.stride_tricks.sliding_window_view(ranges, window)
    is_similar = ~(np.isnan(windows) | (np.abs(windows - windows[:, :1]) > max_difference)).any(axis=1)
    is_kept = np.zeros(ranges.size, dtype=bool)
    for offset in range(window):
        is_kept[offset : offset + is_similar.size] |= is_similar
    return is_kept


def _offsets(window: int) -> list[int]:
    """Return −window … window without 0."""
    return [offset for offset in range(-window, window + 1) if offset]


def _shifted(count: int, offset: int) -> tuple[slice, slice]:
    """Return slices of the neighbors at an offset, and of the beams that have them."""
    length = max(count - abs(offset), 0)
    there, here = max(offset, 0), max(-offset, 0)
    return slice(there, there + length), slice(here, here + length)
