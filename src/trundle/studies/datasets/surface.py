"""Upper surfaces of models, on which others stand."""

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
_EVEN_M = 0.005
"""Height difference below which a footprint counts as even."""


class Surface:
    """Upper surface of a model that does not move."""

    def __init__(self, scene: Scene, bodies: range, poses: NDArray[np.float64], outlines: Outlines, at: Source) -> None:
        """Find its extent.

        Raises:
            DescriptionError: it has no visual.
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
        """x and y of two opposite corners [m]; None: a plane, which has no end."""
        planes = [float(poses[shape.body][2]) for shape in shapes if isinstance(shape.geometry, Plane)]
        if len(points) and not planes:
            (x0, y0, _), (x1, y1, _) = points.min(axis=0).tolist(), points.max(axis=0).tolist()
            self.extent = (x0, y0), (x1, y1)
        self._above = max([*planes, *points[:, 2].tolist()]) + 1.0

    def height(self, points: NDArray[np.float64]) -> float | None:
        """Return the height below the first of (N, 2) points; None if there is none, or another below others."""
        heights: list[float] = []
        for x, y in points.tolist():
            distances, _ = self._renderer.cast(Pose((x, y, self._above)), _DOWN, max_range_m=math.inf)
            heights.append(self._above - float(distances[0]))
            if not abs(heights[-1] - heights[0]) <= _EVEN_M:
                return None
        return heights[0] if math.isfinite(heights[0]) else None
