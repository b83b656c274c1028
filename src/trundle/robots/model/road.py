"""Roads drawn on the ground."""

from msgspec import Struct

from trundle.base.diagnostics import Source
from trundle.spatial import Vector3

from .material import Material


class Road(Struct, frozen=True, kw_only=True):
    """Road strip along a centre line: visual only, no collision."""

    name: str
    at: Source
    points: tuple[Vector3, ...]
    """Centre line, at least two points [m]."""
    width: float = 1.0
    """Width [m], which is also the texture's: u runs from 0 on the left to 1 on the right, v grows by 1 per `width` of
    length.
    """
    material: Material
