"""How far shapes reach."""

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.spatial import Vector3

from .scene import ShapeGeometry


def corners_of(geometry: ShapeGeometry) -> list[Vector3]:
    """The eight corners of the box around a shape, in its own frame [m]; none of an endless plane."""
    match geometry:
        case Box((x, y, z)):
            half = (x / 2, y / 2, z / 2)
        case Cylinder(radius, length):
            half = (radius, radius, length / 2)
        case Capsule(radius, length):
            half = (radius, radius, length / 2 + radius)
        case Sphere(radius):
            half = (radius, radius, radius)
        case Ellipsoid(radii):
            half = radii
        case Plane():
            return []
        case Mesh(vertices):
            low, high = vertices.min(axis=0).tolist(), vertices.max(axis=0).tolist()
            return [(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    return [(sx * half[0], sy * half[1], sz * half[2]) for sx in (-1, 1) for sy in (-1, 1) for sz in (-1, 1)]
