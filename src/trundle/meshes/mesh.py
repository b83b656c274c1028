"""Triangles with a colour."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, slots=True, eq=False)
class Mesh:
    """A triangle mesh in its own frame, in metres, z up."""

    vertices: NDArray[np.float32]
    """(N, 3) [m]"""
    faces: NDArray[np.int32]
    """(M, 3) indices into the vertices, counter-clockwise from outside."""
    rgba: tuple[float, float, float, float] | None = None
    """The file's own colour; None where it has none."""

    def scaled(self, scale: tuple[float, float, float]) -> "Mesh":
        """The mesh stretched along its axes; a mirrored one keeps its outside outside."""
        if scale == (1.0, 1.0, 1.0):
            return self
        mirrored = scale[0] * scale[1] * scale[2] < 0
        faces = self.faces[:, ::-1].copy() if mirrored else self.faces
        return Mesh(self.vertices * np.asarray(scale, dtype=np.float32), faces, self.rgba)
