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
    """Many worlds; made by `trundle.gym.make_vec`. Each equals a single environment of the same seed, bit for bit.

    A world whose episode has ended is reset by the next step, as in Gymnasium's own vector environments.
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
        """Begin an episode of every world.

        Args:
            seed: of the first world, and each next one has the next; or one for each.
            options: none are known.

        Raises:
            UsageError: the number of seeds is wrong.
        """
        del options
        seeds = [seed + row for row in range(self.num_envs)] if isinstance(seed, int) else seed
        seeds = [None] * self.num_envs if seeds is None else seeds
        if len(seeds) != self.num_envs:
            raise UsageError(f"{len(seeds)} seeds for {self.num_envs} worlds")
        for row, own in enumerate(seeds):
            if own is not None or not self._is_seeded:
                self.worlds.random[row] = seeding.np_random(own)[0]
            self.worlds.reset(row)
        self._is_seeded = True
        self._ended[:] = False
        return self.worlds.observe(), {}

    def step(
        self, actions: NDArray[np.float32]
    ) -> tuple[Observed, NDArray[np.float64], _Bools, _Bools, dict[str, Any]]:
        """Act for one period in each world, and reset those whose episodes ended at the last step."""
        again = self._ended
        step = self.worlds.step(actions, chosen=~again)
        for row in np.flatnonzero(again).tolist():
            self.worlds.reset(row)
        rewards, terminated = np.where(again, 0.0, step.rewards), step.terminated & ~again
        truncated = step.truncated & ~again
        self._ended = terminated | truncated
        unstable = self.worlds.states.batch.unstable & ~again
        infos = {"unstable": unstable, "_unstable": unstable.copy()} if unstable.any() else {}
        return self.worlds.observe(), rewards, terminated, truncated, infos

    def render(self) -> tuple[NDArray[np.uint8], ...] | None:  # pyright: ignore[reportIncompatibleMethodOverride]
        """Return a picture (height, width, 3) of each world, or None without a render mode."""
        if self._overview is None:
            return None
        return tuple(self._overview.draw(row) for row in range(self.num_envs))
