"""Rays, and what they find."""

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.diagnostics import Diagnostics
from trundle.model import EVERY_BIT, AnimationState, Plane, World
from trundle.render import NativeRenderer, Scene, scene_from_world, update_skins
from trundle.spatial import Pose, Vector3

_Array = NDArray[np.float64]
_ENDLESS = 2e6
"""[m] Width of a plane that is touched; only where it is seen has it a size."""
_LAYERS = 8
"""So many links within one another are looked through; a lidar sits inside two or three."""
_AWAY = 1e6
"""[m] Where links are put that are not to be met."""


class RayHits(Struct, frozen=True, eq=False):
    """What each ray met."""

    distances: _Array
    """(rays,) [m]; inf where there is nothing."""
    retros: _Array
    """(rays,) The laser_retro of what is there; 0 where there is nothing."""
    links: NDArray[np.intp]
    """(rays,) The link that it is on; −1 where there is nothing."""


class Rays(Protocol):
    """Casts rays against one kind of shapes."""

    def __call__(self, origin: Vector3, directions: _Array, reach: float, exclude: int, /) -> RayHits:
        """From one place in (rays, 3) directions in the world, [m] far, looking through one link."""
        ...


class RayCaster:
    """Casts rays against all collision shapes of a world, or all its visuals."""

    def __init__(self, world: World, *, collisions: bool, mask: int = EVERY_BIT) -> None:
        """Make a scene of them; what it leaves out has been said by who drew or compiled it."""
        self.world = world
        scene = scene_from_world(world, Diagnostics(), collisions=collisions, mask=mask)
        scene = _with_infinite_planes(scene) if collisions else scene
        self._scene, self._renderer = scene, NativeRenderer(scene)
        self._retros = np.array([*(shape.laser_retro for shape in scene.shapes), 0.0])
        self._poses: _Array = np.zeros((0, 7))
        self._bodies = np.array([*(shape.body for shape in scene.shapes), -1], dtype=np.intp)

    def update(self, poses: _Array, animation_state: Callable[[str], AnimationState]) -> None:
        """Move the links, (links, 7) x y z qw qx qy qz in the world, and the skins of actors."""
        if poses is not self._poses:  # those that were asked for again at one instant are the same array
            self._poses = poses
            self._renderer.update(poses)
        update_skins(self._renderer, self._scene, animation_state)

    def cast(self, origin: Vector3, directions: _Array, reach: float, exclude: int | None) -> RayHits:
        """See `Rays`."""
        distances, shapes = self._renderer.cast(Pose(origin), directions, reach_m=reach, exclude=exclude)
        return RayHits(distances, self._retros[shapes], self._bodies[shapes])

    def cast_through(self, origin: Vector3, directions: _Array, reach: float, hidden: Sequence[int]) -> RayHits:
        """Cast rays that look through some links wherever they are."""
        poses = self._poses.copy()
        poses[hidden, :3] = _AWAY
        self._renderer.update(poses)
        found = self.cast(origin, directions, reach, None)
        self._renderer.update(self._poses)
        return found

    def cast_from_distance(self, origin: Vector3, directions: _Array, reach: float, nearest: float) -> RayHits:
        """Cast rays that look through a link where it is nearer than this [m], as a GPU's begin at its near clip."""
        found = self.cast(origin, directions, reach, None)
        poses = self._poses.copy()
        for _ in range(_LAYERS):
            near = np.flatnonzero(found.distances < nearest)
            if not len(near):
                break
            poses[found.links[near], :3] = _AWAY
            self._renderer.update(poses)
            behind = self.cast(origin, directions[near], reach, None)
            found.distances[near], found.retros[near] = behind.distances, behind.retros
            found.links[near] = behind.links
        self._renderer.update(self._poses)
        return found


def _with_infinite_planes(scene: Scene) -> Scene:
    """The scene with planes that have no rim."""
    shapes = tuple(
        replace(shape, geometry=replace(shape.geometry, size=(_ENDLESS, _ENDLESS)))
        if isinstance(shape.geometry, Plane)
        else shape
        for shape in scene.shapes
    )
    return replace(scene, shapes=shapes)
