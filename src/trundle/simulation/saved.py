"""A simulation's state, kept to go back to it exactly."""

from dataclasses import dataclass

from trundle.physics import EngineState

from .pushes import Ends
from .timeline import Timeline


@dataclass(frozen=True, slots=True)
class SavedSimulation:
    """A state to go back to."""

    steps: int
    timeline: Timeline
    engine: EngineState
    ends: Ends
