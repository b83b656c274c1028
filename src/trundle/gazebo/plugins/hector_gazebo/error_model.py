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
            parameters: of the plugin.
            random: for noise and drift.
            prefix: of the parameters: accel for <accelDrift> and so on.
            axes: number of values; a single number holds for all.
        """

        def read(name: str, default: float) -> NDArray[np.float64]:
            full = prefix + name[0].upper() + name[1:] if prefix else name
            count = 1 if len(parameters.text(full, "").split()) == 1 else axes
            return np.resize(np.array(parameters.numbers(full, count, (default,))), axes)

        self._random = random
        self._offset, self._drift = read("offset", 0.0), read("drift", 0.0)
        self._frequency = read("driftFrequency", 1.0 / 3600.0)
        self._scale = read("scaleError", 1.0)
        self.noise = read("gaussianNoise", 0.0)
        """(axes,) Standard deviation of the noise."""
        self.reset()

    @property
    def variances(self) -> list[float]:
        """(axes,) Variances of drift and noise together."""
        return (self._drift**2 + self.noise**2).tolist()

    def reset(self) -> None:
        """Restart the drift."""
        self._drifted = self._random.normal(0.0, 1.0, self._drift.shape) * self._drift

    def apply(self, values: Sequence[float], dt_s: float) -> list[float]:
        """Values with errors, `dt_s` after the last ones."""
        return (np.array(values) * self._scale + self.sample(dt_s)).tolist()

    def sample(self, dt_s: float) -> NDArray[np.float64]:
        """(axes,) Errors to add to true values."""
        kept = np.exp(-self._frequency * dt_s)
        push = np.sqrt(2.0 * self._frequency) * self._drift * self._random.normal(0.0, 1.0, self._drift.shape)
        self._drifted = kept * self._drifted + dt_s * push
        return self._offset + self._drifted + self.noise * self._random.normal(0.0, 1.0, self.noise.shape)
