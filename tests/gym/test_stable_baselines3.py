"""Training by stable-baselines3 (extra `learn`), which takes the environments as they are."""

import importlib.util
import subprocess
import sys

import pytest

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(
        importlib.util.find_spec("stable_baselines3") is None, reason="stable-baselines3 is not installed"
    ),
]

_TRAINING = """
import gymnasium
import numpy as np
import stable_baselines3
import torch
from gymnasium.wrappers import RescaleAction
from stable_baselines3.common.env_util import make_vec_env

import trundle.gym

torch.set_num_threads(1)  # whose hand-overs cost more than so small a network
ends = {"min_action": np.float32(-1.0), "max_action": np.float32(1.0)}
envs = make_vec_env("Trundle/CartPole-v0", 8, seed=0, wrapper_class=RescaleAction, wrapper_kwargs=ends)
model = stable_baselines3.PPO("MlpPolicy", envs, n_steps=128, batch_size=256, learning_rate=1e-3, device="cpu", seed=0)
model.learn(30_000)

judges = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=16)
high = judges.single_action_space.high
scores = trundle.gym.score(judges, lambda seen: high * model.predict(seen, deterministic=True)[0], seed=10_000)
print(np.mean(scores))
"""


def test_ppo_of_stable_baselines3_learns_to_balance_a_pole() -> None:
    """In a process of its own: torch's triton crashes where other tests have drawn by a software OpenGL."""
    done = subprocess.run([sys.executable, "-c", _TRAINING], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert float(done.stdout.splitlines()[-1]) > 400.0
