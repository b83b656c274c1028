"""Batch of states that a GPU steps; poses, twists and resets are computed by this machine's processors."""

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import TrundleError

from ...compile.compiled_world import CompiledWorld
from ..batch import Batch
from .gpu_states import StepResult, advance
from .stepper import GpuStepper


class GpuBatch(Batch):
    """Rows of one world in single precision; as `Batch`, but its numbers are not equal to the bit."""

    def __init__(
        self, compiled: CompiledWorld, rows: int, threads: int, *, actuated: bool, max_speed: float, device: str
    ) -> None:
        """Reserve the rows.

        Args:
            compiled: the world.
            rows: number of states.
            threads: number of threads that compute poses.
            actuated: see `Batch`.
            max_speed: see `Batch`.
            device: Warp's name of the GPU.

        Raises:
            UsageError: the GPU cannot step the world, with the reasons.
        """
        super().__init__(compiled, rows, threads, actuated=actuated, max_speed=max_speed)
        self._max_speed = max_speed
        self._stepper_on_gpu = GpuStepper(compiled, self._workers[0][0], rows, device)

    def step(self, count: int, *, chosen: NDArray[np.bool_] | None = None) -> None:
        """See `Batch`.

        Raises:
            TrundleError: a row has more contacts than the GPU has room for.
        """
        chosen = self._all if chosen is None else chosen
        results = self._advance(count, chosen) if count else np.full(len(chosen), StepResult.STABLE)
        if (results[chosen] == StepResult.CROWDED).any():
            raise TrundleError("a world has more contacts than the GPU has room for; use device='cpu'")
        super().step(0, chosen=chosen)
        self.unstable[chosen] = results[chosen] == StepResult.UNSTABLE

    def _advance(self, count: int, chosen: NDArray[np.bool_]) -> NDArray[np.int8]:
        return advance(
            self._stepper_on_gpu,
            self._compiled.model,
            self.states,
            max_efforts=self._max_efforts,
            rates=self._rates,
            count=count,
            chosen=chosen,
            max_speed=self._max_speed,
        )
