"""Evaluation of a policy by its returns."""

from collections.abc import Callable
from typing import Any

import numpy as np
from gymnasium.vector import VectorEnv
from numpy.typing import NDArray


def score(envs: "VectorEnv[Any, Any, Any]", policy: Callable[[Any], object], *, seed: int = 0) -> NDArray[np.float64]:
    """Return (worlds,) returns of one episode in each world; the seeds are `seed`, `seed` + 1, …"""
    observation, _ = envs.reset(seed=seed)
    returns, running = np.zeros(envs.num_envs), np.ones(envs.num_envs, dtype=np.bool_)
    while running.any():
        observation, rewards, terminated, truncated, _ = envs.step(policy(observation))
        returns += np.where(running, rewards, 0.0)
        running &= ~(terminated | truncated)
    return returns
