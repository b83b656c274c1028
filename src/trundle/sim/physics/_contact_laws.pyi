from collections.abc import Callable, Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

VERSION: int
"""Of the MuJoCo whose headers this was compiled with, as `mujoco.mj_version()` has it."""

def names() -> list[str]:
    """What `bind` takes the addresses of."""

def bind(addresses: Sequence[int]) -> None: ...
def install() -> None:
    """Have MuJoCo call the laws in every step, behind whoever it calls now."""

def set_timers(on: bool) -> None:
    """Have MuJoCo time the parts of every step [s], in all threads, or end it."""

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

def read_contacts(model: int, data: int, contacts: Sequence[int]) -> NDArray[np.float64]:
    """Return (N, 15) rows of the contacts of these indices: see `step.contact.Contacts`."""

class ContactRecorder:
    """Contacts of chosen geoms, recorded by `step`."""

    def __init__(self, geoms: Sequence[int], geom_count: int, most_steps: int) -> None:
        """Have the latest steps with contacts kept, at most `most_steps`."""

    @property
    def is_stale(self) -> bool:
        """True if other bodies sleep than those whose contacts are known; `set_sleeping` must follow."""

    def set_sleeping(self, rows: NDArray[np.float64]) -> None:
        """Set the contacts among sleeping bodies, from the last step on."""

    def replace_since(self, time_ns: int, rows: NDArray[np.float64]) -> None:
        """Record rows in place of whatever was recorded at that time or later."""

    def take(self) -> tuple[list[int], NDArray[np.float64]]:
        """Return the time of each row [ns] and the rows (N, 15), and forget them."""

    def copy(self) -> ContactRecorder: ...

class StepAction:
    """Action before each step."""

    def checkpoint(self) -> Callable[[], None]:
        """Return a function that restores what the action has changed, but for the engine."""

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
    """Step up to `count` times; return how many steps, fewer if a recorder became stale or an action needs Python, and
    False if one does.

    Args:
        model: address.
        data: address.
        count: of steps.
        recorders: record at every step.
        actions: act before every step, in this order.
        acts_first: before the first step, too.
        time_ns: before the first step [ns].
        step_ns: length of a step [ns].
    """

class MotorBank:
    """Commands of the motors of an engine; `step.motors.Motors` says what they do."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        axes: NDArray[np.float64],
        states: NDArray[np.float64],
    ) -> None:
        """Bind the engine's arrays.

        Args:
            model: of the engine.
            data: of the engine.
            axes: (axes, 4) degree of freedom, actuator or -1, effort and velocity limits.
            states: (actuators, 13) last commands, all zero so far; written from now on.
        """

    def command_effort(self, axis: int, effort: float, hardware: bool) -> None: ...
    def command_velocity(self, axis: int, velocity: float, max_effort: float, hardware: bool) -> None: ...
    def command_position(self, axis: int, position: float, max_effort: float, rate: float) -> None: ...
    def drive_kinematically(self, axis: int, velocity: float, hardware: bool) -> None: ...
    def repeat(self, axis: int, command: tuple[float, float, float, float]) -> None:
        """Give an axis a command of `command_of`."""

    def command_of(self, axis: int) -> tuple[float, float, float, float]:
        """Return target, largest effort, rate and constant effort of an axis' direct command."""

    @property
    def switches(self) -> int:
        """Number of times that a command switched a motor on or off."""

def wake_tree(model: int, data: int, dof: int) -> None:
    """Wake the tree of a degree of freedom, if it sleeps at rest. Model and data by their addresses."""
