"""A sensor_msgs/Image as the page can show it."""

import numpy as np
from numpy.typing import NDArray

_COLORS: dict[str, tuple[int, tuple[int, int, int]]] = {
    "rgb8": (3, (0, 1, 2)),
    "bgr8": (3, (2, 1, 0)),
    "rgba8": (4, (0, 1, 2)),
    "bgra8": (4, (2, 1, 0)),
    "mono8": (1, (0, 0, 0)),
    "8UC1": (1, (0, 0, 0)),
    "8UC3": (3, (2, 1, 0)),
}
"""Encoding → bytes of a pixel, and which of them are red, green and blue (OpenCV's own order is blue first)."""
_RANGES = {"16UC1": np.uint16, "mono16": np.uint16, "32FC1": np.float32}
"""Depths and 16-bit greys are stretched over the values they hold, as rviz's "Normalize Range" does."""


def rgb_of(
    data: bytes | memoryview | NDArray[np.uint8],
    *,
    encoding: str,
    height: int,
    width: int,
    step: int,
    big_endian: bool = False,
) -> NDArray[np.uint8] | None:
    """Return (height, width, 3), or None where the encoding is unknown or the data too short for it."""
    raw = np.frombuffer(data, dtype=np.uint8)
    if height <= 0 or width <= 0 or raw.size < height * step:
        return None
    rows = raw[: height * step].reshape(height, step)
    if encoding in _COLORS:
        size, order = _COLORS[encoding]
        if step < width * size:
            return None
        pixels = rows[:, : width * size].reshape(height, width, size)
        return np.ascontiguousarray(pixels[:, :, list(order)])
    if encoding in _RANGES:
        kind = np.dtype(_RANGES[encoding]).newbyteorder(">" if big_endian else "<")
        if step < width * kind.itemsize:
            return None
        values = np.ascontiguousarray(rows[:, : width * kind.itemsize]).view(kind).astype(np.float64)
        return _grey(values)
    return None


def _grey(values: NDArray[np.float64]) -> NDArray[np.uint8]:
    """Stretch values over 0 to 255; what is not finite is black."""
    finite = np.isfinite(values)
    low, high = (float(values[finite].min()), float(values[finite].max())) if finite.any() else (0.0, 1.0)
    scaled = np.where(finite, (values - low) / max(high - low, 1e-9) * 255.0, 0.0)
    return np.repeat(scaled.astype(np.uint8)[:, :, None], 3, axis=2)
