"""Interface of a profiler of strides, which reads the wall clock."""

from enum import Enum
from typing import Protocol


class StridePart(Enum):
    """Parts of a stride other than hooks."""

    BETWEEN = "between strides"
    COMMANDS = "commands"
    """Commands and callbacks of messages."""
    SCHEDULE = "schedule"
    """Search for due hooks, and the snapshot."""
    PHYSICS = "physics"
    LISTENERS = "listeners"
    """Listeners to the readings of sensors."""
    TIMELINE = "timeline"
    """Saving of states for the timeline."""


class Profiler(Protocol):
    """Charges the wall time of a stride to its parts."""

    def lap(self, *parts: object) -> None:
        """Charge the time since the last lap to parts, in equal shares: hooks, or members of `StridePart`."""
        ...
