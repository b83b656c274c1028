"""Lowest points of rotated shapes."""

import math

import numpy as np
import pytest

from trundle.app.picture.lowest_point import lowest_point
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.sim.render import ShapeGeometry
from trundle.spatial import Pose

CUBE = Mesh(
    np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32),
    np.zeros((1, 3), dtype=np.int32),
)


@pytest.mark.parametrize(
    ("geometry", "roll", "depth"),
    [
        (Box((2.0, 2.0, 2.0)), math.pi / 4, math.sqrt(2)),
        (CUBE, math.pi / 4, math.sqrt(2)),
        (Sphere(0.7), 0.3, 0.7),
        (Cylinder(0.5, 2.0), math.pi / 2, 0.5),
        (Cylinder(0.5, 2.0), math.pi / 4, 1.5 * math.sqrt(0.5)),
        (Capsule(0.5, 2.0), math.pi / 4, math.sqrt(0.5) + 0.5),
        (Ellipsoid((1.0, 2.0, 3.0)), math.pi / 2, 2.0),
        (Plane((0.0, 0.0, 1.0), (1.0, 1.0)), 0.0, -math.inf),
    ],
)
def test_lowest_point_of_a_rotated_shape(geometry: ShapeGeometry, roll: float, depth: float) -> None:
    """Rotation about x, then about the vertical, which has no effect."""
    assert lowest_point(geometry, Pose.from_rpy(4.0, 5.0, 6.0, roll, 0.0, 0.8)) == pytest.approx(6.0 - depth)
