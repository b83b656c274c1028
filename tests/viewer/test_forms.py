"""Triangle meshes have the volume and position of the shapes that they replace."""

import math

import numpy as np
import pytest

from trundle.meshes import Mesh
from trundle.model import Box, Capsule, Cylinder, Ellipsoid, Plane, Sphere
from trundle.render import Shape, ShapeGeometry
from trundle.viewer.forms import form_of, instance_of


@pytest.mark.parametrize(
    ("geometry", "volume", "reach"),
    [
        (Box((0.2, 0.3, 0.4)), 0.024, (0.1, 0.15, 0.2)),
        (Cylinder(0.5, 2.0), math.pi * 0.25 * 2, (0.5, 0.5, 1.0)),
        (Sphere(0.5), math.pi / 6, (0.5, 0.5, 0.5)),
        (Ellipsoid((0.5, 1.0, 2.0)), 4 / 3 * math.pi, (0.5, 1.0, 2.0)),
        (Capsule(0.5, 1.0), math.pi * (0.25 + 1 / 6), (0.5, 0.5, 1.0)),
    ],
)
def test_a_solid_encloses_its_volume_with_faces_outwards(
    geometry: ShapeGeometry, volume: float, reach: tuple[float, float, float]
) -> None:
    """The signed volume is the sum of a · (b × c) / 6 over the faces; 48 segments lose less than 1 % of it."""
    shape = Shape(name="solid", body=0, geometry=geometry)
    form, instance = form_of(shape), instance_of(shape)
    corners = (form.vertices * np.array(instance.scale))[form.faces]

    signed = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum() / 6

    assert signed == pytest.approx(volume, rel=0.01)
    assert corners.reshape(-1, 3).max(axis=0) == pytest.approx(reach, rel=1e-6)


def test_a_plane_lies_across_its_normal() -> None:
    shape = Shape(name="wall", body=0, geometry=Plane((1.0, 0.0, 0.0), (2.0, 3.0)))
    instance = instance_of(shape)

    assert instance.shape_from_form.transform_vector((0.0, 0.0, 1.0)) == pytest.approx((1.0, 0.0, 0.0))


def test_a_zero_thickness_box_is_still_drawn() -> None:
    assert min(instance_of(Shape(name="sheet", body=0, geometry=Box((1.0, 0.0, 1.0)))).scale) > 0.0


def test_shapes_of_one_mesh_share_a_form_and_others_do_not() -> None:
    triangle = np.eye(3, dtype=np.float32), np.array([[0, 1, 2]], dtype=np.int32)
    one, other = Mesh(*triangle), Mesh(*triangle)
    keys = [instance_of(Shape(name="m", body=0, geometry=mesh)).key for mesh in (one, one, other)]

    assert keys[0] == keys[1] != keys[2]
