from collections.abc import Callable, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

VERSION: int
"""Version of the MuJoCo headers that this was compiled with, as `mujoco.mj_version()` returns it."""

def names() -> list[str]:
    """Return the names of the functions whose addresses `bind` takes."""

def bind(addresses: Sequence[int]) -> None: ...
def install() -> None:
    """Install the laws as MuJoCo's callbacks of every step, after those installed now."""

def set_timers(on: bool) -> None:
    """Start or stop MuJoCo's timing of the parts of every step [s], in all threads."""

def report_efforts(model: int, data: int) -> None:
    """Write the motors' efforts to qfrc_actuator, after a step. Model and data by their addresses."""

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
    """Make a stepper with a thread for each worker: a model and its data by their addresses."""

def read_contacts(model: int, data: int, contacts: Sequence[int]) -> NDArray[np.float64]:
    """Return (N, 15) rows of the contacts with these indices; see `step.contact.Contacts`."""

class ContactRecorder:
    """Contacts of chosen geoms, recorded by `step`."""

    def __init__(self, geoms: Sequence[int], geom_count: int, max_steps: int) -> None:
        """Keep the latest steps with contacts, at most `max_steps`."""

    @property
    def is_stale(self) -> bool:
        """True if other bodies sleep than at the last `set_sleeping`, which must be called again."""

    def set_sleeping(self, rows: NDArray[np.float64]) -> None:
        """Set the contacts among sleeping bodies, from the last step on."""

    def replace_since(self, time_ns: int, rows: NDArray[np.float64]) -> None:
        """Replace the rows recorded at that time or later."""

    def take(self) -> tuple[list[int], NDArray[np.float64]]:
        """Return the time of each row [ns] and the rows (N, 15), and clear the record."""

    def copy(self) -> ContactRecorder: ...

class StepAction:
    """Action before each step."""

    def checkpoint(self) -> Callable[[], None]:
        """Return a function that restores the action's state, but not the engine's."""

def step(
    model: int,
    data: int,
    count: int,
    recorders: Sequence[ContactRecorder],
    actions: Sequence[StepAction],
    acts_first: bool,
    time_ns: int,
    step_ns: int,
) -> tuple[int, bool]:
    """Step up to `count` times; return the number of steps, and False if an action needs Python. The steps end early
    if an action needs Python or a recorder is stale.

    Args:
        model: address of the model.
        data: address of the data.
        count: number of steps.
        recorders: recorders called at every step.
        actions: actions before every step, in this order.
        acts_first: True: the actions act before the first step, too.
        time_ns: time before the first step [ns].
        step_ns: length of a step [ns].
    """

class MotorBank:
    """Commands of the motors of an engine; see `step.motors.Motors`."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        axes: NDArray[np.float64],
        states: NDArray[np.float64],
    ) -> None:
        """Bind the engine's arrays.

        Args:
            model: engine's model.
            data: engine's data.
            axes: (axes, 4) degree of freedom, actuator or -1, effort and velocity limits.
            states: (actuators, 13) last commands, initially zero; written by the bank.
        """

    def command_effort(self, axis: int, effort: float, hardware: bool) -> None: ...
    def command_velocity(self, axis: int, velocity: float, max_effort: float, hardware: bool) -> None: ...
    def command_position(self, axis: int, position: float, max_effort: float, rate: float) -> None: ...
    def drive_kinematically(self, axis: int, velocity: float, hardware: bool) -> None: ...
    def repeat(self, axis: int, command: tuple[float, float, float, float]) -> None:
        """Set an axis' command, as returned by `command_of`."""

    def command_of(self, axis: int) -> tuple[float, float, float, float]:
        """Return target, largest effort, rate and constant effort of an axis' direct command."""

    @property
    def switches(self) -> int:
        """Number of times that a command switched a motor on or off."""

def wake_tree(model: int, data: int, dof: int) -> None:
    """Wake the tree of a degree of freedom, if it sleeps at rest. Model and data by their addresses."""
