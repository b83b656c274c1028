"""Conversion of images for display: depth and other plain values as gray levels, colors in 8 bits."""

from typing import TYPE_CHECKING, Any

import numpy as np

from .color import ConversionError, convert_color
from .encodings import element_type

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

_PREFIXES = ("mono", "bgr", "rgb")
_GRAY = 128
"""Gray level of an image of equal values."""


def cvtColorForDisplay(
    source: "ArrayLike",
    encoding_in: str,
    encoding_out: str,
    do_dynamic_scaling: bool = False,
    min_image_value: float = 0.0,
    max_image_value: float = 0.0,
) -> "NDArray[Any]":
    """Convert an image to an encoding for display.

    Args:
        source: (height, width) or (height, width, channels).
        encoding_in: encoding of the image.
        encoding_out: color or mono of 8 bits; '' for bgr8.
        do_dynamic_scaling: scale from the image's minimum and maximum to 0 … 255.
        min_image_value: value that becomes 0; the same as the maximum: no scaling.
        max_image_value: value that becomes 255.

    Raises:
        RuntimeError: the encodings do not fit.
    """
    image: NDArray[Any] = np.asarray(source)
    name, channels = element_type(encoding_in) or (image.dtype.name, 1)
    target = encoding_out or "bgr8"
    if not target.startswith(_PREFIXES) or not target.endswith("8"):
        raise RuntimeError(f"cv_bridge.cvtColorForDisplay: {encoding_out!r} is neither color nor mono of 8 bits")
    if name == "int32" and target == "bgr8":
        raise RuntimeError("cv_bridge.cvtColorForDisplay: labels (32SC1) need the original's color table")
    if do_dynamic_scaling:
        min_image_value, max_image_value = float(np.nanmin(image)), float(np.nanmax(image))
        if min_image_value == max_image_value:
            return np.full((*image.shape[:2], 3), _GRAY, np.uint8)
    try:
        if min_image_value == max_image_value:
            return convert_color(image, "mono16" if encoding_in == "16UC1" else encoding_in, target)
        if channels != 1:
            raise ConversionError("scaling for images with more than one channel is unsupported")
        return convert_color(_scale(image, min_image_value, max_image_value), "mono8", target)
    except ConversionError as error:
        raise RuntimeError(
            f"cv_bridge.cvtColorForDisplay() while trying to convert image from '{encoding_in}' to '{target}' "
            f"an exception was thrown ({error})"
        ) from None


def _scale(image: "NDArray[Any]", minimum: float, maximum: float) -> "NDArray[np.uint8]":
    """Scale to gray levels of 8 bits; values that are not finite become black."""
    shifted = image.astype(np.float64) - minimum
    if np.issubdtype(image.dtype, np.integer):
        limits = np.iinfo(image.dtype)
        shifted = np.clip(np.rint(shifted), limits.min, limits.max)
    scaled = np.rint(shifted * (255.0 / (maximum - minimum)))
    return np.clip(np.where(np.isfinite(scaled), scaled, 0), 0, 255).astype(np.uint8)
