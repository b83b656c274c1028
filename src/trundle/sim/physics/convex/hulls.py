"""Convex hulls as MuJoCo computes them, and distances between surfaces."""

import mujoco
import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .native_output import native_output_hidden

_Points = NDArray[np.float64]
_Numbers = NDArray[np.intp]
_SAMPLES = 4000
"""Points sampled on a surface, a few hundredths of its size apart."""
_PROBES = 250
_SURVEY = 1000
_TOUCH = 1e-9
"""Tolerance of overlaps [m]."""
_FLAT = 1e-7
"""Thickness of a flat set, relative to its size or distance from the origin: MuJoCo stores vertices with 24 bits."""
_FEW = 48
"""Maximum number of triangles up to which all are tested exactly."""
_NEAREST = 8
"""Number of nearest samples whose triangles are tested exactly, in larger surfaces."""


class Hull(Struct, frozen=True):
    """Convex hull of points."""

    corners: _Points
    """(C, 3) vertices of the hull [m]."""
    faces: _Numbers
    """(F, 3) indices into the corners, counter-clockwise from outside."""
    triangles: _Points
    """(F, 3, 3) faces [m], counter-clockwise from outside."""
    normals: _Points
    """(F, 3) outward unit normals."""
    offsets: _Points
    """(F,) distances of the faces from the origin along their normals [m]."""
    bases: _Numbers
    """(F,) index of a corner of each face among the points."""
    volume: float
    """[m³]"""

    def signed_distances(self, points: _Points) -> _Points:
        """Return the largest signed distance of each point (N, 3) to the face planes, (N,) [m]; below zero: inside."""
        highest = np.full(len(points), -np.inf)
        for normal, offset in zip(self.normals, self.offsets, strict=True):
            np.maximum(highest, points @ normal - offset, out=highest)
        return highest


def hull_of(points: _Points) -> Hull | None:
    """Return the hull of points (N, 3) [m]; None if they are flat."""
    if is_flat(points):
        return None  # Qhull fails on it
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
    bases = numbers[solid, 0].astype(np.intp)
    used, numbered = np.unique(numbers, return_inverse=True)
    volume = volume_of(triangles)
    return Hull(points[used], numbered.reshape(faces, 3), triangles, normals[solid], offsets[solid], bases, volume)


def is_flat(points: _Points) -> bool:
    """True if points (N, 3) [m] are coplanar, collinear, coincident or not finite."""
    if len(points) < 4 or not np.isfinite(points).all():
        return True
    thickness = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1]
    return bool(thickness <= _FLAT * max(float(np.ptp(points, axis=0).max()), float(np.abs(points).max())))


def volume_of(triangles: _Points) -> float:
    """Return the volume of a closed surface (F, 3, 3), counter-clockwise from outside [m³]."""
    a, b, c = np.moveaxis(triangles - triangles.reshape(-1, 3).mean(axis=0), 1, 0)
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6


def area_of(triangles: _Points) -> float:
    """Return the area of a surface (F, 3, 3) [m²]."""
    edges = triangles[:, 1:] - triangles[:, :1]
    return float(np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1).sum()) / 2


def hausdorff_distance(
    from_triangles: _Points, to_triangles: _Points, *, probes: int = _PROBES, samples: int = _SAMPLES
) -> float:
    """Return the approximate one-sided Hausdorff distance from one surface (F, 3, 3) to another (G, 3, 3) [m].

    Args:
        from_triangles: first surface.
        to_triangles: second surface.
        probes: sample points on the first.
        samples: sample points on the second.
    """
    points, _ = sample_surface(from_triangles, probes)
    return float(_distances_to(points, to_triangles, samples).max())


def _distances_to(probes: _Points, triangles: _Points, count: int = _SAMPLES) -> _Points:
    """Return (N,) approximate distances from points (N, 3) to a surface [m]."""
    if len(triangles) <= _FEW:
        return _distances(probes[:, None], triangles[None]).min(axis=1)
    samples, owners = sample_surface(triangles, count)
    squares = (samples * samples).sum(axis=1) - 2 * probes @ samples.T
    nearest = np.argpartition(squares, min(_NEAREST, len(samples)) - 1, axis=1)[:, :_NEAREST]
    return _distances(probes[:, None], triangles[owners[nearest]]).min(axis=1)


def surface_error(triangles: _Points, solids: list[Hull], *, closed: bool) -> float:
    """Return the approximate Hausdorff distance between a surface (F, 3, 3) and the outside of the solids'
    union [m].
    """
    if not solids:
        return np.inf
    samples, _ = sample_surface(triangles, _SURVEY)
    missing = float(_signed_distances(solids, samples).max())
    probes, owners = sample_surface(np.concatenate([solid.triangles for solid in solids]), _SURVEY)
    owner = np.repeat(np.arange(len(solids)), [len(solid.triangles) for solid in solids])[owners]
    # Parts of a piece inside another, or inside the surface, are not visible.
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
    """Return (N,) signed distances of points (N, 3) to the union of solids [m]; below zero: inside one."""
    heights = np.full(len(points), np.inf)
    for solid in solids:
        np.minimum(heights, solid.signed_distances(points), out=heights)
    return heights


def _is_inside(point: _Points, triangles: _Points) -> bool:
    """True if a closed surface (F, 3, 3) contains a point (3,), by the sum of solid angles (van Oosterom)."""
    a, b, c = np.moveaxis(triangles - point, 1, 0)
    la, lb, lc = (np.linalg.norm(corner, axis=1) for corner in (a, b, c))
    ab, bc, ca = ((u * v).sum(axis=1) for u, v in ((a, b), (b, c), (c, a)))
    over = (a * np.cross(b, c)).sum(axis=1)
    return float(np.arctan2(over, la * lb * lc + ab * lc + bc * la + ca * lb).sum()) > np.pi


def sample_surface(triangles: _Points, count: int) -> tuple[_Points, _Numbers]:
    """Return about `count` evenly distributed points on a surface (F, 3, 3), deterministic, and each one's triangle."""
    edges = triangles[:, 1:] - triangles[:, :1]
    areas = np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1)
    cumulative_counts = np.cumsum(areas) * (count / max(float(areas.sum()), np.finfo(float).tiny))
    numbers = np.diff(np.round(cumulative_counts).astype(np.intp), prepend=0)
    owners = np.repeat(np.arange(len(triangles)), numbers)
    index = np.arange(len(owners)) - np.repeat(np.cumsum(numbers) - numbers, numbers) + 0.5
    # Roberts' sequence, even over the unit square for any number of points, folded into the triangle.
    u, v = (index * 0.7548776662466927) % 1, (index * 0.5698402909980532) % 1
    u, v = np.where(u + v > 1, 1 - u, u), np.where(u + v > 1, 1 - v, v)
    return triangles[owners, 0] + u[:, None] * edges[owners, 0] + v[:, None] * edges[owners, 1], owners


def _distances(points: _Points, triangles: _Points) -> _Points:
    """Return (…) distances from points (…, 3) to triangles (…, 3, 3) [m]."""
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
    """Return the area of the convex polygon around points (N, 3) projected along a normal [m²], by Andrew's monotone
    chain.
    """
    across = np.cross(normal, [1.0, 0.0, 0.0] if abs(normal[0]) < 0.9 else [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    flat = np.column_stack([corners @ across, corners @ np.cross(normal, across)])
    flat = flat[np.lexsort((flat[:, 1], flat[:, 0]))]

    def chain(points: list[list[float]]) -> list[list[float]]:
        chain_points: list[list[float]] = []
        for x, y in points:
            while len(chain_points) > 1:
                (x0, y0), (x1, y1) = chain_points[-2:]
                if (x1 - x0) * (y - y0) - (y1 - y0) * (x - x0) > 0:
                    break
                chain_points.pop()
            chain_points.append([x, y])
        return chain_points[:-1]

    hull = np.array(chain(flat.tolist()) + chain(flat[::-1].tolist()))
    x, y = hull.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2
