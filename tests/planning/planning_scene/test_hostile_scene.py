"""Scenes with more than is reasonable are refused, or checked all the same."""

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from tests.planning.scenes import ready, scene_with, seven_axis, thing

from trundle.base.diagnostics import UsageError
from trundle.planning.planning_scene import MAX_TRIANGLES, MAX_VOXELS, PlanningScene, Voxels
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cylinder, Sphere


def test_a_million_triangles_are_refused_at_once() -> None:
    faces = np.zeros((1_000_000, 3), np.int32)
    mesh = Mesh(np.zeros((3, 3), np.float32), faces)

    with pytest.raises(UsageError, match=f"'x': a mesh of 1000000 triangles; at most {MAX_TRIANGLES}"):
        scene_with(thing("x", mesh))


def test_flat_and_degenerate_meshes_are_checked() -> None:
    point = Mesh(np.zeros((3, 3), np.float32), np.array([[0, 1, 2]], np.int32))
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    sheet = Mesh(square, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    scene = scene_with(thing("point", point, 2.0), thing("sheet", sheet, z=-0.2))
    assert scene.is_free()

    scene.move("sheet", scene.frame_pose("link_4"))
    assert not scene.is_free()


@pytest.mark.parametrize(
    ("centers", "sizes"),
    [
        (np.zeros((MAX_VOXELS + 1, 3)), np.ones(MAX_VOXELS + 1)),
        (np.full((1, 3), np.nan), np.ones(1)),
        (np.zeros((2, 3)), np.ones(1)),
        (np.zeros((1, 3)), np.zeros(1)),
    ],
)
def test_voxels_that_cannot_be_are_refused(centers: np.ndarray, sizes: np.ndarray) -> None:
    with pytest.raises(UsageError, match=r"voxels"):
        scene_with().set_voxels(Voxels(centers, sizes))


def _random_scene(rng: np.random.Generator) -> PlanningScene:
    shapes = [Box(tuple(rng.uniform(0.02, 0.4, 3).tolist())), Sphere(0.1), Cylinder(0.05, 0.5)]
    return scene_with(*(thing(f"{i}", shape, *rng.uniform(-0.8, 0.8, 3).tolist()) for i, shape in enumerate(shapes)))


@settings(max_examples=15, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_contacts_distances_and_verdicts_agree(seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene, model = _random_scene(rng), seven_axis()
    for state in rng.uniform(model.lower, model.upper, (20, len(model.variables))):
        contacts, nearest, is_free = scene.check(state), scene.distance(state).distance, scene.is_free(state)
        if abs(nearest) > 1e-4:  # a touch is either
            assert is_free == (nearest > 0)
            assert is_free == (not contacts)
        if contacts:
            assert max(contact.depth for contact in contacts) <= -nearest + 1e-3


@settings(max_examples=10, deadline=None)
@given(st.integers(0, 2**32 - 1))
def test_a_padding_of_the_distance_is_the_limit(seed: int) -> None:
    rng = np.random.default_rng(seed)
    scene = scene_with(thing("ball", Sphere(0.05), *rng.uniform((0.3, -0.8, 0.3), (1.2, 0.8, 1.2)).tolist()))
    matrix = scene.allowed_collisions
    matrix.set_entries("base_link", scene.model.links, True)
    scene.allowed_collisions = matrix
    nearest = scene.distance(ready())
    if not 1e-3 < nearest.distance < 1.0 or "ball" not in (nearest.body_1, nearest.body_2):
        return
    for factor, is_free in ((0.99, True), (1.01, False)):
        for link in scene.model.links:
            scene.set_padding(link, 0.0)
        scene.set_padding(nearest.body_1, factor * nearest.distance)
        assert scene.is_free(ready()) == is_free
