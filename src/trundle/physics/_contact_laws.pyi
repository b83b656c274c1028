from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

VERSION: int
"""Of the MuJoCo whose headers this was compiled with, as `mujoco.mj_version()` has it."""

def names() -> list[str]:
    """What `bind` takes the addresses of."""

def bind(addresses: Sequence[int]) -> None: ...
def install() -> None:
    """Have MuJoCo call the laws in every step, behind whoever it calls now."""

def report_efforts(model: int, data: int) -> None:
    """Write what motors exert to qfrc_actuator, after a step. Both by their addresses."""

class RowStepper:
    """Steps many states of one world, with the GIL released."""

    def step(
        self,
        chosen: NDArray[np.bool_],
        states: NDArray[np.float64],
        max_efforts: NDArray[np.float64],
        rates: NDArray[np.float64],
        unstable: NDArray[np.bool_],
        poses: NDArray[np.float64],
        twists: NDArray[np.float64],
        steps: int,
    ) -> None:
        """Step the chosen rows, each a state (mjSTATE_INTEGRATION) with its motors, and write their links' poses and
        twists; an unstable row keeps its state.
        """

def make_row_stepper(
    workers: Sequence[tuple[int, int]], links: Sequence[int], max_speed: float, always_actuated: bool
) -> RowStepper:
    """Make a stepper with a thread for each worker, which is a model and its data by their addresses."""
