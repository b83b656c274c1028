"""Noise of SDF: a Gaussian per reading, a bias and quantisation."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import Noise
from trundle.spatial import NS_PER_S, Vector3

_Values = NDArray[np.float64]


class NoiseSource:
    """Noise of one value, or of every value of a scan."""

    def __init__(self, noise: Noise, random: "np.random.Generator") -> None:
        self._noise = noise
        self._random = random
        sign = 1.0 if random.random() < 0.5 else -1.0
        self._bias = sign * random.normal(noise.bias_mean, noise.bias_stddev)
        self._last_ns: int | None = None
        self.is_silent = noise == Noise()

    def apply_to_value(self, value: float, time_ns: int = 0) -> float:
        """Return a value with noise; the time advances a wandering bias."""
        return float(self.apply(np.array([value]), time_ns)[0])

    def apply(self, values: _Values, time_ns: int) -> _Values:
        """Return the values of one instant with noise on each."""
        noise = self._noise
        if self.is_silent:
            return values
        self._wander(time_ns)
        noisy = values + self._random.normal(noise.mean, noise.stddev, values.shape) + self._bias
        return np.round(noisy / noise.precision) * noise.precision if noise.precision else noisy

    def _wander(self, time_ns: int) -> None:
        """Advance the bias by the elapsed time with the exact Ornstein-Uhlenbeck step, as Gazebo does."""
        density, tau = self._noise.wander_density, self._noise.wander_time_s
        last_ns, self._last_ns = self._last_ns, time_ns
        if not (density and tau) or last_ns is None or time_ns <= last_ns:
            return
        elapsed = (time_ns - last_ns) / NS_PER_S
        spread = density * math.sqrt(-tau / 2.0 * math.expm1(-2.0 * elapsed / tau))
        self._bias = math.exp(-elapsed / tau) * self._bias + self._random.normal(0.0, spread)


def apply_noise(values: Vector3, sources: Sequence[NoiseSource], time_ns: int) -> Vector3:
    """Return a vector with the noise of each component."""
    x, y, z = (source.apply_to_value(value, time_ns) for value, source in zip(values, sources, strict=True))
    return (x, y, z)
