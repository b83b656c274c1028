"""Ray casting against collisions or visuals."""

from collections.abc import Callable, Sequence
from typing import Protocol

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import Diagnostics
from trundle.robots.model import EVERY_BIT, AnimationState, Plane, World
from trundle.sim.render import NativeRenderer, Scene, scene_from_world, update_skins
from trundle.spatial import Pose, Vector3

_Array = NDArray[np.float64]
_ENDLESS = 2e6
"""Width that stands for an infinite collision plane [m]; only a visual plane has a size."""
_LAYERS = 8
"""Maximum number of links that enclose a ray's origin and that it passes through; a lidar is inside two or three."""
_AWAY = 1e6
"""Position that hides links from rays [m]."""


class RayHits(Struct, frozen=True, eq=False):
    """Hit of each ray."""

    distances: _Array
    """(rays,) Distance [m]; inf without a hit."""
    retros: _Array
    """(rays,) laser_retro of the surface; 0 without a hit."""


class Rays(Protocol):
    """Ray cast against collisions or visuals."""

    def __call__(self, origin: Vector3, directions: _Array, reach: float, exclude: int, /) -> RayHits:
        """Cast from one origin along (rays, 3) directions in the world, up to `reach` [m], ignoring one link."""
        ...


class RayCaster:
    """Ray caster against all collision shapes of a world, or all its visuals."""

    def __init__(self, world: World, *, collisions: bool, mask: int = EVERY_BIT) -> None:
        """Build the scene; unsupported shapes were reported when the world was compiled or rendered."""
        self.world = world
        scene = scene_from_world(world, Diagnostics(), collisions=collisions, mask=mask)
        scene = _with_infinite_planes(scene) if collisions else scene
        self._scene, self._renderer = scene, NativeRenderer(scene)
        self._retros = np.array([*(shape.laser_retro for shape in scene.shapes), 0.0])
        self._poses: _Array = np.zeros((0, 7))
        self._bodies = np.array([*(shape.body for shape in scene.shapes), -1], dtype=np.intp)

    def update(self, poses: _Array, animation_state: Callable[[str], AnimationState]) -> None:
        """Move links to poses, (links, 7) x y z qw qx qy qz in the world, and deform the skins of actors."""
        if poses is not self._poses:  # repeated requests at one instant return the same array
            self._poses = poses
            self._renderer.update(poses)
        update_skins(self._renderer, self._scene, animation_state)

    def cast(self, origin: Vector3, directions: _Array, reach: float, exclude: int | None) -> RayHits:
        """See `Rays`."""
        distances, shapes = self._cast(origin, directions, reach, exclude)
        return RayHits(distances, self._retros[shapes])

    def _cast(
        self, origin: Vector3, directions: _Array, reach: float, exclude: int | None = None
    ) -> tuple[_Array, NDArray[np.int32]]:
        """Return (rays,) distances [m] and shapes hit, −1 for none."""
        return self._renderer.cast(Pose(origin), directions, max_range_m=reach, exclude=exclude)

    def cast_through(self, origin: Vector3, directions: _Array, reach: float, hidden: Sequence[int]) -> RayHits:
        """Cast rays that ignore some links."""
        poses = self._poses.copy()
        poses[hidden, :3] = _AWAY
        self._renderer.update(poses)
        hits = self.cast(origin, directions, reach, None)
        self._renderer.update(self._poses)
        return hits

    def cast_from_distance(self, origin: Vector3, directions: _Array, reach: float, nearest: float) -> RayHits:
        """Cast rays that ignore links nearer than `nearest` [m], as a GPU's near clip plane does."""
        distances, shapes = self._cast(origin, directions, reach)
        poses = self._poses.copy()
        for _ in range(_LAYERS):
            near = np.flatnonzero(distances < nearest)
            if not len(near):
                break
            poses[self._bodies[shapes[near]], :3] = _AWAY
            self._renderer.update(poses)
            distances[near], shapes[near] = self._cast(origin, directions[near], reach)
        self._renderer.update(self._poses)
        return RayHits(distances, self._retros[shapes])


def _with_infinite_planes(scene: Scene) -> Scene:
    """Return the scene with planes of `_ENDLESS` width."""
    shapes = tuple(
        replace(shape, geometry=replace(shape.geometry, size=(_ENDLESS, _ENDLESS)))
        if isinstance(shape.geometry, Plane)
        else shape
        for shape in scene.shapes
    )
    return replace(scene, shapes=shapes)
