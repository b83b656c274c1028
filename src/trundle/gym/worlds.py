"""Worlds of an environment: many states of one description, and a task."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Required, TypeAlias, TypedDict

import numpy as np
from gymnasium import spaces
from msgspec import Struct
from numpy.typing import ArrayLike, NDArray

from trundle.base.diagnostics import UsageError
from trundle.live.loaded_simulation import LoadedSimulation
from trundle.sim.physics import WorldRow
from trundle.spatial import NS_PER_S

from .actions import Action, Apply
from .observations import Observation, ObservationReader
from .states import WorldStates

_Array = NDArray[np.float64]
Observations: TypeAlias = Observation | Sequence[Observation] | Mapping[str, Observation]
Observed: TypeAlias = NDArray[np.generic] | dict[str, NDArray[np.generic]]
"""Arrays with a row for each world."""


class Task(Struct, frozen=True, kw_only=True):
    """Observations, actions and rewards; functions take the states of all worlds and return a value for each."""

    observations: Observations
    """One observation; a list, which is concatenated to one array; or a dict, whose observations keep their names."""
    actions: Action | Sequence[Action]
    reward: Callable[[WorldStates], _Array]
    """(rows,) reward of the step."""
    terminated: Callable[[WorldStates], NDArray[np.bool_]] | None = None
    """(rows,) mask of the episodes that end."""
    reset: Callable[[LoadedSimulation, np.random.Generator], None] | None = None
    """Function that changes one world through its handles at the beginning of an episode."""
    max_steps: int | None = None
    """Steps after which an episode is truncated."""
    period_s: float = 0.02
    """Simulated time of a step [s], a multiple of the world's time step."""


class TaskArguments(TypedDict, total=False):
    """Fields of `Task`, as keyword arguments of `make` and `make_vec`."""

    observations: Required[Observations]
    actions: Required[Action | Sequence[Action]]
    reward: Required[Callable[[WorldStates], _Array]]
    terminated: Callable[[WorldStates], NDArray[np.bool_]] | None
    reset: Callable[[LoadedSimulation, np.random.Generator], None] | None
    max_steps: int | None
    period_s: float


class Step(Struct, frozen=True):
    """Result of a step; all arrays are (rows,)."""

    rewards: _Array
    terminated: NDArray[np.bool_]
    truncated: NDArray[np.bool_]


class Worlds:
    """States of one world and their task."""

    def __init__(
        self, simulation: LoadedSimulation, task: Task, *, rows: int, threads: int, gpu: str | None = None
    ) -> None:
        """Set up the rows; `reset` begins their episodes.

        Args:
            simulation: loaded simulation.
            task: task to learn.
            rows: number of worlds.
            threads: number of threads.
            gpu: see `Engine.batch`.

        Raises:
            UsageError: a name in the task does not exist, or a setting is invalid.
        """
        self.task = task
        self.steps = _steps_per_period(task.period_s, simulation.step_ns)
        batch = simulation.engine.batch(rows, threads=threads, gpu=gpu)
        self.states = WorldStates(simulation, batch)
        actions = task.actions if isinstance(task.actions, Sequence) else [task.actions]
        bindings = [action.bind(self.states) for action in actions]
        self.action_space = _concatenated([space for space, _ in bindings])
        self._applies: list[tuple[slice, Apply]] = []
        first = 0
        for space, apply in bindings:
            self._applies.append((slice(first, first + space.shape[0]), apply))
            first += space.shape[0]
        self.states.actions = np.zeros((rows, first))
        self.random: list[np.random.Generator] = [np.random.default_rng(0) for _ in range(rows)]
        self._readers = self._make_readers(task.observations)
        self._elapsed = np.zeros(rows, dtype=np.intp)
        self._loaded = simulation.engine.world_row()

    def _make_readers(self, observations: Observations) -> dict[str, ObservationReader] | list[ObservationReader]:
        if isinstance(observations, Mapping):
            return {name: part.reader(self.states, self.random) for name, part in observations.items()}
        parts = observations if isinstance(observations, Sequence) else [observations]
        readers = [part.reader(self.states, self.random) for part in parts]
        if len(readers) > 1 and any(reader.space.dtype == np.uint8 for reader in readers):
            raise UsageError("a picture cannot be joined to other observations; name them: observations={'eye': …}")
        return readers

    @property
    def observation_space(self) -> spaces.Space[Any]:
        """Space of one world's observation."""
        readers = self._readers
        if isinstance(readers, dict):
            return spaces.Dict({name: reader.space for name, reader in readers.items()})
        return readers[0].space if len(readers) == 1 else _concatenated([reader.space for reader in readers])

    def observe(self) -> Observed:
        """Return the observations of all worlds."""
        if isinstance(self._readers, dict):
            return {name: reader.read() for name, reader in self._readers.items()}
        arrays = [reader.read() for reader in self._readers]
        return arrays[0] if len(arrays) == 1 else np.concatenate(arrays, axis=1)

    def reset(self, rows: Sequence[int]) -> None:
        """Begin an episode of worlds, with their generators in `random`."""
        self.states.batch.write_rows(rows, [self._first_state(row) for row in rows])
        readers = self._readers.values() if isinstance(self._readers, dict) else self._readers
        for row in rows:
            self.states.actions[row] = 0.0
            self._elapsed[row] = 0
            for reader in readers:
                reader.reset(row)

    def _first_state(self, row: int) -> WorldRow:
        if self.task.reset is None:
            return self._loaded
        simulation = self.states.simulation
        simulation.reset()
        self.task.reset(simulation, self.random[row])
        return simulation.engine.world_row()

    def step(self, actions: ArrayLike, *, chosen: NDArray[np.bool_] | None = None) -> Step:
        """Act on worlds and step them.

        Args:
            actions: (rows, numbers)
            chosen: (rows,) worlds to step; None: all.

        Raises:
            UsageError: an action has the wrong shape, or is not finite.
        """
        self.states.actions = self._check_actions(actions)
        for part, apply in self._applies:
            apply(self.states.actions[:, part])
        self.states.batch.step(self.steps, chosen=chosen)
        self._elapsed += 1
        rewards = np.asarray(self.task.reward(self.states), dtype=np.float64)
        rows = len(self.random)
        if rewards.shape != (rows,):
            raise UsageError(f"reward returns an array of shape {rewards.shape}, not ({rows},): a value for each world")
        terminated = self.states.batch.unstable.copy()
        if self.task.terminated is not None:
            terminated |= self.task.terminated(self.states)
        truncated = np.zeros(rows, dtype=np.bool_)
        if self.task.max_steps is not None:
            truncated = self._elapsed >= self.task.max_steps
        return Step(rewards, terminated, truncated)

    def _check_actions(self, actions: ArrayLike) -> _Array:
        values, space = np.array(actions, dtype=np.float64), self.action_space
        if values.shape != (shape := (len(self.random), *space.shape)):
            raise UsageError(f"actions have shape {values.shape}, not {shape}")
        if not np.isfinite(values).all():
            raise UsageError("an action is not finite")
        return np.clip(values, space.low, space.high)


def _steps_per_period(period_s: float, step_ns: int) -> int:
    period_ns = round(period_s * NS_PER_S)
    if period_ns < step_ns or period_ns % step_ns:
        raise UsageError(f"period_s={period_s:g} is not a multiple of the world's time step, {step_ns / NS_PER_S:g} s")
    return period_ns // step_ns


def _concatenated(parts: "Sequence[spaces.Box[Any]]") -> "spaces.Box[Any]":
    return spaces.Box(
        np.concatenate([part.low for part in parts]), np.concatenate([part.high for part in parts]), dtype=np.float32
    )
