"""Training with stable-baselines3 (extra `learn`) in unmodified environments."""

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

torch.set_num_threads(1)  # thread switches take longer than a network of this size
bounds = {"min_action": np.float32(-1.0), "max_action": np.float32(1.0)}
envs = make_vec_env("Trundle/CartPole-v0", 8, seed=0, wrapper_class=RescaleAction, wrapper_kwargs=bounds)
model = stable_baselines3.PPO("MlpPolicy", envs, n_steps=128, batch_size=256, learning_rate=1e-3, device="cpu", seed=0)
model.learn(30_000)

evaluation_envs = gymnasium.make_vec("Trundle/CartPole-v0", num_envs=16)
high = evaluation_envs.single_action_space.high
scores = trundle.gym.score(evaluation_envs, lambda x: high * model.predict(x, deterministic=True)[0], seed=10_000)
print(np.mean(scores))
"""


def test_ppo_of_stable_baselines3_learns_to_balance_a_pole() -> None:
    """In a new process: torch's triton crashes after other tests have rendered with a software OpenGL."""
    process = subprocess.run([sys.executable, "-c", _TRAINING], capture_output=True, text=True, check=False)
    assert process.returncode == 0, process.stderr
    assert float(process.stdout.splitlines()[-1]) > 400.0
