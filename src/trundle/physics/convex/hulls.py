"""Convex hulls as MuJoCo makes them, and how far they are from what they stand for."""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .native_output import native_output_hidden

_Points = NDArray[np.float64]
_Numbers = NDArray[np.intp]
_SAMPLES = 4000
"""Points that stand for a surface: a few hundredths of its size apart."""
_PROBES = 250
_SURVEY = 1000
_TOUCH = 1e-9
"""[m]"""
_FLAT = 1e-7
"""Part of its size, or of how far out it is, that something flat is thick: MuJoCo's corners have 24 bits."""
_FEW = 48
"""Triangles that are all looked at closely."""
_NEAREST = 8
"""Points of a surface whose triangles are looked at closely."""


class Hull(Struct, frozen=True):
    """The smallest convex body around some points."""

    corners: _Points
    """(C, 3) those of the points that are corners of it [m]."""
    triangles: _Points
    """(F, 3, 3) its surface [m], counter-clockwise from outside."""
    normals: _Points
    """(F, 3) out of it; unit."""
    offsets: _Points
    """(F,) of each face from the origin, along its normal [m]."""
    volume: float
    """[m³]"""

    def signed_distances(self, points: _Points) -> _Points:
        """(N,) how far above the highest face that they are above points (N, 3) are; below zero: inside [m]."""
        highest = np.full(len(points), -np.inf)
        for normal, offset in zip(self.normals, self.offsets, strict=True):
            np.maximum(highest, points @ normal - offset, out=highest)
        return highest


def hull_of(points: _Points) -> Hull | None:
    """The hull of points (N, 3) [m]; None where they are flat, or as good as that."""
    if is_flat(points):
        return None  # of which Qhull would make an error
    spec = mujoco.MjSpec()
    spec.add_mesh(name="hull", uservert=points.reshape(-1), inertia=mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX)
    geom = spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_MESH, contype=1)
    geom.meshname = "hull"
    try:
        with native_output_hidden():
            model = spec.compile()
    except ValueError:
        return None
    count, faces = model.mesh_graph[:2].tolist()
    numbers = model.mesh_graph[2 + 3 * count + 3 * faces :][: 3 * faces].reshape(faces, 3)
    triangles = points[numbers]
    edges = triangles[:, 1:] - triangles[:, :1]
    normals = np.cross(edges[:, 0], edges[:, 1])
    lengths = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(lengths, np.finfo(float).tiny)[:, None]
    solid = lengths > 1e-6 * lengths.max()
    offsets = np.einsum("ij,ij->i", normals, triangles[:, 0])
    return Hull(points[np.unique(numbers)], triangles, normals[solid], offsets[solid], volume_of(triangles))


def is_flat(points: _Points) -> bool:
    """Whether points (N, 3) [m] are in a plane, on a line, or one; or not all finite."""
    if len(points) < 4 or not np.isfinite(points).all():
        return True
    thickness = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1]
    return bool(thickness <= _FLAT * max(float(np.ptp(points, axis=0).max()), float(np.abs(points).max())))


def volume_of(triangles: _Points) -> float:
    """[m³] Enclosed by a closed surface (F, 3, 3), counter-clockwise from outside."""
    a, b, c = np.moveaxis(triangles - triangles.reshape(-1, 3).mean(axis=0), 1, 0)
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6


def area_of(triangles: _Points) -> float:
    """[m²] Of a surface (F, 3, 3)."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()) / 2


def hausdorff_distance(
    from_triangles: _Points, to_triangles: _Points, *, probes: int = _PROBES, samples: int = _SAMPLES
) -> float:
    """[m] From the point of one surface (F, 3, 3) that is farthest from another (G, 3, 3), to that; about so.

    Args:
        from_triangles: that are looked at.
        to_triangles: that are near or far.
        probes: points of the first that are tried.
        samples: points that stand for the second.
    """
    points, _ = sample_surface(from_triangles, probes)
    return float(_distances_to(points, to_triangles, samples).max())


def _distances_to(probes: _Points, triangles: _Points, count: int = _SAMPLES) -> _Points:
    """(N,) [m] from points (N, 3) to a surface; about so."""
    if len(triangles) <= _FEW:
        return _distances(probes[:, None], triangles[None]).min(axis=1)
    samples, owners = sample_surface(triangles, count)
    squares = (samples * samples).sum(axis=1) - 2 * probes @ samples.T
    nearest = np.argpartition(squares, min(_NEAREST, len(samples)) - 1, axis=1)[:, :_NEAREST]
    return _distances(probes[:, None], triangles[owners[nearest]]).min(axis=1)


def surface_error(triangles: _Points, solids: list[Hull], *, closed: bool) -> float:
    """[m] How far what solids together look like is from a surface (F, 3, 3) at most, either way; about so."""
    if not solids:
        return np.inf
    samples, _ = sample_surface(triangles, _SURVEY)
    missing = float(_signed_distances(solids, samples).max())
    probes, owners = sample_surface(np.concatenate([solid.triangles for solid in solids]), _SURVEY)
    owner = np.repeat(np.arange(len(solids)), [len(solid.triangles) for solid in solids])[owners]
    # Where one piece goes on as another, and what is inside the surface, is not to be seen.
    hidden = np.zeros(len(probes), dtype=bool)
    for i, solid in enumerate(solids):
        hidden |= (owner != i) & (solid.signed_distances(probes) < _TOUCH)
    probes = probes[~hidden]
    away = _distances_to(probes, triangles)
    for i in np.argsort(-away, kind="stable"):
        if away[i] <= missing or not (closed and _is_inside(probes[i], triangles)):
            return max(missing, float(away[i]), 0.0)
    return max(missing, 0.0)


def _signed_distances(solids: list[Hull], points: _Points) -> _Points:
    """(N,) how far points (N, 3) are outside all of some solids; below zero: in one of them [m]."""
    heights = np.full(len(points), np.inf)
    for solid in solids:
        np.minimum(heights, solid.signed_distances(points), out=heights)
    return heights


def _is_inside(point: _Points, triangles: _Points) -> bool:
    """Whether a surface (F, 3, 3) goes around a point (3,): by the sum of solid angles (van Oosterom)."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(corner, axis=1) for corner in (a, b, c))
    ab, bc, ca = ((u * v).sum(axis=1) for u, v in ((a, b), (b, c), (c, a)))
    over = (a * np.cross(b, c)).sum(axis=1)
    return float(np.arctan2(over, la * lb * lc + ab * lc + bc * la + ca * lb).sum()) > np.pi


def sample_surface(triangles: _Points, count: int) -> tuple[_Points, _Numbers]:
    """About `count` points evenly on a surface (F, 3, 3), the same every time, and which triangle each is on."""
    edges = triangles[:, 1:] - triangles[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    wanted = np.cumsum(areas) * (count / max(float(areas.sum()), np.finfo(float).tiny))
    numbers = np.diff(np.round(wanted).astype(np.intp), prepend=0)
    owners = np.repeat(np.arange(len(triangles)), numbers)
    turn = np.arange(len(owners)) - np.repeat(np.cumsum(numbers) - numbers, numbers) + 0.5
    # Roberts' sequence over the unit square, which fills it evenly however many there are; folded into the triangle.
    u, v = (turn * 0.7548776662466927) % 1, (turn * 0.5698402909980532) % 1
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return triangles[owners, 0] + u[:, None] * edges[owners, 0] + v[:, None] * edges[owners, 1], owners


def _distances(points: _Points, triangles: _Points) -> _Points:
    """(…) from points (…, 3) to triangles (…, 3, 3) [m]."""
    ends = np.roll(triangles, -1, axis=-2) - triangles
    arms = points[..., None, :] - triangles
    lengths = np.maximum((ends * ends).sum(axis=-1), np.finfo(float).tiny)
    along = np.clip((arms * ends).sum(axis=-1) / lengths, 0.0, 1.0)
    to_edges = np.linalg.norm(arms - along[..., None] * ends, axis=-1).min(axis=-1)
    normals = np.cross(ends[..., 0, :], ends[..., 1, :])
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), np.finfo(float).tiny)
    sides = (normals[..., None, :] * np.cross(ends, arms)).sum(axis=-1)
    return np.where((sides > 0).all(axis=-1), np.abs((normals * arms[..., 0, :]).sum(axis=-1)), to_edges)


def convex_hull_area(corners: _Points, normal: _Points) -> float:
    """[m²] Of the convex polygon around points (N, 3), seen along a normal: Andrew's monotone chain."""
    across = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    flat = np.column_stack([corners @ across, corners @ np.cross(normal, across)])
    flat = flat[np.lexsort((flat[:, 1], flat[:, 0]))]

    def chain(points: list[list[float]]) -> list[list[float]]:
        kept: list[list[float]] = []
        for x, y in points:
            while len(kept) > 1:
                (x0, y0), (x1, y1) = kept[-2:]
                if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0:
                    break
                kept.pop()
            kept.append([x, y])
        return kept[:-1]

    hull = np.array(chain(flat.tolist()) + chain(flat[::-1].tolist()))
    x, y = hull.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
