"""Collisions as MuJoCo geoms."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Flag, auto

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.meshes import Mesh, MeshError, load_mesh, triangles_of
from trundle.model import (
    Box,
    Capsule,
    Collision,
    Cone,
    Cylinder,
    Ellipsoid,
    Empty,
    Geometry,
    Heightmap,
    MeshFile,
    Plane,
    Polyline,
    Sphere,
    Surface,
)
from trundle.spatial import Pose, Vector3, upright

from .convex_geoms import THINNEST, add_hull, add_hulls, thick_hulls
from .decomposition import FULL, CutMesh, Decomposition
from .hulls import hull_of
from .pieces import split
from .terrain import add_terrain

_CONE_SIDES = 32
_MOST_CORNERS = 1000
"""Of a polyline: cutting it up takes time by their cube."""


class Meets(Flag):
    """What a shape can touch."""

    PLANES = auto()
    STANDING = auto()
    """What else stands."""
    MOVING = auto()
    ALL = PLANES | STANDING | MOVING


@dataclass(frozen=True, slots=True)
class ShapeEntry:
    """One geom that can touch others."""

    geom: mujoco.MjsGeom
    name: str
    collision: str
    """`model::link::collision`"""
    model: int
    link: str
    """`model::link`"""
    fixed: bool
    """Part of the world: nothing moves it."""
    surface: Surface
    meets: Meets = Meets.ALL
    points: int = 1
    """How many of ODE's contact points each of its contacts stands for."""

    @property
    def kind(self) -> Meets:
        """As what it is met."""
        if not self.fixed:
            return Meets.MOVING
        return Meets.PLANES if self.geom.type == mujoco.mjtGeom.mjGEOM_PLANE else Meets.STANDING


def mesh_arrays(mesh: Mesh) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """Vertices (N, 3) [m] and faces (M, 3) of a mesh."""
    return mesh.vertices.astype(float), mesh.faces.astype(np.intp)


def collision_mesh(collision: Collision) -> Mesh | None:
    """Read the mesh of a collision, as large as it says; None where it has none.

    Raises:
        MeshError: it cannot be read.
    """
    geometry = collision.geometry
    if not isinstance(geometry, MeshFile) or geometry.path is None:
        return None
    mesh = load_mesh(geometry.path, submesh=geometry.submesh, center=geometry.center_submesh)
    return mesh.scaled(geometry.scale)


def add_shape(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    *,
    fixed: bool,
    decomposition: Decomposition | None,
) -> list[tuple[mujoco.MjsGeom, Meets]]:
    """Add a collision to a body, in pieces where it takes several; none after a warning where it cannot be one.

    Args:
        spec: of the world.
        body: that has it.
        collision: as written.
        name: of the geom, or of each piece up to a number.
        report: takes what is not as written.
        fixed: it never moves.
        decomposition: cuts meshes; None: each is its convex hull.
    """
    geometry = _mended(collision, report)
    pose = collision.link_from_collision
    match geometry:
        case MeshFile(path=None) | Empty():
            return []
        case MeshFile():
            try:
                mesh = collision_mesh(collision)
            except MeshError as error:
                report.warn(collision.at, f"{error}; the collision is left out")
                return []
            assert mesh is not None  # caught above
            if decomposition is None:
                if not fixed and split(*mesh_arrays(mesh), fixed=False).hollow:
                    what = f"a mesh of {len(mesh.faces)} triangles that is not convex; how physics cuts it was not"
                    report.info(collision.at, f"collision {collision.name!r}: {what} looked at (check --collisions)")
                (corners,) = _thick([mesh.vertices.astype(float)], collision, report)
                return [(add_hull(spec, body, pose, name, corners), Meets.ALL)]
            cut = decomposition.pieces_of(*mesh_arrays(mesh), fixed=fixed)
            _report_cut(cut, mesh, collision, report)
            return _add_pieces(spec, body, collision, name, report, cut.pieces.corners, fixed=fixed)
        case Cone(radius, length):
            turns = np.linspace(0.0, 2 * np.pi, _CONE_SIDES, endpoint=False)
            base = np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(_CONE_SIDES, -length / 2)])
            corners = np.vstack([base, [0.0, 0.0, length / 2]])
            away = radius * (1 - np.cos(np.pi / _CONE_SIDES))
            what = f"a cone; physics has it with {_CONE_SIDES} sides, a surface up to {away:.2g} m away"
            report.info(collision.at, f"collision {collision.name!r}: {what}")
            return [(add_hull(spec, body, pose, name, corners), Meets.ALL)]
        case Polyline(outlines, height):
            prisms = _add_prisms(spec, body, collision, name, report, outlines, height)
            return [(geom, Meets.ALL) for geom in prisms]
        case Heightmap():
            return [(geom, Meets.ALL) for geom in add_terrain(spec, body, collision, geometry, name, report)]
        case _:
            pass
    geom = body.add_geom(name=name, pos=pose.position, quat=pose.quaternion, group=3)
    match geometry:
        case Box(size):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_BOX, [s / 2 for s in size]
        case Cylinder(radius, length):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CYLINDER, [radius, length / 2, 0]
        case Capsule(radius, length):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_CAPSULE, [radius, length / 2, 0]
        case Sphere(radius):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_SPHERE, [radius, 0, 0]
        case Ellipsoid(radii):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_ELLIPSOID, list(radii)
        case Plane(normal, _):
            geom.type, geom.size = mujoco.mjtGeom.mjGEOM_PLANE, [0, 0, 1]
            geom.quat = (pose @ Pose(quaternion=upright(normal))).quaternion
    return [(geom, Meets.ALL)]


def _add_pieces(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    pieces: list[NDArray[np.float64]],
    *,
    fixed: bool,
) -> list[tuple[mujoco.MjsGeom, Meets]]:
    pose = collision.link_from_collision
    corners = _thick(pieces, collision, report)
    if len(corners) == 1:
        return [(add_hull(spec, body, pose, name, corners[0]), Meets.ALL)]
    geoms = add_hulls(spec, body, pose, name, corners)
    if fixed or hull_of(np.concatenate(corners)) is None:
        return [(geom, Meets.ALL) for geom in geoms]
    # On a plane pieces stand as the hull around them all does, which touches it in far fewer points.
    hull = add_hull(spec, body, pose, f"{name}#hull", np.concatenate(corners))
    return [(hull, Meets.PLANES), *((geom, Meets.STANDING | Meets.MOVING) for geom in geoms)]


def _report_cut(cut: CutMesh, mesh: Mesh, collision: Collision, report: Diagnostics) -> None:
    """Say what stands for a hollow mesh, and how well."""
    misfits = cut.pieces.misfits
    if not misfits:
        return
    worst = max(misfits, key=lambda misfit: misfit.away)
    is_filled = any(misfit.is_filled for misfit in misfits)
    how = "fills it" if is_filled else f"takes it for {len(cut.pieces.corners)} convex pieces"
    times = "" if worst.times is None else f"{round(worst.times, 2):g} times its volume, "
    what = f"a hollow mesh of {len(mesh.faces)} triangles; physics {how}"
    said = f"collision {collision.name!r}: {what}: {times}a surface up to {worst.away:.2g} m away"
    if cut.is_failed:
        report.warn(collision.at, f"{said}; it could not be cut into convex pieces")
    elif cut.is_coarse:
        report.warn(collision.at, f"{said}; fewer pieces than could be, to save time: {FULL}=1 has them all")
    else:
        report.info(collision.at, said)


def _add_prisms(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    outlines: tuple[tuple[tuple[float, float], ...], ...],
    height: float,
) -> list[mujoco.MjsGeom]:
    """A polyline as one prism for each triangle of its ground plan."""
    if sum(map(len, outlines)) > _MOST_CORNERS or not height > 0:
        what = f"a polyline of more than {_MOST_CORNERS} corners, or without height; it is left out"
        report.warn(collision.at, f"collision {collision.name!r}: {what}")
        return []
    prisms = [np.array([(x, y, z) for z in (0.0, height) for x, y in triangle]) for triangle in triangles_of(outlines)]
    return add_hulls(spec, body, collision.link_from_collision, name, _thick(prisms, collision, report))


def _thick(
    pieces: Sequence[NDArray[np.float64]], collision: Collision, report: Diagnostics
) -> list[NDArray[np.float64]]:
    """Pieces (N, 3) [m] that a hull can be made of."""
    thick, thickest = thick_hulls(pieces)
    if thickest:
        what = f"a mesh of zero thickness; physics uses {thickest * 1000:.2g} mm"
        report.warn(collision.at, f"collision {collision.name!r}: {what}")
    return thick


def _mended(collision: Collision, report: Diagnostics) -> Geometry:
    def thick(lengths: Vector3, names: str) -> Vector3:
        thin = [n for n, length in zip(names.split(), lengths, strict=False) if not length >= THINNEST]
        if thin:
            report.warn(
                collision.at,
                f"collision {collision.name!r}: {' and '.join(thin)} of zero thickness; "
                f"physics uses {THINNEST * 1000:g} mm",
            )
        x, y, z = (max(length, THINNEST) for length in lengths)
        return (x, y, z)

    match collision.geometry:
        case Box(size):
            return Box(thick(size, "x y z"))
        case Cylinder(radius, length):
            radius, length, _ = thick((radius, length, 1.0), "radius length")
            return Cylinder(radius, length)
        case Cone(radius, length):
            radius, length, _ = thick((radius, length, 1.0), "radius length")
            return Cone(radius, length)
        case Capsule(radius, length):
            radius, length, _ = thick((radius, length, 1.0), "radius length")
            return Capsule(radius, length)
        case Sphere(radius):
            return Sphere(thick((radius, 1.0, 1.0), "radius")[0])
        case Ellipsoid(radii):
            return Ellipsoid(thick(radii, "x y z"))
        case other:
            return other
