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
class MeshFile:
    """Triangles from a file."""

    path: Path
    """Where the file is; `uri` is resolved once, when the description is read."""
    uri: str
    """As the author wrote it."""
    scale: Vector3 = (1.0, 1.0, 1.0)
    submesh: str | None = None
    """Only the part of this name."""
    center_submesh: bool = False
    """Move that part's bounding box to the origin."""


Geometry: TypeAlias = Box | Cylinder | Capsule | Sphere | Ellipsoid | Plane | MeshFile
