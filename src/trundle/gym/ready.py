"""Entry points of the built-in environments, called by Gymnasium."""

from typing import Literal

from .environments import make, make_vec
from .ready_tasks import READY
from .single_env import SimulationEnv
from .vector_env import SimulationVectorEnv


def make_ready(*, name: str, render_mode: str | None = None, camera: str | None = None) -> SimulationEnv:
    """Make a built-in environment; see `trundle.gym.make`."""
    file, task = READY[name]
    return make(file, render_mode=render_mode, camera=camera, **task)


def make_ready_vec(
    *,
    name: str,
    num_envs: int = 1,
    threads: int | None = None,
    device: Literal["cpu", "cuda"] = "cpu",
    render_mode: str | None = None,
    camera: str | None = None,
) -> SimulationVectorEnv:
    """Make many worlds of a built-in environment; see `trundle.gym.make_vec`."""
    file, task = READY[name]
    return make_vec(
        file, num_envs=num_envs, threads=threads, device=device, render_mode=render_mode, camera=camera, **task
    )
