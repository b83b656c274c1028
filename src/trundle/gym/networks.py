"""Multilayer perceptron and its optimizer, in NumPy."""

from collections.abc import Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

_Array = NDArray[np.float64]
_MAX_NORM = 0.5
"""Largest norm of a gradient; larger gradients are scaled down."""
_MOMENTUM, _SQUARE_MOMENTUM, _TINY = 0.9, 0.999, 1e-8
"""Defaults of Adam (Kingma and Ba, 2015)."""


def evaluate(parameters: Sequence[_Array], inputs: _Array) -> _Array:
    """Return the outputs (…, outputs) for inputs (…, inputs).

    Args:
        parameters: weights (inputs, outputs) and bias (outputs,) of each layer; tanh is applied between layers.
        inputs: normalized inputs.
    """
    return _activations(parameters, inputs)[-1]


def gradient(parameters: Sequence[_Array], inputs: _Array, slopes: _Array) -> list[_Array]:
    """Return the derivative of a loss with respect to each parameter.

    Args:
        parameters: see `evaluate`.
        inputs: (rows, inputs)
        slopes: (rows, outputs) derivative of the loss with respect to the outputs.
    """
    activations = _activations(parameters, inputs)
    derivatives: list[_Array] = []
    for layer in reversed(range(len(parameters) // 2)):
        derivatives += [slopes.sum(axis=0), activations[layer].T @ slopes]
        slopes = (slopes @ parameters[2 * layer].T) * (1.0 - np.square(activations[layer]))
    return derivatives[::-1]


def _activations(parameters: Sequence[_Array], inputs: _Array) -> list[_Array]:
    """Return the inputs of every layer and the outputs of the last layer."""
    activations, last = [inputs], len(parameters) // 2 - 1
    for layer in range(last + 1):
        sums = activations[-1] @ parameters[2 * layer] + parameters[2 * layer + 1]
        activations.append(sums if layer == last else np.tanh(sums))
    return activations


def initial_parameters(sizes: Sequence[int], random: np.random.Generator, *, last_scale: float) -> list[_Array]:
    """Return orthogonal weights and zero biases.

    Args:
        sizes: numbers of inputs, of units in each hidden layer, and of outputs.
        random: random number generator.
        last_scale: scale of the last layer's weights; the scale of the other layers is √2.
    """
    parameters: list[_Array] = []
    for layer, (inputs, outputs) in enumerate(pairwise(sizes)):
        tall = np.linalg.qr(random.standard_normal((max(inputs, outputs), min(inputs, outputs))))[0]
        scale = last_scale if layer == len(sizes) - 2 else np.sqrt(2.0)
        parameters += [scale * (tall if inputs >= outputs else tall.T), np.zeros(outputs)]
    return parameters


class Adam:
    """Gradient descent with momentum and a step size for each parameter."""

    def __init__(self, parameters: Sequence[_Array]) -> None:
        """Optimize parameters, in place."""
        self._parameters = parameters
        self._means = [np.zeros_like(parameter) for parameter in parameters]
        self._squares = [np.zeros_like(parameter) for parameter in parameters]
        self._steps = 0

    def step(self, gradients: Sequence[_Array], rate: float) -> None:
        """Move each parameter by about `rate` against its gradient."""
        self._steps += 1
        norm = float(np.sqrt(sum(np.vdot(array, array) for array in gradients)))
        scale = min(1.0, _MAX_NORM / (norm + _TINY))
        rate *= np.sqrt(1.0 - _SQUARE_MOMENTUM**self._steps) / (1.0 - _MOMENTUM**self._steps)
        for parameter, mean, square, raw in zip(self._parameters, self._means, self._squares, gradients, strict=True):
            slope = raw * scale
            mean += (1.0 - _MOMENTUM) * (slope - mean)
            square += (1.0 - _SQUARE_MOMENTUM) * (np.square(slope) - square)
            parameter -= rate * mean / (np.sqrt(square) + _TINY)
