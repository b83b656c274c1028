"""Collisions as MuJoCo geoms."""

from typing import TYPE_CHECKING

import mujoco
import numpy as np

from trundle.base.diagnostics import Diagnostics
from trundle.robots.meshes import triangulate
from trundle.robots.model import (
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
)
from trundle.spatial import Pose, Vector3, rotation_from_z

from .convex_geoms import MIN_THICKNESS, add_hull, add_hulls, thick_pieces
from .shape_entry import CollidesWith

if TYPE_CHECKING:
    from ..convex.mesh_decomposition import WorldDecomposition

_CONE_SIDES = 32
_MAX_CORNERS = 1000
"""Maximum number of corners of a polyline; the time of triangulation grows with its cube."""


def add_shape(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    *,
    fixed: bool,
    decomposition: "WorldDecomposition | None",
) -> list[tuple[mujoco.MjsGeom, CollidesWith]]:
    """Add a collision to a body as one or several geoms; an unsupported one is dropped with a warning.

    Args:
        spec: the world's specification.
        body: owner of the geoms.
        collision: collision as in the file.
        name: name of the geom, or prefix of the pieces' names.
        report: receives deviations from the file.
        fixed: True if the body never moves.
        decomposition: convex pieces of meshes; None: each mesh is its convex hull.
    """
    geometry = _repaired(collision, report)
    pose = collision.link_from_collision
    match geometry:
        case MeshFile(path=None) | Empty():
            return []
        case MeshFile():
            from .mesh_shapes import add_mesh  # worlds without meshes do not import the decomposition

            return add_mesh(spec, body, collision, name, report, fixed=fixed, decomposition=decomposition)
        case Cone(radius, length):
            turns = np.linspace(0.0, 2 * np.pi, _CONE_SIDES, endpoint=False)
            base = np.column_stack([radius * np.cos(turns), radius * np.sin(turns), np.full(_CONE_SIDES, -length / 2)])
            corners = np.vstack([base, [0.0, 0.0, length / 2]])
            away = radius * (1 - np.cos(np.pi / _CONE_SIDES))
            note = f"a cone; physics uses a pyramid of {_CONE_SIDES} sides, a surface up to {away:.2g} m away"
            report.info(collision.at, f"collision {collision.name!r}: {note}", "approximated-shape")
            return [(add_hull(spec, body, pose, name, corners), CollidesWith.ALL)]
        case Polyline(outlines, height):
            prisms = _add_prisms(spec, body, collision, name, report, outlines, height)
            return [(geom, CollidesWith.ALL) for geom in prisms]
        case Heightmap():
            from .terrain import add_terrain  # worlds without heightmaps do not import the image reader

            return [(geom, CollidesWith.ALL) for geom in add_terrain(spec, body, collision, geometry, name, report)]
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
            geom.quat = (pose @ Pose(quaternion=rotation_from_z(normal))).quaternion
    return [(geom, CollidesWith.ALL)]


def _add_prisms(
    spec: mujoco.MjSpec,
    body: mujoco.MjsBody,
    collision: Collision,
    name: str,
    report: Diagnostics,
    outlines: tuple[tuple[tuple[float, float], ...], ...],
    height: float,
) -> list[mujoco.MjsGeom]:
    """Add a polyline as one prism per triangle of its outline."""
    if sum(map(len, outlines)) > _MAX_CORNERS or not height > 0:
        problem = f"a polyline of more than {_MAX_CORNERS} corners, or without height; it is left out"
        report.warn(collision.at, f"collision {collision.name!r}: {problem}", "degenerate-shape")
        return []
    prisms = [np.array([(x, y, z) for z in (0.0, height) for x, y in triangle]) for triangle in triangulate(outlines)]
    return add_hulls(spec, body, collision.link_from_collision, name, thick_pieces(prisms, collision, report))


def _repaired(collision: Collision, report: Diagnostics) -> Geometry:
    def thick(lengths: Vector3, names: str) -> Vector3:
        thin = [n for n, length in zip(names.split(), lengths, strict=False) if not length >= MIN_THICKNESS]
        if thin:
            report.warn(
                collision.at,
                f"collision {collision.name!r}: {' and '.join(thin)} of zero thickness; "
                f"physics uses {MIN_THICKNESS * 1000:g} mm",
                "degenerate-shape",
            )
        x, y, z = (max(length, MIN_THICKNESS) for length in lengths)
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
