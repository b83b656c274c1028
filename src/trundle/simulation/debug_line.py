"""Lines in the world that somebody draws while it runs; viewers show them, and they can be read."""

from msgspec import Struct, field

from trundle.spatial import Vector3


class DebugLine(Struct):
    """A line strip that grows."""

    rgb: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """0 to 1."""
    points: list[Vector3] = field(default_factory=list[Vector3])
    """In the world [m], oldest first."""
