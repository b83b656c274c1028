"""Thin-wall decomposition: convex sheets along nearly flat parts of a surface.

For thin hollow meshes such as trays, buckets and tubes, which a voxel grid resolves badly.
"""

from collections.abc import Iterator
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from .hulls import area_of, convex_hull_area, hausdorff_distance, hull_of, volume_of

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_MAX_SHEETS = 64
_BENDS = (0.002, 0.005, 0.01, 0.02, 0.04)
"""Flatness tolerances of a sheet, relative to the mesh size; the first with few enough sheets is used."""
_STEEPEST = 0.7
"""Smallest cosine between a sheet's normal and its faces'."""
_WASTE = 1.02
"""Ratio of a convex polygon's area to its faces' up to which a sheet needs no exact test."""
_PROBES, _SAMPLES = 64, 1000
"""Sample points for testing walls; the result is measured with more."""
_THICK = 0.01
"""Wall thickness of an open surface relative to its size."""
_THINNEST, _THICKEST = 1e-3, 0.01
"""Smallest and largest wall thickness of an open surface [m]."""


def shell_pieces(points: _Points, faces: _Faces, *, closed: bool) -> list[_Points]:
    """Return corners (N, 3) of each sheet [m]; empty if there are too many.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points, none without area.
        closed: True: walls lie inside the surface, half as thick as the body; False: centred on the open surface.
    """
    if not closed:
        # A surface visible from both sides may contain its faces twice.
        faces = faces[np.unique(np.sort(faces, axis=1), axis=0, return_index=True)[1]]
    size = float(np.ptp(points, axis=0).max())
    thickness = min(max(_THICK * size, _THINNEST), _THICKEST)
    if closed:
        triangles = points[faces]
        thickness = abs(volume_of(triangles)) / area_of(triangles)
    surface = _Surface(points, faces, thickness, closed=closed)
    for bend in _BENDS:
        sheets = list(islice(surface.sheets(bend * size), _MAX_SHEETS + 1))
        if len(sheets) <= _MAX_SHEETS:
            return sheets
    return []


class _Surface:
    """Faces with normals, areas and neighbours."""

    def __init__(self, points: _Points, faces: _Faces, thickness: float, *, closed: bool) -> None:
        self._points = points
        self._faces = faces
        self._thickness = thickness
        self._closed = closed
        a, b, c = (points[faces[:, i]] for i in range(3))
        across = np.cross(b - a, c - a)
        lengths = np.linalg.norm(across, axis=1)
        self._normals = across / lengths[:, None]
        self._areas = lengths / 2
        self._neighbours: list[list[int]] = [[] for _ in faces]
        by_edge: dict[tuple[int, int], list[int]] = {}
        for i, (u, v, w) in enumerate(faces.tolist()):
            for edge in ((u, v), (v, w), (w, u)):
                others = by_edge.setdefault((min(edge), max(edge)), [])
                for other in others:
                    self._neighbours[i].append(other)
                    self._neighbours[other].append(i)
                others.append(i)

    def sheets(self, bend: float) -> Iterator[_Points]:
        """Yield walls along the whole surface, flat within `bend` [m]."""
        free = np.ones(len(self._faces), dtype=bool)
        for seed in np.argsort(-self._areas, kind="stable").tolist():
            if not free[seed]:
                continue
            normal = self._normals[seed]
            heights = self._points @ normal - self._points[self._faces[seed, 0]] @ normal
            facing = self._normals @ normal
            alike = (facing if self._closed else np.abs(facing)) >= _STEEPEST
            patch = self._connected(seed, free & alike & (np.abs(heights) <= bend)[self._faces].all(axis=1))
            free[patch] = False
            yield from self._walls(patch, normal, bend)

    def _connected(self, seed: int, allowed: NDArray[np.bool_]) -> _Faces:
        """Return the allowed faces connected to `seed`."""
        connected, todo = {seed}, [seed]
        while todo:
            for face in self._neighbours[todo.pop()]:
                if allowed[face] and face not in connected:
                    connected.add(face)
                    todo.append(face)
        return np.array(sorted(connected), dtype=np.intp)

    def _walls(self, patch: _Faces, normal: _Points, bend: float) -> Iterator[_Points]:
        """Yield walls along a patch, halved until each wall's hull covers no other space."""
        corners, inward = self._points[np.unique(self._faces[patch])], normal * self._thickness
        layers = (corners, corners - inward) if self._closed else (corners - inward / 2, corners + inward / 2)
        wall = np.concatenate(layers)
        if len(patch) == 1 or self._is_full(patch, corners, normal) or self._is_near(wall, bend):
            yield wall
            return
        middles = self._points[self._faces[patch]].mean(axis=1)
        centred = middles - middles.mean(axis=0)
        along = centred @ np.linalg.eigh(centred.T @ centred)[1][:, -1]
        order = np.argsort(along, kind="stable")
        yield from self._walls(patch[order[: len(patch) // 2]], normal, bend)
        yield from self._walls(patch[order[len(patch) // 2 :]], normal, bend)

    def _is_full(self, patch: _Faces, corners: _Points, normal: _Points) -> bool:
        projected_area = self._areas[patch] @ np.abs(self._normals[patch] @ normal)
        return convex_hull_area(corners, normal) <= _WASTE * float(projected_area)

    def _is_near(self, wall: _Points, bend: float) -> bool:
        solid = hull_of(wall)
        if solid is None:
            return True
        away = hausdorff_distance(solid.triangles, self._points[self._faces], probes=_PROBES, samples=_SAMPLES)
        return away <= bend + self._thickness
