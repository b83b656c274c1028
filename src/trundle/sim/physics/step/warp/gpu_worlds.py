"""Engines of worlds that differ in numbers only, stepped side by side on a GPU."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ..engine import MAX_SPEED, Engine
from .gpu_states import StepResult, advance
from .varied_numbers import model_on_gpu, varied_numbers


class GpuWorlds:
    """Engines that a GPU steps together; between two steps each is read and commanded like any other."""

    def __init__(self, engines: Sequence[Engine], device: str) -> None:
        """Bring the worlds to the GPU.

        Args:
            engines: engines at time zero, without `gpu_differences` from the first.
            device: Warp's name of the GPU.

        Raises:
            UsageError: the GPU cannot step such a world, with the reasons.
        """
        from .stepper import GpuStepper  # mujoco_warp need not be installed

        self._engines = engines
        self._compiled = engines[0].compiled
        models = [model_on_gpu(engine.compiled) for engine in engines]
        self._stepper = GpuStepper(self._compiled, models[0], len(engines), device, varied_numbers(models))

    def step(self, count: int, *, chosen: NDArray[np.bool_]) -> list[StepResult]:
        """Step chosen engines, with their motors and loads; unstable and crowded ones keep their states.

        Args:
            count: number of steps.
            chosen: (engines,)

        Returns:
            One for each engine; undefined for engines that were not chosen.
        """
        rows = [engine.world_row() for engine in self._engines]
        states = np.stack([row.state for row in rows])
        results = advance(
            self._stepper,
            self._compiled.model,
            states,
            max_efforts=np.stack([row.motors.max_efforts for row in rows]),
            rates=np.stack([row.motors.rates for row in rows]),
            count=count,
            chosen=chosen,
            max_speed=MAX_SPEED,
        )
        for index in np.flatnonzero(chosen & (results == StepResult.STABLE)).tolist():
            self._engines[index].set_row_state(states[index])
        return [*map(StepResult, results.tolist())]
