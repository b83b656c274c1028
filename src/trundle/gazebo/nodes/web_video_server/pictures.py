"""Image messages as files of JPEG and PNG."""

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_COLOR_CHANNELS = {"rgb8": "RGB", "bgr8": "BGR", "8UC3": "BGR", "rgba8": "RGBA", "bgra8": "BGRA", "8UC4": "BGRA"}
_GREY_ENCODINGS = ("mono8", "8UC1")
_SCALED_TYPES = {"mono16": "u2", "16UC1": "u2", "16SC1": "i2", "32SC1": "i4", "32FC1": "f4", "64FC1": "f8"}
_WHITE = 255
_MAX_SIDE = 8192
_MAX_LEVEL = 9


class PictureError(Exception):
    """Image that cannot be shown; the text has the reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Encoding:
    """Requested file format, from a request's query."""

    format: Literal["jpeg", "png"] = "jpeg"
    quality: int = 95
    """JPEG's quality [%]; compression level of PNG."""
    width: int | None = None
    """[px]; None: width of the image."""
    height: int | None = None
    rotates: bool = False
    """True: rotated by 180°."""


def encode_picture(message: "sensor_msgs.Image", encoding: Encoding) -> bytes:
    """Encode an image message.

    Raises:
        PictureError: its encoding is not supported, or its data is too short.
    """
    image = Image.fromarray(_pixels(message))
    if encoding.rotates:
        image = image.transpose(Image.Transpose.ROTATE_180)
    size = (min(encoding.width or image.width, _MAX_SIDE), min(encoding.height or image.height, _MAX_SIDE))
    if size != image.size:
        image = image.resize(size, Image.Resampling.BILINEAR)
    out = io.BytesIO()
    if encoding.format == "png":
        image.save(out, "png", compress_level=min(max(encoding.quality, 0), _MAX_LEVEL))
    else:
        flat = image.convert("RGB") if image.mode == "RGBA" else image
        flat.save(out, "jpeg", quality=min(max(encoding.quality, 1), 100))
    return out.getvalue()


def _pixels(message: "sensor_msgs.Image") -> NDArray[np.uint8]:
    """Return grey, RGB or RGBA pixels of shape (height, width[, channels])."""
    encoding = message.encoding
    if encoding in _COLOR_CHANNELS:
        order = _COLOR_CHANNELS[encoding]
        array = _rows(message, np.dtype(np.uint8), len(order))
        return np.ascontiguousarray(array[..., [order.index(channel) for channel in "RGBA"[: len(order)]]])
    if encoding in _GREY_ENCODINGS:
        return np.ascontiguousarray(_rows(message, np.dtype(np.uint8), 1)[..., 0])
    if encoding in _SCALED_TYPES:
        layout = np.dtype(_SCALED_TYPES[encoding]).newbyteorder(">" if message.is_bigendian else "<")
        return _scaled(_rows(message, layout, 1)[..., 0].astype(np.float64), is_grey=encoding == "mono16")
    supported = ", ".join((*_COLOR_CHANNELS, *_GREY_ENCODINGS, *_SCALED_TYPES))
    raise PictureError(f"images of encoding {encoding[:50]!r} cannot be shown; supported: {supported}")


def _scaled(values: NDArray[np.float64], *, is_grey: bool) -> NDArray[np.uint8]:
    """Scale depths so that the maximum is white, as in the original; a grey image keeps its brightness."""
    values = np.where(np.isfinite(values) & (values > 0.0), values, 0.0)
    maximum = np.iinfo(np.uint16).max if is_grey else values.max(initial=0.0)
    return (values * (_WHITE / maximum if maximum > 0.0 else 0.0)).astype(np.uint8)


def _rows(message: "sensor_msgs.Image", layout: np.dtype[Any], channels: int) -> NDArray[Any]:
    """Return pixels of shape (height, width, channels), without the padding of rows."""
    height, width = int(message.height), int(message.width)
    row = width * channels * layout.itemsize
    step = int(message.step) or row
    data = np.asarray(message.data, np.uint8)
    if not width or not height or step < row or data.size < step * (height - 1) + row:
        raise PictureError(f"an image of {width} x {height} pixels has {data.size} bytes in rows of {step}")
    padded = np.zeros(step * height, np.uint8)
    padded[: min(data.size, padded.size)] = data[: padded.size]
    return np.ascontiguousarray(padded.reshape(height, step)[:, :row]).view(layout).reshape(height, width, channels)
