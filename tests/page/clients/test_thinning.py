"""Smaller versions of images and clouds."""

import io
import math
import struct
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from trundle.page.clients.thinning import thinner
from trundle.ros import Messages

MESSAGES = Messages()
HEADER = {"seq": 7, "stamp": {"sec": 3, "nanosec": 4}, "frame_id": "camera"}


def _image(encoding: str, pixels: NDArray[Any], *, padding: int = 0) -> bytes:
    height, width = pixels.shape[:2]
    rows = pixels.reshape(height, -1).view(np.uint8)
    data = np.pad(rows, ((0, 0), (0, padding)))
    fields = {"header": HEADER, "height": height, "width": width, "encoding": encoding, "step": data.shape[1]}
    return MESSAGES.serialize(MESSAGES.new("sensor_msgs/Image", fields | {"data": data.reshape(-1)}))


def _thinned(type_name: str, data: bytes, max_bytes: int) -> Any:
    thin = thinner(type_name, memoryview(data))
    assert thin is not None
    smaller = thin(max_bytes)
    assert smaller is not None
    return MESSAGES.deserialize(smaller, type_name)


@pytest.mark.parametrize(("encoding", "dtype", "channels"), [("rgb8", np.uint8, 3), ("32FC1", np.float32, 1)])
def test_an_image_keeps_every_so_many_pixels(encoding: str, dtype: type, channels: int) -> None:
    pixels = np.arange(480 * 640 * channels).astype(dtype).reshape(480, 640, channels)
    image = _thinned("sensor_msgs/Image", _image(encoding, pixels, padding=5), 25_000)

    every = math.ceil(640 / image.width)
    expected = pixels[::every, ::every]
    assert (image.height, image.width) == expected.shape[:2]
    assert image.step == image.width * channels * pixels.itemsize
    assert np.array_equal(image.data.view(dtype).reshape(expected.shape), expected)
    assert 5_000 < image.data.nbytes <= 25_000
    assert (image.encoding, image.header.frame_id, image.header.stamp.nanosec) == (encoding, "camera", 4)


def test_a_cloud_keeps_every_so_many_points() -> None:
    points = np.arange(100 * 100 * 4, dtype=np.float32).reshape(100, 100, 4)
    fields = [{"name": name, "offset": 4 * i, "datatype": 7, "count": 1} for i, name in enumerate("xyzi")]
    cloud = {"header": HEADER, "height": 100, "width": 100, "fields": fields, "point_step": 16, "row_step": 1600}
    cloud |= {"data": points.view(np.uint8).reshape(-1), "is_dense": True}
    data = MESSAGES.serialize(MESSAGES.new("sensor_msgs/PointCloud2", cloud))

    thinned = _thinned("sensor_msgs/PointCloud2", data, 20_000)

    assert (thinned.height, thinned.point_step, thinned.row_step) == (1, 16, 16 * thinned.width)
    assert np.array_equal(thinned.data.view(np.float32).reshape(-1, 4), points.reshape(-1, 4)[::8])
    assert [field.name for field in thinned.fields] == list("xyzi")
    assert thinned.is_dense


def test_a_jpeg_is_encoded_again_with_fewer_pixels() -> None:
    noise = np.random.default_rng(1).integers(0, 255, (480, 640, 3), np.uint8)
    encoded = io.BytesIO()
    Image.fromarray(noise).save(encoded, "JPEG", quality=95)
    fields = {"header": HEADER, "format": "rgb8; jpeg compressed bgr8", "data": np.frombuffer(encoded.getvalue(), "u1")}
    data = MESSAGES.serialize(MESSAGES.new("sensor_msgs/CompressedImage", fields))

    image = _thinned("sensor_msgs/CompressedImage", data, 25_000)

    picture = Image.open(io.BytesIO(image.data.tobytes()))
    assert len(image.data) < 40_000 < len(data)
    assert picture.width / picture.height == pytest.approx(640 / 480, rel=0.05)
    assert image.format == "rgb8; jpeg compressed bgr8"


def test_what_cannot_be_thinned_is_left_alone() -> None:
    """Pixels of bayer and yuv patterns depend on their neighbors."""
    pixels = np.zeros((480, 640, 1), np.uint8)

    assert thinner("std_msgs/UInt8MultiArray", b"") is None
    for encoding in ("bayer_rggb8", "yuv422", "999UC1"):
        thin = thinner("sensor_msgs/Image", _image(encoding, pixels))
        assert thin is not None
        assert thin(1000) is None


@pytest.mark.parametrize("type_name", ["sensor_msgs/Image", "sensor_msgs/PointCloud2", "sensor_msgs/CompressedImage"])
def test_damaged_messages_are_not_thinned(type_name: str) -> None:
    whole = _image("rgb8", np.zeros((20, 20, 3), np.uint8))
    for end in range(0, len(whole), 7):
        for data in (whole[:end], whole[:end] + b"\xff" * 40):
            thin = thinner(type_name, data)
            assert thin is not None
            thin(100)
    huge = struct.pack("<IIIIIII", 0, 0, 0, 0, 2**32 - 1, 2**32 - 1, 0)
    thin = thinner(type_name, huge + bytes(100))
    assert thin is not None
    assert thin(100) is None
