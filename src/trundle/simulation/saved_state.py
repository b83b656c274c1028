"""A simulation's state, kept to go back to it exactly."""

from msgspec import Struct

from trundle.physics import EngineState

from .applied_loads import Expiries
from .step_clock import StepClock


class SavedSimulation(Struct, frozen=True):
    """A state to go back to."""

    steps: int
    clock: StepClock
    engine: EngineState
    expiries: Expiries
