"""Environments from any description."""

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from trundle.bringup.loaded_simulation import LoadedSimulation, load_simulation
from trundle.diagnostics import UsageError

from .actions import Action
from .single_env import SimulationEnv
from .states import WorldStates
from .vector_env import SimulationVectorEnv
from .worlds import Observations, Task, Worlds

if TYPE_CHECKING:
    from trundle.description import Model, World

_RENDER_MODES = (None, "rgb_array")


def make(
    file: "str | os.PathLike[str] | Model | World",
    *,
    observations: Observations,
    actions: Action | Sequence[Action],
    reward: Callable[[WorldStates], NDArray[np.float64]],
    terminated: Callable[[WorldStates], NDArray[np.bool_]] | None = None,
    reset: Callable[[LoadedSimulation, np.random.Generator], None] | None = None,
    max_steps: int | None = None,
    period_s: float = 0.02,
    render_mode: str | None = None,
    camera: str | None = None,
) -> SimulationEnv:
    """Make a Gymnasium environment of a robot or world.

    Args:
        file: as `trundle.load` takes it.
        observations: one, several joined to one array, or several by name.
        actions: one or several, whose numbers are joined.
        reward: takes the states of all worlds, and returns a reward for each row.
        terminated: takes the states, too, and returns True where the episode ends; None: nowhere.
        reset: changes the loaded world by its handles before each episode, with the episode's random numbers.
        max_steps: after which an episode is truncated; None: never.
        period_s: simulated time of a step [s].
        render_mode: "rgb_array" or None.
        camera: name of the camera that `render` looks through; None: a three-quarter view.

    Raises:
        TrundleError: the file cannot be read, or a name in it does not exist.
    """
    task = Task(
        observations=observations,
        actions=actions,
        reward=reward,
        terminated=terminated,
        reset=reset,
        max_steps=max_steps,
        period_s=period_s,
    )
    return make_task(file, task, render_mode=render_mode, camera=camera)


def make_vec(
    file: "str | os.PathLike[str] | Model | World",
    *,
    num_envs: int,
    observations: Observations,
    actions: Action | Sequence[Action],
    reward: Callable[[WorldStates], NDArray[np.float64]],
    terminated: Callable[[WorldStates], NDArray[np.bool_]] | None = None,
    reset: Callable[[LoadedSimulation, np.random.Generator], None] | None = None,
    max_steps: int | None = None,
    period_s: float = 0.02,
    threads: int | None = None,
    render_mode: str | None = None,
    camera: str | None = None,
) -> SimulationVectorEnv:
    """Make a Gymnasium vector environment of many worlds, stepped by threads of this process; see `make`.

    Args:
        file: as `trundle.load` takes it.
        num_envs: number of worlds.
        observations: see `make`.
        actions: see `make`.
        reward: see `make`.
        terminated: see `make`.
        reset: see `make`.
        max_steps: see `make`.
        period_s: see `make`.
        threads: None: one for each core.
        render_mode: see `make`.
        camera: see `make`.
    """
    task = Task(
        observations=observations,
        actions=actions,
        reward=reward,
        terminated=terminated,
        reset=reset,
        max_steps=max_steps,
        period_s=period_s,
    )
    return make_vec_task(file, task, num_envs=num_envs, threads=threads, render_mode=render_mode, camera=camera)


def make_task(
    file: "str | os.PathLike[str] | Model | World",
    task: Task,
    *,
    render_mode: str | None = None,
    camera: str | None = None,
) -> SimulationEnv:
    """Make an environment of a task; see `make`."""
    _check_render_mode(render_mode)
    return SimulationEnv(Worlds(_load(file), task, rows=1, threads=1), render_mode=render_mode, camera=camera)


def make_vec_task(
    file: "str | os.PathLike[str] | Model | World",
    task: Task,
    *,
    num_envs: int,
    threads: int | None = None,
    render_mode: str | None = None,
    camera: str | None = None,
) -> SimulationVectorEnv:
    """Make a vector environment of a task; see `make_vec`."""
    _check_render_mode(render_mode)
    if num_envs < 1:
        raise UsageError(f"num_envs={num_envs}: at least one world is needed")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count()
    worlds = Worlds(_load(file), task, rows=num_envs, threads=threads or cores or 1)
    return SimulationVectorEnv(worlds, render_mode=render_mode, camera=camera)


def _load(file: "str | os.PathLike[str] | Model | World") -> LoadedSimulation:
    return load_simulation(os.fspath(file) if isinstance(file, str | os.PathLike) else file)


def _check_render_mode(mode: str | None) -> None:
    if mode not in _RENDER_MODES:
        raise UsageError(f"render_mode={mode!r}: environments draw to arrays only, render_mode='rgb_array'")
