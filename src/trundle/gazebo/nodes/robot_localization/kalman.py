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
"""Smallest variance of a measurement: no sensor is exact, and the gain would have no bound."""
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
    """Mahalanobis distance from the estimate above which it is rejected."""


class KalmanFilter:
    """Estimate and its covariance."""

    def __init__(self, *, process_noise: Array, covariance: Array, state: Sequence[float] = (0.0,) * SIZE) -> None:
        """Start with a state.

        Args:
            process_noise: (15, 15), growth of the covariance in each second of prediction.
            covariance: (15, 15) of the state.
            state: see the module.
        """
        self._process_noise = process_noise
        self.state: Array = np.array(state, dtype=float)
        self.covariance: Array = np.array(covariance, dtype=float)

    def predict(self, dt: float) -> None:
        """Move on by a time [s] at constant acceleration and angular velocity."""
        steps = _STEP * np.eye(SIZE)
        around = np.concatenate((steps, -steps), axis=1) + self.state[:, None]
        moved = _motion(np.concatenate((around, self.state[:, None]), axis=1), dt)
        slopes = (moved[:, :SIZE] - moved[:, SIZE:-1]) / (2.0 * _STEP)
        self.state = moved[:, -1]
        self.covariance = slopes @ self.covariance @ slopes.T + self._process_noise * dt
        self._wrap()

    def start(self, measurement: Measurement) -> None:
        """Take over what the first measurement has."""
        at = list(measurement.indices)
        self.state[at] = measurement.values
        self.covariance[np.ix_(at, at)] = measurement.covariance

    def correct(self, measurement: Measurement) -> bool:
        """Correct by a measurement; return False if it is too far from the estimate, and nothing changed."""
        at = list(measurement.indices)
        noise = measurement.covariance.copy()
        np.fill_diagonal(noise, np.maximum(np.abs(np.diagonal(noise)), _MIN_VARIANCE))
        columns = self.covariance[:, at]
        spread = np.linalg.inv(columns[at] + noise)
        difference = measurement.values - self.state[at]
        turned = [number for number, index in enumerate(at) if ANGLES.start <= index < ANGLES.stop]
        difference[turned] = wrapped(difference[turned])
        if float(difference @ spread @ difference) > measurement.max_distance**2:
            return False
        gain = columns @ spread
        self.state = self.state + gain @ difference
        kept = np.eye(SIZE)
        kept[:, at] -= gain
        self.covariance = kept @ self.covariance @ kept.T + gain @ noise @ gain.T  # Joseph's form stays positive
        self._wrap()
        return True

    def _wrap(self) -> None:
        self.state[ANGLES] = wrapped(self.state[ANGLES])


def wrapped(angles: Array) -> Array:
    """Return angles [rad] within ±π."""
    return (angles + math.pi) % (2.0 * math.pi) - math.pi


def _motion(states: Array, dt: float) -> Array:
    """Return states (15, n) after a time [s]."""
    moved = states.copy()
    shift = states[6:9] * dt + 0.5 * states[12:15] * dt * dt
    (sr, sp, sy), (cr, cp, cy) = np.sin(states[ANGLES]), np.cos(states[ANGLES])
    x, y, z = shift
    moved[0] += cy * cp * x + (cy * sp * sr - sy * cr) * y + (cy * sp * cr + sy * sr) * z
    moved[1] += sy * cp * x + (sy * sp * sr + cy * cr) * y + (sy * sp * cr - cy * sr) * z
    moved[2] += -sp * x + cp * sr * y + cp * cr * z
    across = sr * states[10] + cr * states[11]
    level = np.where(np.abs(cp) < _MIN_COS_PITCH, np.copysign(_MIN_COS_PITCH, cp), cp)
    moved[3] += (states[9] + sp / level * across) * dt
    moved[4] += (cr * states[10] - sr * states[11]) * dt
    moved[5] += across / level * dt
    moved[6:9] += states[12:15] * dt
    return moved
