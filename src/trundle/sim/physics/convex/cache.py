"""Disk cache of convex pieces."""

import numpy as np

from trundle.robots.meshes import RawPart, load_parts, save_parts

from .pieces import ConvexPieces, HullError


def save_pieces(key: str, pieces: ConvexPieces) -> None:
    """Save pieces under a key, atomically."""
    none = np.zeros((0, 3), dtype=np.int64)
    errors = [
        (np.nan if m.volume_ratio is None else m.volume_ratio, m.distance, float(m.is_filled)) for m in pieces.errors
    ]
    parts = [RawPart(names=("misfits",), vertices=np.array(errors, dtype=float).reshape(-1, 3), faces=none)]
    parts += [RawPart(names=("piece",), vertices=corners, faces=none) for corners in pieces.corners]
    save_parts(_name(key), parts)


def load_pieces(key: str) -> ConvexPieces | None:
    """Load the pieces of a key; None if missing or invalid."""
    parts = load_parts(_name(key))
    if not parts or any(part.vertices.ndim != 2 or part.vertices.shape[1] != 3 for part in parts):
        return None
    errors, *pieces = (np.asarray(part.vertices, dtype=float) for part in parts)
    if not pieces or not all(len(corners) and np.isfinite(corners).all() for corners in pieces):
        return None
    found = [
        HullError(None if np.isnan(times) else times, away, is_filled=bool(is_filled))
        for times, away, is_filled in errors.tolist()
    ]
    return ConvexPieces(pieces, found)


def _name(key: str) -> str:
    return f"pieces-{key}"
