"""Policy: a small network that returns an action for an observation."""

from os import PathLike, fspath
from pathlib import Path
from typing import Self
from zipfile import BadZipFile

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.atomic_write import replaced_atomically
from trundle.base.diagnostics import UsageError

from .networks import evaluate

_Array = NDArray[np.float64]
_MAX_DEVIATION = 10.0
"""Largest observation, in standard deviations from the mean."""
_MAX_BYTES = 64 << 20
_PARTS = ("mean", "deviation", "low", "high")


class MlpPolicy(Struct, frozen=True, eq=False):
    """Multilayer perceptron with normalized observations, whose outputs −1 … 1 are scaled to low … high."""

    parameters: tuple[_Array, ...]
    """Weights and bias of each layer; see `networks.evaluate`."""
    mean: _Array
    """(observations,) mean of the training's observations."""
    deviation: _Array
    """(observations,) standard deviation of the training's observations."""
    low: _Array
    """(actions,) smallest action."""
    high: _Array
    """(actions,) largest action."""

    def __call__(self, observation: NDArray[np.floating]) -> _Array:
        """Return the action (…, actions) for an observation (…, observations)."""
        return self.scale(evaluate(self.parameters, self.normalize(observation)))

    def normalize(self, observation: NDArray[np.floating]) -> _Array:
        """Return observations (…, values) in standard deviations from the mean."""
        return np.clip((observation - self.mean) / self.deviation, -_MAX_DEVIATION, _MAX_DEVIATION)

    def scale(self, outputs: _Array) -> _Array:
        """Return actions (…, values) for outputs in −1 … 1."""
        return (self.low + self.high) / 2 + (self.high - self.low) / 2 * np.clip(outputs, -1.0, 1.0)

    def save(self, file: str | PathLike[str]) -> None:
        """Write a .npz file."""
        layers = {f"layer_{number}": array for number, array in enumerate(self.parameters)}
        with replaced_atomically(Path(file)) as temporary, temporary.open("wb") as stream:
            np.savez(stream, **layers, **{name: getattr(self, name) for name in _PARTS})

    @classmethod
    def load(cls, file: str | PathLike[str]) -> Self:
        """Read a file that `save` wrote.

        Raises:
            UsageError: the file is not a policy.
        """
        try:
            with open(file, "rb") as stream, np.load(stream, allow_pickle=False) as arrays:
                if sum(entry.file_size for entry in arrays.zip.infolist()) > _MAX_BYTES:
                    raise ValueError(f"it holds more than {_MAX_BYTES >> 20} MiB")
                names = [name for name in arrays.files if name.startswith("layer_")]
                layers = tuple(np.asarray(arrays[f"layer_{number}"], np.float64) for number in range(len(names)))
                policy = cls(layers, *(np.asarray(arrays[name], np.float64) for name in _PARTS))
        except (AttributeError, BadZipFile, EOFError, KeyError, MemoryError, OSError, TypeError, ValueError) as error:
            raise UsageError(f"{fspath(file)}: not a policy that MlpPolicy.save wrote: {error}") from None
        if not policy._fits():
            raise UsageError(f"{fspath(file)}: not a policy: its arrays do not fit together, or are not finite")
        return policy

    def _fits(self) -> bool:
        """True if all arrays are finite and of matching sizes."""
        size = self.mean.shape
        for weights, bias in zip(self.parameters[::2], self.parameters[1::2], strict=False):
            if weights.shape != size + bias.shape or bias.ndim != 1:
                return False
            size = bias.shape
        arrays = (*self.parameters, self.mean, self.deviation, self.low, self.high)
        return (
            len(self.parameters) % 2 == 0
            and self.mean.ndim == 1
            and self.deviation.shape == self.mean.shape
            and self.low.shape == self.high.shape == size
            and all(bool(np.isfinite(array).all()) for array in arrays)
            and bool((self.deviation > 0.0).all())
        )
