"""Messages that programs are given: those of sensors have readings, all others are zero but their stamps."""

from typing import Any

_RAYS, _SIDE = 720, 32
_CAMERA = [float(_SIDE), 0.0, _SIDE / 2, 0.0, float(_SIDE), _SIDE / 2, 0.0, 0.0, 1.0]
_FILLED: dict[str, dict[str, Any]] = {
    "sensor_msgs/LaserScan": {
        "angle_min": -3.14,
        "angle_max": 3.14,
        "angle_increment": 6.28 / _RAYS,
        "range_min": 0.1,
        "range_max": 10.0,
        "ranges": [2.0] * _RAYS,
        "intensities": [0.0] * _RAYS,
    },
    "sensor_msgs/Image": {
        "width": _SIDE,
        "height": _SIDE,
        "encoding": "rgb8",
        "step": 3 * _SIDE,
        "data": bytes(3 * _SIDE * _SIDE),
    },
    "sensor_msgs/CameraInfo": {"width": _SIDE, "height": _SIDE, "K": _CAMERA},
    "nav_msgs/OccupancyGrid": {
        "info": {"resolution": 0.1, "width": _SIDE, "height": _SIDE},
        "data": [0] * (_SIDE * _SIDE),
    },
}


def fields_of(kind: str) -> dict[str, Any]:
    """Return the fields of a message that is published to programs.

    Args:
        kind: type, such as sensor_msgs/LaserScan.
    """
    return _FILLED.get(kind, {})
