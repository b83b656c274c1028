"""Geoms of collisions, with the properties that determine their contacts."""

from enum import Flag, auto

import mujoco
from msgspec import Struct

from trundle.robots.model import Surface


class CollidesWith(Flag):
    """Kinds of shapes that a shape can collide with."""

    PLANES = auto()
    FIXED = auto()
    """Fixed shapes other than planes."""
    MOVING = auto()
    ALL = PLANES | FIXED | MOVING


class ShapeEntry(Struct, frozen=True):
    """Geom that takes part in collisions."""

    geom: mujoco.MjsGeom
    name: str
    collision: str
    """`model::link::collision`"""
    model: int
    link: str
    """`model::link`"""
    fixed: bool
    """True if the shape cannot move."""
    surface: Surface
    collides_with: CollidesWith = CollidesWith.ALL
    points: int = 1
    """Number of ODE contact points represented by each of its contacts."""
    has_tread: bool = False
    """True for the cylinder of a wheel, whose tread carries it on fixed shapes."""

    @property
    def kind(self) -> CollidesWith:
        """Kind of the shape in the other's `collides_with`."""
        if not self.fixed:
            return CollidesWith.MOVING
        return CollidesWith.PLANES if self.geom.type == mujoco.mjtGeom.mjGEOM_PLANE else CollidesWith.FIXED
