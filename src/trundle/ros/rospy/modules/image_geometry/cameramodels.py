"""Pinhole and stereo cameras, from CameraInfo messages.

Matrices are numpy.matrix, as in image_geometry, so that `*` multiplies them.
"""

import copy
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy

from .distortion import rectify_image, undistort_point

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    _Matrix = numpy.matrix[Any, numpy.dtype[numpy.float64]]


def mkmat(rows: int, cols: int, L: "ArrayLike") -> "_Matrix":
    """Matrix of numbers, row by row."""
    return numpy.matrix(numpy.array(L, dtype="float64").reshape(rows, cols))


class PinholeCameraModel:
    """Camera with one lens."""

    def __init__(self) -> None:
        self.K: Any = None
        self.D: Any = None
        self.R: Any = None
        self.P: Any = None
        self.full_K: Any = None
        self.full_P: Any = None
        self.width: Any = None
        self.height: Any = None
        self.binning_x: Any = None
        self.binning_y: Any = None
        self.raw_roi: Any = None
        self.tf_frame: Any = None
        self.stamp: Any = None
        self.resolution: Any = None

    def fromCameraInfo(self, msg: Any) -> None:
        """Read the parameters of a CameraInfo message; K and P are adjusted for binning and region of interest."""
        self.full_K, self.full_P = mkmat(3, 3, msg.K), mkmat(3, 4, msg.P)
        self.K, self.P = self.full_K.copy(), self.full_P.copy()
        self.D = mkmat(len(msg.D), 1, msg.D) if len(msg.D) else None
        self.R = mkmat(3, 3, msg.R)
        self.width, self.height = msg.width, msg.height
        self.resolution = (msg.width, msg.height)
        self.binning_x, self.binning_y = max(1, msg.binning_x), max(1, msg.binning_y)
        self.raw_roi = copy.copy(msg.roi)
        if not any((msg.roi.x_offset, msg.roi.y_offset, msg.roi.width, msg.roi.height)):
            self.raw_roi.width, self.raw_roi.height = msg.width, msg.height
        self.tf_frame, self.stamp = msg.header.frame_id, msg.header.stamp
        for matrix in (self.K, self.P):
            matrix[0, 0] /= self.binning_x
            matrix[1, 1] /= self.binning_y
            matrix[0, 2] = (matrix[0, 2] - self.raw_roi.x_offset) / self.binning_x
            matrix[1, 2] = (matrix[1, 2] - self.raw_roi.y_offset) / self.binning_y

    def rectifyImage(self, raw: "NDArray[Any]", rectified: "NDArray[Any]") -> None:
        """Write the rectified image of `raw` into the array `rectified`, (height, width[, channels])."""
        self.mapx, self.mapy = rectify_image(self, raw, rectified)

    def rectifyPoint(self, uv_raw: Sequence[float]) -> "NDArray[numpy.float64]":
        """Rectified pixel (u, v) of a raw one."""
        return undistort_point(uv_raw, self.K, self.D, self.R, self.P)

    def project3dToPixel(self, point: Sequence[float]) -> tuple[float, float]:
        """Rectified pixel (u, v) of a point (x, y, z) [m] in the camera's frame; NaN in its plane."""
        x, y, w = (float(value) for value in numpy.asarray(self.P) @ (*point[:3], 1.0))
        return (x / w, y / w) if w != 0 else (math.nan, math.nan)

    def projectPixelTo3dRay(self, uv: Sequence[float]) -> tuple[float, float, float]:
        """Unit vector from the camera through a rectified pixel."""
        x, y = (uv[0] - self.cx()) / self.fx(), (uv[1] - self.cy()) / self.fy()
        length = math.sqrt(x * x + y * y + 1.0)
        return x / length, y / length, 1.0 / length

    def getDeltaU(self, deltaX: float, Z: float) -> float:
        """Pixels of a width [m] at depth Z [m]."""
        return math.inf if Z == 0 else self.fx() * deltaX / Z

    def getDeltaV(self, deltaY: float, Z: float) -> float:
        """Pixels of a height [m] at depth Z [m]."""
        return math.inf if Z == 0 else self.fy() * deltaY / Z

    def getDeltaX(self, deltaU: float, Z: float) -> float:
        """Width [m] of pixels at depth Z [m]."""
        return Z * deltaU / self.fx()

    def getDeltaY(self, deltaV: float, Z: float) -> float:
        """Height [m] of pixels at depth Z [m]."""
        return Z * deltaV / self.fy()

    def fullResolution(self) -> Any:
        """(width, height) [px], without binning and region of interest."""
        return self.resolution

    def intrinsicMatrix(self) -> Any:
        """K, 3×3."""
        return self.K

    def distortionCoeffs(self) -> Any:
        """D, n×1, or None."""
        return self.D

    def rotationMatrix(self) -> Any:
        """R, 3×3."""
        return self.R

    def projectionMatrix(self) -> Any:
        """P, 3×4."""
        return self.P

    def fullIntrinsicMatrix(self) -> Any:
        """K at full resolution."""
        return self.full_K

    def fullProjectionMatrix(self) -> Any:
        """P at full resolution."""
        return self.full_P

    def cx(self) -> float:
        """Principal point [px]."""
        return self.P[0, 2]

    def cy(self) -> float:
        """Principal point [px]."""
        return self.P[1, 2]

    def fx(self) -> float:
        """Focal length [px]."""
        return self.P[0, 0]

    def fy(self) -> float:
        """Focal length [px]."""
        return self.P[1, 1]

    def Tx(self) -> float:
        """Translation of a stereo camera's second lens times -fx [px·m]."""
        return self.P[0, 3]

    def Ty(self) -> float:
        """Translation in y times -fy [px·m]; see `Tx`."""
        return self.P[1, 3]

    def fovX(self) -> float:
        """Horizontal field of view [rad]."""
        return 2 * math.atan(self.width / (2 * self.fx()))

    def fovY(self) -> float:
        """Vertical field of view [rad]."""
        return 2 * math.atan(self.height / (2 * self.fy()))

    def tfFrame(self) -> Any:
        """Name of the camera's optical frame."""
        return self.tf_frame


class StereoCameraModel:
    """Two rectified cameras side by side."""

    def __init__(self) -> None:
        self.left, self.right = PinholeCameraModel(), PinholeCameraModel()
        self.Q: Any = None

    def fromCameraInfo(self, left_msg: Any, right_msg: Any) -> None:
        """Read the parameters of two CameraInfo messages."""
        self.left.fromCameraInfo(left_msg)
        self.right.fromCameraInfo(right_msg)
        baseline = -self.right.Tx() / self.right.fx()
        self.Q = numpy.zeros((4, 4))
        self.Q[0, 0] = self.Q[1, 1] = 1.0
        self.Q[0, 3], self.Q[1, 3] = -self.right.cx(), -self.right.cy()
        self.Q[2, 3] = self.right.fx()
        self.Q[3, 2] = 1.0 / baseline

    def tfFrame(self) -> Any:
        """Name of the left camera's optical frame."""
        return self.left.tfFrame()

    def project3dToPixel(self, point: Sequence[float]) -> tuple[tuple[float, float], tuple[float, float]]:
        """((u, v) left, (u, v) right) of a point (x, y, z) [m]."""
        return self.left.project3dToPixel(point), self.right.project3dToPixel(point)

    def projectPixelTo3d(self, left_uv: Sequence[float], disparity: float) -> tuple[float, float, float]:
        """Point (x, y, z) [m] of a left pixel and its disparity [px]; zeros for disparity 0."""
        x, y, z, w = (float(value) for value in self.Q @ (left_uv[0], left_uv[1], disparity, 1.0))
        return (x / w, y / w, z / w) if w != 0 else (0.0, 0.0, 0.0)

    def getZ(self, disparity: float) -> float:
        """Depth [m] of a disparity [px]."""
        return math.inf if disparity == 0 else -self.right.Tx() / disparity

    def getDisparity(self, Z: float) -> float:
        """Disparity [px] at a depth [m]."""
        return math.inf if Z == 0 else -self.right.Tx() / Z
