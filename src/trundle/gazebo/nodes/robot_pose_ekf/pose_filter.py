"""Kalman filter of a pose by relative measurements."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose, quaternion_from_rpy

_Array = NDArray[np.float64]
_SYSTEM_NOISE = 1000.0**2
"""Variance that a step adds; so large that only the sensors' motions determine the pose, as in the original."""
_START_VARIANCE = 0.001**2


class PoseFilter:
    """Kalman filter of a pose: x, y, z [m], roll, pitch, yaw [rad]."""

    def __init__(self, pose: Pose) -> None:
        self.state: _Array = np.array([*pose.position, *pose.rpy])
        self.covariance: _Array = _START_VARIANCE * np.eye(6)

    @property
    def pose(self) -> Pose:
        """Estimate."""
        x, y, z, roll, pitch, yaw = self.state.tolist()
        return Pose((x, y, z), quaternion_from_rpy(roll, pitch, yaw))

    def predict(self) -> None:
        """Predict: the robot may have moved anywhere."""
        self.covariance = self.covariance + _SYSTEM_NOISE * np.eye(6)

    def rest(self) -> None:
        """Undo the last prediction: the robot stands still."""
        self.covariance = self.covariance - _SYSTEM_NOISE * np.eye(6)

    def correct(self, indices: Sequence[int], values: Sequence[float], covariance: _Array) -> None:
        """Correct by measured elements and their covariance; angles are wrapped to the estimate's."""
        rows = list(indices)
        difference = np.array(values) - self.state[rows]
        for row, index in enumerate(rows):
            if index >= 3:
                difference[row] = math.remainder(difference[row], math.tau)
        columns = self.covariance[:, rows]
        gain = columns @ np.linalg.inv(columns[rows] + covariance)
        self.state = self.state + gain @ difference
        correction = np.eye(6)
        correction[:, rows] -= gain
        self.covariance = correction @ self.covariance @ correction.T + gain @ covariance @ gain.T
