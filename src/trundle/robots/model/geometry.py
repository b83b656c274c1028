"""Shapes of visuals and collisions, centred on their own frame unless stated otherwise."""

from pathlib import Path
from typing import TypeAlias

from msgspec import Struct

from trundle.spatial import Vector3


class Box(Struct, frozen=True):
    """Axis-aligned box."""

    size: Vector3
    """Full lengths along x, y, z [m]; zero is kept as written."""


class Cylinder(Struct, frozen=True):
    """Cylinder along z."""

    radius: float
    """[m]"""
    length: float
    """[m]"""


class Capsule(Struct, frozen=True):
    """Cylinder along z with a hemisphere at each end."""

    radius: float
    """[m]"""
    length: float
    """Length of the cylindrical part [m]."""


class Sphere(Struct, frozen=True):
    """Sphere."""

    radius: float
    """[m]"""


class Ellipsoid(Struct, frozen=True):
    """Axis-aligned ellipsoid."""

    radii: Vector3
    """Half lengths along x, y, z [m]."""


class Plane(Struct, frozen=True):
    """Plane through the origin: infinite as a collision, a rectangle as a visual."""

    normal: Vector3
    """Unit vector."""
    size: tuple[float, float]
    """Lengths of the visual rectangle [m]."""


class Cone(Struct, frozen=True):
    """Cone along z, tip up, centred at half its height."""

    radius: float
    """Radius of the base [m]."""
    length: float
    """[m]"""


class Polyline(Struct, frozen=True):
    """Closed outlines in the x-y plane, extruded along +z from z = 0; outlines inside others are holes."""

    outlines: tuple[tuple[tuple[float, float], ...], ...]
    """Corners of each outline [m]."""
    height: float
    """[m]"""


class TerrainLayer(Struct, frozen=True, kw_only=True):
    """Texture tiled over terrain."""

    size: float = 10.0
    """Side of one repetition [m]."""
    diffuse: Path | None = None
    """Color image; None if the file was not found; the reader warned."""
    normal: Path | None = None
    from_height: float = 0.0
    """Height above the lowest point from which this layer covers the previous one [m]."""
    fade: float = 0.0
    """Height range of the transition [m]."""


class Heightmap(Struct, frozen=True):
    """Terrain from a grey image: black is the lowest, white the highest."""

    path: Path | None
    """Image file; None if it was not found; the reader warned."""
    uri: str
    """As the author wrote it."""
    size: Vector3 = (1.0, 1.0, 1.0)
    """Size of the whole terrain [m]."""
    position: Vector3 = (0.0, 0.0, 0.0)
    """Centre [m]."""
    sampling: int = 2
    """Samples per pixel and axis."""
    layers: tuple[TerrainLayer, ...] = ()
    """Texture layers, lowest first."""


class Empty(Struct, frozen=True):
    """No shape: an empty <geometry>, or a kind that is not supported."""


class MeshFile(Struct, frozen=True):
    """Triangle mesh from a file."""

    path: Path | None
    """Mesh file, resolved from `uri` when the description is read; None if it was not found; the reader warned."""
    uri: str
    """As the author wrote it."""
    scale: Vector3 = (1.0, 1.0, 1.0)
    submesh: str | None = None
    """Name of the submesh used; None: the whole mesh."""
    center_submesh: bool = False
    """Move the submesh's bounding box centre to the origin."""


Solid: TypeAlias = Box | Cylinder | Capsule | Sphere | Ellipsoid | Plane
"""Shapes given by a few numbers."""

Geometry: TypeAlias = Solid | Cone | MeshFile | Polyline | Heightmap | Empty
