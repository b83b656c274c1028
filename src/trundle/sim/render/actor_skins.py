"""Actors' skins: shapes and animated vertices."""

from collections.abc import Callable, Iterator

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.robots.meshes import MeshError, Motion, Skin, load_motion, load_skin, match_bones, root_of
from trundle.robots.model import Actor, Animation, AnimationState, World
from trundle.spatial import quaternions_from_matrices

from .renderer import Renderer
from .scene import Scene, SceneSkin, Shape

_Array = NDArray[np.float64]
_SMALL = 1e-12


def unsupported_reason(actor: Actor) -> str | None:
    """Return the reason why an actor's skin cannot be animated; None if it can."""
    if actor.skin is None or actor.skin.path is None:
        return "its skin file was not found"
    try:
        skin = load_skin(actor.skin.path)
        for animation in actor.animations:
            if animation.path is not None and match_bones(skin.bones, load_motion(animation.path).bones) is None:
                return f"animation {animation.name!r} is for another skeleton"
    except MeshError as error:
        return str(error)
    return None


def skinned_shapes(actor: Actor, body: int, first: int) -> tuple[list[Shape], SceneSkin] | None:
    """Return the shapes of an actor's skin and their animation; None if it cannot be animated.

    Args:
        actor: actor with a skin.
        body: index of its body.
        first: index of the first shape in the scene.
    """
    if actor.skin is None or actor.skin.path is None or unsupported_reason(actor) is not None:
        return None
    puppet = SkinnedActor(actor, load_skin(actor.skin.path))
    mesh = puppet.skin.mesh
    numbers = np.repeat(np.arange(len(mesh.vertices), dtype=np.float32)[:, None], 3, axis=1)
    numbered = replace(mesh, vertices=numbers)
    start = mesh.with_vertices(puppet.vertices(AnimationState()))
    shapes: list[Shape] = []
    rows: list[NDArray[np.intp]] = []
    for piece, numbered_piece in zip(start.split_by_material(), numbered.split_by_material(), strict=True):
        texture = piece.parts[0].texture if piece.parts and piece.uv is not None else None
        rgba = piece.parts[0].tint if texture is not None else piece.rgba
        shape = Shape(name=f"{actor.name}_skin", body=body, geometry=piece, texture=texture)
        shapes.append(shape if rgba is None else replace(shape, rgba=rgba))
        rows.append(numbered_piece.vertices[:, 0].astype(np.intp))
    return shapes, SceneSkin(actor=actor.name, body=body, first=first, rows=tuple(rows), animated=puppet)


def skinned_actors(world: World) -> Iterator[tuple[int, str, "SkinnedActor"]]:
    """Yield the index of the body, the name and the skin of each actor whose skin is animated."""
    actors = {f"{actor.name}::{actor.name}_pose": actor for actor in world.actors}
    bodies = (f"{model.name}::{link.name}" for model in world.models for link in model.links)
    for body, name in enumerate(bodies):
        actor = actors.get(name)
        if actor is not None and actor.skin is not None and actor.skin.path and unsupported_reason(actor) is None:
            yield body, actor.name, SkinnedActor(actor, load_skin(actor.skin.path))


def update_skins(renderer: Renderer, scene: Scene, animation_state: Callable[[str], AnimationState]) -> None:
    """Update the vertices of a scene's skins to their actors' animation states."""
    for skin in scene.skins:
        vertices = skin.animated.vertices(animation_state(skin.actor))
        for number, rows in enumerate(skin.rows):
            renderer.set_vertices(skin.first + number, vertices[rows])


class SkinnedActor:
    """Skin with its animations."""

    def __init__(self, actor: Actor, skin: Skin) -> None:
        assert actor.skin is not None
        self.skin = skin
        self._scale = actor.skin.scale
        self._root = root_of(skin.bones)
        self._animations: dict[str, tuple[Animation, Motion, dict[int, int]]] = {}
        for animation in actor.animations:
            if animation.path is None:
                continue
            motion = load_motion(animation.path)
            bones = match_bones(skin.bones, motion.bones)
            if bones is not None:
                self._animations[animation.name] = (animation, motion, bones)
        axes = skin.joint_poses(self._bone_poses(AnimationState()))[:, :3, :3]
        lengths = np.maximum(np.linalg.norm(axes, axis=1), _SMALL)
        self._stretches: _Array = lengths * np.sign(np.linalg.det(axes))[:, None]
        """(B, 3) scales along the bones' axes at the start of the first animation; negative for mirrored bones."""
        self.bone_from_skin: _Array = skin.bone_from_skin.copy()
        """(B, 4, 4) bind matrices, with those scales and the skin's, which `bone_poses` do not contain."""
        self.bone_from_skin[:, :3] *= self._scale * self._stretches[:, :, None]

    @property
    def bones(self) -> tuple[str, ...]:
        """Names of the bones of `bone_poses`."""
        return tuple(f"bone {number}" for number in range(len(self.skin.joint_indices)))

    def bone_poses(self, state: AnimationState) -> _Array:
        """Return (B, 7) x y z [m], qw qx qy qz of the bones in the actor's frame."""
        poses = self.skin.joint_poses(self._bone_poses(state))
        turns = quaternions_from_matrices(poses[:, :3, :3] / self._stretches[:, None])
        return np.hstack([self._scale * poses[:, :3, 3], turns])

    def vertices(self, state: AnimationState) -> NDArray[np.float32]:
        """Return (N, 3) vertices in the actor's frame [m]."""
        return self.skin.vertices(self._bone_poses(state)) * np.float32(self._scale)

    def _bone_poses(self, state: AnimationState) -> dict[int, _Array]:
        """Return parent_from_bone (4, 4) of the animated bones.

        As in Gazebo, a moving actor's root bone stays over its path, and with <interpolate_x> the animation advances
        with the distance covered.
        """
        chosen = self._animations.get(state.animation) or next(iter(self._animations.values()), None)
        if chosen is None:
            return {}
        animation, motion, bones = chosen
        scale = animation.scale / (self._scale or 1.0)
        time_s = state.time_s
        if animation.interpolate_x and state.distance_m and motion.length_s > 0.0:
            time_s = motion.time_at(state.distance_m, animation.scale)
        poses = {bones[number]: pose for number, pose in motion.poses(time_s, scale).items() if number in bones}
        if self._root in poses:
            if not state.placed:
                poses[self._root] = np.eye(4)
            elif state.distance_m is not None:
                poses[self._root][0, 3] = 0.0
        return poses
