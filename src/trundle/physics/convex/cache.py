"""Convex pieces of hollow parts, kept on disk."""

import numpy as np

from trundle.meshes import RawPart, keep, load_kept

from .pieces import ConvexPieces, HullError


def keep_pieces(key: str, pieces: ConvexPieces) -> None:
    """Keep pieces under a key, at once and whole."""
    none = np.zeros((0, 3), dtype=np.int64)
    misfits = [(np.nan if m.times is None else m.times, m.away, float(m.is_filled)) for m in pieces.misfits]
    parts = [RawPart(names=("misfits",), vertices=np.array(misfits, dtype=float).reshape(-1, 3), faces=none)]
    parts += [RawPart(names=("piece",), vertices=corners, faces=none) for corners in pieces.corners]
    keep(_name(key), parts)


def find_pieces(key: str) -> ConvexPieces | None:
    """Find what was kept under a key; None where nothing is, or it makes no sense."""
    parts = load_kept(_name(key))
    if not parts or any(part.vertices.ndim != 2 or part.vertices.shape[1] != 3 for part in parts):
        return None
    misfits, *pieces = (np.asarray(part.vertices, dtype=float) for part in parts)
    if not pieces or not all(len(corners) and np.isfinite(corners).all() for corners in pieces):
        return None
    found = [
        HullError(None if np.isnan(times) else times, away, is_filled=bool(is_filled))
        for times, away, is_filled in misfits.tolist()
    ]
    return ConvexPieces(pieces, found)


def _name(key: str) -> str:
    return f"pieces-{key}"
