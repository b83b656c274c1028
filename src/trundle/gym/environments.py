"""Environments from any description."""

import os
import warnings
from typing import TYPE_CHECKING, Literal, Unpack

from trundle.base.diagnostics import UsageError
from trundle.live.loading import load
from trundle.sim.physics import NoGpuError, find_gpu

from .single_env import SimulationEnv
from .vector_env import SimulationVectorEnv
from .worlds import Task, TaskArguments, Worlds

if TYPE_CHECKING:
    from trundle.robots.description import Model, World

_DEVICES = ("cpu", "cuda")
_RENDER_MODES = (None, "rgb_array")


def make(
    file: "str | os.PathLike[str] | Model | World",
    *,
    render_mode: str | None = None,
    camera: str | None = None,
    **task: Unpack[TaskArguments],
) -> SimulationEnv:
    """Make a Gymnasium environment of a robot or world.

    Args:
        file: see `trundle.load`.
        render_mode: "rgb_array" or None.
        camera: name of the camera of `render`; None: a three-quarter view.
        task: fields of `Task`, of which observations, actions and reward are required.

    Raises:
        TrundleError: the file cannot be read, or a name in it does not exist.
    """
    _check_render_mode(render_mode)
    worlds = Worlds(load(file), Task(**task), rows=1, threads=1)
    return SimulationEnv(worlds, render_mode=render_mode, camera=camera)


def make_vec(
    file: "str | os.PathLike[str] | Model | World",
    *,
    num_envs: int,
    threads: int | None = None,
    device: Literal["cpu", "cuda"] = "cpu",
    render_mode: str | None = None,
    camera: str | None = None,
    **task: Unpack[TaskArguments],
) -> SimulationVectorEnv:
    """Make a Gymnasium vector environment of many worlds, stepped by threads of this process or on a GPU.

    Args:
        file: see `trundle.load`.
        num_envs: number of worlds.
        threads: None: one for each core.
        device: "cuda" steps on an NVIDIA GPU, in single precision; without a GPU the threads step, with a warning.
        render_mode: see `make`.
        camera: see `make`.
        task: see `make`.

    Raises:
        TrundleError: the file cannot be read, a name in it does not exist, or the GPU cannot step this world.
    """
    _check_render_mode(render_mode)
    gpu = _find_gpu(device)
    if num_envs < 1:
        raise UsageError(f"num_envs={num_envs}: at least one world is needed")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    worlds = Worlds(load(file), Task(**task), rows=num_envs, threads=threads or cores or 1, gpu=gpu)
    return SimulationVectorEnv(worlds, render_mode=render_mode, camera=camera)


def _find_gpu(device: str) -> str | None:
    if device not in _DEVICES:
        raise UsageError(f"device={device!r}: worlds are stepped on {' or '.join(map(repr, _DEVICES))}")
    if device == "cpu":
        return None
    try:
        return find_gpu()
    except NoGpuError as error:
        warnings.warn(f"device='cuda': {error}; the worlds are stepped by the CPU", stacklevel=3)
        return None


def _check_render_mode(mode: str | None) -> None:
    if mode not in _RENDER_MODES:
        raise UsageError(f"render_mode={mode!r}: environments render only to arrays, render_mode='rgb_array'")
