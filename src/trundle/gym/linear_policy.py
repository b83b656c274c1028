"""Linear policy: an action for an observation, by a matrix."""

from os import PathLike
from typing import Self

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

_Array = NDArray[np.float64]


class LinearPolicy(Struct, frozen=True, eq=False):
    """Action = middle + half range · (weights · observation + bias), within the range."""

    weights: _Array
    """(actions, observations)"""
    bias: _Array
    """(actions,)"""
    low: _Array
    """(actions,) smallest action."""
    high: _Array
    """(actions,) largest action."""

    def __call__(self, observation: NDArray[np.floating]) -> _Array:
        """Return the action (…, actions) for an observation (…, observations)."""
        asked = np.clip(observation @ self.weights.T + self.bias, -1.0, 1.0)
        return (self.low + self.high) / 2 + (self.high - self.low) / 2 * asked

    def save(self, file: str | PathLike[str]) -> None:
        """Write a .npz file."""
        np.savez(file, weights=self.weights, bias=self.bias, low=self.low, high=self.high)

    @classmethod
    def load(cls, file: str | PathLike[str]) -> Self:
        """Read a file of `save`."""
        with np.load(file) as arrays:
            return cls(arrays["weights"], arrays["bias"], arrays["low"], arrays["high"])
