"""Messages that programs are given: those of sensors have readings, all others are zero but their stamps."""

from typing import Any

_RAYS, _SIDE = 720, 32
_CAMERA = [float(_SIDE), 0.0, _SIDE / 2, 0.0, float(_SIDE), _SIDE / 2, 0.0, 0.0, 1.0]
_WALL = [100] * _SIDE
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
    "sensor_msgs/Joy": {"axes": [0.0] * 8, "buttons": [0] * 16},
    "nav_msgs/OccupancyGrid": {
        "info": {
            "resolution": 0.1,
            "width": _SIDE,
            "height": _SIDE,
            "origin": {"position": {"x": -0.05 * _SIDE, "y": -0.05 * _SIDE}, "orientation": {"w": 1.0}},
        },
        "data": _WALL + ([100] + [0] * (_SIDE - 2) + [100]) * (_SIDE - 2) + _WALL,
    },
    **{f"std_msgs/{kind}MultiArray": {"data": [0] * 16} for kind in ("Int32", "Float32", "Float64")},
}


def fields_of(kind: str) -> dict[str, Any]:
    """Return the fields of a message that is published to programs.

    Args:
        kind: type, such as sensor_msgs/LaserScan.
    """
    return _FILLED.get(kind, {})
