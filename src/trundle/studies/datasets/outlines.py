"""Extents of models as points."""

import numpy as np
from numpy.typing import NDArray

from trundle.sim.render import Scene, outline_of
from trundle.spatial import pose_from_row, transform_points

_Array = NDArray[np.float64]
_MAX_POINTS = 2000
"""Maximum number of points of a shape; of more points, only the outermost are kept."""
_DIRECTIONS = 1024
_GOLDEN_ANGLE = 2.399963229728653


class Outlines:
    """Outermost points of each body's shapes, in its frame."""

    def __init__(self, scene: Scene) -> None:
        points: list[list[_Array]] = [[] for _ in scene.bodies]
        for shape in scene.shapes:
            outline = outermost(outline_of(shape.geometry))
            if len(outline):
                points[shape.body].append(transform_points(shape.body_from_shape, outline))
        self._points = [np.concatenate(clouds) if clouds else np.zeros((0, 3)) for clouds in points]

    def in_world(self, bodies: range, poses: _Array) -> _Array:
        """Return the (N, 3) points of bodies in the world [m]; `poses` are (links, 7)."""
        clouds = [transform_points(pose_from_row(poses[body]), self._points[body]) for body in bodies]
        return np.concatenate(clouds) if clouds else np.zeros((0, 3))


def outermost(points: _Array) -> _Array:
    """Return the extreme points along the axes and in many other directions."""
    if len(points) <= _MAX_POINTS:
        return points
    chosen = np.unique(np.argmax(points @ _directions().T, axis=0))
    return points[chosen]


def _directions() -> _Array:
    """Return (N, 3) unit vectors: evenly distributed directions, and the axes."""
    z = 1.0 - (2.0 * np.arange(_DIRECTIONS) + 1.0) / _DIRECTIONS
    turn, flat = _GOLDEN_ANGLE * np.arange(_DIRECTIONS), np.sqrt(1.0 - z * z)
    around = np.stack([flat * np.cos(turn), flat * np.sin(turn), z], axis=-1)
    return np.concatenate([np.eye(3), -np.eye(3), around])
