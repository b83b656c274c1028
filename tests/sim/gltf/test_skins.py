"""Actors as glTF skins: vertices deformed by the bones' nodes and weights."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from tests.sim.gltf.glb import Glb
from tests.skinned import bending_column

import trundle
from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import AnimationState
from trundle.sim.gltf import Document, add_scene
from trundle.sim.render import Scene, scene_from_world
from trundle.spatial import compose_rows, pose_from_row

_WORLD = """<sdf version="1.6"><world name="w"><actor name="bender"><pose>1 2 0 0 0 0.5</pose>
<skin><filename>column.dae</filename><scale>{}</scale></skin>
<animation name="bend"><filename>column.dae</filename></animation></actor></world></sdf>"""


def scene_in(folder: Path, *, scale: float = 1.0) -> tuple[Scene, NDArray[np.float64]]:
    """Scene of a bending actor, and the poses of its bodies."""
    (folder / "column.dae").write_text(bending_column(weights=(0.75, 0.25)))
    (folder / "w.sdf").write_text(_WORLD.format(scale))
    sim = trundle.load(str(folder / "w.sdf"))
    return scene_from_world(sim.world, Diagnostics()), sim.snapshot().poses


def deformed(glb: Glb, poses: dict[int, Any]) -> NDArray[np.float64]:
    """Vertices in the world by the formula of glTF 2.0, 3.7.3.3, with bodies at given poses."""
    nodes = glb.tree["nodes"]
    (skin,) = glb.tree["skins"]
    inverse = glb.array(skin["inverseBindMatrices"]).reshape(-1, 4, 4).transpose(0, 2, 1)
    weights, joints = (glb.attribute("bender_skin", name) for name in ("WEIGHTS_0", "JOINTS_0"))
    points = glb.attribute("bender_skin", "POSITION")
    total = np.zeros((len(points), 3))
    for number, (node, matrix) in enumerate(zip(skin["joints"], inverse, strict=True)):
        pose = pose_from_row(poses[nodes[node]["extras"]["body"]])
        bound = points @ matrix[:3, :3].T + matrix[:3, 3]
        moved = np.array([pose.transform_point((x, y, z)) for x, y, z in bound.tolist()])
        total += np.where(joints == number, weights, 0.0).sum(axis=1)[:, None] * moved
    return total


@pytest.mark.parametrize("scale", [1.0, 0.5])
@pytest.mark.parametrize("time_s", [0.0, 0.6])
def test_bones_deform_vertices_as_the_renderer(tmp_path: Path, scale: float, time_s: float) -> None:
    scene, poses = scene_in(tmp_path, scale=scale)
    document = Document(embed=True)
    bodies = range(7, 7 + len(scene.bodies) + len(scene.bones))
    glb = Glb(document.glb(add_scene(document, scene, poses, bodies)))
    (skin,) = scene.skins
    state = AnimationState(animation="bend", time_s=time_s)

    bones = skin.animated.bone_poses(state)
    in_world = compose_rows(np.broadcast_to(poses[skin.body], bones.shape), bones)
    points = deformed(glb, dict(zip(bodies[len(scene.bodies) :], in_world, strict=True)))

    world_from_body = pose_from_row(poses[skin.body])
    vertices = skin.animated.vertices(state)[skin.rows[0]]
    expected = {tuple(np.round(world_from_body.transform_point((x, y, z)), 5)) for x, y, z in vertices.tolist()}
    assert {tuple(np.round(point, 5)) for point in points} == expected


def test_bones_are_nodes_of_the_world_with_their_own_bodies(tmp_path: Path) -> None:
    scene, poses = scene_in(tmp_path)
    document = Document(embed=True)
    glb = Glb(document.glb(add_scene(document, scene, poses, range(3))))

    root = glb.tree["nodes"][glb.tree["scenes"][0]["nodes"][0]]
    names = {glb.tree["nodes"][child]["name"]: glb.tree["nodes"][child] for child in root["children"]}
    assert scene.bones == ("bender::bone 0", "bender::bone 1")
    assert [names[bone]["extras"]["body"] for bone in scene.bones] == [1, 2]
    assert glb.attribute("bender_skin", "WEIGHTS_0").sum(axis=1) == pytest.approx(1.0)
