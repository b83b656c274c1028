"""depthimage_to_laserscan: converts the middle rows of a depth image to a laser scan."""

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trundle.ros import Node, Option, Options, ReconfigureServer

from .host import NodeHost
from .private_parameters import private_parameters

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_ENCODINGS: dict[str, tuple[type[np.generic], float]] = {
    "32FC1": (np.float32, 1.0),
    "16UC1": (np.uint16, 0.001),
    "mono16": (np.uint16, 0.001),
}
"""Encoding → dtype, unit [m]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Pinhole:
    """Intrinsics of the camera [px]."""

    focal_px: float
    center_x_px: float
    center_y_px: float


def scan_from_depths(
    depths: NDArray[np.float64], camera: Pinhole, *, rows: int, min_range_m: float, max_range_m: float
) -> tuple[float, float, NDArray[np.float32]]:
    """Convert to a scan: angle_min, angle_max [rad] and one range [m] per column, from right to left.

    Args:
        depths: (height, width) along the optical axis [m]; NaN or infinite without measurement.
        camera: intrinsics.
        rows: number of rows about the middle; the nearest range of a column is used.
        min_range_m: minimum range [m]; other ranges become NaN, or infinite if infinity was measured.
        max_range_m: maximum range [m].
    """
    height, width = depths.shape
    first = max(0, int(camera.center_y_px - rows / 2))
    band = depths[first : min(first + rows, height)]
    slopes = (np.arange(width) - camera.center_x_px) / camera.focal_px
    ranges = band * np.hypot(1.0, slopes)
    is_valid = np.isfinite(ranges) & (ranges >= min_range_m) & (ranges <= max_range_m)
    nearest = np.where(is_valid, ranges, np.inf).min(axis=0, initial=np.inf)
    empty = np.where(np.isinf(band).any(axis=0), np.inf, np.nan)
    columns = np.where(np.isfinite(nearest), nearest, empty)
    angle_min, angle_max = -math.atan(slopes[-1]), -math.atan(slopes[0])
    # Columns are evenly spaced in the image, rays in angle; if two columns fall on one ray, the nearer range is used.
    increment = (angle_max - angle_min) / max(width - 1, 1)
    ray_indices = np.clip(np.rint((-np.arctan(slopes) - angle_min) / increment).astype(int), 0, width - 1)
    scan = np.full(width, np.nan)
    for index, value in zip(ray_indices.tolist(), columns.tolist(), strict=True):
        scan[index] = np.fmin(scan[index], value)
    return angle_min, angle_max, scan.astype(np.float32)


class DepthImageToLaserScan:
    """Converts `image` with its camera_info to `scan`."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._camera: Pinhole | None = None
        self._is_logged = False

    async def run(self) -> int:
        """Convert until cancelled."""
        node = self._node
        settings = await private_parameters(node)
        self._rows = settings.integer("scan_height", 1)
        self._scan_time_s = settings.number("scan_time", 1.0 / 30.0)
        self._min_range_m, self._max_range_m = settings.number("range_min", 0.45), settings.number("range_max", 10.0)
        self._frame = settings.text("output_frame_id", settings.text("output_frame", "camera_depth_frame"))
        self._scan = node.advertise("scan", "sensor_msgs/LaserScan", queue_size=10)
        ReconfigureServer(node, self._options(), self._reconfigure)
        topic = node.resolve("image")
        info = f"{topic.rpartition('/')[0]}/camera_info"
        node.subscribe(info, "sensor_msgs/CameraInfo", self._on_camera_info, queue_size=1)
        node.subscribe("image", "sensor_msgs/Image", self._on_image, queue_size=1)
        await node.closed.wait()
        return 0

    def _options(self) -> list[Option]:
        """Options of the original's Depth.cfg."""
        return [
            Option(name="scan_height", value=self._rows, lower=1, upper=500, description="Rows to use"),
            Option(
                name="scan_time", value=self._scan_time_s, lower=0.0, upper=1.0, description="Time between scans [s]"
            ),
            Option(name="range_min", value=self._min_range_m, lower=0.0, upper=10.0, description="Minimum range [m]"),
            Option(name="range_max", value=self._max_range_m, lower=0.0, upper=10.0, description="Maximum range [m]"),
            Option(name="output_frame_id", value=self._frame, description="Frame of the scan"),
        ]

    def _reconfigure(self, values: Options) -> Options:
        self._rows, self._scan_time_s = int(values["scan_height"]), float(values["scan_time"])
        self._min_range_m, self._max_range_m = float(values["range_min"]), float(values["range_max"])
        self._frame = str(values["output_frame_id"])
        return values

    def _on_camera_info(self, info: "sensor_msgs.CameraInfo") -> None:
        k = [float(value) for value in info.K]
        self._camera = Pinhole(focal_px=k[0], center_x_px=k[2], center_y_px=k[5]) if k[0] > 0.0 else None

    def _on_image(self, image: "sensor_msgs.Image") -> None:
        if self._camera is None or not self._scan.has_subscribers:
            return
        if image.encoding not in _ENCODINGS:
            if not self._is_logged:
                self._node.log.error(
                    f"encoding {image.encoding!r} is not a depth encoding; supported: {', '.join(_ENCODINGS)}"
                )
            self._is_logged = True
            return
        self._scan.publish(self._fields(image, self._camera))

    def _fields(self, image: "sensor_msgs.Image", camera: Pinhole) -> dict[str, Any]:
        min_range_m, max_range_m = self._min_range_m, self._max_range_m
        depths = read_depths(image)
        angle_min, angle_max, ranges = scan_from_depths(
            depths, camera, rows=self._rows, min_range_m=min_range_m, max_range_m=max_range_m
        )
        return {
            "header": {"stamp": image.header.stamp, "frame_id": self._frame},
            "angle_min": angle_min,
            "angle_max": angle_max,
            "angle_increment": (angle_max - angle_min) / max(len(ranges) - 1, 1),
            "scan_time": self._scan_time_s,
            "range_min": min_range_m,
            "range_max": max_range_m,
            "ranges": ranges,
        }


def read_depths(image: "sensor_msgs.Image") -> NDArray[np.float64]:
    """Return the depths (height, width) of a depth image [m]; zeros of integer encodings become NaN."""
    dtype, unit_m = _ENCODINGS[image.encoding]
    stored_dtype = np.dtype(dtype).newbyteorder(">" if image.is_bigendian else "<")
    rows = np.asarray(image.data, dtype=np.uint8).reshape(image.height, image.step)
    used_bytes = np.ascontiguousarray(rows[:, : image.width * stored_dtype.itemsize])
    depths = used_bytes.view(stored_dtype).astype(np.float64) * unit_m
    if unit_m != 1.0:
        depths[depths == 0.0] = np.nan
    return depths
