"""Messages of sensors and navigation, for rviz and the page to draw."""

import math
import struct
from collections.abc import Mapping, Sequence
from typing import Any

HEADER = {"frame_id": "map"}
IN_PLATE = {"frame_id": "plate"}

Message = tuple[str, str, Mapping[str, Any]]


def point(x: float, y: float, z: float = 0.0) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


def pose(x: float, y: float, z: float = 0.0, yaw: float = 0.0) -> dict[str, Any]:
    turn = {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}
    return {"position": point(x, y, z), "orientation": turn}


def ring(count: int, radius: float = 2.0) -> list[dict[str, Any]]:
    """Return poses along most of a circle, tangential to it."""
    angles = [1.8 * math.pi * index / count for index in range(count)]
    return [pose(radius * math.cos(a), radius * math.sin(a), 0.2, a + math.pi / 2) for a in angles]


def covariance(*variances: float) -> list[float]:
    """Return a covariance in which x and y are correlated."""
    matrix = [0.0] * 36
    for row, variance in enumerate(variances):
        matrix[7 * row] = variance
    matrix[1] = matrix[6] = 0.1
    return matrix


def cloud(points: Sequence[Sequence[float]], last: str) -> dict[str, Any]:
    """Return a PointCloud2 of x, y, z and one further channel, float32 or packed colors."""
    form = "<fffI" if last == "rgb" else "<ffff"
    names = ("x", "y", "z", last)
    return {
        "header": HEADER,
        "height": 1,
        "width": len(points),
        "fields": [{"name": name, "offset": 4 * word, "datatype": 7, "count": 1} for word, name in enumerate(names)],
        "point_step": 16,
        "row_step": 16 * len(points),
        "data": b"".join(struct.pack(form, *point) for point in points),
        "is_dense": True,
    }


SPIRAL = [(0.3 * a * math.cos(a), 0.3 * a * math.sin(a), 0.25 * a, a) for a in (i / 6 for i in range(6, 48))]
COLORS = [(x, y, z, (0xFF0000, 0x00FF00, 0x2040FF, 0xFFFF00)[i % 4]) for i, (x, y, z, _) in enumerate(SPIRAL)]
MANY = [(2 * math.cos(i / 40), 2 * math.sin(i / 40), i / 1500, float(i)) for i in range(2000)]
SCAN = {
    "header": IN_PLATE,
    "angle_min": -1.5,
    "angle_max": 1.5,
    "angle_increment": 0.05,
    "range_min": 0.1,
    "range_max": 8.0,
    "ranges": [3.0 + 0.5 * math.sin(i / 5) for i in range(61)],
    "intensities": [float(i) for i in range(61)],
}
MAP = {
    "header": HEADER,
    "info": {"resolution": 0.2, "width": 20, "height": 20, "origin": pose(-2, -2)},
    "data": [-1 if x < 5 and y < 5 else (x * 5 + y) % 101 for y in range(20) for x in range(20)],
}
TWIST = {"linear": point(1, 0, 0.3), "angular": point(0, 0.4, 0.8)}
SENSOR = {"header": IN_PLATE, "variance": 0.0}


def depth() -> list[Message]:
    size = {"width": 64, "height": 48}
    header = {"frame_id": "map", "stamp": {"secs": 1, "nsecs": 0}}
    depth = b"".join(struct.pack("<f", 1.5 + u / 40) for _ in range(48) for u in range(64))
    color = bytes(part for v in range(48) for u in range(64) for part in (4 * u, 5 * v, 90))
    k = [60.0, 0.0, 32.0, 0.0, 60.0, 24.0, 0.0, 0.0, 1.0]
    p = [60.0, 0.0, 32.0, 0.0, 0.0, 60.0, 24.0, 0.0, 0.0, 0.0, 1.0, 0.0]
    images = "sensor_msgs/Image"
    return [
        ("/depth/camera_info", "sensor_msgs/CameraInfo", {"header": header, "K": k, "P": p, **size}),
        ("/depth/image", images, {"header": header, "encoding": "32FC1", "step": 256, "data": depth, **size}),
        ("/depth/color", images, {"header": header, "encoding": "rgb8", "step": 192, "data": color, **size}),
    ]
