"""Ready environments: rules of Gymnasium, equality of many worlds with one, determinism."""

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
def test_gymnasium_finds_no_fault(name) -> None:
    check_env(gymnasium.make(name, render_mode="rgb_array").unwrapped)


@pytest.mark.parametrize("name", IDS)
def test_each_world_of_many_equals_a_single_one(name) -> None:
    many = gymnasium.make_vec(name, num_envs=3, threads=2)
    single = SyncVectorEnv([lambda: gymnasium.make(name).unwrapped] * 3)
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
        for found, awaited in zip(results, expected, strict=True):
            assert np.array_equal(found, awaited)
        ends += int(results[1].sum() + results[2].sum())
    assert ends > 0


@pytest.mark.parametrize("name", IDS)
def test_a_seed_gives_the_same_bytes(name) -> None:
    def episode() -> list[bytes]:
        env = gymnasium.make(name).unwrapped
        env.action_space.seed(3)
        seen = [env.reset(seed=5)[0].tobytes()]
        return seen + [env.step(env.action_space.sample())[0].tobytes() for _ in range(20)]

    assert episode() == episode()
    other = gymnasium.make(name).unwrapped
    assert other.reset(seed=6)[0].tobytes() != episode()[0]


def test_pictures_show_each_world() -> None:
    envs = gymnasium.make_vec("Trundle/ArmReach-v0", num_envs=2, render_mode="rgb_array")
    envs.reset(seed=0)

    one, other = envs.render()

    assert one.shape == (360, 480, 3)
    assert (one != other).any()


def test_a_cart_pole_falls_without_control_and_stands_with_it() -> None:
    envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=4)
    feedback = np.array([1.0, 30.0, 2.0, 6.0])

    falling = trundle.gym.score(envs, lambda seen: np.zeros((len(seen), 1)))
    standing = trundle.gym.score(envs, lambda seen: np.clip(seen @ feedback, -10.0, 10.0)[:, None])

    assert (falling < 200.0).all()
    assert (standing == 500.0).all()
