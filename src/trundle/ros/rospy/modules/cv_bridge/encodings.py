"""Encodings of image messages: element type and channels."""

import re

_NAMED = {
    "mono8": ("uint8", 1),
    "mono16": ("uint16", 1),
    "bgr8": ("uint8", 3),
    "rgb8": ("uint8", 3),
    "bgra8": ("uint8", 4),
    "rgba8": ("uint8", 4),
    "bgr16": ("uint16", 3),
    "rgb16": ("uint16", 3),
    "bgra16": ("uint16", 4),
    "rgba16": ("uint16", 4),
    "yuv422": ("uint8", 2),
    "yuv422_yuy2": ("uint8", 2),
    **{f"bayer_{pattern}8": ("uint8", 1) for pattern in ("rggb", "bggr", "gbrg", "grbg")},
    **{f"bayer_{pattern}16": ("uint16", 1) for pattern in ("rggb", "bggr", "gbrg", "grbg")},
}
_DEPTHS = ("uint8", "int8", "uint16", "int16", "int32", "float32", "float64")
"""Element types in the order of OpenCV's numbers."""
_SHORT = ("8U", "8S", "16U", "16S", "32S", "32F", "64F")
_GENERIC = re.compile(r"(8U|8S|16U|16S|32S|32F|64F)(?:C([1-4]))?")


def element_type(encoding: str) -> tuple[str, int] | None:
    """Numpy type's name and channels of an encoding; None if the encoding is unknown."""
    if encoding in _NAMED:
        return _NAMED[encoding]
    match = _GENERIC.fullmatch(encoding)
    return None if match is None else (_DEPTHS[_SHORT.index(match[1])], int(match[2] or 1))


def generic_encoding(dtype_name: str, channels: int) -> str:
    """Encoding of an array without color meaning, such as `8UC3`.

    Raises:
        KeyError: no image has elements of this type.
    """
    if dtype_name not in _DEPTHS:
        raise KeyError(dtype_name)
    return f"{_SHORT[_DEPTHS.index(dtype_name)]}C{channels}"


def cv_type(dtype_name: str, channels: int) -> int:
    """OpenCV's type number."""
    return _DEPTHS.index(dtype_name) + ((channels - 1) << 3)


def from_cv_type(number: int) -> tuple[str, int]:
    """Numpy type's name and channels of OpenCV's type number."""
    return _DEPTHS[number & 7], (number >> 3) + 1
