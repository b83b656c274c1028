"""Shapes of visuals and collisions, each centred on its own frame unless it says otherwise."""

from pathlib import Path
from typing import TypeAlias

from msgspec import Struct

from trundle.spatial import Vector3


class Box(Struct, frozen=True):
    """An axis-aligned box."""

    size: Vector3
    """Full lengths along x, y, z [m]; zero is kept as written."""


class Cylinder(Struct, frozen=True):
    """A cylinder along z."""

    radius: float
    """[m]"""
    length: float
    """[m]"""


class Capsule(Struct, frozen=True):
    """A cylinder along z with a half sphere at each end."""

    radius: float
    """[m]"""
    length: float
    """Of the cylindrical part [m]."""


class Sphere(Struct, frozen=True):
    """A ball."""

    radius: float
    """[m]"""


class Ellipsoid(Struct, frozen=True):
    """An ellipsoid along the axes."""

    radii: Vector3
    """Half lengths along x, y, z [m]."""


class Plane(Struct, frozen=True):
    """A plane through the origin: infinite as a collision, a rectangle as a visual."""

    normal: Vector3
    """Unit."""
    size: tuple[float, float]
    """Lengths of the visual rectangle [m]."""


class Cone(Struct, frozen=True):
    """A cone along z, its tip up, centred at half its height."""

    radius: float
    """Of the base [m]."""
    length: float
    """[m]"""


class Polyline(Struct, frozen=True):
    """Closed outlines in the x-y plane, extruded along +z from z = 0; outlines inside others are holes."""

    outlines: tuple[tuple[tuple[float, float], ...], ...]
    """Corners of each [m]."""
    height: float
    """[m]"""


class TerrainLayer(Struct, frozen=True, kw_only=True):
    """An image that is repeated over terrain."""

    size: float = 10.0
    """Side of one repetition [m]."""
    diffuse: Path | None = None
    """Its colours; None: nowhere, which was said."""
    normal: Path | None = None
    from_height: float = 0.0
    """Above the lowest point it covers the layer before it [m]."""
    fade: float = 0.0
    """Height over which it does [m]."""


class Heightmap(Struct, frozen=True):
    """Terrain from a grey image: black is the lowest, white the highest."""

    path: Path | None
    """Where the image is; None: nowhere, which was said."""
    uri: str
    """As the author wrote it."""
    size: Vector3 = (1.0, 1.0, 1.0)
    """Lengths of the whole [m]."""
    position: Vector3 = (0.0, 0.0, 0.0)
    """Of its centre [m]."""
    sampling: int = 2
    """Samples per pixel and axis."""
    layers: tuple[TerrainLayer, ...] = ()
    """What it is painted with, the lowest first."""


class Empty(Struct, frozen=True):
    """No shape at all, as written or for want of one that is known."""


class MeshFile(Struct, frozen=True):
    """Triangles from a file."""

    path: Path | None
    """Where the file is; `uri` is resolved once, when the description is read. None: nowhere, which was said."""
    uri: str
    """As the author wrote it."""
    scale: Vector3 = (1.0, 1.0, 1.0)
    submesh: str | None = None
    """Only the part of this name."""
    center_submesh: bool = False
    """Move that part's bounding box to the origin."""


Solid: TypeAlias = Box | Cylinder | Capsule | Sphere | Ellipsoid | Plane
"""What a few numbers describe."""

Geometry: TypeAlias = Solid | Cone | MeshFile | Polyline | Heightmap | Empty
