"""Merging of neighbouring faces to convex patches, each represented exactly by one convex body."""

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

_Points = NDArray[np.float64]
_Numbers = NDArray[np.intp]
_TOLERANCE = 1e-4
"""Largest deviation of a patch's hull from its faces [m]."""
_STRAIGHT = 1e-4
"""Largest sine of a concave angle in an outline."""
_MAX_CORNERS = 12
_MAX_FACES = 16
_ROUNDS = 6


class Patches(Struct, frozen=True):
    """Convex patches of a surface."""

    loops: _Numbers
    """(P, K) vertex indices of each outline, counter-clockwise from outside; entries beyond its size are undefined."""
    sizes: _Numbers
    """(P,) number of corners."""
    normals: _Points
    """(P, 3) sum of the faces' normals, whose lengths are twice the areas."""
    planes: _Points
    """(P, M, 4) unit normal and offset of each face; beyond the count the first is repeated."""
    counts: _Numbers
    """(P,) number of faces."""


def convex_patches(points: _Points, faces: _Numbers, *, depth: float) -> Patches:
    """Merge faces pairwise, in several rounds.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into points, none without area.
        depth: largest distance of a patch's vertices behind the plane of one of its faces [m].
    """
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    units = normals / np.linalg.norm(normals, axis=1, keepdims=True)
    planes = np.column_stack([units, np.einsum("ij,ij->i", units, a)])[:, None]
    count = len(faces)
    patches = Patches(faces, np.full(count, 3, dtype=np.intp), normals, planes, np.ones(count, dtype=np.intp))
    for _ in range(_ROUNDS if count else 0):
        pairs = _matched(*_joinable(points, patches, depth), len(patches.sizes))
        if not len(pairs):
            break
        patches = _joined(patches, pairs)
    return patches


def _joinable(points: _Points, patches: Patches, depth: float) -> tuple[_Numbers, _Points]:
    """Return (E, 4) mergeable pairs: patch, edge, other patch, its edge; and (E,) the gain of each."""
    pairs = _neighbours(patches)
    first, edge, second, other = pairs.T
    pairs = pairs[
        (patches.sizes[first] + patches.sizes[second] - 2 <= _MAX_CORNERS)
        & (patches.counts[first] + patches.counts[second] <= _MAX_FACES)
    ]
    first, edge, second, other = pairs.T
    # … p, u, v, q … and … s, v, u, t …
    p, u, v, q = (_corner(patches, first, edge + step) for step in (-1, 0, 1, 2))
    s, t = _corner(patches, second, other - 1), _corner(patches, second, other + 2)
    normals = patches.normals[first] + patches.normals[second]
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), np.finfo(float).tiny)
    turns = [_turn(points, corners, normals) for corners in ((p, u, t), (s, v, q))]
    is_good = (t != p) & (s != q) & (turns[0] >= -_STRAIGHT) & (turns[1] >= -_STRAIGHT)
    pairs = pairs[is_good]
    first, _, second, _ = pairs.T
    top, bottom = _heights(points, patches, first, second)
    other_top, other_bottom = _heights(points, patches, second, first)
    is_good = (np.maximum(top, other_top) <= _TOLERANCE) & (np.minimum(bottom, other_bottom) >= -depth)
    gain = np.minimum(bottom, other_bottom)[is_good]
    return pairs[is_good], gain


def _neighbours(patches: Patches) -> _Numbers:
    """Return (E, 4) pairs of patches with a common edge, once each: patch, edge, other patch, its edge."""
    width = patches.loops.shape[1]
    owner = np.repeat(np.arange(len(patches.sizes)), width)
    number = np.tile(np.arange(width), len(patches.sizes))
    exists = number < patches.sizes[owner]
    owner, number = owner[exists], number[exists]
    start, end = _corner(patches, owner, number), _corner(patches, owner, number + 1)
    vertex_count = int(patches.loops.max()) + 1
    keys, back = start * vertex_count + end, end * vertex_count + start
    order = np.argsort(keys, kind="stable")
    reverse = np.searchsorted(keys, back, sorter=order)
    reverse = order[np.minimum(reverse, len(keys) - 1)]
    _, index, occurrences = np.unique(keys, return_inverse=True, return_counts=True)
    is_once = occurrences[index] == 1
    is_pair = (keys[reverse] == back) & is_once & is_once[reverse] & (owner < owner[reverse])
    return np.column_stack([owner, number, owner[reverse], number[reverse]])[is_pair]


def _corner(patches: Patches, patch: _Numbers, number: _Numbers) -> _Numbers:
    return patches.loops[patch, number % patches.sizes[patch]]


def _turn(points: _Points, corners: tuple[_Numbers, _Numbers, _Numbers], normals: _Points) -> _Points:
    """Return (E,) sine of the left turn of an outline at the second of three corners."""
    p, u, t = (points[corner] for corner in corners)
    one, two = u - p, t - u
    lengths = np.linalg.norm(one, axis=1) * np.linalg.norm(two, axis=1)
    return np.einsum("ij,ij->i", np.cross(one, two), normals) / np.maximum(lengths, np.finfo(float).tiny)


def _heights(points: _Points, patches: Patches, upper: _Numbers, lower: _Numbers) -> tuple[_Points, _Points]:
    """Return the highest and the lowest vertex of patches `upper` above the faces of patches `lower`, (E,) each [m]."""
    width = patches.loops.shape[1]
    numbers = np.minimum(np.arange(width), patches.sizes[upper][:, None] - 1)
    corners = points[patches.loops[upper[:, None], numbers]]
    planes = patches.planes[lower]
    heights = np.einsum("eki,emi->ekm", corners, planes[..., :3]) - planes[:, None, :, 3]
    return heights.max(axis=(1, 2), initial=-np.inf), heights.min(axis=(1, 2), initial=np.inf)


def _matched(pairs: _Numbers, gain: _Points, count: int) -> _Numbers:
    """Return the pairs to merge, at most one for each patch: repeatedly the pairs that are best for both patches."""
    order = np.argsort(-gain, kind="stable")
    pairs = pairs[order]
    chosen: list[_Numbers] = []
    while len(pairs):
        rank = np.arange(len(pairs))
        best = np.full(count, len(pairs))
        np.minimum.at(best, pairs[:, 0], rank)
        np.minimum.at(best, pairs[:, 2], rank)
        is_best = (best[pairs[:, 0]] == rank) & (best[pairs[:, 2]] == rank)
        chosen.append(pairs[is_best])
        merged = np.zeros(count, dtype=bool)
        merged[chosen[-1][:, [0, 2]]] = True
        pairs = pairs[~(merged[pairs[:, 0]] | merged[pairs[:, 2]])]
    return np.concatenate(chosen) if chosen else np.zeros((0, 4), dtype=np.intp)


def _joined(patches: Patches, pairs: _Numbers) -> Patches:
    first, edge, second, other = pairs.T
    one, two = patches.sizes[first], patches.sizes[second]
    sizes, counts = one + two - 2, patches.counts[first] + patches.counts[second]
    step = np.arange(max(int(sizes.max()), patches.loops.shape[1]))
    # From v around the first to before u, then from u around the second to before v.
    in_first = patches.loops[first[:, None], (edge[:, None] + 1 + step) % one[:, None]]
    in_second = patches.loops[second[:, None], (other[:, None] + 2 + step - one[:, None]) % two[:, None]]
    loops = np.where(step < one[:, None] - 1, in_first, in_second)
    face = np.arange(max(int(counts.max()), patches.planes.shape[1]))
    count = patches.counts[first][:, None]
    from_first = patches.planes[first[:, None], np.minimum(face, count - 1)]
    last = patches.counts[second][:, None] - 1
    from_second = patches.planes[second[:, None], np.clip(face - count, 0, last)]
    planes = np.where((face < count)[..., None], from_first, from_second)
    unmerged = np.setdiff1d(np.arange(len(patches.sizes)), pairs[:, [0, 2]])
    padding = [(0, 0), (0, len(step) - patches.loops.shape[1])]
    return Patches(
        np.concatenate([loops, np.pad(patches.loops[unmerged], padding)]),
        np.concatenate([sizes, patches.sizes[unmerged]]),
        np.concatenate([patches.normals[first] + patches.normals[second], patches.normals[unmerged]]),
        np.concatenate(
            [
                planes,
                np.pad(patches.planes[unmerged], [(0, 0), (0, len(face) - patches.planes.shape[1]), (0, 0)], "edge"),
            ]
        ),
        np.concatenate([counts, patches.counts[unmerged]]),
    )
