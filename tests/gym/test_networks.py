"""Networks: the gradient is the difference quotient; Adam descends; the parameters' scale."""

import numpy as np

from trundle.gym.networks import Adam, evaluate, gradient, initial_parameters

_RANDOM = np.random.default_rng(3)


def test_the_gradient_is_the_difference_quotient() -> None:
    parameters = initial_parameters((4, 5, 3, 2), _RANDOM, last_scale=1.0)
    inputs, wanted = _RANDOM.standard_normal((7, 4)), _RANDOM.standard_normal((7, 2))

    def loss() -> float:
        return float(np.square(evaluate(parameters, inputs) - wanted).sum())

    found = gradient(parameters, inputs, 2.0 * (evaluate(parameters, inputs) - wanted))

    for parameter, slopes in zip(parameters, found, strict=True):
        at = tuple(size - 1 for size in parameter.shape)
        parameter[at] += 1e-6
        above = loss()
        parameter[at] -= 2e-6
        below = loss()
        parameter[at] += 1e-6
        np.testing.assert_allclose(slopes[at], (above - below) / 2e-6, rtol=1e-5)


def test_weights_begin_orthogonal() -> None:
    first, _, last, _ = initial_parameters((6, 4, 3), _RANDOM, last_scale=0.01)

    np.testing.assert_allclose(first.T @ first, 2.0 * np.eye(4), atol=1e-12)
    np.testing.assert_allclose(last.T @ last, 1e-4 * np.eye(3), atol=1e-12)


def test_adam_finds_the_bottom_of_a_long_valley() -> None:
    at = np.array([1.0, 1.0])
    optimizer = Adam([at])
    for number in range(2000):
        optimizer.step([at * [1.0, 100.0]], 0.1 * (1.0 - number / 2000))

    np.testing.assert_allclose(at, 0.0, atol=1e-6)
