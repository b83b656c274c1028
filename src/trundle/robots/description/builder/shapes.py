"""Builder of shapes with mass properties."""

from abc import abstractmethod
from pathlib import Path
from typing import TYPE_CHECKING, Generic, TypedDict, TypeVar, Unpack

import numpy as np
from msgspec import Struct

from trundle.base.arguments import pose_of, vector_of
from trundle.base.diagnostics import UsageError, no_such
from trundle.robots.meshes import Mesh, load_mesh
from trundle.robots.model import GREY, Box, Capsule, Cylinder, Geometry, Material, MeshFile, Sphere, Surface
from trundle.spatial import ZERO, Pose, Vector3

from ..inertia_sum import Tensor
from ..sdf.auto_inertia import volume_and_moments
from .names import check_positive, color_of

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from trundle.base.arguments import PoseLike

WATER = 1000.0
"""[kg/m³] SDF's default density."""
Added = TypeVar("Added")


class Shape(Struct, frozen=True, kw_only=True):
    """Shape with a visual, a collision, or both."""

    name: str
    geometry: Geometry
    pose: Pose
    mass: float
    """[kg]"""
    center: Vector3
    """Centre of mass in the shape's frame [m]."""
    inertia: Tensor
    """Inertia about the centre of mass, in the shape's axes [kg·m²]."""
    material: Material
    surface: Surface
    visual: bool
    collision: bool


class ShapeOptions(TypedDict, total=False):
    """Options of every shape."""

    pose: "PoseLike"
    """Pose in the parent's frame: `Pose`, or 3, 6 or 7 numbers; default: identity."""
    mass: float
    """Mass [kg]; default: from the density."""
    density: float
    """Density [kg/m³]; default: water's, which is SDF's."""
    color: "ArrayLike"
    """Red, green, blue, each 0 to 1, and opacity if there are 4; default: Gazebo's grey."""
    surface: Surface
    """Friction and contact; default: SDF's."""
    visual: bool
    """True for a visual; default: True."""
    collision: bool
    """True for a collision; default: True."""


class ShapeAdder(Generic[Added]):
    """Base of builders to which shapes are added, as models, links or parts of a link.

    A shape's name is also that of its visual and collision; `ShapeOptions` has the optional arguments.
    """

    @abstractmethod
    def add_shape(self, shape: Shape) -> Added:
        """Add a shape created by the other methods."""

    def add_box(self, name: str, size: "ArrayLike", **options: Unpack[ShapeOptions]) -> Added:
        """Add a box of full lengths `size` along x, y, z [m].

        Raises:
            UsageError: a length, mass or density is not above zero, or the name is a duplicate.
        """
        x, y, z = vector_of(size, f"size of box {name!r} [m]")
        check_positive(f"size of box {name!r}", x, y, z)
        return self.add_shape(_solid(name, Box((x, y, z)), options))

    def add_sphere(self, name: str, radius: float, **options: Unpack[ShapeOptions]) -> Added:
        """Add a sphere of a radius [m].

        Raises:
            UsageError: the radius, mass or density is not above zero, or the name is a duplicate.
        """
        check_positive(f"radius of sphere {name!r}", radius)
        return self.add_shape(_solid(name, Sphere(radius), options))

    def add_cylinder(self, name: str, radius: float, length: float, **options: Unpack[ShapeOptions]) -> Added:
        """Add a cylinder along its z, of a radius and a length [m].

        Raises:
            UsageError: a length, mass or density is not above zero, or the name is a duplicate.
        """
        check_positive(f"radius and length of cylinder {name!r}", radius, length)
        return self.add_shape(_solid(name, Cylinder(radius, length), options))

    def add_capsule(self, name: str, radius: float, length: float, **options: Unpack[ShapeOptions]) -> Added:
        """Add a capsule along its z; `length` is the length of the cylindrical part [m], as in SDF.

        Raises:
            UsageError: a length, mass or density is not above zero, or the name is a duplicate.
        """
        check_positive(f"radius and length of capsule {name!r}", radius, length)
        return self.add_shape(_solid(name, Capsule(radius, length), options))

    def add_mesh(
        self, name: str, file: str | Path, *, scale: "ArrayLike" = (1.0, 1.0, 1.0), **options: Unpack[ShapeOptions]
    ) -> Added:
        """Add the closed mesh of a .dae, .stl, .obj or .glb file.

        Raises:
            UsageError: the mesh encloses no volume, a mass or density is not above zero, or the name is a duplicate.
            MeshError: the file cannot be used.
        """
        path, factors = Path(file).expanduser().resolve(), vector_of(scale, f"scale of mesh {name!r}")
        volume, center, per_mass = _enclosed(load_mesh(path), factors, file)
        geometry = MeshFile(path=path, uri=path.as_uri(), scale=factors)
        return self.add_shape(_shape(name, geometry, volume, per_mass, options, center=center))


def _solid(name: str, geometry: Box | Capsule | Cylinder | Sphere, options: ShapeOptions) -> Shape:
    properties = volume_and_moments(geometry)
    assert properties is not None, "a shape with a closed formula"
    volume, moments = properties
    return _shape(name, geometry, volume, (*moments, 0.0, 0.0, 0.0), options)


def _shape(
    name: str, geometry: Geometry, volume: float, per_mass: Tensor, options: ShapeOptions, *, center: Vector3 = ZERO
) -> Shape:
    """Return a shape with the mass of its options or volume [m³]; `per_mass` is inertia per unit of mass [m²]."""
    unknown = options.keys() - ShapeOptions.__annotations__.keys()
    if unknown:
        raise UsageError(no_such(f"shape {name!r}: no option", unknown.pop(), list(ShapeOptions.__annotations__)))
    mass = options.get("mass", options.get("density", WATER) * volume)
    check_positive(f"mass or density of {name!r}", mass)
    color = color_of(options.get("color", GREY.diffuse), f"color of {name!r}")
    a, b, c, d, e, f = (entry * mass for entry in per_mass)
    return Shape(
        name=name,
        geometry=geometry,
        pose=pose_of(options.get("pose", Pose()), f"pose of {name!r}"),
        mass=mass,
        center=center,
        inertia=(a, b, c, d, e, f),
        material=Material(diffuse=color, ambient=color) if "color" in options else GREY,
        surface=options.get("surface", Surface()),
        visual=options.get("visual", True),
        collision=options.get("collision", True),
    )


def _enclosed(mesh: Mesh, scale: Vector3, file: str | Path) -> tuple[float, Vector3, Tensor]:
    """Return a closed mesh's volume [m³], centre of mass [m] and inertia about it per unit of mass [m²].

    Sums over the tetrahedra of each face with the origin: ∫ x xᵀ dV = Σ det/120 (Σᵢ vᵢ vᵢᵀ + s sᵀ), s = Σᵢ vᵢ.
    """
    corners = mesh.vertices.astype(np.float64)[mesh.faces] * np.asarray(scale)
    six_volumes = np.linalg.det(corners)
    volume = float(six_volumes.sum() / 6)
    if not abs(volume) > 0.0:
        raise UsageError(f"mesh {file} encloses no volume, so its mass and inertia are not known")
    sums = corners.sum(axis=1)
    center = (six_volumes @ sums) / (24 * volume)
    products = np.einsum("n,nij,nik->jk", six_volumes, corners, corners) + (sums.T * six_volumes) @ sums
    second = products / (120 * volume) - np.outer(center, center)
    xx, yy, zz = np.diag(second).tolist()
    x, y, z = center.tolist()
    inertia = (yy + zz, xx + zz, xx + yy, -float(second[0, 1]), -float(second[0, 2]), -float(second[1, 2]))
    return abs(volume), (x, y, z), inertia
