"""Gymnasium vector environment of many worlds in one process."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from gymnasium.utils import seeding
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError

from .overview import Overview
from .worlds import Observed, Worlds

_Bools = NDArray[np.bool_]


class SimulationVectorEnv(VectorEnv[Observed, NDArray[np.float32], Any]):
    """Many worlds; made by `trundle.gym.make_vec`. Each is bit-identical to a single environment of the same seed.

    The step after an episode's end resets its world, as in Gymnasium's vector environments.
    """

    def __init__(self, worlds: Worlds, *, render_mode: str | None = None, camera: str | None = None) -> None:
        """Wrap worlds; see `SimulationEnv`."""
        self.worlds = worlds
        self.metadata = {
            "render_modes": ["rgb_array"],
            "render_fps": round(1.0 / worlds.task.period_s),
            "autoreset_mode": AutoresetMode.NEXT_STEP,
        }
        self.num_envs = len(worlds.random)
        self.render_mode = render_mode
        self.single_observation_space = worlds.observation_space
        self.single_action_space = worlds.action_space
        self.observation_space = batch_space(self.single_observation_space, self.num_envs)
        self.action_space = batch_space(self.single_action_space, self.num_envs)
        self._ended: _Bools = np.zeros(self.num_envs, dtype=np.bool_)
        self._is_seeded = False
        self._overview = None if render_mode is None else Overview(worlds.states, camera)

    def reset(
        self, *, seed: int | Sequence[int | None] | None = None, options: dict[str, object] | None = None
    ) -> tuple[Observed, dict[str, object]]:
        """Begin an episode of every world; return the observations (rows, values) and `info`.

        Args:
            seed: seed of the first world, the following worlds have the following seeds; or one seed for each world.
            options: ignored.

        Raises:
            UsageError: the number of seeds is wrong.
        """
        del options
        seeds = [seed + row for row in range(self.num_envs)] if isinstance(seed, int) else seed
        seeds = [None] * self.num_envs if seeds is None else seeds
        if len(seeds) != self.num_envs:
            raise UsageError(f"{len(seeds)} seeds for {self.num_envs} worlds")
        for row, row_seed in enumerate(seeds):
            if row_seed is not None or not self._is_seeded:
                self.worlds.random[row] = seeding.np_random(row_seed)[0]
        self.worlds.reset(range(self.num_envs))
        self._is_seeded = True
        self._ended[:] = False
        return self.worlds.observe(), {}

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[Observed, NDArray[np.float64], _Bools, _Bools, dict[str, Any]]:
        """Act for one period in each world; reset worlds whose episodes ended in the last step.

        Args:
            actions: (rows, values), in the units of their action.

        Returns observations (rows, values), and rewards, terminated and truncated (rows,), and info.
        """
        was_ended = self._ended
        step = self.worlds.step(actions, chosen=~was_ended)
        if was_ended.any():
            self.worlds.reset(np.flatnonzero(was_ended).tolist())
        rewards, terminated = np.where(was_ended, 0.0, step.rewards), step.terminated & ~was_ended
        truncated = step.truncated & ~was_ended
        self._ended = terminated | truncated
        unstable = self.worlds.states.batch.unstable & ~was_ended
        infos = {"unstable": unstable, "_unstable": unstable.copy()} if unstable.any() else {}
        return self.worlds.observe(), rewards, terminated, truncated, infos

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:
        """Return a picture (height, width, 3) of each world, or None without a render mode."""
        if self._overview is None:
            return None
        return tuple(self._overview.draw(row) for row in range(self.num_envs))
