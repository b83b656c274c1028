"""Multilayer perceptron and its optimizer, in NumPy."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_MAX_NORM = 0.5
"""Largest norm of a gradient; longer ones are scaled down."""
_MOMENTUM, _SQUARE_MOMENTUM, _TINY = 0.9, 0.999, 1e-8
"""Adam's own (Kingma and Ba, 2015)."""


def evaluate(parameters: Sequence[_Array], inputs: _Array) -> _Array:
    """Return the outputs (…, outputs) for inputs (…, inputs).

    Args:
        parameters: weights (inputs, outputs) and bias (outputs,) of each layer in turn; tanh is between the layers.
        inputs: numbers of about one.
    """
    return _activations(parameters, inputs)[-1]


def gradient(parameters: Sequence[_Array], inputs: _Array, slopes: _Array) -> list[_Array]:
    """Return the derivative of a loss by each parameter.

    Args:
        parameters: see `evaluate`.
        inputs: (rows, inputs)
        slopes: (rows, outputs) derivative of the loss by the outputs.
    """
    activations = _activations(parameters, inputs)
    found: list[_Array] = []
    for layer in reversed(range(len(parameters) // 2)):
        found += [slopes.sum(axis=0), activations[layer].T @ slopes]
        slopes = (slopes @ parameters[2 * layer].T) * (1.0 - np.square(activations[layer]))
    return found[::-1]


def _activations(parameters: Sequence[_Array], inputs: _Array) -> list[_Array]:
    """Return the inputs of every layer, and the outputs of the last."""
    found, last = [inputs], len(parameters) // 2 - 1
    for layer in range(last + 1):
        sums = found[-1] @ parameters[2 * layer] + parameters[2 * layer + 1]
        found.append(sums if layer == last else np.tanh(sums))
    return found


def initial_parameters(sizes: Sequence[int], random: np.random.Generator, *, last_scale: float) -> list[_Array]:
    """Return orthogonal weights and no bias.

    Args:
        sizes: of the inputs, of each hidden layer, of the outputs.
        random: generator.
        last_scale: factor of the last layer; the others have √2.
    """
    found: list[_Array] = []
    for layer, (inputs, outputs) in enumerate(pairwise(sizes)):
        tall = np.linalg.qr(random.standard_normal((max(inputs, outputs), min(inputs, outputs))))[0]
        scale = last_scale if layer == len(sizes) - 2 else np.sqrt(2.0)
        found += [scale * (tall if inputs >= outputs else tall.T), np.zeros(outputs)]
    return found


class Adam:
    """Gradient descent with momentum and a step size for each parameter."""

    def __init__(self, parameters: Sequence[_Array]) -> None:
        """Optimize parameters, in place."""
        self._parameters = parameters
        self._means = [np.zeros_like(each) for each in parameters]
        self._squares = [np.zeros_like(each) for each in parameters]
        self._steps = 0

    def step(self, gradients: Sequence[_Array], rate: float) -> None:
        """Move the parameters against their gradients, by about `rate` each."""
        self._steps += 1
        norm = float(np.sqrt(sum(np.vdot(each, each) for each in gradients)))
        scale = min(1.0, _MAX_NORM / (norm + _TINY))
        rate *= np.sqrt(1.0 - _SQUARE_MOMENTUM**self._steps) / (1.0 - _MOMENTUM**self._steps)
        for parameter, mean, square, raw in zip(self._parameters, self._means, self._squares, gradients, strict=True):
            slope = raw * scale
            mean += (1.0 - _MOMENTUM) * (slope - mean)
            square += (1.0 - _SQUARE_MOMENTUM) * (np.square(slope) - square)
            parameter -= rate * mean / (np.sqrt(square) + _TINY)
