"""Lines drawn by plugins while the world runs, for viewers and callers."""

from msgspec import Struct, field

from trundle.spatial import Vector3


class DebugLine(Struct):
    """Line strip."""

    rgb: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """0 to 1."""
    points: list[Vector3] = field(default_factory=list[Vector3])
    """Points in the world [m], oldest first."""
