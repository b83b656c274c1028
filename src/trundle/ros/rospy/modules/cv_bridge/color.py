"""Colour conversion between encodings, on numpy; weights as OpenCV's, ITU-R BT.601."""

import re

import numpy as np

from .encodings import element_type

_ORDER = re.compile(r"(rgb|bgr)(a?)(8|16)")
_SHIFT = 14
_RED, _GREEN, _BLUE = 4899, 9617, 1868
"""Weights of brightness, times 2¹⁴."""


class ConversionError(Exception):
    """No way from one encoding to the other."""


def convert_color(image, source, target):
    """New image in another encoding, or a copy in the same; programs draw on it.

    Args:
        image: (height, width) or (height, width, channels).
        source: its encoding.
        target: the encoding wanted.

    Raises:
        ConversionError: there is no way.
    """
    if source == target:
        return image.copy()
    for encoding in (source, target):
        if element_type(encoding) is None:
            raise ConversionError(f"Unrecognized image encoding [{encoding}]")
    is_plain = not (_family(source) and _family(target))
    if is_plain:
        if element_type(source)[1] != element_type(target)[1]:
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


def _family(encoding):
    """mono, color, bayer, yuv; '' for arrays without a meaning."""
    if _ORDER.fullmatch(encoding):
        return "color"
    return next((family for family in ("mono", "bayer", "yuv") if encoding.startswith(family)), "")


def _bits(encoding):
    return 16 if element_type(encoding)[0] == "uint16" else 8


def _reorder(image, source, target):
    """Channels in another order, from or to one channel."""
    if _family(source) == "mono":
        _, alpha, _ = _ORDER.fullmatch(target).groups()
        planes = [image] * 3 + ([np.full_like(image, np.iinfo(image.dtype).max)] if alpha else [])
        return np.stack(planes, axis=-1)
    source_order, source_alpha, _ = _ORDER.fullmatch(source).groups()
    if _family(target) == "mono":
        red, green, blue = (image[..., source_order.index(color)].astype(np.uint32) for color in "rgb")
        gray = (red * _RED + green * _GREEN + blue * _BLUE + (1 << (_SHIFT - 1))) >> _SHIFT
        return gray.astype(image.dtype)
    target_order, target_alpha, _ = _ORDER.fullmatch(target).groups()
    planes = [image[..., source_order.index(color)] for color in target_order]
    if target_alpha:
        opaque = np.full(image.shape[:2], np.iinfo(image.dtype).max, image.dtype)
        planes.append(image[..., 3] if source_alpha else opaque)
    return np.stack(planes, axis=-1)


def _change_depth(image, source, target, *, is_plain):
    """Elements in another type; colours are scaled to its range."""
    depth = element_type(target)[0]
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


def _with_opencv(image, source, *, is_gray):
    """BGR of a Bayer or YUV image, or the brightness of a Bayer image."""
    try:
        import cv2
    except ImportError:
        raise ConversionError(f"images in {source} need OpenCV: pip install opencv-python-headless") from None
    codes = {"yuv422": "YUV2BGR_UYVY", "yuv422_yuy2": "YUV2BGR_YUY2"}
    first_pixels = {"bayer_rggb": "BG", "bayer_bggr": "RG", "bayer_gbrg": "GR", "bayer_grbg": "GB"}
    if (code := codes.get(source)) is None:
        code = f"BAYER_{first_pixels[re.sub(r'[0-9]+$', '', source)]}2{'GRAY' if is_gray else 'BGR'}"
    return cv2.cvtColor(image, getattr(cv2, f"COLOR_{code}"))
