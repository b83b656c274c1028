"""A simulation's state, kept to go back to it exactly."""

from msgspec import Struct

from trundle.physics import EngineState

from .pushes import Ends
from .timeline import Timeline


class SavedSimulation(Struct, frozen=True):
    """A state to go back to."""

    steps: int
    timeline: Timeline
    engine: EngineState
    ends: Ends
