"""Color conversion between encodings, with numpy; weights as in OpenCV: ITU-R BT.601."""

import re
from typing import TYPE_CHECKING, Any

import numpy as np

from .encodings import element_type

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ORDER = re.compile(r"(rgb|bgr)(a?)(8|16)")
_SHIFT = 14
_RED, _GREEN, _BLUE = 4899, 9617, 1868
"""Weights of luminance, times 2¹⁴."""


class ConversionError(Exception):
    """An encoding cannot be converted to another."""


def convert_color(image: "NDArray[Any]", source: str, target: str) -> "NDArray[Any]":
    """Image in another encoding, or a copy in the same: always a new array, on which programs may draw.

    Args:
        image: (height, width) or (height, width, channels).
        source: encoding of the image.
        target: encoding of the result.

    Raises:
        ConversionError: unknown encoding, or no such conversion.
    """
    if source == target:
        return image.copy()
    for encoding in (source, target):
        if element_type(encoding) is None:
            raise ConversionError(f"Unrecognized image encoding [{encoding}]")
    is_plain = not (_family(source) and _family(target))
    if is_plain:
        if _element_type(source)[1] != _element_type(target)[1]:
            raise ConversionError(
                f"[{source}] is not a color format. but [{target}] is. The conversion does not make sense"
            )
        return _change_depth(image, source, target, is_plain=True)
    if _family(target) in ("yuv", "bayer"):
        raise ConversionError(f"Conversion from [{source}] to [{target}] is not possible")
    if _family(source) in ("yuv", "bayer"):
        is_gray = _family(source) == "bayer" and _family(target) == "mono"
        image = _with_opencv(image, source, is_gray=is_gray)
        source = f"{'mono' if is_gray else 'bgr'}{_bits(source)}"
    if _family(source) != "mono" or _family(target) != "mono":
        image = _reorder(image, source, target)
    return _change_depth(image, source, target, is_plain=False)


def _family(encoding: str) -> str:
    """mono, color, bayer, yuv; '' for encodings without color meaning."""
    if _ORDER.fullmatch(encoding):
        return "color"
    return next((family for family in ("mono", "bayer", "yuv") if encoding.startswith(family)), "")


def _element_type(encoding: str) -> tuple[str, int]:
    """Numpy type's name and channels of a known encoding."""
    elements = element_type(encoding)
    assert elements is not None
    return elements


def _channel_order(encoding: str) -> tuple[str, str]:
    """Order of a color encoding's channels, "rgb" or "bgr", and "a" or "" for alpha."""
    match = _ORDER.fullmatch(encoding)
    assert match is not None
    return match[1], match[2]


def _bits(encoding: str) -> int:
    return 16 if _element_type(encoding)[0] == "uint16" else 8


def _reorder(image: "NDArray[Any]", source: str, target: str) -> "NDArray[Any]":
    """Reorder channels, or convert from or to one channel."""
    if _family(source) == "mono":
        _, alpha = _channel_order(target)
        planes = [image] * 3 + ([np.full_like(image, np.iinfo(image.dtype).max)] if alpha else [])
        return np.stack(planes, axis=-1)
    source_order, source_alpha = _channel_order(source)
    if _family(target) == "mono":
        red, green, blue = (image[..., source_order.index(color)].astype(np.uint32) for color in "rgb")
        gray = (red * _RED + green * _GREEN + blue * _BLUE + (1 << (_SHIFT - 1))) >> _SHIFT
        return gray.astype(image.dtype)
    target_order, target_alpha = _channel_order(target)
    planes = [image[..., source_order.index(color)] for color in target_order]
    if target_alpha:
        opaque = np.full(image.shape[:2], np.iinfo(image.dtype).max, image.dtype)
        planes.append(image[..., 3] if source_alpha else opaque)
    return np.stack(planes, axis=-1)


def _change_depth(image: "NDArray[Any]", source: str, target: str, *, is_plain: bool) -> "NDArray[Any]":
    """Convert the element type; colors are scaled to its range."""
    depth = _element_type(target)[0]
    if image.dtype == depth:
        return image if image.flags.writeable else image.copy()
    scale = 1.0
    if not is_plain:
        scale = 255.0 / 65535.0 if depth == "uint8" else 65535.0 / 255.0
    scaled = image.astype(np.float64) * scale
    if np.issubdtype(depth, np.integer):
        limits = np.iinfo(depth)
        scaled = np.clip(np.rint(scaled), limits.min, limits.max)
    return scaled.astype(depth)


def _with_opencv(image: "NDArray[Any]", source: str, *, is_gray: bool) -> "NDArray[Any]":
    """Convert a Bayer or YUV image to BGR, or a Bayer image to gray."""
    try:
        import cv2
    except ImportError:
        raise ConversionError(f"images in {source} need OpenCV: pip install opencv-python-headless") from None
    codes = {"yuv422": "YUV2BGR_UYVY", "yuv422_yuy2": "YUV2BGR_YUY2"}
    first_pixels = {"bayer_rggb": "BG", "bayer_bggr": "RG", "bayer_gbrg": "GR", "bayer_grbg": "GB"}
    if (code := codes.get(source)) is None:
        code = f"BAYER_{first_pixels[re.sub(r'[0-9]+$', '', source)]}2{'GRAY' if is_gray else 'BGR'}"
    return cv2.cvtColor(image, getattr(cv2, f"COLOR_{code}"))
