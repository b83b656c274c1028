"""Actors' skins: shapes and animated vertices."""

from collections.abc import Callable

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.meshes import MeshError, Motion, Skin, load_motion, load_skin, match_bones, root_of
from trundle.model import Actor, Animation, AnimationState

from .renderer import Renderer
from .scene import Scene, SceneSkin, Shape


def unsupported_reason(actor: Actor) -> str | None:
    """Return the reason why an actor's skin cannot be animated; None if it can."""
    if actor.skin is None or actor.skin.path is None:
        return "its skin file was not found"
    try:
        skin = load_skin(actor.skin.path)
        for animation in actor.animations:
            if animation.path is not None and match_bones(skin.bones, load_motion(animation.path).bones) is None:
                return f"animation {animation.name!r} is of another skeleton"
    except MeshError as error:
        return str(error)
    return None


def skinned_shapes(actor: Actor, body: int, first: int) -> tuple[list[Shape], SceneSkin] | None:
    """Return the shapes of an actor's skin and their animation; None if it cannot be animated.

    Args:
        actor: with a skin.
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
    for piece, same in zip(start.split_by_material(), numbered.split_by_material(), strict=True):
        texture = piece.parts[0].texture if piece.parts and piece.uv is not None else None
        rgba = piece.parts[0].tint if texture is not None else piece.rgba
        shape = Shape(name=f"{actor.name}_skin", body=body, geometry=piece, texture=texture)
        shapes.append(shape if rgba is None else replace(shape, rgba=rgba))
        rows.append(same.vertices[:, 0].astype(np.intp))
    return shapes, SceneSkin(actor=actor.name, first=first, rows=tuple(rows), vertices=puppet.vertices)


def update_skins(renderer: Renderer, scene: Scene, animation_state: Callable[[str], AnimationState]) -> None:
    """Update the vertices of a scene's skins to their actors' animation states."""
    for skin in scene.skins:
        vertices = skin.vertices(animation_state(skin.actor))
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

    def vertices(self, state: AnimationState) -> NDArray[np.float32]:
        """Return (N, 3) vertices in the actor's frame [m].

        As in Gazebo, a moving actor's root bone stays over its path, and with <interpolate_x> the animation advances
        with the distance covered.
        """
        chosen = self._animations.get(state.animation) or next(iter(self._animations.values()), None)
        if chosen is None:
            return self.skin.vertices({}) * np.float32(self._scale)
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
        return self.skin.vertices(poses) * np.float32(self._scale)
