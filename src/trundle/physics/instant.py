"""The state of a world at one instant, worked out as far as somebody asks."""

from functools import cached_property
from threading import Lock

import mujoco
import numpy as np
from numpy.typing import NDArray

from .index import CompiledWorld
from .reader import StateReader

_Array = NDArray[np.float64]


class Looker:
    """Works out poses beside the engine that goes on; for any thread."""

    def __init__(self, compiled: CompiledWorld) -> None:
        self._compiled = compiled
        self._lock = Lock()
        self._reader: StateReader | None = None

    def bodies(self, qpos: _Array, qvel: _Array) -> tuple[_Array, _Array]:
        """`StateReader.link_poses` and `link_twists` of a state."""
        with self._lock:
            if self._reader is None:
                self._reader = StateReader(self._compiled, mujoco.MjData(self._compiled.model))
            self._reader.show(qpos, qvel)
            return self._reader.link_poses(), self._reader.link_twists()


class Instant:
    """What the engine held; nothing in it changes any more. Poses cost most, so they wait until they are wanted."""

    def __init__(self, looker: Looker, reader: StateReader) -> None:
        """Take what the reader has before it."""
        self._looker = looker
        self._qpos, self._qvel = reader.state()
        self.axis_positions = reader.axis_positions()
        """(axes,) [rad or m]; a ball joint's three are its rotation vector."""
        self.axis_velocities = reader.axis_velocities()
        """(axes,) [rad/s or m/s]"""
        self.axis_efforts = reader.axis_efforts()
        """(axes,) what drives them [N·m or N]"""

    @cached_property
    def bodies(self) -> tuple[_Array, _Array]:
        """(links, 7) poses and (links, 6) twists of the link frames."""
        return self._looker.bodies(self._qpos, self._qvel)
