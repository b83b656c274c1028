"""SDF's image formats, converted from RGB."""

from collections.abc import Callable, Mapping

import numpy as np
from numpy.typing import NDArray

_Rgb = NDArray[np.uint8]
_Pixels = NDArray[np.uint8] | NDArray[np.uint16]
_FULL = np.uint16(257)
"""Factor from 8 to 16 bits: 65535 / 255."""


def pixels_in(format_: str, rgb: _Rgb) -> tuple[_Pixels, str]:
    """Return the image in a format, (height, width[, 3]), and its ROS encoding.

    Args:
        format_: key of FORMATS.
        rgb: (height, width, 3)
    """
    encoding, convert = FORMATS[format_]
    return convert(rgb), encoding


def _same(rgb: _Rgb) -> _Pixels:
    return rgb


def _bgr(rgb: _Rgb) -> _Pixels:
    return rgb[..., ::-1]


def _grey(rgb: _Rgb) -> NDArray[np.uint8]:
    """Return the ITU-R BT.601 luma, as OpenCV."""
    r, g, b = (rgb[..., i].astype(np.uint32) for i in range(3))
    return ((299 * r + 587 * g + 114 * b + 500) // 1000).astype(np.uint8)


def _deep(rgb: _Rgb) -> _Pixels:
    return rgb * _FULL


def _deep_grey(rgb: _Rgb) -> _Pixels:
    return _grey(rgb) * _FULL


def _bayer(pattern: str) -> Callable[[_Rgb], _Pixels]:
    """Return a function that samples a 2 × 2 Bayer pattern, given row by row."""

    def make(rgb: _Rgb) -> _Pixels:
        mosaic = np.empty(rgb.shape[:2], dtype=np.uint8)
        for index, color in enumerate(pattern):
            row, column = divmod(index, 2)
            mosaic[row::2, column::2] = rgb[row::2, column::2, "rgb".index(color)]
        return mosaic

    return make


FORMATS: Mapping[str, tuple[str, Callable[[_Rgb], _Pixels]]] = {
    **dict.fromkeys(("L8", "L_INT8"), ("mono8", _grey)),
    **dict.fromkeys(("L16", "L_INT16"), ("mono16", _deep_grey)),
    **dict.fromkeys(("R8G8B8", "RGB_INT8"), ("rgb8", _same)),
    **dict.fromkeys(("B8G8R8", "BGR_INT8"), ("bgr8", _bgr)),
    **dict.fromkeys(("R16G16B16", "RGB_INT16"), ("rgb16", _deep)),
    **{f"BAYER_{p.upper()}8": (f"bayer_{p}8", _bayer(p)) for p in ("rggb", "bggr", "gbrg", "grbg")},
}
"""SDF and gz format → ROS encoding and converter."""
