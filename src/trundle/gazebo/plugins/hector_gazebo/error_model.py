"""Error model of hector_gazebo's sensors: scale, offset, drift and noise of each axis."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.robots.parameters import TagParameters


class ErrorModel:
    """A Gauss-Markov process and white noise, by <offset>, <drift>, <driftFrequency>, <gaussianNoise>, <scaleError>."""

    def __init__(
        self, parameters: TagParameters, random: np.random.Generator, *, prefix: str = "", axes: int = 3
    ) -> None:
        """Read the parameters.

        Args:
            parameters: plugin's parameters.
            random: generator of noise and drift.
            prefix: prefix of the parameters: accel for <accelDrift> and so on.
            axes: number of values; a single number holds for all.
        """

        def read(name: str, default: float) -> NDArray[np.float64]:
            parameter = prefix + name[0].upper() + name[1:] if prefix else name
            count = 1 if len(parameters.text(parameter, "").split()) == 1 else axes
            return np.resize(np.array(parameters.numbers(parameter, count, (default,))), axes)

        self._random = random
        self._offset, self._drift = read("offset", 0.0), read("drift", 0.0)
        self._frequency = read("driftFrequency", 1.0 / 3600.0)
        self._scale = read("scaleError", 1.0)
        self.noise = read("gaussianNoise", 0.0)
        """(axes,) Standard deviation of the noise."""
        self.reset()

    @property
    def variances(self) -> list[float]:
        """(axes,) Sum of the variances of drift and noise."""
        return (self._drift**2 + self.noise**2).tolist()

    def reset(self) -> None:
        """Restart the drift."""
        self._current_drift = self._random.normal(0.0, 1.0, self._drift.shape) * self._drift

    def apply(self, values: Sequence[float], dt_s: float) -> list[float]:
        """Return the values with errors, `dt_s` after the last ones."""
        return (np.array(values) * self._scale + self.sample(dt_s)).tolist()

    def sample(self, dt_s: float) -> NDArray[np.float64]:
        """(axes,) Errors to add to true values."""
        decay = np.exp(-self._frequency * dt_s)
        diffusion = np.sqrt(2.0 * self._frequency) * self._drift * self._random.normal(0.0, 1.0, self._drift.shape)
        self._current_drift = decay * self._current_drift + dt_s * diffusion
        return self._offset + self._current_drift + self.noise * self._random.normal(0.0, 1.0, self.noise.shape)
