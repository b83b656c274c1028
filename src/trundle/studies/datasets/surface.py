"""Upper surfaces of models, on which other models are placed."""

import math

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.diagnostics import DescriptionError, Source
from trundle.robots.model import Plane
from trundle.sim.render import NativeRenderer, Scene
from trundle.spatial import Pose

from .outlines import Outlines

_DOWN = np.array([[0.0, 0.0, -1.0]])
_MAX_UNEVENNESS_M = 0.005
"""Maximum height difference within a footprint."""


class Surface:
    """Upper surface of an immobile model."""

    def __init__(self, scene: Scene, bodies: range, poses: NDArray[np.float64], outlines: Outlines, at: Source) -> None:
        """Find the surface's extent.

        Raises:
            DescriptionError: the model has no visual.
        """
        shapes = tuple(shape for shape in scene.shapes if shape.body in bodies)
        if not shapes:
            raise DescriptionError(
                at, f"model {scene.bodies[bodies.start].partition('::')[0]!r} has no visual to stand on"
            )
        self._renderer = NativeRenderer(replace(scene, shapes=shapes, skins=()))
        self._renderer.update(poses)
        points = outlines.in_world(bodies, poses)
        self.extent: tuple[tuple[float, float], tuple[float, float]] | None = None
        """x and y of two opposite corners [m]; None: an infinite plane."""
        planes = [float(poses[shape.body][2]) for shape in shapes if isinstance(shape.geometry, Plane)]
        if len(points) and not planes:
            (x0, y0, _), (x1, y1, _) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
            self.extent = (x0, y0), (x1, y1)
        self._above = max([*planes, *points[:, 2].tolist()]) + 1.0

    def height(self, points: NDArray[np.float64]) -> float | None:
        """Return the height at (N, 2) points; None if there is no surface, or an uneven one."""
        heights: list[float] = []
        for x, y in points.tolist():
            distances, _ = self._renderer.cast(Pose((x, y, self._above)), _DOWN, max_range_m=math.inf)
            heights.append(self._above - float(distances[0]))
            if not abs(heights[-1] - heights[0]) <= _MAX_UNEVENNESS_M:
                return None
        return heights[0] if math.isfinite(heights[0]) else None
