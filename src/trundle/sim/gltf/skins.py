"""Skins of actors: nodes of their bones, and the meshes deformed by them."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from trundle.robots.meshes import Mesh
from trundle.robots.model import AnimationState
from trundle.sim.render import SceneSkin
from trundle.spatial import Pose, pose_from_row

from .document import Document
from .packing import PackedTriangles, pack
from .transform import transform_fields
from .triangles import Binding, triangles_from_mesh

_INFLUENCES = 4
"""Bones per vertex that every reader of glTF supports."""


def add_bones(
    document: Document, skin: SceneSkin, world_from_body: Pose, bodies: Sequence[int]
) -> tuple[list[int], int]:
    """Add the bones of a skin, each a body in the world.

    Args:
        document: document to extend.
        skin: actor's skin.
        world_from_body: pose of the actor.
        bodies: `extras.body` of each bone.

    Returns:
        The bones' nodes, and the index of the skin.
    """
    puppet = skin.animated
    nodes: list[int] = []
    for name, row, body in zip(puppet.bones, puppet.bone_poses(AnimationState()), bodies, strict=True):
        node: dict[str, object] = {"name": f"{skin.actor}::{name}", "extras": {"body": body}}
        nodes.append(document.add("nodes", node | transform_fields(world_from_body @ pose_from_row(row))))
    matrices = document.matrices(puppet.bone_from_skin)
    return nodes, document.add("skins", {"joints": nodes, "inverseBindMatrices": matrices})


def packed_skin(skin: SceneSkin, number: int, shape: Mesh) -> PackedTriangles:
    """Return the bytes of one of a skin's shapes, in the bind pose.

    Args:
        skin: actor's skin.
        number: index of the shape in the skin.
        shape: shape's mesh in any pose.
    """
    rows, bound = skin.rows[number], skin.animated.skin
    binding = _strongest(bound.influences[rows], bound.weights[rows])
    mesh = shape.with_vertices(bound.bound[rows, :3].astype(np.float32))
    return pack(triangles_from_mesh(mesh, binding))


def _strongest(influences: NDArray[np.intp], weights: NDArray[np.float64]) -> Binding:
    """Return the four bones of largest weight of each vertex."""
    order = np.argsort(-weights, axis=1, kind="stable")[:, :_INFLUENCES]
    chosen = np.take_along_axis(weights, order, axis=1)
    bones = np.where(chosen > 0.0, np.take_along_axis(influences, order, axis=1), 0)
    missing = ((0, 0), (0, _INFLUENCES - order.shape[1]))
    total = np.maximum(chosen.sum(axis=1, keepdims=True), np.finfo(float).tiny)
    return Binding(
        bones=np.pad(bones, missing).astype(np.uint16), weights=np.pad(chosen / total, missing).astype(np.float32)
    )
