"""Triangle strips along a line, for roads."""

from collections.abc import Sequence

import numpy as np

from trundle.spatial import Vector3

from .mesh import Mesh

_BEND = 0.97
"""Cosine of the angle between segments above which a corner counts as straight; below its negative, the road turns
back. Such corners are not mitred.
"""


def strip_mesh(points: Sequence[Vector3], width: float) -> Mesh:
    """Return a level strip with mitred corners, like Gazebo's roads.

    Its uv repeat an image of the strip's width: u from 0 on the left to 1 on the right, v up along the road.

    Args:
        points: centre line, at least two points [m].
        width: [m]
    """
    line = np.array(points, dtype=np.float64)
    segments = np.diff(line, axis=0)
    lengths = np.linalg.norm(segments, axis=1)
    directions = segments / np.maximum(lengths, 1e-9)[:, None]
    before, after = np.vstack([directions[:1], directions]), np.vstack([directions, directions[-1:]])
    straight = np.einsum("ij,ij->i", before, after)
    half = np.where(np.abs(straight) < _BEND, 1.0 / np.sqrt(np.maximum((1.0 + straight) / 2, 1e-3)), 1.0) * width / 2
    along = before + after
    across = np.column_stack([-along[:, 1], along[:, 0], np.zeros(len(line))])
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-9)[:, None]
    sides = across * half[:, None]
    vertices = np.stack([line + sides, line - sides], axis=1).reshape(-1, 3)
    distances = np.concatenate([[0.0], np.cumsum(lengths)]) / width
    uv = np.column_stack([np.tile([0.0, 1.0], len(line)), np.repeat(distances, 2)])
    quad = np.array([[0, 1, 3], [0, 3, 2]])  # left and right vertex, here and at the next point
    faces = (2 * np.arange(len(segments))[:, None, None] + quad).reshape(-1, 3)
    return Mesh(vertices.astype(np.float32), faces.astype(np.int32), uv=uv[faces].astype(np.float32))
