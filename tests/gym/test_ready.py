"""Built-in environments: Gymnasium's checks, equality of vector and single environments, determinism."""

from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import SyncVectorEnv

import trundle.gym
from trundle.gym.registration import IDS


@pytest.mark.parametrize("name", IDS)
# Actions are in the units of the description; Gymnasium's RescaleAction normalizes them.
@pytest.mark.filterwarnings("ignore:.*we recommend using a symmetric and normalized space")
@pytest.mark.filterwarnings("ignore:.*Box observation space (minimum|maximum) value is.*infinity")
def test_gymnasiums_checker_accepts_environments(name: str) -> None:
    check_env(gymnasium.make(name, render_mode="rgb_array").unwrapped)


@pytest.mark.parametrize("name", IDS)
def test_worlds_of_a_vector_environment_equal_single_environments(name: str) -> None:
    many: Any = gymnasium.make_vec(name, num_envs=3, threads=2)
    single: Any = SyncVectorEnv([lambda: gymnasium.make(name).unwrapped] * 3)
    assert many.observation_space == single.observation_space
    assert many.action_space == single.action_space
    many.action_space.seed(1)
    ends = 0

    first, second = many.reset(seed=7)[0], single.reset(seed=7)[0]

    for _ in range(170):
        assert first.tobytes() == second.tobytes()
        action = many.action_space.sample()
        first, *results = many.step(action)
        second, *expected = single.step(action)
        for result, expected_result in zip(results, expected, strict=True):
            assert np.array_equal(result, expected_result)
        ends += int(results[1].sum() + results[2].sum())
    assert ends > 0


@pytest.mark.parametrize("name", IDS)
def test_episodes_of_equal_seeds_are_bit_identical(name: str) -> None:
    def episode() -> list[bytes]:
        env = gymnasium.make(name).unwrapped
        env.action_space.seed(3)
        first = env.reset(seed=5)[0].tobytes()
        return [first] + [env.step(env.action_space.sample())[0].tobytes() for _ in range(20)]

    assert episode() == episode()
    other = gymnasium.make(name).unwrapped
    assert other.reset(seed=6)[0].tobytes() != episode()[0]


def test_pictures_show_each_world() -> None:
    envs: Any = gymnasium.make_vec("Trundle/ArmReach-v0", num_envs=2, render_mode="rgb_array")
    envs.reset(seed=0)

    first, second = envs.render()

    assert first.shape == (360, 480, 3)
    assert (first != second).any()


def test_a_cart_pole_falls_without_control_and_balances_with_feedback() -> None:
    envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=4)
    feedback = np.array([1.0, 30.0, 2.0, 6.0])

    falling = trundle.gym.score(envs, lambda observations: np.zeros((len(observations), 1)))
    balanced = trundle.gym.score(envs, lambda observations: np.clip(observations @ feedback, -10.0, 10.0)[:, None])

    assert (falling < 200.0).all()
    assert (balanced == 500.0).all()
