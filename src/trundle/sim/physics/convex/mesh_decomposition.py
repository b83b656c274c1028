"""Decomposition of a world's meshes before the compile: equal parts are decomposed once, and cached on disk.

The level of detail of a part depends on the estimated time for the part and those before it in the file, never on a
clock or the cache: results repeat to the byte on slow and fast machines.
"""

import hashlib
import os
import threading
from collections.abc import Generator, Iterable, Mapping, Sequence
from contextlib import closing
from typing import Protocol, TypeAlias, TypeVar

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.robots.meshes import RawPart, load_parts, save_parts

from . import jobs
from .pieces import ConcavePart, ConvexPieces, Detail, HullError, hull_of_part
from .splitting import MAX_PIECES, MAX_SLABS, MeshSplit, as_single_hull, split_mesh

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
_K = TypeVar("_K")
_V = TypeVar("_V")
MeshRequest: TypeAlias = tuple[_Points, _Faces, bool]
"""Vertices (N, 3) [m], faces (M, 3) counter-clockwise from outside, and True if the mesh is fixed."""
FULL = "TRUNDLE_FULL_DECOMPOSITION"
"""Environment variable that lifts the time budget."""
MAX_SECONDS = 120.0
"""Time budget of a world on one processor [s]; beyond, parts are decomposed coarsely."""
MAX_SECONDS_A_MESH = 40.0
_MAX_CACHED = 1024
_cache_lock = threading.Lock()
_claims_changed = threading.Condition()
_claimed: set[str] = set()
"""Keys of the parts that a thread of this process decomposes."""

_splits: dict[bytes, MeshSplit] = {}
"""Mesh digest → split; least recently used first."""
_pieces: dict[str, ConvexPieces] = {}
"""Part key → pieces; least recently used first."""


class DecomposedMesh(Struct, frozen=True):
    """Convex pieces of a mesh."""

    pieces: ConvexPieces
    is_coarse: bool
    """True if the time budget reduced the number of pieces."""
    is_failed: bool
    """True if a part failed and its hull replaces it."""
    is_stand_in: bool = False
    """True if a part's hull replaces it until it is cut."""
    simplified_by: float = 0.0
    """See `MeshSplit`."""


class Background(Protocol):
    """Decomposes parts while their hulls stand in."""

    failed: set[str]
    """Keys of the parts that could not be decomposed."""

    def cut(self, parts: Sequence[ConcavePart]) -> None:
        """Decompose parts that are not being decomposed already."""
        ...


class WorldDecomposition:
    """Decomposition of all meshes of one world."""

    def __init__(self, background: Background | None = None) -> None:
        """Prepare.

        Args:
            background: decomposes slow meshes while their hulls stand in; None: all are decomposed at once.
        """
        self._background = background
        self._stand_ins: dict[str, ConvexPieces] = {}
        self._plans: dict[bytes, tuple[MeshSplit, list[ConcavePart]]] = {}
        self._chosen: dict[str, ConcavePart] = {}
        """Part key at full detail → part at the chosen detail."""
        self._seconds = 0.0
        self._slabs = 0
        self._failed: dict[str, ConvexPieces] = {}

    def decompose_all(self, meshes: Iterable[MeshRequest]) -> None:
        """Decompose meshes in file order, in several processes or in the background if it takes long."""
        parts_by_key: dict[str, ConcavePart] = {}
        for vertices, faces, fixed in meshes:
            _, parts = self._plan(vertices, faces, fixed=fixed)
            parts_by_key.update((part.key, part) for part in parts)
        todo = {key: part for key, part in parts_by_key.items() if not self._has(part)}
        if self._background is not None and sum(part.seconds for part in todo.values()) > jobs.SHORT_S:
            self._stand_in(todo, self._background)
            return
        with closing(decompose_once(list(todo.values()))) as done:
            for part, pieces in done:
                if pieces is None:
                    self._failed[part.key] = hull_of_part(part)

    def _stand_in(self, todo: Mapping[str, ConcavePart], background: Background) -> None:
        """Use hulls until the parts are cut."""
        for key, part in todo.items():
            (self._failed if key in background.failed else self._stand_ins)[key] = hull_of_part(part)
        background.cut([part for key, part in todo.items() if key in self._stand_ins])

    def _has(self, part: ConcavePart) -> bool:
        return part.key in self._failed or part.key in self._stand_ins or find_pieces(part) is not None

    def pieces_of(self, vertices: _Points, faces: _Faces, *, fixed: bool) -> DecomposedMesh:
        """Return the convex pieces of a mesh, decomposing it if needed."""
        whole, parts = self._plan(vertices, faces, fixed=fixed)
        pieces = ConvexPieces(list(whole.corners), [])
        for (lowest, _), part in zip(whole.concave, parts, strict=True):
            if not self._has(part):
                self.decompose_all([(vertices, faces, fixed)])
            cut = self._stand_ins.get(part.key) or find_pieces(part) or self._failed[part.key]
            pieces.corners.extend(corners + lowest for corners in cut.corners)
            pieces.errors.extend(cut.errors)
        is_coarse = any(part.detail is Detail.COARSE for part in parts)
        is_failed = any(part.key in self._failed for part in parts)
        is_stand_in = any(part.key in self._stand_ins for part in parts)
        return DecomposedMesh(pieces, is_coarse, is_failed, is_stand_in, whole.simplified_by)

    def _plan(self, vertices: _Points, faces: _Faces, *, fixed: bool) -> tuple[MeshSplit, list[ConcavePart]]:
        """Split a mesh, and choose the detail of its concave parts."""
        digest = hashlib.sha256(b"%d %d " % (fixed, len(vertices)) + vertices.tobytes() + faces.tobytes()).digest()
        if digest not in self._plans:
            whole = _splits.get(digest) or split_mesh(vertices, faces, fixed=fixed)
            _cache(_splits, digest, whole)
            if len(whole.corners) > MAX_PIECES and len(whole.corners) > MAX_SLABS - self._slabs:
                whole = as_single_hull(vertices, faces)
            self._slabs += len(whole.corners)
            self._plans[digest] = whole, self._chosen_parts([part for _, part in whole.concave])
        return self._plans[digest]

    def _chosen_parts(self, parts: Iterable[ConcavePart]) -> list[ConcavePart]:
        """Choose the detail of a mesh's parts within the time budget."""
        before_s = self._seconds
        chosen: list[ConcavePart] = []
        for part in parts:
            key = part.key
            if key not in self._chosen:
                remaining_s = min(MAX_SECONDS - self._seconds, MAX_SECONDS_A_MESH - (self._seconds - before_s))
                if part.detail is Detail.FULL and part.seconds > remaining_s and FULL not in os.environ:
                    part = replace(part, detail=Detail.COARSE)
                self._chosen[key] = part
                self._seconds += part.seconds
            chosen.append(self._chosen[key])
        return chosen


def decompose_once(
    parts: Sequence[ConcavePart], *, redraws: bool = True
) -> Generator[tuple[ConcavePart, ConvexPieces | None]]:
    """Decompose parts as `decompose_parts` does, and keep their pieces; those that another thread decomposes are waited
    for: the simulation and the planner of one robot start together.

    Args:
        parts: parts to decompose.
        redraws: True: redraw a line of progress on a terminal; False: print lines.
    """
    with _claims_changed:
        own = [part for part in parts if part.detail is Detail.HULL or part.key not in _claimed]
        keys = {part.key for part in own if part.detail is not Detail.HULL}
        _claimed.update(keys)
    try:
        with closing(jobs.decompose_parts(own, redraws=redraws)) as done:
            for part, pieces in done:
                if pieces is not None:
                    store_pieces(part, pieces)
                yield part, pieces
    finally:
        with _claims_changed:
            _claimed.difference_update(keys)
            _claims_changed.notify_all()
    own_parts = {id(part) for part in own}
    for part in parts:
        if id(part) not in own_parts:
            with _claims_changed:
                _claims_changed.wait_for(lambda key=part.key: key not in _claimed)
            yield part, find_pieces(part)


def find_pieces(part: ConcavePart) -> ConvexPieces | None:
    """Return the pieces kept for a part, in memory or on disk."""
    pieces = _pieces.get(part.key)
    if pieces is None and part.detail is not Detail.HULL:
        pieces = load_pieces(part.key)
    if pieces is not None:
        _cache(_pieces, part.key, pieces)
    return pieces


def store_pieces(part: ConcavePart, pieces: ConvexPieces) -> None:
    """Keep the pieces of a part, in memory and on disk."""
    _cache(_pieces, part.key, pieces)
    if part.detail is not Detail.HULL:
        save_pieces(part.key, pieces)


def clear_cache() -> None:
    """Clear the in-memory caches."""
    _splits.clear()
    _pieces.clear()


def _cache(memory: dict[_K, _V], key: _K, value: _V) -> None:
    with _cache_lock:
        memory.pop(key, None)
        memory[key] = value
        if len(memory) > _MAX_CACHED:
            del memory[next(iter(memory))]


def convex_pieces(vertices: _Points, faces: _Faces, *, fixed: bool) -> ConvexPieces:
    """Decompose one mesh, or return the cached pieces."""
    return WorldDecomposition().pieces_of(vertices, faces, fixed=fixed).pieces


def save_pieces(key: str, pieces: ConvexPieces) -> None:
    """Save pieces on disk under a key, atomically."""
    none = np.zeros((0, 3), dtype=np.int64)
    errors = [
        (np.nan if m.volume_ratio is None else m.volume_ratio, m.distance, float(m.is_filled)) for m in pieces.errors
    ]
    parts = [RawPart(names=("misfits",), vertices=np.array(errors, dtype=float).reshape(-1, 3), faces=none)]
    parts += [RawPart(names=("piece",), vertices=corners, faces=none) for corners in pieces.corners]
    save_parts(_cache_name(key), parts)


def load_pieces(key: str) -> ConvexPieces | None:
    """Load the pieces of a key; None if missing or invalid."""
    parts = load_parts(_cache_name(key))
    if not parts or any(part.vertices.ndim != 2 or part.vertices.shape[1] != 3 for part in parts):
        return None
    errors, *pieces = (np.asarray(part.vertices, dtype=float) for part in parts)
    if not pieces or not all(len(corners) and np.isfinite(corners).all() for corners in pieces):
        return None
    hull_errors = [
        HullError(None if np.isnan(times) else times, away, is_filled=bool(is_filled))
        for times, away, is_filled in errors.tolist()
    ]
    return ConvexPieces(pieces, hull_errors)


def _cache_name(key: str) -> str:
    return f"pieces-{key}"
