"""Lowest point of a shape."""

import math

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import ShapeGeometry
from trundle.spatial import Pose


def lowest_point(geometry: ShapeGeometry, world_from_shape: Pose) -> float:
    """Return the height of a shape's lowest point in the world [m]; infinity for a plane."""
    # The world's z axis in the shape's frame.
    x, y, z = world_from_shape.inverse().transform_vector((0.0, 0.0, 1.0))
    match geometry:
        case Box(size):
            depth = sum(side / 2 * abs(up) for side, up in zip(size, (x, y, z), strict=True))
        case Cylinder(radius, length):
            depth = length / 2 * abs(z) + radius * math.hypot(x, y)
        case Capsule(radius, length):
            depth = length / 2 * abs(z) + radius
        case Sphere(radius):
            depth = radius
        case Ellipsoid((a, b, c)):
            depth = math.hypot(a * x, b * y, c * z)
        case Plane():
            return math.inf
        case Mesh(vertices):
            depth = -float((vertices @ (x, y, z)).min())
    return world_from_shape.position[2] - depth
