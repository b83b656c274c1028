"""Nodes of a scene: links, their visuals and lights below one root that turns z up into y up."""

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import Plane
from trundle.sim.render import Scene, SceneLight, Shape
from trundle.spatial import Pose, pose_from_row

from .animation import add_animation
from .document import Document
from .lights import light_rotation, punctual_light
from .materials import material_from_shape
from .packing import PackedTriangles, packed_mesh
from .skins import add_bones, packed_skin
from .solids import scaled_solid
from .transform import UNSCALED, transform_fields

_Y_FROM_Z_UP = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
"""x y z w of a turn by −90° about x."""


def glb_from_scene(scene: Scene, poses: NDArray[np.float64]) -> bytes:
    """Return a scene as one self-contained GLB.

    Args:
        scene: shapes and lights.
        poses: (bodies, 7) x y z [m], qw qx qy qz of each body in the world.
    """
    document = Document(embed=True)
    return document.glb(add_scene(document, scene, poses, range(len(scene.bodies) + len(scene.bones))))


def animated_glb(scene: Scene, times: NDArray[np.float64], poses: NDArray[np.float64]) -> bytes:
    """Return a scene with moving bodies as one self-contained GLB.

    Args:
        scene: shapes and lights.
        times: (N,) ascending [s]; the animation begins at the first.
        poses: (N, bodies, 7) x y z [m], qw qx qy qz of each body, then of each bone, in the world.
    """
    document = Document(embed=True)
    root = add_scene(document, scene, poses[0], range(len(scene.bodies) + len(scene.bones)))
    add_animation(document, "recording", times, poses)
    return document.glb(root)


def add_scene(document: Document, scene: Scene, poses: NDArray[np.float64], bodies: Sequence[int]) -> int:
    """Add a scene to a document; return its root node.

    Args:
        document: document to extend.
        scene: shapes and lights.
        poses: (bodies, 7) x y z [m], qw qx qy qz of each body in the world.
        bodies: `extras.body` of each body, then of each bone.
    """
    children_of_body: dict[int | None, list[int]] = {}
    skins, children = _add_skins(document, scene, poses, bodies[len(scene.bodies) :])
    for number, shape in enumerate(scene.shapes):
        if number in skins:
            node = _skin_node(document, shape, *skins[number])
        elif not isinstance(shape.geometry, Mesh) or len(shape.geometry.faces):
            node = _visual_node(document, shape)
        else:
            continue
        children_of_body.setdefault(shape.body, []).append(document.add("nodes", node))
    for light in scene.lights:
        children_of_body.setdefault(light.body, []).append(document.add("nodes", _light_node(document, light)))
    children += children_of_body.get(None, [])
    for body, name in enumerate(scene.bodies):
        pose = pose_from_row(poses[body])
        node: dict[str, object] = {"name": name, "extras": {"body": bodies[body]}} | transform_fields(pose)
        if body in children_of_body:
            node["children"] = children_of_body[body]
        children.append(document.add("nodes", node))
    root: dict[str, object] = {"name": "world", "rotation": _Y_FROM_Z_UP}
    if children:
        root["children"] = children
    return document.add("nodes", root)


def _add_skins(
    document: Document, scene: Scene, poses: NDArray[np.float64], bodies: Sequence[int]
) -> tuple[dict[int, tuple[PackedTriangles, int]], list[int]]:
    """Add the skins; return the bytes and the skin of each shape that has one, and the nodes of all bones."""
    shapes: dict[int, tuple[PackedTriangles, int]] = {}
    bones: list[int] = []
    for skin in scene.skins:
        skin_bodies = bodies[len(bones) : len(bones) + len(skin.animated.bones)]
        nodes, index = add_bones(document, skin, pose_from_row(poses[skin.body]), skin_bodies)
        bones += nodes
        for number in range(len(skin.rows)):
            mesh = scene.shapes[skin.first + number].geometry
            assert isinstance(mesh, Mesh)
            shapes[skin.first + number] = packed_skin(skin, number, mesh), index
    return shapes, bones


def _skin_node(document: Document, shape: Shape, triangles: PackedTriangles, skin: int) -> dict[str, object]:
    """Return the node of a mesh that bones deform; its transform is ignored."""
    mesh = document.mesh(triangles, _material(document, shape, has_uv=triangles.has_uv))
    return {"name": shape.name, "mesh": mesh, "skin": skin, "extras": {"visual": shape.name}}


def _visual_node(document: Document, shape: Shape) -> dict[str, object]:
    if isinstance(shape.geometry, Mesh):
        triangles, pose, scale = packed_mesh(shape.geometry), Pose(), UNSCALED
    else:
        triangles, pose, scale = scaled_solid(shape.geometry)
    mesh = document.mesh(triangles, _material(document, shape, has_uv=triangles.has_uv))
    extras: dict[str, object] = {"visual": shape.name}
    if not shape.casts_shadow or isinstance(shape.geometry, Plane):  # planes cast no shadow, as in the native renderer
        extras["casts_shadow"] = False
    node: dict[str, object] = {"name": shape.name, "mesh": mesh, "extras": extras}
    return node | transform_fields(shape.body_from_shape @ pose, scale)


def _material(document: Document, shape: Shape, *, has_uv: bool) -> int:
    texture = None if shape.texture is None or not has_uv else document.texture(shape.texture)
    if texture is not None and shape.texture_scale != (1.0, 1.0):
        document.use("KHR_texture_transform")
    colors = (shape.rgba, shape.ambient, shape.specular, shape.emissive, shape.shininess)
    key = (colors, texture, shape.texture_scale)
    return document.shared("materials", key, lambda: material_from_shape(shape, texture))


def _light_node(document: Document, light: SceneLight) -> dict[str, object]:
    number = document.add_light(punctual_light(light))
    pose = Pose(light.position, light_rotation(light))
    return {
        "name": light.name or "light",
        "extensions": {"KHR_lights_punctual": {"light": number}},
    } | transform_fields(pose)
