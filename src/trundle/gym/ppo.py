"""Proximal policy optimization (Schulman et al., 2017), with NumPy only."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from gymnasium import spaces
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError

from .networks import Adam, evaluate, gradient, initial_parameters
from .policy import MlpPolicy
from .rollout import Collector, Envs, Samples

_Array = NDArray[np.float64]
_INITIAL_NOISE = -0.5
"""Initial logarithm of the standard deviation of the outputs, whose range is −1 … 1."""
_CLIP = 0.2
"""Largest relative change of an output's probability by one rollout."""
_EPOCHS = 8
"""Passes over the samples of a rollout."""
_BATCH = 512
"""Samples per gradient step."""
_TINY = 1e-8
_RECENT = 100


class Iteration(Struct, frozen=True, eq=False):
    """Policy after a rollout and its optimization."""

    number: int
    policy: MlpPolicy
    steps: int
    """Steps so far, of all worlds."""
    mean_return: float
    """Mean return of the latest hundred episodes, with noise; nan before the first ends."""


def train(
    envs: Envs,
    *,
    iterations: int,
    steps: int = 64,
    hidden: Sequence[int] = (32, 32),
    learning_rate: float = 2e-3,
    seed: int = 0,
) -> Iterator[Iteration]:
    """Train a policy, and yield it after each rollout; the caller may stop early.

    Args:
        envs: vector environment with observations and actions of one array each.
        iterations: maximum number of iterations.
        steps: steps of a rollout in each world.
        hidden: sizes of the hidden layers.
        learning_rate: initial learning rate; it decreases to zero at the last iteration.
        seed: seed of all random numbers.

    Raises:
        UsageError: the environment's observations or actions are not one array.
    """
    actions, observations = _array_space(envs.single_action_space), _array_space(envs.single_observation_space)
    random = np.random.default_rng(seed)
    learner = _Learner(observations.shape[0], actions.shape[0], hidden, random)
    collector = Collector(envs, random, seed=seed)
    low, high = actions.low.astype(np.float64), actions.high.astype(np.float64)

    for number in range(iterations):
        moments = collector.observations
        policy = MlpPolicy(learner.parameters(), moments.mean, moments.deviation, low, high)
        samples = collector.collect(policy, learner.noise, learner.critic, steps)
        learner.improve(samples, learning_rate * (1.0 - number / iterations), random)
        recent = collector.finished[-_RECENT:]
        yield Iteration(
            number=number,
            policy=replace(policy, parameters=learner.parameters()),
            steps=(number + 1) * steps * envs.num_envs,
            mean_return=float(np.mean(recent)) if recent else np.nan,
        )


class _Learner:
    """Networks of the policy and of the critic."""

    def __init__(self, inputs: int, outputs: int, hidden: Sequence[int], random: np.random.Generator) -> None:
        self.actor = initial_parameters((inputs, *hidden, outputs), random, last_scale=0.01)
        self.critic = initial_parameters((inputs, *hidden, 1), random, last_scale=1.0)
        self.noise: _Array = np.full(outputs, _INITIAL_NOISE)
        """Logarithm of the standard deviation of the outputs."""
        self._optimizer = Adam([*self.actor, self.noise, *self.critic])

    def parameters(self) -> tuple[_Array, ...]:
        """Return copies of the policy's parameters."""
        return tuple(array.copy() for array in self.actor)

    def improve(self, samples: Samples, rate: float, random: np.random.Generator) -> None:
        """Optimize the policy and the critic with samples."""
        count = len(samples.observations)
        for _ in range(_EPOCHS):
            order = random.permutation(count)
            for first in range(0, count, _BATCH):
                self._descend(samples, order[first : first + _BATCH], rate)

    def _descend(self, samples: Samples, batch: NDArray[np.intp], rate: float) -> None:
        observations, advantages = samples.observations[batch], samples.advantages[batch]
        advantages = (advantages - advantages.mean()) / (advantages.std() + _TINY)
        scale = np.exp(self.noise)
        normal = (samples.outputs[batch] - evaluate(self.actor, observations)) / scale
        densities = (-0.5 * np.square(normal) - self.noise).sum(axis=1)
        ratio = np.exp(densities - samples.densities[batch])
        is_unclipped = np.where(advantages > 0.0, ratio < 1.0 + _CLIP, ratio > 1.0 - _CLIP)
        slope = (-advantages * ratio * is_unclipped / len(batch))[:, None]
        error = evaluate(self.critic, observations) - samples.returns[batch, None]
        gradients = [
            *gradient(self.actor, observations, slope * normal / scale),
            (slope * (np.square(normal) - 1.0)).sum(axis=0),
            *gradient(self.critic, observations, error / len(batch)),
        ]
        self._optimizer.step(gradients, rate)


def _array_space(space: spaces.Space[Any]) -> spaces.Box:
    if not isinstance(space, spaces.Box) or len(space.shape) != 1:
        raise UsageError(f"the policy needs one array of numbers, not {space}")
    return space
