"""Shapes of visuals and collisions, each centred on its own frame unless it says otherwise."""

from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

from trundle.spatial import Vector3


@dataclass(frozen=True, slots=True)
class Box:
    """An axis-aligned box."""

    size: Vector3
    """Full lengths along x, y, z [m]; zero is kept as written."""


@dataclass(frozen=True, slots=True)
class Cylinder:
    """A cylinder along z."""

    radius: float
    """[m]"""
    length: float
    """[m]"""


@dataclass(frozen=True, slots=True)
class Capsule:
    """A cylinder along z with a half sphere at each end."""

    radius: float
    """[m]"""
    length: float
    """Of the cylindrical part [m]."""


@dataclass(frozen=True, slots=True)
class Sphere:
    """A ball."""

    radius: float
    """[m]"""


@dataclass(frozen=True, slots=True)
class Ellipsoid:
    """An ellipsoid along the axes."""

    radii: Vector3
    """Half lengths along x, y, z [m]."""


@dataclass(frozen=True, slots=True)
class Plane:
    """A plane through the origin: infinite as a collision, a rectangle as a visual."""

    normal: Vector3
    """Unit."""
    size: tuple[float, float]
    """Lengths of the visual rectangle [m]."""


@dataclass(frozen=True, slots=True)
class Cone:
    """A cone along z, its tip up, centred at half its height."""

    radius: float
    """Of the base [m]."""
    length: float
    """[m]"""


@dataclass(frozen=True, slots=True)
class Polyline:
    """Closed outlines in the x-y plane, extruded along +z from z = 0; outlines inside others are holes."""

    outlines: tuple[tuple[tuple[float, float], ...], ...]
    """Corners of each [m]."""
    height: float
    """[m]"""


@dataclass(frozen=True, slots=True, kw_only=True)
class TerrainLayer:
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


@dataclass(frozen=True, slots=True)
class Heightmap:
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


@dataclass(frozen=True, slots=True)
class Empty:
    """No shape at all, as written or for want of one that is known."""


@dataclass(frozen=True, slots=True)
class MeshFile:
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
