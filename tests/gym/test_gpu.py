"""Vector environments on a GPU, or on Warp's CPU device without a GPU."""

from importlib.util import find_spec

import gymnasium
import numpy as np
import pytest
from tests.warp_device import warp_device

from trundle.base.diagnostics import UsageError
from trundle.gym.ready_tasks import READY
from trundle.gym.vector_env import SimulationVectorEnv
from trundle.gym.worlds import Task, Worlds
from trundle.live.loading import load

NAME = "Trundle/CartPole-v0"


def test_without_a_gpu_the_cpu_steps_with_a_warning() -> None:
    if warp_device() != "cpu":
        pytest.skip("there is a GPU")
    with pytest.warns(UserWarning, match="device='cuda': .*; the worlds are stepped by the CPU"):
        envs = gymnasium.make_vec(NAME, num_envs=2, device="cuda")
    cpu = gymnasium.make_vec(NAME, num_envs=2)
    envs.action_space.seed(0)
    actions = envs.action_space.sample()

    assert np.array_equal(envs.reset(seed=0)[0], cpu.reset(seed=0)[0])
    assert np.array_equal(envs.step(actions)[0], cpu.step(actions)[0])


def test_an_unknown_device_is_refused() -> None:
    with pytest.raises(UsageError, match="device='tpu': worlds are stepped on 'cpu' or 'cuda'"):
        gymnasium.make_vec(NAME, num_envs=2, device="tpu")


@pytest.mark.slow
@pytest.mark.skipif(
    find_spec("warp") is None or find_spec("mujoco_warp") is None,
    reason="mujoco-warp is not installed: trundle doctor says how",
)
def test_episodes_on_the_gpu_equal_those_on_the_cpu() -> None:
    file, task = READY[NAME]
    cpu, gpu = (
        SimulationVectorEnv(Worlds(load(file), Task(**task), rows=4, threads=1, gpu=device))
        for device in (None, warp_device())
    )
    cpu.action_space.seed(1)
    ends = 0

    first, second = cpu.reset(seed=3)[0], gpu.reset(seed=3)[0]

    for _ in range(60):
        assert second == pytest.approx(first, abs=1e-3)
        # Constant efforts in one direction make poles fall.
        actions = np.sign(cpu.action_space.sample()[:1]) * np.full_like(cpu.action_space.sample(), 5.0)
        first, _, terminated, *_ = cpu.step(actions)
        second, _, gpu_terminated, *_ = gpu.step(actions)
        assert np.array_equal(terminated, gpu_terminated)
        ends += int(terminated.sum())
    assert ends > 0
