"""Training of the built-in environments to a required score, and policy files."""

from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from numpy.typing import NDArray

from trundle import gym
from trundle.base.diagnostics import UsageError

_EVALUATION_SEED = 10_000
"""First seed of the evaluation episodes, which training does not use."""


def train_policy(name: str, *, required_score: float, worlds: int, iterations: int, steps: int = 64) -> gym.MlpPolicy:
    """Return the first policy with the required mean return in 32 worlds of other seeds."""
    envs, evaluation_envs = gymnasium.make_vec(name, num_envs=worlds), gymnasium.make_vec(name, num_envs=32)
    best = -np.inf
    for iteration in gym.train(envs, iterations=iterations, steps=steps):
        if iteration.number % 3 == 2:
            best = max(best, gym.score(evaluation_envs, iteration.policy, seed=_EVALUATION_SEED).mean())
            if best > required_score:
                return iteration.policy
    pytest.fail(f"{name}: the best score is {best:.2f}, not {required_score}")


@pytest.mark.slow
def test_a_policy_learns_to_balance_a_pole_and_is_saved(tmp_path: Path) -> None:
    policy = train_policy("Trundle/CartPole-v0", required_score=475.0, worlds=16, iterations=30)
    policy.save(tmp_path / "policy.npz")

    loaded = gym.MlpPolicy.load(tmp_path / "policy.npz")

    observations = np.random.default_rng(0).standard_normal((5, 4))
    assert (loaded(observations) == policy(observations)).all()
    assert loaded(observations[0]).shape == (1,)


@pytest.mark.slow
def test_a_policy_learns_to_reach() -> None:
    train_policy("Trundle/ArmReach-v0", required_score=45.0, worlds=64, iterations=30)


def test_training_is_reproducible_with_any_number_of_threads() -> None:
    def weights(threads: int) -> list[bytes]:
        envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=6, threads=threads)
        last = list(gym.train(envs, iterations=2, steps=20, seed=4))[-1]
        return [array.tobytes() for array in last.policy.parameters]

    assert weights(1) == weights(2)


def test_steps_and_returns_are_counted() -> None:
    envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=3)
    last = list(gym.train(envs, iterations=2, steps=50))[-1]

    assert last.steps == 300
    assert 10.0 < last.mean_return < 100.0


def test_training_refuses_observations_by_name() -> None:
    envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=1)
    envs.single_observation_space = gymnasium.spaces.Dict({"tilt": envs.single_observation_space})
    with pytest.raises(UsageError, match="one array of numbers, not Dict"):
        next(gym.train(envs, iterations=1))


def _save(file: Path, **changed: NDArray[Any]) -> None:
    arrays = {"layer_0": np.ones((4, 1)), "layer_1": np.zeros(1), "mean": np.zeros(4), "deviation": np.ones(4)}
    np.savez(file, **{**arrays, "low": -np.ones(1), "high": np.ones(1), **changed})


@pytest.mark.parametrize(
    "changed",
    [
        {"layer_0": np.ones((3, 1))},
        {"layer_1": np.full(1, np.nan)},
        {"layer_2": np.ones((1, 1))},
        {"deviation": np.zeros(4)},
        {"high": np.ones(2)},
        {"mean": np.array([None] * 4)},
        {"low": np.array(["a"])},
        {"mean": np.array(1.0)},
        {"note": np.zeros(9 << 20)},
    ],
)
def test_an_invalid_policy_file_is_refused(tmp_path: Path, changed: dict[str, NDArray[Any]]) -> None:
    file = tmp_path / "policy.npz"
    _save(file)
    assert gym.MlpPolicy.load(file)(np.ones(4)) == [1.0]
    _save(file, **changed)

    with pytest.raises(UsageError, match=r"policy\.npz: not a policy"):
        gym.MlpPolicy.load(file)


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04 no zip", b"text", b"\x93NUMPY\x01\x00"])
def test_a_file_that_is_not_an_npz_archive_is_refused(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "policy.npz").write_bytes(content)
    with pytest.raises(UsageError, match="not a policy"):
        gym.MlpPolicy.load(tmp_path / "policy.npz")
    with pytest.raises(UsageError, match="not a policy"):
        gym.MlpPolicy.load(tmp_path / "none.npz")
