"""Image messages."""

import sys
from typing import TYPE_CHECKING, Any

import numpy as np
from sensor_msgs.msg import Image

from cv_bridge.encodings import element_type

from .registry import converts_from_numpy, converts_to_numpy

if TYPE_CHECKING:
    from numpy.typing import NDArray


@converts_to_numpy(Image)
def image_to_numpy(msg: Any) -> "NDArray[Any]":
    """(height, width) or (height, width, channels).

    Raises:
        TypeError: no such encoding.
    """
    dtype, channels = _element_type(msg.encoding)
    dtype = dtype.newbyteorder(">" if msg.is_bigendian else "<")
    strides = (msg.step, dtype.itemsize * channels, dtype.itemsize)
    image = np.ndarray((msg.height, msg.width, channels), dtype, buffer=bytearray(msg.data), strides=strides)
    return image[..., 0] if channels == 1 else image


@converts_from_numpy(Image)
def numpy_to_image(arr: "NDArray[Any]", encoding: str) -> Any:
    """Image message from an array (height, width) or (height, width, channels).

    Raises:
        TypeError: no such encoding, or the array does not fit it.
    """
    dtype, expected = _element_type(encoding)
    if arr.ndim not in (2, 3):
        raise TypeError(f"an image has two or three dimensions, not {arr.ndim}")
    channels = arr.shape[2] if arr.ndim == 3 else 1
    if channels != expected:
        raise TypeError(f"Array has {channels} channels, {encoding} requires {expected}")
    if arr.dtype.type != dtype.type:
        raise TypeError(f"Array is {arr.dtype.type}, {encoding} requires {dtype.type}")
    pixels = np.ascontiguousarray(arr)
    is_native_big = arr.dtype.byteorder == "=" and sys.byteorder == "big"
    return Image(
        encoding=encoding,
        height=arr.shape[0],
        width=arr.shape[1],
        data=pixels.tobytes(),
        step=pixels.strides[0],
        is_bigendian=arr.dtype.byteorder == ">" or is_native_big,
    )


def _element_type(encoding: str) -> "tuple[np.dtype[Any], int]":
    elements = element_type(encoding)
    if elements is None:
        raise TypeError(f"Unrecognized encoding {encoding}")
    name, channels = elements
    return np.dtype(name), channels
