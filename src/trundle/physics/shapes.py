"""Collisions as MuJoCo geoms."""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.meshes import MeshError, load_mesh
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
from trundle.spatial import IDENTITY_QUATERNION, Pose, Quaternion, Vector3

THINNEST = 1e-4
"""[m] What a thickness of zero becomes: 0.1 mm."""


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
    is_tread: bool = False
    """Of a wheel; touches what is fixed."""


def add_shape(
    spec: mujoco.MjSpec, body: mujoco.MjsBody, collision: Collision, name: str, report: Diagnostics
) -> mujoco.MjsGeom | None:
    """Add a collision to a body; None after a warning where it cannot be one."""
    geometry = _mended(collision, report)
    pose = collision.link_from_collision
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
        case MeshFile(path=None) | Empty():
            spec.delete(geom)
            return None
        case Cone() | Polyline() | Heightmap():
            what = type(geometry).__name__.lower()
            report.warn(collision.at, f"collision {collision.name!r}: a {what} is not simulated yet; it is left out")
            spec.delete(geom)
            return None
        case MeshFile(path=path):
            assert path is not None  # caught above
            try:
                mesh = load_mesh(path, submesh=geometry.submesh, center=geometry.center_submesh)
            except MeshError as error:
                report.warn(collision.at, f"{error}; the collision is left out")
                spec.delete(geom)
                return None
            corners = _thick_hull(mesh.scaled(geometry.scale).vertices.astype(float), collision, report)
            # Without faces: meshes touch by their convex hulls, which MuJoCo makes of the corners.
            spec.add_mesh(name=name, uservert=corners.reshape(-1), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
            geom.type, geom.meshname = mujoco.mjtGeom.mjGEOM_MESH, name
    return geom


def _thick_hull(corners: NDArray[np.float64], collision: Collision, report: Diagnostics) -> NDArray[np.float64]:
    """A mesh's corners (N, 3) [m]; across what is flat or a line, a second layer of them, as a hull needs a volume."""
    centred = corners - corners.mean(axis=0)
    axes = np.linalg.eigh(centred.T @ centred)[1].T
    thin = [axis for axis in axes if np.ptp(centred @ axis) < THINNEST]
    for axis in thin:
        corners = np.concatenate([corners - axis * THINNEST / 2, corners + axis * THINNEST / 2])
    if thin:
        report.warn(
            collision.at,
            f"collision {collision.name!r}: a mesh of zero thickness; physics uses {THINNEST * 1000:g} mm",
        )
    return corners


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
        case Capsule(radius, length):
            radius, length, _ = thick((radius, length, 1.0), "radius length")
            return Capsule(radius, length)
        case Sphere(radius):
            return Sphere(thick((radius, 1.0, 1.0), "radius")[0])
        case Ellipsoid(radii):
            return Ellipsoid(thick(radii, "x y z"))
        case other:
            return other


def upright(normal: Vector3) -> Quaternion:
    """The shortest rotation that takes +z to a unit vector."""
    x, y, z = normal
    if z < -1 + 1e-12:
        return (0.0, 1.0, 0.0, 0.0)
    if z > 1 - 1e-12:
        return IDENTITY_QUATERNION
    w = math.sqrt((1 + z) / 2)
    return (w, -y / (2 * w), x / (2 * w), 0.0)
