"""Rollout: steps of many worlds under a policy with noise, and the advantages of its actions."""

from collections.abc import Sequence
from typing import Any, TypeAlias

import numpy as np
from gymnasium.vector import VectorEnv
from msgspec import Struct
from numpy.typing import NDArray

from .networks import evaluate
from .policy import MlpPolicy

_Array = NDArray[np.float64]
_Bools = NDArray[np.bool_]
Envs: TypeAlias = "VectorEnv[Any, Any, Any]"
_DISCOUNT, _TRACE = 0.99, 0.95
"""Discount of rewards per step, and the λ of generalized advantage estimation (Schulman et al., 2016)."""
_MIN_VARIANCE = 1e-4


class Moments:
    """Running mean and variance of numbers that arrive in batches."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.mean: _Array = np.zeros(shape)
        self.variance: _Array = np.ones(shape)
        self._count = 1e-4

    def add(self, values: _Array) -> None:
        """Add (rows, …) numbers."""
        total, difference = self._count + len(values), values.mean(axis=0) - self.mean
        squares = values.var(axis=0) * len(values) + np.square(difference) * self._count * len(values) / total
        self.variance = (self.variance * self._count + squares) / total
        self.mean = self.mean + difference * len(values) / total
        self._count = total

    @property
    def deviation(self) -> _Array:
        """Standard deviation, above zero for constant numbers."""
        return np.sqrt(self.variance + _MIN_VARIANCE)


class Samples(Struct, frozen=True, eq=False):
    """Steps of a rollout in no particular order; every array has a row for each step."""

    observations: _Array
    """(steps, observations) normalized."""
    outputs: _Array
    """(steps, actions) outputs of the policy with noise; actions are in −1 … 1."""
    densities: _Array
    """(steps,) logarithm of the outputs' probability density, up to a constant."""
    advantages: _Array
    """(steps,) discounted reward minus the critic's estimate."""
    returns: _Array
    """(steps,) discounted reward, the target of the critic."""


class Collector:
    """Vector environment in which a policy acts with noise; episodes continue from one rollout to the next."""

    def __init__(self, envs: Envs, random: np.random.Generator, *, seed: int) -> None:
        """Begin the first episodes.

        Args:
            envs: worlds with autoreset in the step after an episode's end.
            random: random number generator of the noise.
            seed: seed of the first world; see `VectorEnv.reset`.
        """
        self._envs = envs
        self._random = random
        self._latest: _Array = np.asarray(envs.reset(seed=seed)[0], dtype=np.float64)
        self._ended = np.zeros(envs.num_envs, dtype=np.bool_)
        self._returns, self._discounted = np.zeros((2, envs.num_envs))
        self._rewards = Moments(())
        """Moments of the discounted rewards, which are scaled by their deviation."""
        self.observations = Moments(self._latest.shape[1:])
        self.observations.add(self._latest)
        self.finished: list[float] = []
        """Returns of the episodes that ended, the latest last."""

    def collect(self, policy: MlpPolicy, noise: _Array, critic: Sequence[_Array], steps: int) -> Samples:
        """Act for some steps in every world.

        Args:
            policy: policy without noise.
            noise: (actions,) logarithm of the standard deviation of the policy's outputs.
            critic: parameters of the network that estimates the discounted reward for normalized observations.
            steps: number of steps in each world.
        """
        worlds, width = self._envs.num_envs, len(noise)
        raw = np.empty((steps + 1, *self._latest.shape))
        outputs = np.empty((steps, worlds, width))
        densities, rewards = np.empty((2, steps, worlds))
        failed, ended, is_valid = np.empty((3, steps, worlds), dtype=np.bool_)
        for i in range(steps):
            normal = self._random.standard_normal((worlds, width))
            raw[i], is_valid[i] = self._latest, ~self._ended
            outputs[i] = evaluate(policy.parameters, policy.normalize(self._latest)) + np.exp(noise) * normal
            densities[i] = (-0.5 * np.square(normal) - noise).sum(axis=1)
            rewards[i], failed[i], ended[i] = self._step(policy.scale(outputs[i]))
        raw[steps] = self._latest
        observations = policy.normalize(raw)
        values = evaluate(critic, observations)[..., 0]
        # An episode's last observation comes before the reset, so that its value follows the last step.
        temporal_difference = (
            rewards / self._rewards.deviation + _DISCOUNT * np.where(failed, 0.0, values[1:]) - values[:-1]
        )
        advantages, later = np.empty_like(temporal_difference), np.zeros(worlds)
        for i in reversed(range(steps)):
            advantages[i] = later = temporal_difference[i] + _DISCOUNT * _TRACE * np.where(ended[i], 0.0, later)
        self.observations.add(raw[:-1][is_valid])
        targets = advantages + values[:-1]
        return Samples(
            observations[:-1][is_valid], outputs[is_valid], densities[is_valid], advantages[is_valid], targets[is_valid]
        )

    def _step(self, actions: _Array) -> tuple[_Array, _Bools, _Bools]:
        """Act; return the rewards, the mask of terminated episodes, and the mask of ended episodes."""
        observations, rewards, terminated, truncated, _ = self._envs.step(actions)
        self._latest, self._ended = np.asarray(observations, dtype=np.float64), terminated | truncated
        self._returns += rewards
        self._discounted = _DISCOUNT * self._discounted + rewards
        self._rewards.add(self._discounted)
        self.finished += self._returns[self._ended].tolist()
        self._returns[self._ended] = self._discounted[self._ended] = 0.0
        return rewards, terminated, self._ended
