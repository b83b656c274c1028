"""Training by stable-baselines3 (extra `learn`), which takes the environments as they are."""

import gymnasium
import numpy as np
import pytest
from gymnasium.wrappers import RescaleAction

import trundle.gym

pytestmark = [
    pytest.mark.slow,
    pytest.mark.filterwarnings("ignore::DeprecationWarning"),
    pytest.mark.filterwarnings("ignore::UserWarning"),
]


def test_ppo_of_stable_baselines3_learns_to_balance_a_pole() -> None:
    stable_baselines3 = pytest.importorskip("stable_baselines3")
    import torch
    from stable_baselines3.common.env_util import make_vec_env

    torch.set_num_threads(1)  # whose hand-overs cost more than so small a network
    ends = {"min_action": np.float32(-1.0), "max_action": np.float32(1.0)}
    envs = make_vec_env("Trundle/CartPole-v0", 8, seed=0, wrapper_class=RescaleAction, wrapper_kwargs=ends)
    model = stable_baselines3.PPO(
        "MlpPolicy", envs, n_steps=128, batch_size=256, learning_rate=1e-3, device="cpu", seed=0
    )

    model.learn(30_000)

    judges = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=16)
    high = judges.single_action_space.high
    scores = trundle.gym.score(judges, lambda seen: high * model.predict(seen, deterministic=True)[0], seed=10_000)
    assert np.mean(scores) > 400.0
