"""Noise as SDF states it: a Gaussian at every reading and a bias that is drawn once."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.model import Noise
from trundle.spatial import Vector3

_Values = NDArray[np.float64]


class NoiseSource:
    """The noise of one value, or of every value of a scan."""

    def __init__(self, noise: Noise, random: np.random.Generator) -> None:
        self._noise = noise
        self._random = random
        sign = 1.0 if random.random() < 0.5 else -1.0
        self._bias = sign * random.normal(noise.bias_mean, noise.bias_stddev)
        self.is_silent = noise == Noise()

    def disturb_one(self, value: float) -> float:
        """A value with noise on it."""
        return float(self.disturb(np.array([value]))[0])

    def disturb(self, values: _Values) -> _Values:
        """The values with noise on each."""
        if self.is_silent:
            return values
        return values + self._random.normal(self._noise.mean, self._noise.stddev, values.shape) + self._bias


def disturbed(values: Vector3, sources: Sequence[NoiseSource]) -> Vector3:
    """Three numbers with the noise of each."""
    x, y, z = (source.disturb_one(value) for value, source in zip(values, sources, strict=True))
    return (x, y, z)
