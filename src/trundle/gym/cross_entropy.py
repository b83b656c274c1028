"""Cross-entropy method: trains a linear policy with NumPy alone.

Each generation draws candidates from a normal distribution, one for each world of a vector environment, and fits the
distribution to the best of them.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, TypeAlias

import numpy as np
from gymnasium import spaces
from gymnasium.vector import VectorEnv
from msgspec import Struct
from numpy.typing import NDArray

from trundle.diagnostics import UsageError

from .linear_policy import LinearPolicy

_Array = NDArray[np.float64]
_Envs: TypeAlias = "VectorEnv[Any, Any, Any]"
_ELITE = 0.15
"""Part of the candidates that the distribution is fitted to."""
_EXTRA = 0.3
"""Part of the first standard deviation that is added to that of the first generations, against early narrowing."""
_SMALL = 0.1
"""Magnitude of an observation below which its weights grow no further."""
_SEEDS = 1 << 31


class Generation(Struct, frozen=True, eq=False):
    """Result of one generation."""

    number: int
    policy: LinearPolicy
    """Mean of the distribution."""
    scores: _Array
    """(candidates,) mean return of each."""


def train(envs: _Envs, *, generations: int, episodes: int = 2, seed: int = 0) -> Iterator[Generation]:
    """Train, and yield each generation; stop it when a policy is good enough.

    Args:
        envs: vector environment, with a candidate in each world; actions and observations are one array.
        generations: largest number.
        episodes: of each candidate per generation, the same for all of them.
        seed: of all random numbers.

    Raises:
        UsageError: the environment's observations or actions are no single array.
    """
    shape = _width(envs.single_action_space), _width(envs.single_observation_space) + 1
    random = np.random.default_rng(seed)
    first = _first_spread(envs, seed)
    mean, spread = np.zeros(shape), np.broadcast_to(first, shape)
    elite = max(2, round(_ELITE * envs.num_envs))
    for number in range(generations):
        candidates = mean + spread * random.standard_normal((envs.num_envs, *shape))
        scores = np.zeros(envs.num_envs)
        for _ in range(episodes):
            same = [int(random.integers(_SEEDS))] * envs.num_envs
            scores += _returns(envs, _policies(envs, candidates), same) / episodes
        best = candidates[np.argsort(-scores, kind="stable")[:elite]]
        extra = _EXTRA * max(0.0, 1.0 - 2.0 * number / generations)
        mean, spread = best.mean(axis=0), best.std(axis=0) + extra * first
        yield Generation(number, _policy(envs, mean), scores)


def _first_spread(envs: _Envs, seed: int) -> _Array:
    """Return (observations + 1,) standard deviations of weights and bias that make actions of the whole range."""
    observation = envs.reset(seed=seed)[0].astype(np.float64)
    magnitude = np.sqrt(np.square(observation).mean(axis=0))
    return np.append(1.0 / np.maximum(magnitude, _SMALL), 1.0) / np.sqrt(observation.shape[1])


def score(envs: _Envs, policy: Callable[[Any], Any], *, seed: int = 0) -> _Array:
    """Return (worlds,) the return of an episode in each world, which begin with the seeds `seed`, `seed` + 1, …"""
    return _returns(envs, policy, [seed + row for row in range(envs.num_envs)])


def _returns(envs: _Envs, policy: Callable[[Any], Any], seeds: Sequence[int]) -> _Array:
    each: Any = list(seeds)  # Gymnasium's own take them, too; its types do not say so
    observation, _ = envs.reset(seed=each)
    returns, running = np.zeros(envs.num_envs), np.ones(envs.num_envs, dtype=np.bool_)
    while running.any():
        observation, rewards, terminated, truncated, _ = envs.step(policy(observation))
        returns += np.where(running, rewards, 0.0)
        running &= ~(terminated | truncated)
    return returns


def _policies(envs: _Envs, candidates: _Array) -> Callable[[Any], Any]:
    """Return the policies of all candidates, one for each world."""
    low, high = _range(envs)

    def act(observation: NDArray[np.float32]) -> _Array:
        asked = np.einsum("rij,rj->ri", candidates[:, :, :-1], observation) + candidates[:, :, -1]
        return (low + high) / 2 + (high - low) / 2 * np.clip(asked, -1.0, 1.0)

    return act


def _policy(envs: _Envs, matrix: _Array) -> LinearPolicy:
    return LinearPolicy(matrix[:, :-1], matrix[:, -1], *_range(envs))


def _range(envs: _Envs) -> tuple[_Array, _Array]:
    space = envs.single_action_space
    assert isinstance(space, spaces.Box)
    return space.low.astype(np.float64), space.high.astype(np.float64)


def _width(space: spaces.Space[Any]) -> int:
    if not isinstance(space, spaces.Box) or len(space.shape) != 1:
        raise UsageError(f"a linear policy needs one array of numbers, not {space}")
    return space.shape[0]
