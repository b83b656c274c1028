"""Noise as SDF states it: a Gaussian at every reading and a bias that is drawn once."""

import numpy as np
from numpy.typing import NDArray

from trundle.model import Noise

_Values = NDArray[np.float64]


class NoiseSource:
    """The noise of one value, or of every value of a scan."""

    def __init__(self, noise: Noise, random: np.random.Generator) -> None:
        self._noise = noise
        self._random = random
        sign = 1.0 if random.random() < 0.5 else -1.0
        self._bias = sign * random.normal(noise.bias_mean, noise.bias_stddev)
        self.is_silent = noise == Noise()

    def disturb(self, values: _Values) -> _Values:
        """The values with noise on each."""
        if self.is_silent:
            return values
        return values + self._random.normal(self._noise.mean, self._noise.stddev, values.shape) + self._bias
