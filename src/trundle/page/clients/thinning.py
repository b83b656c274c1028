"""Smaller versions of ROS messages for slow connections: images with fewer pixels, clouds with fewer points."""

import io
import math
import re
import struct
from collections.abc import Callable
from typing import TYPE_CHECKING

from .frames import Buffer

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Thin = Callable[[int], Buffer | None]
"""Returns a version of a message of about that many bytes; None: there is none."""

_U32 = struct.Struct("<I")
_STAMP_BYTES = 12
"""Sequence number and stamp of a header."""
_PIXEL_BYTES = {
    "mono8": 1, "mono16": 2, "rgb8": 3, "bgr8": 3, "rgba8": 4, "bgra8": 4,
    "rgb16": 6, "bgr16": 6, "rgba16": 8, "bgra16": 8,
}  # fmt: skip
"""Bytes per pixel by encoding, besides those of `_GENERIC`; bayer and yuv patterns are not thinned."""
_GENERIC = re.compile(r"(8|16|32|64)[USF]C([1-4]?)")
_MAX_PIXELS = 1 << 26
"""Largest JPEG that is decoded."""
_JPEG_QUALITY = 75


def thinner(type_name: str, data: Buffer) -> Thin | None:
    """Return the function that thins messages of a type; None: they cannot be thinned."""
    thin = {
        "sensor_msgs/Image": _thin_image,
        "sensor_msgs/PointCloud2": _thin_cloud,
        "sensor_msgs/CompressedImage": _thin_jpeg,
    }.get(type_name)
    if thin is None:
        return None

    def shrink(max_bytes: int) -> Buffer | None:
        try:
            return thin(memoryview(data), max(1, max_bytes))
        except (struct.error, ValueError, OSError):
            return None  # damaged; clients report it

    return shrink


class _Reader:
    """Reads the fields of a serialized message in turn.

    Raises:
        struct.error, ValueError: the message is damaged.
    """

    def __init__(self, data: memoryview) -> None:
        self.data = data
        self.at = 0

    def number(self) -> int:
        (number,) = _U32.unpack_from(self.data, self.at)
        self.at += _U32.size
        return number

    def skip(self, count: int) -> None:
        self.at += count

    def bytes(self) -> memoryview:
        """Read a string or an array of bytes."""
        size = self.number()
        self.at += size
        if self.at > len(self.data):
            raise ValueError("the message is cut off")
        return self.data[self.at - size : self.at]

    def header(self) -> None:
        self.skip(_STAMP_BYTES)
        self.bytes()


def _thin_image(data: memoryview, max_bytes: int) -> Buffer | None:
    reader = _Reader(data)
    reader.header()
    header_end = reader.at
    height, width = reader.number(), reader.number()
    encoding_at = reader.at
    pixel_bytes = _pixel_bytes(bytes(reader.bytes()).decode("ascii", "replace"))
    reader.skip(1)  # is_bigendian
    step_at = reader.at
    step = reader.number()
    pixels = _rows(reader.bytes(), height, step)
    if pixel_bytes is None or not 0 < width * pixel_bytes <= step:
        return None
    pixels = pixels[:, : width * pixel_bytes].reshape(height, width, pixel_bytes)
    every = math.ceil(math.sqrt(pixels.nbytes / max_bytes))
    pixels = pixels[::every, ::every]
    rows, columns = pixels.shape[:2]
    return b"".join(
        (
            data[:header_end],
            struct.pack("<II", rows, columns),
            data[encoding_at:step_at],
            struct.pack("<II", columns * pixel_bytes, pixels.nbytes),
            pixels.tobytes(),
        )
    )


def _pixel_bytes(encoding: str) -> int | None:
    generic = _GENERIC.fullmatch(encoding)
    if generic is not None:
        return int(generic[1]) // 8 * int(generic[2] or 1)
    return _PIXEL_BYTES.get(encoding)


def _thin_cloud(data: memoryview, max_bytes: int) -> Buffer | None:
    reader = _Reader(data)
    reader.header()
    header_end = reader.at
    height, width = reader.number(), reader.number()
    fields_at = reader.at
    for _ in range(min(reader.number(), len(data))):
        reader.bytes()
        reader.skip(2 * _U32.size + 1)  # offset, datatype, count
    reader.skip(1)  # is_bigendian
    step_at = reader.at
    point_bytes, step = reader.number(), reader.number()
    points = _rows(reader.bytes(), height, step)
    if not 0 < width * point_bytes <= step:
        return None
    points = points[:, : width * point_bytes].reshape(height * width, point_bytes)
    points = points[:: math.ceil(points.nbytes / max_bytes)]
    return b"".join(
        (
            data[:header_end],
            struct.pack("<II", 1, len(points)),
            data[fields_at:step_at],
            struct.pack("<III", point_bytes, points.nbytes, points.nbytes),
            points.tobytes(),
            data[reader.at :],
        )
    )


def _rows(data: memoryview, height: int, step: int) -> "NDArray[np.uint8]":
    """Return the rows of an array of bytes.

    Raises:
        ValueError: it has not as many rows.
    """
    import numpy as np  # only where a connection is slow

    return np.frombuffer(data, np.uint8, height * step).reshape(height, step)


def _thin_jpeg(data: memoryview, max_bytes: int) -> Buffer | None:
    reader = _Reader(data)
    reader.header()
    if b"jpeg" not in bytes(reader.bytes()).lower():
        return None
    data_at = reader.at
    jpeg = _smaller_jpeg(reader.bytes(), max_bytes)
    return None if jpeg is None else b"".join((data[:data_at], _U32.pack(len(jpeg)), jpeg))


def _smaller_jpeg(data: memoryview, max_bytes: int) -> bytes | None:
    """Return a JPEG with fewer pixels; None: the original has too many pixels to be decoded here."""
    from PIL import Image

    share = math.sqrt(max_bytes / len(data))
    try:
        with Image.open(io.BytesIO(data), formats=("JPEG",)) as image:
            if image.width * image.height > _MAX_PIXELS:
                return None
            size = max(1, int(image.width * share)), max(1, int(image.height * share))
            image.draft(None, size)  # decodes at a reduced scale where that suffices
            smaller = io.BytesIO()
            image.resize(size).save(smaller, "JPEG", quality=_JPEG_QUALITY)
            return smaller.getvalue()
    except (Image.DecompressionBombError, Image.DecompressionBombWarning):
        return None
