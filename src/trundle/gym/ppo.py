"""Proximal policy optimization (Schulman et al., 2017), with NumPy alone."""

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
_FIRST_NOISE = -0.5
"""Logarithm of the standard deviation of the first outputs, whose range is −1 … 1."""
_CLIP = 0.2
"""Change of an output's probability from which on it is not changed further by one rollout."""
_EPOCHS = 8
"""Passes over the samples of a rollout."""
_BATCH = 512
"""Samples of a gradient."""
_TINY = 1e-8
_RECENT = 100


class Iteration(Struct, frozen=True, eq=False):
    """Policy after a rollout and the optimization that followed."""

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
    """Train a policy, and yield it after each rollout; stop when it is good enough.

    Args:
        envs: vector environment; its observations and actions are one array each.
        iterations: largest number.
        steps: of a rollout, in each world.
        hidden: sizes of the hidden layers.
        learning_rate: at the beginning; it falls to zero at the last iteration.
        seed: of all random numbers.

    Raises:
        UsageError: the environment's observations or actions are no single array.
    """
    actions, observations = _box(envs.single_action_space), _box(envs.single_observation_space)
    random = np.random.default_rng(seed)
    learner = _Learner(observations.shape[0], actions.shape[0], hidden, random)
    collector = Collector(envs, random, seed=seed)
    low, high = actions.low.astype(np.float64), actions.high.astype(np.float64)

    for number in range(iterations):
        seen = collector.observations
        policy = MlpPolicy(learner.parameters(), seen.mean, seen.deviation, low, high)
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
        self.noise: _Array = np.full(outputs, _FIRST_NOISE)
        """Logarithm of the standard deviation of the outputs."""
        self._optimizer = Adam([*self.actor, self.noise, *self.critic])

    def parameters(self) -> tuple[_Array, ...]:
        """Return copies of the policy's parameters."""
        return tuple(each.copy() for each in self.actor)

    def improve(self, samples: Samples, rate: float, random: np.random.Generator) -> None:
        """Optimize the policy on samples, and the critic."""
        count = len(samples.observations)
        for _ in range(_EPOCHS):
            order = random.permutation(count)
            for first in range(0, count, _BATCH):
                self._descend(samples, order[first : first + _BATCH], rate)

    def _descend(self, samples: Samples, chosen: NDArray[np.intp], rate: float) -> None:
        seen, advantages = samples.observations[chosen], samples.advantages[chosen]
        advantages = (advantages - advantages.mean()) / (advantages.std() + _TINY)
        scale = np.exp(self.noise)
        normal = (samples.outputs[chosen] - evaluate(self.actor, seen)) / scale
        densities = (-0.5 * np.square(normal) - self.noise).sum(axis=1)
        ratio = np.exp(densities - samples.densities[chosen])
        free = np.where(advantages > 0.0, ratio < 1.0 + _CLIP, ratio > 1.0 - _CLIP)
        slope = (-advantages * ratio * free / len(chosen))[:, None]
        error = evaluate(self.critic, seen) - samples.returns[chosen, None]
        gradients = [
            *gradient(self.actor, seen, slope * normal / scale),
            (slope * (np.square(normal) - 1.0)).sum(axis=0),
            *gradient(self.critic, seen, error / len(chosen)),
        ]
        self._optimizer.step(gradients, rate)


def _box(space: spaces.Space[Any]) -> spaces.Box:
    if not isinstance(space, spaces.Box) or len(space.shape) != 1:
        raise UsageError(f"the policy needs one array of numbers, not {space}")
    return space
