"""Bones of actors, which the page moves like links."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trundle.robots.model import AnimationState, World
from trundle.spatial import compose_rows

_Array = NDArray[np.float64]


class ActorBones:
    """Bones of the actors whose skins are animated."""

    def __init__(self, world: World) -> None:
        self._actors = []
        if world.actors:
            from trundle.sim.render import skinned_actors  # lazy: loads the COLLADA reader

            self._actors = list(skinned_actors(world))
        self.names = tuple(f"{name}::{bone}" for _, name, puppet in self._actors for bone in puppet.bones)
        """Names of the bones in the scene."""

    def with_bones(self, poses: _Array, animation_state: Callable[[str], AnimationState]) -> _Array:
        """Return the poses of the links (links, 7) in the world, followed by rows for the bones."""
        if not self._actors:
            return poses
        rows = [poses]
        for body, name, puppet in self._actors:
            bones = puppet.bone_poses(animation_state(name))
            rows.append(compose_rows(np.broadcast_to(poses[body], bones.shape), bones))
        return np.concatenate(rows)
