"""Lines in the scene: what plugins draw, and what sensors see."""

import numpy as np
import viser
from numpy.typing import NDArray

from .content import DrawnLine

_WIDTH_PX = 2.0


class Lines:
    """Line strips by their place in the state; each is sent anew only when it changed."""

    def __init__(self, server: viser.ViserServer, folder: str) -> None:
        self._server = server
        self._folder = folder
        self._handles: dict[int, viser.LineSegmentsHandle] = {}
        self._drawn: dict[int, bytes] = {}
        self._colours: dict[int, tuple[int, int, int]] = {}

    def update(self, lines: tuple[DrawnLine, ...]) -> None:
        """Draw these, and no others."""
        for i, line in enumerate(lines):
            seen = line.points.tobytes()
            if self._drawn.get(i) == seen:
                continue
            same = i in self._handles and len(self._drawn[i]) == len(seen) and self._colours[i] == line.rgb
            self._drawn[i], self._colours[i] = seen, line.rgb
            if same:
                self._handles[i].points = segments_along(line.points)
                continue
            self._remove(i)
            if len(line.points) >= 2:
                self._handles[i] = self._server.scene.add_line_segments(
                    f"{self._folder}/{i}",
                    points=segments_along(line.points),
                    colors=line.rgb,
                    thickness=_WIDTH_PX,
                    thickness_units="screen",
                )
        for i in [i for i in self._drawn if i >= len(lines)]:
            del self._drawn[i]
            self._remove(i)

    def _remove(self, i: int) -> None:
        handle = self._handles.pop(i, None)
        if handle is not None:
            handle.remove()


def segments_along(points: NDArray[np.float32]) -> NDArray[np.float32]:
    """Each two neighbours of a strip (N, 3) as a segment, (N − 1, 2, 3)."""
    return np.stack([points[:-1], points[1:]], axis=1)
