"""Image messages as files of JPEG and PNG."""

import io
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs

_COLOURS = {"rgb8": "RGB", "bgr8": "BGR", "8UC3": "BGR", "rgba8": "RGBA", "bgra8": "BGRA", "8UC4": "BGRA"}
_GREYS = ("mono8", "8UC1")
_SCALED = {"mono16": "u2", "16UC1": "u2", "16SC1": "i2", "32SC1": "i4", "32FC1": "f4", "64FC1": "f8"}
_WHITE = 255
_MAX_SIDE = 8192
_MAX_LEVEL = 9


class PictureError(Exception):
    """An image that cannot be shown; the text says why."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Encoding:
    """Wanted file, of a request's query."""

    format: Literal["jpeg", "png"] = "jpeg"
    quality: int = 95
    """JPEG's quality [%]; compression level of PNG."""
    width: int | None = None
    """[px]; None: the image's."""
    height: int | None = None
    rotates: bool = False
    """True: turned by 180°."""


def encode_picture(message: "sensor_msgs.Image", wanted: Encoding) -> bytes:
    """Encode an image message.

    Raises:
        PictureError: its encoding is not supported, or it is shorter than its size says.
    """
    image = Image.fromarray(_pixels(message))
    if wanted.rotates:
        image = image.transpose(Image.Transpose.ROTATE_180)
    size = (min(wanted.width or image.width, _MAX_SIDE), min(wanted.height or image.height, _MAX_SIDE))
    if size != image.size:
        image = image.resize(size, Image.Resampling.BILINEAR)
    out = io.BytesIO()
    if wanted.format == "png":
        image.save(out, "png", compress_level=min(max(wanted.quality, 0), _MAX_LEVEL))
    else:
        flat = image.convert("RGB") if image.mode == "RGBA" else image
        flat.save(out, "jpeg", quality=min(max(wanted.quality, 1), 100))
    return out.getvalue()


def _pixels(message: "sensor_msgs.Image") -> NDArray[np.uint8]:
    """Grey, RGB or RGBA, of shape (height, width[, channels])."""
    encoding = message.encoding
    if encoding in _COLOURS:
        order = _COLOURS[encoding]
        array = _rows(message, np.dtype(np.uint8), len(order))
        return np.ascontiguousarray(array[..., [order.index(channel) for channel in "RGBA"[: len(order)]]])
    if encoding in _GREYS:
        return np.ascontiguousarray(_rows(message, np.dtype(np.uint8), 1)[..., 0])
    if encoding in _SCALED:
        layout = np.dtype(_SCALED[encoding]).newbyteorder(">" if message.is_bigendian else "<")
        return _scaled(_rows(message, layout, 1)[..., 0].astype(np.float64), is_grey=encoding == "mono16")
    known = ", ".join((*_COLOURS, *_GREYS, *_SCALED))
    raise PictureError(f"images of encoding {encoding[:50]!r} cannot be shown; those that can: {known}")


def _scaled(values: NDArray[np.float64], *, is_grey: bool) -> NDArray[np.uint8]:
    """Scale depths, as the original does, so that the largest is white; a grey image keeps its brightness."""
    values = np.where(np.isfinite(values) & (values > 0.0), values, 0.0)
    largest = np.iinfo(np.uint16).max if is_grey else values.max(initial=0.0)
    return (values * (_WHITE / largest if largest > 0.0 else 0.0)).astype(np.uint8)


def _rows(message: "sensor_msgs.Image", layout: np.dtype[Any], channels: int) -> NDArray[Any]:
    """Shape (height, width, channels), without the padding of rows."""
    height, width = int(message.height), int(message.width)
    row = width * channels * layout.itemsize
    step = int(message.step) or row
    data = np.asarray(message.data, np.uint8)
    if not width or not height or step < row or data.size < step * (height - 1) + row:
        raise PictureError(f"an image of {width} x {height} pixels has {data.size} bytes in rows of {step}")
    padded = np.zeros(step * height, np.uint8)
    padded[: min(data.size, padded.size)] = data[: padded.size]
    return np.ascontiguousarray(padded.reshape(height, step)[:, :row]).view(layout).reshape(height, width, channels)
