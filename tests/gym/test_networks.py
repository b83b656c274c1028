"""Networks: gradients, the optimizer, and initial parameters."""

import numpy as np

from trundle.gym.networks import Adam, evaluate, gradient, initial_parameters

_RANDOM = np.random.default_rng(3)


def test_the_gradient_equals_finite_differences() -> None:
    parameters = initial_parameters((4, 5, 3, 2), _RANDOM, last_scale=1.0)
    inputs, targets = _RANDOM.standard_normal((7, 4)), _RANDOM.standard_normal((7, 2))

    def loss() -> float:
        return float(np.square(evaluate(parameters, inputs) - targets).sum())

    gradients = gradient(parameters, inputs, 2.0 * (evaluate(parameters, inputs) - targets))

    for parameter, slopes in zip(parameters, gradients, strict=True):
        index = tuple(size - 1 for size in parameter.shape)
        parameter[index] += 1e-6
        above = loss()
        parameter[index] -= 2e-6
        below = loss()
        parameter[index] += 1e-6
        np.testing.assert_allclose(slopes[index], (above - below) / 2e-6, rtol=1e-5)


def test_initial_weights_are_orthogonal() -> None:
    first, _, last, _ = initial_parameters((6, 4, 3), _RANDOM, last_scale=0.01)

    np.testing.assert_allclose(first.T @ first, 2.0 * np.eye(4), atol=1e-12)
    np.testing.assert_allclose(last.T @ last, 1e-4 * np.eye(3), atol=1e-12)


def test_adam_minimizes_an_ill_conditioned_function() -> None:
    point = np.array([1.0, 1.0])
    optimizer = Adam([point])
    for number in range(2000):
        optimizer.step([point * [1.0, 100.0]], 0.1 * (1.0 - number / 2000))

    np.testing.assert_allclose(point, 0.0, atol=1e-6)
