"""Images and point clouds as messages, without their headers."""

import io
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from trundle.sim.render import colored_points
from trundle.sim.sensors import CameraReading, CameraSensor, pixels_in

_FLOAT32 = 7
"""sensor_msgs/PointField.FLOAT32"""
_KELVIN_STEP = 0.01
"""Unit of gz's thermal cameras [K]."""
_JPEG_QUALITY = 80
"""Default of image_transport's plugin `compressed` [%]."""
_CHANNELS = {"mono8": (0,), "rgb8": (0, 1, 2), "bgr8": (2, 1, 0)}
"""Encoding that has a compressed image → its channels as grey or RGB."""


def image_encoder(format_: str) -> Callable[[CameraReading], dict[str, object]]:
    """Return the function that makes color sensor_msgs/Image in one of SDF's pixel formats."""
    return lambda reading: _image(*pixels_in(format_, reading.rgb))


def is_compressible(format_: str) -> bool:
    """True for the pixel formats of SDF whose images `compressed_image` takes."""
    return pixels_in(format_, np.zeros((2, 2, 3), np.uint8))[1] in _CHANNELS


def compressed_image(image: Mapping[str, Any]) -> dict[str, object]:
    """sensor_msgs/CompressedImage (JPEG) of a sensor_msgs/Image in mono8, rgb8 or bgr8, as by image_transport."""
    encoding = image["encoding"]
    channels = _CHANNELS[encoding]
    pixels = image["data"].reshape(image["height"], image["width"], len(channels))
    flat = pixels[..., 0] if len(channels) == 1 else pixels[..., channels]
    out = io.BytesIO()
    Image.fromarray(np.ascontiguousarray(flat)).save(out, "jpeg", quality=_JPEG_QUALITY)
    kind = "" if len(channels) == 1 else "bgr8"
    return {"format": f"{encoding}; jpeg compressed {kind}", "data": np.frombuffer(out.getvalue(), np.uint8)}


def depth_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of depths [m], 32FC1."""
    assert reading.depth is not None
    return _image(reading.depth, "32FC1")


def labels_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of labels (mono8), or of 65536 · label + instance (32SC1)."""
    assert reading.labels is not None
    return _image(reading.labels, "mono8" if reading.labels.dtype == np.uint8 else "32SC1")


def thermal_image(reading: CameraReading) -> dict[str, object]:
    """sensor_msgs/Image of temperatures [0.01 K], mono16."""
    assert reading.temperatures is not None
    counts = np.clip(np.rint(reading.temperatures / _KELVIN_STEP), 0, 65535)
    return _image(counts.astype(np.uint16), "mono16")


def _image(pixels: NDArray[np.generic], encoding: str) -> dict[str, object]:
    height, width = pixels.shape[:2]
    data = np.ascontiguousarray(pixels).reshape(-1).view(np.uint8)
    return {"height": height, "width": width, "encoding": encoding, "step": data.size // height, "data": data}


def point_cloud_encoder(camera: CameraSensor) -> Callable[[CameraReading], dict[str, object]]:
    """Return the function that makes sensor_msgs/PointCloud2: a colored point per pixel in the optical frame [m], NaN
    without depth."""
    right, down = (np.ascontiguousarray(slopes, dtype=np.float32) for slopes in camera.projection.slopes())
    fields = [
        {"name": name, "offset": 4 * i, "datatype": _FLOAT32, "count": 1}
        for i, name in enumerate(("x", "y", "z", "rgb"))
    ]

    def cloud(reading: CameraReading) -> dict[str, object]:
        assert reading.depth is not None
        height, width = reading.depth.shape
        points = colored_points(reading.depth, reading.rgb, right, down)
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
