"""Images made visible: depth and other plain values as shades of grey, colours in 8 bits."""

import numpy as np

from .color import ConversionError, convert_color
from .encodings import element_type

_PREFIXES = ("mono", "bgr", "rgb")
_GREY = 128
"""Shade of an image whose values are all the same."""


def cvtColorForDisplay(
    source, encoding_in, encoding_out, do_dynamic_scaling=False, min_image_value=0.0, max_image_value=0.0
):
    """Image in an encoding that can be shown.

    Args:
        source: (height, width) or (height, width, channels).
        encoding_in: its encoding.
        encoding_out: colour or mono of 8 bits; '' for bgr8.
        do_dynamic_scaling: scale from the image's least and greatest value to 0 … 255.
        min_image_value: value that becomes 0; the same as the maximum: no scaling.
        max_image_value: value that becomes 255.

    Raises:
        RuntimeError: the encodings do not fit.
    """
    source = np.asarray(source)
    name, channels = element_type(encoding_in) or (source.dtype.name, 1)
    target = encoding_out or "bgr8"
    if not target.startswith(_PREFIXES) or not target.endswith("8"):
        raise RuntimeError(f"cv_bridge.cvtColorForDisplay: {encoding_out!r} is neither colour nor mono of 8 bits")
    if name == "int32" and target == "bgr8":
        raise RuntimeError("cv_bridge.cvtColorForDisplay: labels (32SC1) need the colours of the original's table")
    if do_dynamic_scaling:
        min_image_value, max_image_value = float(np.nanmin(source)), float(np.nanmax(source))
        if min_image_value == max_image_value:
            return np.full((*source.shape[:2], 3), _GREY, np.uint8)
    try:
        if min_image_value == max_image_value:
            return convert_color(source, "mono16" if encoding_in == "16UC1" else encoding_in, target)
        if channels != 1:
            raise ConversionError("scaling for images with more than one channel is unsupported")
        return convert_color(_scale(source, min_image_value, max_image_value), "mono8", target)
    except ConversionError as error:
        what = f"while trying to convert image from '{encoding_in}' to '{target}'"
        raise RuntimeError(f"cv_bridge.cvtColorForDisplay() {what} an exception was thrown ({error})") from None


def _scale(image, least, greatest):
    """Shades of grey of 8 bits; what is no finite number is black."""
    shifted = image.astype(np.float64) - least
    if np.issubdtype(image.dtype, np.integer):
        limits = np.iinfo(image.dtype)
        shifted = np.clip(np.rint(shifted), limits.min, limits.max)
    scaled = np.rint(shifted * (255.0 / (greatest - least)))
    return np.clip(np.where(np.isfinite(scaled), scaled, 0), 0, 255).astype(np.uint8)
