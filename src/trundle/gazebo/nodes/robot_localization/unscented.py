"""Unscented Kalman filter of a free body's motion: a few points, moved by the motion, give the uncertainty.

E. Wan and R. van der Merwe, "The unscented Kalman filter for nonlinear estimation", 2000. Measurements are elements of
the state, so that their correction is that of the extended filter.
"""

from collections.abc import Sequence

import numpy as np

from .kalman import ANGLES, SIZE, Array, KalmanFilter, move, wrap_angles


class UnscentedKalmanFilter(KalmanFilter):
    """Estimate and its covariance."""

    def __init__(
        self,
        *,
        process_noise: Array,
        covariance: Array,
        state: Sequence[float] = (0.0,) * SIZE,
        alpha: float = 0.001,
        kappa: float = 0.0,
        beta: float = 2.0,
    ) -> None:
        """Start with a state.

        Args:
            process_noise: (15, 15) growth of the covariance per second of prediction.
            covariance: (15, 15) covariance of the state.
            state: (15,) initial state; see `kalman`.
            alpha: distance of the points from the estimate, divided by the standard deviation and √15.
            kappa: number added to 15 in that distance.
            beta: knowledge of the distribution; 2 for a normal one.
        """
        super().__init__(process_noise=process_noise, covariance=covariance, state=state)
        spread = alpha * alpha * (SIZE + kappa)
        self._reach = float(np.sqrt(spread))
        self._mean_weights = np.full(2 * SIZE + 1, 0.5 / spread)
        self._mean_weights[0] = 1.0 - SIZE / spread
        self._covariance_weights = self._mean_weights.copy()
        self._covariance_weights[0] += 1.0 - alpha * alpha + beta

    def predict(self, dt: float) -> None:
        """Predict over a time [s] at constant acceleration and angular velocity."""
        steps = self._reach * _root(self.covariance)
        points = self.state[:, None] + np.concatenate((np.zeros((SIZE, 1)), steps, -steps), axis=1)
        moved = move(points, dt)
        # differences from the moved estimate, so that angles may be averaged
        offsets = moved - moved[:, :1]
        offsets[ANGLES] = wrap_angles(offsets[ANGLES])
        mean = offsets @ self._mean_weights
        deviations = offsets - mean[:, None]
        self.state = moved[:, 0] + mean
        self.covariance = (deviations * self._covariance_weights) @ deviations.T + self._process_noise * dt
        self._wrap()


def _root(covariance: Array) -> Array:
    """Return a matrix whose product with its transpose is a covariance, which may be singular."""
    try:
        root = np.asarray(np.linalg.cholesky(covariance), dtype=np.float64)
    except np.linalg.LinAlgError:
        values, vectors = np.linalg.eigh(covariance)
        root = np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)), dtype=np.float64)
    return root
