"""Ways painted on the ground."""

from msgspec import Struct

from trundle.diagnostics import Source
from trundle.spatial import Vector3

from .material import Material


class Road(Struct, frozen=True, kw_only=True):
    """A strip along a line: seen, never touched."""

    name: str
    at: Source
    points: tuple[Vector3, ...]
    """Of its middle line, at least two [m]."""
    width: float = 1.0
    """[m] A texture is as wide: u goes from 0 on the left to 1 on the right, v grows by one on every `width` of way."""
    material: Material
