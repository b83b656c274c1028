"""Case of the comparison with rviz: one display, with the messages of its topics."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

HEADER = {"frame_id": "map"}
FRAMES = {"base": (1.0, 0.0, 0.5), "arm": (0.0, 2.0, 1.0), "plate": (-1.0, -2.0, 0.2)}
"""Frames below map and their positions [m]."""
IN_PLATE = {"frame_id": "plate"}

Display = Mapping[str, Any]
"""Entry of an .rviz file."""
Message = tuple[str, str, Mapping[str, Any]]
"""Topic, type, fields."""


@dataclass(frozen=True, kw_only=True)
class Case:
    name: str
    display: Display
    messages: Sequence[Message] = field(default=())
    """Latched messages, published once for this case and later ones."""
    repeated: Sequence[Message] = field(default=())
    """Messages published repeatedly, one after another, while the case is drawn."""
    grain: int = 1
    """Side of the squares that are averaged before the comparison [px], for coarse textures."""
    real: Display | None = None
    """Display for rviz, if Debian's rviz has no such display."""


def point(x: float, y: float, z: float = 0.0) -> dict[str, float]:
    return {"x": x, "y": y, "z": z}


def color(r: float, g: float, b: float, a: float = 1.0) -> dict[str, float]:
    return {"r": r, "g": g, "b": b, "a": a}


def turn(yaw: float) -> dict[str, float]:
    return {"x": 0.0, "y": 0.0, "z": math.sin(yaw / 2), "w": math.cos(yaw / 2)}


def pose(x: float = 0.0, y: float = 0.0, z: float = 0.0, yaw: float = 0.0) -> dict[str, Any]:
    return {"position": point(x, y, z), "orientation": turn(yaw)}


def ring(count: int, radius: float = 2.0) -> list[dict[str, Any]]:
    """Return poses along most of a circle, tangential to it."""
    angles = [1.8 * math.pi * index / count for index in range(count)]
    return [pose(radius * math.cos(a), radius * math.sin(a), 0.2, a + math.pi / 2) for a in angles]


def covariance(*variances: float) -> list[float]:
    """Return a covariance in which x and y are correlated."""
    matrix = [0.0] * 36
    for row, variance in enumerate(variances):
        matrix[7 * row] = variance
    matrix[1] = matrix[6] = 0.1
    return matrix
