"""Objects of a planning scene: in the world, attached to links, and voxels."""

from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cone, Cylinder, Plane, Sphere
from trundle.spatial import Pose

ShapeGeometry: TypeAlias = Box | Sphere | Cylinder | Cone | Plane | Mesh
"""Shape in its own frame [m]; a plane is infinite and thin."""


class PlacedShape(Struct, frozen=True):
    """Shape at a pose in the frame of its owner."""

    geometry: ShapeGeometry
    pose: Pose = Pose()


class CollisionObject(Struct, frozen=True, kw_only=True):
    """Object of the world, as moveit_msgs/CollisionObject."""

    name: str
    shapes: tuple[PlacedShape, ...] = ()
    """In the object's frame."""
    pose: Pose = Pose()
    """Object's frame in the model frame."""
    subframes: dict[str, Pose] = {}
    """Frames of the object, by name."""


class AttachedObject(Struct, frozen=True, kw_only=True):
    """Object that a link carries, as moveit_msgs/AttachedCollisionObject."""

    object: CollisionObject
    """Its pose is in the link's frame."""
    link: str
    touch_links: frozenset[str] = frozenset()
    """Links that may touch it, besides the one that carries it."""


class Voxels(Struct, frozen=True, eq=False):
    """Occupied cubes, as the leaves of an octomap."""

    centers: NDArray[np.float64]
    """(N, 3) in their frame [m]."""
    sizes: NDArray[np.float64]
    """(N,) lengths of the edges [m]."""
    pose: Pose = Pose()
    """Their frame in the model frame."""
