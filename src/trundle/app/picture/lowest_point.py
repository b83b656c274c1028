"""Lowest point of a shape."""

import math

from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import ShapeGeometry
from trundle.spatial import Pose


def lowest_point(geometry: ShapeGeometry, world_from_shape: Pose) -> float:
    """Height of a shape's lowest point in the world [m]; infinity for a plane."""
    # World's z in the shape's frame: the share of each of its axes that points up.
    x, y, z = world_from_shape.inverse().transform_vector((0.0, 0.0, 1.0))
    match geometry:
        case Box(size):
            below = sum(side / 2 * abs(up) for side, up in zip(size, (x, y, z), strict=True))
        case Cylinder(radius, length):
            below = length / 2 * abs(z) + radius * math.hypot(x, y)
        case Capsule(radius, length):
            below = length / 2 * abs(z) + radius
        case Sphere(radius):
            below = radius
        case Ellipsoid((a, b, c)):
            below = math.hypot(a * x, b * y, c * z)
        case Plane():
            return math.inf
        case Mesh(vertices):
            below = -float((vertices @ (x, y, z)).min())
    return world_from_shape.position[2] - below
