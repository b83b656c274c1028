"""Training of the ready environments by the cross-entropy method, up to a stated score."""

import gymnasium
import numpy as np
import pytest

from trundle import gym


def _trained(name: str, *, enough: float, worlds: int = 64, generations: int = 60, episodes: int = 2):
    """Return the first policy whose mean return over 32 episodes of other seeds is enough; None: there is none."""
    envs, judges = gymnasium.make_vec(name, num_envs=worlds), gymnasium.make_vec(name, num_envs=32)
    for generation in gym.train(envs, generations=generations, episodes=episodes):
        if (
            generation.scores.mean() > 0.6 * enough
            and gym.score(judges, generation.policy, seed=10_000).mean() > enough
        ):
            return generation.policy
    return None


def test_a_policy_learns_to_balance_and_is_saved(tmp_path) -> None:
    policy = _trained("Trundle/CartPole-v0", enough=475.0, worlds=32)
    assert policy is not None

    policy.save(tmp_path / "policy.npz")

    envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=4)
    again = gym.LinearPolicy.load(tmp_path / "policy.npz")
    assert np.array_equal(gym.score(envs, again), gym.score(envs, policy))


@pytest.mark.slow
def test_a_policy_learns_to_reach() -> None:
    assert _trained("Trundle/ArmReach-v0", enough=20.0) is not None


@pytest.mark.slow
def test_a_policy_learns_to_drive_to_the_goal_past_a_pillar() -> None:
    assert _trained("Trundle/DriveToGoal-v0", enough=3.0) is not None


def test_training_gives_the_same_policy_again() -> None:
    def weights() -> np.ndarray:
        envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=8)
        return [generation.policy.weights for generation in gym.train(envs, generations=2, seed=4)][-1]

    assert (weights() == weights()).all()
