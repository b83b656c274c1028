"""Rollout: steps of many worlds under a policy with noise, and how much better than expected each action was."""

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
_LEAST_VARIANCE = 1e-4


class Moments:
    """Running mean and variance of numbers that arrive in batches."""

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.mean: _Array = np.zeros(shape)
        self.variance: _Array = np.ones(shape)
        self._count = 1e-4

    def add(self, values: _Array) -> None:
        """Add (rows, …) numbers."""
        total, apart = self._count + len(values), values.mean(axis=0) - self.mean
        own = values.var(axis=0) * len(values) + np.square(apart) * self._count * len(values) / total
        self.variance = (self.variance * self._count + own) / total
        self.mean = self.mean + apart * len(values) / total
        self._count = total

    @property
    def deviation(self) -> _Array:
        """Standard deviation, above zero for numbers that never change."""
        return np.sqrt(self.variance + _LEAST_VARIANCE)


class Samples(Struct, frozen=True, eq=False):
    """Steps of a rollout, without order; every array has a row for each."""

    observations: _Array
    """(steps, observations) normalized."""
    outputs: _Array
    """(steps, actions) outputs of the policy with noise; −1 … 1 is the range of the actions."""
    densities: _Array
    """(steps,) logarithm of the outputs' probability density, but for a constant."""
    advantages: _Array
    """(steps,) discounted reward beyond what the critic expected."""
    returns: _Array
    """(steps,) discounted reward, which the critic learns to expect."""


class Collector:
    """Vector environment in which a policy acts with noise; episodes go on from one rollout to the next."""

    def __init__(self, envs: Envs, random: np.random.Generator, *, seed: int) -> None:
        """Begin the first episodes.

        Args:
            envs: worlds, each of which is reset by the step after its episode's last.
            random: generator of the noise.
            seed: of the first world; see `VectorEnv.reset`.
        """
        self._envs = envs
        self._random = random
        self._seen: _Array = np.asarray(envs.reset(seed=seed)[0], dtype=np.float64)
        self._ended = np.zeros(envs.num_envs, dtype=np.bool_)
        self._returns, self._discounted = np.zeros((2, envs.num_envs))
        self._rewards = Moments(())
        """Moments of the discounted rewards, whose deviation scales them."""
        self.observations = Moments(self._seen.shape[1:])
        self.observations.add(self._seen)
        self.finished: list[float] = []
        """Returns of the episodes that ended, the latest last."""

    def collect(self, policy: MlpPolicy, noise: _Array, critic: Sequence[_Array], steps: int) -> Samples:
        """Act for some steps in every world.

        Args:
            policy: without noise.
            noise: (actions,) logarithm of the standard deviation of its outputs.
            critic: parameters of the network that expects the discounted reward, from normalized observations.
            steps: number in each world.
        """
        worlds, width = self._envs.num_envs, len(noise)
        raw = np.empty((steps + 1, *self._seen.shape))
        outputs = np.empty((steps, worlds, width))
        densities, rewards = np.empty((2, steps, worlds))
        failed, ended, acted = np.empty((3, steps, worlds), dtype=np.bool_)
        for i in range(steps):
            normal = self._random.standard_normal((worlds, width))
            raw[i], acted[i] = self._seen, ~self._ended
            outputs[i] = evaluate(policy.parameters, policy.normalize(self._seen)) + np.exp(noise) * normal
            densities[i] = (-0.5 * np.square(normal) - noise).sum(axis=1)
            rewards[i], failed[i], ended[i] = self._step(policy.scale(outputs[i]))
        raw[steps] = self._seen
        observations = policy.normalize(raw)
        values = evaluate(critic, observations)[..., 0]
        # An episode's last observation is seen before the reset, so that its value follows the last step.
        surprise = rewards / self._rewards.deviation + _DISCOUNT * np.where(failed, 0.0, values[1:]) - values[:-1]
        advantages, later = np.empty_like(surprise), np.zeros(worlds)
        for i in reversed(range(steps)):
            advantages[i] = later = surprise[i] + _DISCOUNT * _TRACE * np.where(ended[i], 0.0, later)
        self.observations.add(raw[:-1][acted])
        expected = advantages + values[:-1]
        return Samples(observations[:-1][acted], outputs[acted], densities[acted], advantages[acted], expected[acted])

    def _step(self, actions: _Array) -> tuple[_Array, _Bools, _Bools]:
        """Act; return the rewards, and which episodes were terminated, and which ended."""
        seen, rewards, terminated, truncated, _ = self._envs.step(actions)
        self._seen, self._ended = np.asarray(seen, dtype=np.float64), terminated | truncated
        self._returns += rewards
        self._discounted = _DISCOUNT * self._discounted + rewards
        self._rewards.add(self._discounted)
        self.finished += self._returns[self._ended].tolist()
        self._returns[self._ended] = self._discounted[self._ended] = 0.0
        return rewards, terminated, self._ended
