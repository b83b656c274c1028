"""Extended Kalman filter of a free body's motion.

State: x, y, z [m]; roll, pitch, yaw [rad], in the world; velocity [m/s], angular velocity [rad/s] and acceleration
[m/s²], in the body. T. Moore and D. Stouch, "A Generalized Extended Kalman Filter Implementation for the Robot
Operating System", 2014.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

SIZE = 15
ANGLES = slice(3, 6)
_STEP = 1e-6
"""Step of numerical derivatives."""
_MIN_VARIANCE = 1e-9
"""Minimum variance of a measurement, which bounds the gain."""
_MIN_COS_PITCH = 1e-6
Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True, kw_only=True)
class Measurement:
    """Values of some elements of the state at one time."""

    stamp_ns: int
    indices: tuple[int, ...]
    """Measured elements of the state, n of them."""
    values: Array
    """(n,)"""
    covariance: Array
    """(n, n)"""
    max_distance: float = math.inf
    """Mahalanobis distance from the estimate above which the measurement is rejected."""


class KalmanFilter:
    """Estimate and its covariance."""

    def __init__(self, *, process_noise: Array, covariance: Array, state: Sequence[float] = (0.0,) * SIZE) -> None:
        """Start with a state.

        Args:
            process_noise: (15, 15) growth of the covariance per second of prediction.
            covariance: (15, 15) covariance of the state.
            state: (15,) initial state; see the module.
        """
        self._process_noise = process_noise
        self.state: Array = np.array(state, dtype=float)
        self.covariance: Array = np.array(covariance, dtype=float)

    def predict(self, dt: float) -> None:
        """Predict over a time [s] at constant acceleration and angular velocity."""
        steps = _STEP * np.eye(SIZE)
        samples = np.concatenate((steps, -steps), axis=1) + self.state[:, None]
        predicted = move(np.concatenate((samples, self.state[:, None]), axis=1), dt)
        jacobian = (predicted[:, :SIZE] - predicted[:, SIZE:-1]) / (2.0 * _STEP)
        self.state = predicted[:, -1]
        self.covariance = jacobian @ self.covariance @ jacobian.T + self._process_noise * dt
        self._wrap()

    def start(self, measurement: Measurement) -> None:
        """Set the measured elements of the state from the first measurement."""
        indices = list(measurement.indices)
        self.state[indices] = measurement.values
        self.covariance[np.ix_(indices, indices)] = measurement.covariance

    def correct(self, measurement: Measurement) -> bool:
        """Correct by a measurement; return False, with the state unchanged, if it is too far from the estimate."""
        indices = list(measurement.indices)
        noise = measurement.covariance.copy()
        np.fill_diagonal(noise, np.maximum(np.abs(np.diagonal(noise)), _MIN_VARIANCE))
        columns = self.covariance[:, indices]
        information = np.linalg.inv(columns[indices] + noise)
        difference = measurement.values - self.state[indices]
        angle_rows = [row for row, index in enumerate(indices) if ANGLES.start <= index < ANGLES.stop]
        difference[angle_rows] = wrap_angles(difference[angle_rows])
        if float(difference @ information @ difference) > measurement.max_distance**2:
            return False
        gain = columns @ information
        self.state = self.state + gain @ difference
        correction = np.eye(SIZE)
        correction[:, indices] -= gain
        self.covariance = (
            correction @ self.covariance @ correction.T + gain @ noise @ gain.T
        )  # Joseph form: stays positive definite
        self._wrap()
        return True

    def _wrap(self) -> None:
        self.state[ANGLES] = wrap_angles(self.state[ANGLES])


def wrap_angles(angles: Array) -> Array:
    """Wrap angles [rad] to ±π."""
    return (angles + math.pi) % (2.0 * math.pi) - math.pi


def move(states: Array, dt: float) -> Array:
    """Return states (15, n) after a time [s]."""
    predicted = states.copy()
    displacement = states[6:9] * dt + 0.5 * states[12:15] * dt * dt
    (sr, sp, sy), (cr, cp, cy) = np.sin(states[ANGLES]), np.cos(states[ANGLES])
    x, y, z = displacement
    predicted[0] += cy * cp * x + (cy * sp * sr - sy * cr) * y + (cy * sp * cr + sy * sr) * z
    predicted[1] += sy * cp * x + (sy * sp * sr + cy * cr) * y + (sy * sp * cr - cy * sr) * z
    predicted[2] += -sp * x + cp * sr * y + cp * cr * z
    yaw_component = sr * states[10] + cr * states[11]
    cos_pitch = np.where(np.abs(cp) < _MIN_COS_PITCH, np.copysign(_MIN_COS_PITCH, cp), cp)
    predicted[3] += (states[9] + sp / cos_pitch * yaw_component) * dt
    predicted[4] += (cr * states[10] - sr * states[11]) * dt
    predicted[5] += yaw_component / cos_pitch * dt
    predicted[6:9] += states[12:15] * dt
    return predicted
