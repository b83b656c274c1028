"""Filters that remove beams that end in a region of space, such as the robot itself."""

from typing import Annotated

import numpy as np
from msgspec import Meta, Struct
from numpy.typing import NDArray

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, TransformBuffer, TransformError

from .filter import ScanFilter
from .scan import Scan

_Length = Annotated[float, Meta(ge=-100.0, le=100.0)]
_MAX_CORNERS = 1000


class _RegionFilter(ScanFilter):
    """Removes beams that end in a region of a frame."""

    def apply(self, scan: Scan) -> bool:
        """See `ScanFilter`."""
        frame = self._frame().lstrip("/")
        try:
            pose = self._buffer.lookup_transform(frame, scan.frame, scan.stamp_ns).pose
        except TransformError as error:
            self.fault = str(error)
            return False
        points = scan.points(pose)
        is_removed = self._is_inside(points) != getattr(self.settings, "invert", False)
        scan.ranges[is_removed & np.isfinite(points[:, 0])] = np.nan
        return True

    def _frame(self) -> str:
        raise NotImplementedError

    def _is_inside(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        raise NotImplementedError


class FootprintSettings(Struct):
    inscribed_radius: float = 0.0
    """Half the side of a square about base_link [m]."""


class LaserScanFootprintFilter(_RegionFilter):
    """Removes beams that end in a square about base_link."""

    Settings = FootprintSettings
    required = ("inscribed_radius",)
    is_reconfigurable = False

    def _frame(self) -> str:
        return "base_link"

    def _is_inside(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        radius = self.settings.inscribed_radius
        return (np.abs(points[:, 0]) <= radius) & (np.abs(points[:, 1]) <= radius)


class BoxSettings(Struct):
    """[m]"""

    box_frame: str = "base_link"
    min_x: _Length = -1.0
    max_x: _Length = 1.0
    min_y: _Length = -1.0
    max_y: _Length = 1.0
    min_z: _Length = -1.0
    max_z: _Length = 1.0
    invert: bool = False


class LaserScanBoxFilter(_RegionFilter):
    """Removes beams that end in a box, or outside it."""

    Settings = BoxSettings

    def _frame(self) -> str:
        return self.settings.box_frame

    def _is_inside(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        box: BoxSettings = self.settings
        lower, upper = (box.min_x, box.min_y, box.min_z), (box.max_x, box.max_y, box.max_z)
        return np.logical_and.reduce((points > lower) & (points < upper), axis=1)


class PolygonSettings(Struct):
    polygon_frame: str = "base_link"
    polygon_padding: Annotated[float, Meta(ge=0.0, le=100.0)] = 0.0
    """[m]"""
    invert: bool = False


class LaserScanPolygonFilter(_RegionFilter):
    """Removes beams that end above a polygon, or outside it; publishes `~NAME/polygon`."""

    Settings = PolygonSettings
    required = ("polygon_frame",)

    def __init__(self, name: str, parameters: RosParameters, node: Node, buffer: TransformBuffer) -> None:
        super().__init__(name, parameters, node, buffer)
        self._corners = _read_corners(parameters)
        topic = node.advertise(f"~{name}/polygon", "geometry_msgs/PolygonStamped", latch=True, queue_size=1)
        points = [{"x": x, "y": y} for x, y in self._padded().tolist()]
        topic.publish({"header": {"frame_id": self._frame()}, "polygon": {"points": points}})

    def _frame(self) -> str:
        return self.settings.polygon_frame

    def _padded(self) -> NDArray[np.float64]:
        return self._corners + np.sign(self._corners) * self.settings.polygon_padding

    def _is_inside(self, points: NDArray[np.float64]) -> NDArray[np.bool_]:
        """A point is inside with an odd number of edges to its right."""
        corners = self._padded()
        ends, x, y = np.roll(corners, 1, axis=0), points[:, 0], points[:, 1]
        is_inside = np.zeros(len(points), dtype=bool)
        with np.errstate(divide="ignore", invalid="ignore"):
            for (x0, y0), (x1, y1) in zip(corners, ends, strict=True):
                is_inside ^= ((y0 > y) != (y1 > y)) & (x < (x1 - x0) * (y - y0) / (y1 - y0) + x0)
        return is_inside


def _read_corners(parameters: RosParameters) -> NDArray[np.float64]:
    """Return the corners (n, 2) of `polygon` [m]."""
    items = parameters.items("polygon")
    name = f"parameter {parameters.namespace}/polygon"
    if not 3 <= len(items) <= _MAX_CORNERS:
        raise ParamError(f"{name} has {len(items)} corners; it is a list of 3 to {_MAX_CORNERS} pairs [x, y]")
    try:
        corners = np.array(items, dtype=np.float64)
    except (TypeError, ValueError):
        corners = np.zeros(0)
    if corners.shape != (len(items), 2) or not np.isfinite(corners).all():
        raise ParamError(f"{name} is not a list of pairs [x, y]")
    return corners
