"""Lens distortion by the plumb bob and rational models (D. C. Brown, 1966; OpenCV's camera calibration)."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    _Array = NDArray[np.float64]

_ROUNDS = 20
"""Fixed-point iterations of the inverse; a few suffice for usual lenses."""


class Camera(Protocol):
    """Calibrated camera, as PinholeCameraModel."""

    K: Any
    D: Any
    R: Any
    P: Any
    width: Any
    height: Any


def distort(x: "_Array", y: "_Array", coefficients: Sequence[float]) -> "tuple[_Array, _Array]":
    """Distorted normalized coordinates of ideal ones; coefficients k1 k2 p1 p2 k3 k4 k5 k6."""
    k1, k2, p1, p2, k3, k4, k5, k6 = coefficients
    r2 = x * x + y * y
    radial = (1 + r2 * (k1 + r2 * (k2 + r2 * k3))) / (1 + r2 * (k4 + r2 * (k5 + r2 * k6)))
    tangential_x = 2 * p1 * x * y + p2 * (r2 + 2 * x * x)
    tangential_y = p1 * (r2 + 2 * y * y) + 2 * p2 * x * y
    return x * radial + tangential_x, y * radial + tangential_y


def eight_coefficients(D: "ArrayLike | None") -> list[float]:
    """Coefficients of a model's D, padded with zeros."""
    coefficients = [] if D is None else np.asarray(D, dtype=float).ravel().tolist()[:8]
    return coefficients + [0.0] * (8 - len(coefficients))


def undistort_point(
    uv: Sequence[float], K: "ArrayLike", D: "ArrayLike | None", R: "ArrayLike", P: "ArrayLike"
) -> "_Array":
    """Rectified pixel, (2,), of a raw one."""
    k, r, p = (np.asarray(matrix, dtype=float) for matrix in (K, R, P))
    coefficients = eight_coefficients(D)
    raw = np.array([(uv[0] - k[0, 2]) / k[0, 0], (uv[1] - k[1, 2]) / k[1, 1]])
    ideal = raw.copy()
    for _ in range(_ROUNDS):
        ideal += raw - np.array(distort(ideal[0], ideal[1], coefficients))
    u, v, w = p[:, :3] @ r @ (*ideal, 1.0)
    return np.array([u / w, v / w])


def rectify_maps(model: Camera) -> "tuple[NDArray[np.float32], NDArray[np.float32]]":
    """Raw pixel x and y, each (height, width), of every rectified pixel."""
    k, r, p = (np.asarray(matrix, dtype=float) for matrix in (model.K, model.R, model.P))
    v, u = np.mgrid[0 : model.height, 0 : model.width].astype(float)
    rays = np.linalg.inv(p[:, :3] @ r) @ np.stack([u.ravel(), v.ravel(), np.ones(u.size)])
    x, y = distort(rays[0] / rays[2], rays[1] / rays[2], eight_coefficients(model.D))
    shape = (model.height, model.width)
    return (
        (x * k[0, 0] + k[0, 2]).reshape(shape).astype(np.float32),
        (y * k[1, 1] + k[1, 2]).reshape(shape).astype(np.float32),
    )


def rectify_image(
    model: Camera, raw: "NDArray[Any]", rectified: "NDArray[Any]"
) -> "tuple[NDArray[np.float32], NDArray[np.float32]]":
    """Write the rectified image; returns the maps. Bicubic with OpenCV, else bilinear; black outside."""
    map_x, map_y = rectify_maps(model)
    try:
        import cv2
    except ImportError:
        rectified[...] = _sample(np.asarray(raw), map_x, map_y)
    else:
        cv2.remap(raw, map_x, map_y, cv2.INTER_CUBIC, rectified)
    return map_x, map_y


def _sample(image: "NDArray[Any]", map_x: "NDArray[np.float32]", map_y: "NDArray[np.float32]") -> "_Array":
    """Bilinear interpolation of an image, (height, width[, channels])."""
    height, width = image.shape[:2]
    left, top = np.floor(map_x).astype(int), np.floor(map_y).astype(int)
    result = np.zeros((*map_x.shape, *image.shape[2:]))
    for dx in (0, 1):
        for dy in (0, 1):
            x, y = left + dx, top + dy
            weight = (1 - np.abs(map_x - x)) * (1 - np.abs(map_y - y))
            weight *= (x >= 0) & (x < width) & (y >= 0) & (y < height)
            pixels = image[np.clip(y, 0, height - 1), np.clip(x, 0, width - 1)]
            result += weight.reshape(weight.shape + (1,) * (image.ndim - 2)) * pixels
    return np.rint(result) if np.issubdtype(image.dtype, np.integer) else result
