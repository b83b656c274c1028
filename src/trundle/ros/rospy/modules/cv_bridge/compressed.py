"""Compressed images: OpenCV where it is installed, else Pillow."""

import io
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

_FORMATS = {"jpg": "JPEG", "jpeg": "JPEG", "jpe": "JPEG", "jp2": "JPEG2000", "tif": "TIFF", "dib": "BMP"}


def decode(data: Any) -> "NDArray[Any]":
    """Decode an image file, to (height, width) or (height, width, channels) in BGR order.

    Raises:
        ValueError: not an image.
    """
    try:
        import cv2
    except ImportError:
        return _decode_with_pillow(data)
    image = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_UNCHANGED)
    if image is None:
        raise ValueError("the data is not an image that OpenCV can read")
    return image


def encode(image: "NDArray[Any]", extension: str) -> bytes:
    """Encode an image in BGR order as a file.

    Raises:
        ValueError: the format is unknown, or cannot hold such an image.
    """
    try:
        import cv2
    except ImportError:
        return _encode_with_pillow(image, extension)
    try:
        is_encoded, data = cv2.imencode(f".{extension}", image)
    except cv2.error as error:
        raise ValueError(str(error)) from None
    if not is_encoded:
        raise ValueError(f"OpenCV cannot write this image as {extension}")
    return data.tobytes()


def _decode_with_pillow(data: Any) -> "NDArray[Any]":
    from PIL import Image, UnidentifiedImageError

    try:
        picture = Image.open(io.BytesIO(bytes(data)))
        picture.load()
    except (UnidentifiedImageError, OSError, Image.DecompressionBombError) as error:
        raise ValueError(f"the data is not an image: {error}") from None
    if picture.mode in ("P", "CMYK", "YCbCr", "LAB", "HSV"):
        picture = picture.convert("RGBA" if "transparency" in picture.info else "RGB")
    pixels = np.array(picture)
    if pixels.dtype == np.int32:  # Pillow's type of 16-bit images
        pixels = pixels.astype(np.uint16)
    return _swap(pixels)


def _encode_with_pillow(image: "NDArray[Any]", extension: str) -> bytes:
    from PIL import Image

    try:
        file = io.BytesIO()
        name = _FORMATS.get(extension.lower(), extension.upper())
        Image.fromarray(np.ascontiguousarray(_swap(np.asarray(image)))).save(file, name, quality=95)
    except (KeyError, TypeError, OSError) as error:
        raise ValueError(f"this image cannot be written as {extension}: {error}") from None
    return file.getvalue()


def _swap(pixels: "NDArray[Any]") -> "NDArray[Any]":
    """RGB ↔ BGR, with or without alpha."""
    if pixels.ndim < 3 or pixels.shape[2] < 3:
        return pixels
    return pixels[..., [2, 1, 0, *range(3, pixels.shape[2])]]
