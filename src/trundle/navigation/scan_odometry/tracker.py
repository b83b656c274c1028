"""The robot's pose, scan by scan: each scan is matched with a keyframe."""

import math

import numpy as np
from numpy.typing import NDArray

from trundle.base.built import refuse_stale
from trundle.spatial import Pose

from ..pose_messages import PlanarPose, from_planar, planar
from . import _icp

refuse_stale(_icp)


class ScanTracker:
    """Pose in the frame of the first scan."""

    def __init__(self, options: _icp.IcpOptions, *, keyframe_linear: float, keyframe_angular: float) -> None:
        """Start at the origin.

        Args:
            options: options of the matches.
            keyframe_linear: distance after which a scan becomes the next keyframe [m]; 0: each scan.
            keyframe_angular: turn after which a scan becomes the next keyframe [rad].
        """
        self._options = options
        self._keyframe_linear = keyframe_linear
        self._keyframe_angular = keyframe_angular
        self._keyframe: NDArray[np.float64] | None = None
        self._fixed_from_keyframe = Pose()
        self.fixed_from_base = Pose()
        self.match: _icp.IcpMatch | None = None
        """Match of the last scan; None after the first."""

    def reset(self, fixed_from_base: Pose) -> None:
        """Go on at a pose, with the next scan as a keyframe."""
        self._keyframe = None
        self.fixed_from_base = self._fixed_from_keyframe = fixed_from_base

    def add(self, points: NDArray[np.float64], base_from_laser: Pose, motion: Pose) -> bool:
        """Match a scan; False: it matches nothing, and becomes the next keyframe at the predicted pose.

        Args:
            points: (n, 2) ends of the beams in the laser's frame, in their order [m].
            base_from_laser: pose of the laser on the robot.
            motion: predicted motion of the robot since the last scan.
        """
        predicted = self.fixed_from_base @ motion
        if self._keyframe is None:
            self._take(points, predicted)
            return True
        laser_from_base = base_from_laser.inverse()
        keyframe_from_base = self._fixed_from_keyframe.inverse() @ predicted
        guess = planar(laser_from_base @ keyframe_from_base @ base_from_laser)
        self.match = _icp.match_scans(self._options, self._keyframe, points, guess)
        if not self.match.is_valid:
            self._take(points, predicted)
            return False
        keyframe_from_base = base_from_laser @ from_planar(*self.match.pose) @ laser_from_base
        self.fixed_from_base = from_planar(*planar(self._fixed_from_keyframe @ keyframe_from_base))
        x, y, yaw = planar(keyframe_from_base)
        if math.hypot(x, y) > self._keyframe_linear or abs(yaw) > self._keyframe_angular:
            self._take(points, self.fixed_from_base)
        return True

    def _take(self, points: NDArray[np.float64], fixed_from_base: Pose) -> None:
        self._keyframe = points
        self.fixed_from_base = self._fixed_from_keyframe = fixed_from_base

    @property
    def pose(self) -> PlanarPose:
        """Pose of the robot."""
        return planar(self.fixed_from_base)

    @property
    def covariance(self) -> NDArray[np.float64]:
        """Covariance (3, 3) of x, y and yaw of the last match with its keyframe, in the fixed frame."""
        if self.match is None:
            return np.zeros((3, 3))
        xx, xy, yy, xt, yt, tt = self.match.covariance
        covariance = np.array([[xx, xy, xt], [xy, yy, yt], [xt, yt, tt]])
        yaw = planar(self._fixed_from_keyframe)[2]
        turn = np.eye(3)
        turn[:2, :2] = [[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]]
        return turn @ covariance @ turn.T
