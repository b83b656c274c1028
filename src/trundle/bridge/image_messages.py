"""Pictures of every kind as messages, without their headers."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trundle.render import coloured_points
from trundle.sensors import CameraReading, CameraSensor, pixels_in

_FLOAT32 = 7
"""sensor_msgs/PointField's number for it."""
_KELVIN_STEP = 0.01
"""[K] What gz's thermal cameras count in."""


def image_encoder(format_: str) -> Callable[[CameraReading], dict[str, object]]:
    """What makes sensor_msgs/Image of colours in one of SDF's formats."""
    return lambda reading: _image(*pixels_in(format_, reading.rgb))


def depth_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of distances [m]."""
    assert reading.depth is not None
    return _image(reading.depth, "32FC1")


def labels_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of labels, or of 65536 times the label plus the instance's number."""
    assert reading.labels is not None
    return _image(reading.labels, "mono8" if reading.labels.dtype == np.uint8 else "32SC1")


def thermal_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of temperatures [0.01 K]."""
    assert reading.temperatures is not None
    counts = np.clip(np.rint(reading.temperatures / _KELVIN_STEP), 0, 65535)
    return _image(counts.astype(np.uint16), "mono16")


def _image(pixels: NDArray[np.generic], encoding: str) -> dict[str, object]:
    height, width = pixels.shape[:2]
    data = np.ascontiguousarray(pixels).reshape(-1).view(np.uint8)
    return {"height": height, "width": width, "encoding": encoding, "step": data.size // height, "data": data}


def point_cloud_encoder(camera: CameraSensor) -> Callable[[CameraReading], dict[str, object]]:
    """What makes sensor_msgs/PointCloud2: a point for each pixel, in its colour, in the optical frame; one without
    depth is not a number."""
    right, down = (np.ascontiguousarray(slopes, dtype=np.float32) for slopes in camera.projection.slopes())
    fields = [
        {"name": name, "offset": 4 * i, "datatype": _FLOAT32, "count": 1}
        for i, name in enumerate(("x", "y", "z", "rgb"))
    ]

    def cloud(reading: CameraReading) -> dict[str, object]:
        assert reading.depth is not None
        height, width = reading.depth.shape
        points = coloured_points(reading.depth, reading.rgb, right, down)
        return {
            "height": height,
            "width": width,
            "fields": fields,
            "point_step": 16,
            "row_step": 16 * width,
            "data": points.reshape(-1).view(np.uint8),
            "is_dense": False,
        }

    return cloud
