"""Gymnasium environment of one world."""

from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from .overview import Overview
from .worlds import Observed, Worlds


class SimulationEnv(gymnasium.Env[Observed, Any]):
    """One world; made by `trundle.gym.make`."""

    def __init__(self, worlds: Worlds, *, render_mode: str | None = None, camera: str | None = None) -> None:
        """Wrap the first row of worlds.

        Args:
            worlds: worlds of one row.
            render_mode: "rgb_array" or None.
            camera: name of the camera of `render`; None: a three-quarter view.
        """
        self.worlds = worlds
        self.metadata = {"render_modes": ["rgb_array"], "render_fps": round(1.0 / worlds.task.period_s)}
        self.render_mode = render_mode
        self.observation_space = worlds.observation_space
        self.action_space = worlds.action_space
        self._overview = None if render_mode is None else Overview(worlds.states, camera)

    def reset(
        self, *, seed: int | None = None, options: dict[str, object] | None = None
    ) -> tuple[Observed, dict[str, object]]:
        """Begin an episode; the same seed gives bit-identical results.

        Returns the observation, (values,) or a dictionary of such arrays by name, and an empty `info`.
        """
        super().reset(seed=seed, options=options)
        self.worlds.random[0] = self.np_random
        self.worlds.reset([0])
        return self._observation(), {}

    def step(self, action: NDArray[np.float32]) -> tuple[Observed, float, bool, bool, dict[str, Any]]:
        """Act for one period; unstable physics ends the episode, and info has "unstable".

        Args:
            action: (values,), in the units of its action: [N], [N·m], [m/s], [rad/s], [m] or [rad].

        Returns observation, reward, terminated, truncated and info.
        """
        step = self.worlds.step(np.asarray(action)[None])
        info = {"unstable": True} if self.worlds.states.batch.unstable[0] else {}
        return self._observation(), float(step.rewards[0]), bool(step.terminated[0]), bool(step.truncated[0]), info

    def render(self) -> NDArray[np.uint8] | None:
        """Return a picture (height, width, 3), or None without a render mode."""
        return None if self._overview is None else self._overview.draw(0)

    def _observation(self) -> Observed:
        observations = self.worlds.observe()
        if isinstance(observations, dict):
            return {name: rows[0] for name, rows in observations.items()}
        return observations[0]
