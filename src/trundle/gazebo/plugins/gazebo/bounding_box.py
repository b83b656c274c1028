"""Bounding box of a link's collisions; Gazebo's native drive plugins derive wheel sizes from it."""

import itertools

from trundle.robots.meshes import MeshError, load_mesh
from trundle.robots.model import Box, Capsule, Collision, Cone, Cylinder, Ellipsoid, Geometry, Link, MeshFile, Sphere
from trundle.spatial import Vector3


def bounding_box(link: Link) -> Vector3:
    """Return the side lengths of the box around all collisions, along the link's axes [m]; zero without any."""
    corners = [corner for collision in link.collisions for corner in _corners(collision)]
    if not corners:
        return (0.0, 0.0, 0.0)
    x, y, z = ([corner[axis] for corner in corners] for axis in range(3))
    return (max(x) - min(x), max(y) - min(y), max(z) - min(z))


def _corners(collision: Collision) -> list[Vector3]:
    (x0, y0, z0), (x1, y1, z1) = _extent(collision.geometry)
    corners = itertools.product((x0, x1), (y0, y1), (z0, z1))
    return [collision.link_from_collision.transform_point(corner) for corner in corners]


def _extent(geometry: Geometry) -> tuple[Vector3, Vector3]:
    """Lower and upper corner of a shape's bounding box, in its own frame [m]."""
    match geometry:
        case Box(size):
            half = (size[0] / 2, size[1] / 2, size[2] / 2)
        case Cylinder(radius, length) | Cone(radius, length):
            half = (radius, radius, length / 2)
        case Capsule(radius, length):
            half = (radius, radius, length / 2 + radius)
        case Sphere(radius):
            half = (radius, radius, radius)
        case Ellipsoid(radii):
            half = radii
        case MeshFile(path=path) if path is not None:
            return _mesh_extent(geometry)
        case _:
            half = (0.0, 0.0, 0.0)
    return (-half[0], -half[1], -half[2]), half


def _mesh_extent(geometry: MeshFile) -> tuple[Vector3, Vector3]:
    assert geometry.path is not None
    try:
        mesh = load_mesh(geometry.path, submesh=geometry.submesh, center=geometry.center_submesh)
    except MeshError:  # physics has already reported the mesh
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    vertices = mesh.scaled(geometry.scale).vertices
    low, high = vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()
    return (low[0], low[1], low[2]), (high[0], high[1], high[2])
