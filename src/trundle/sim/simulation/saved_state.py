"""Saved states of a simulation."""

from msgspec import Struct

from trundle.base.documented import documented
from trundle.sim.physics import EngineState

from .applied_loads import Expiries
from .step_clock import StepClock


@documented("")
class SavedSimulation(Struct, frozen=True):
    """State that `restore` takes."""

    __module__ = "trundle"

    steps: int
    clock: StepClock
    engine: EngineState
    expiries: Expiries
