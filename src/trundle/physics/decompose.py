"""Hollow bodies that move, as convex pieces: CoACD's, made in a process of its own and kept on disk.

X. Wei, M. Liu, Z. Ling, H. Su: Approximate Convex Decomposition for 3D Meshes with Collision-Aware Concavity and Tree
Search. ACM Transactions on Graphics 41(4), 2022.
"""

import hashlib
import io
import logging
import subprocess
import sys

import numpy as np
from numpy.typing import NDArray

from trundle.meshes import RawPart, keep, load_kept

_Points = NDArray[np.float64]
_Faces = NDArray[np.intp]
CONCAVITY = 0.05
"""Of its size: how far a piece may be from its hull."""
_MOST_PIECES = 24
_MOST_FACES = 100_000
_PATIENCE_S = 120.0
_VERSION = 1
_log = logging.getLogger(__name__)


def cut_up(points: _Points, faces: _Faces) -> list[_Points] | None:
    """Cut a mesh into convex pieces, whose corners come back; None where that cannot be done.

    Args:
        points: (N, 3) [m].
        faces: (M, 3) indices into them; open and crossing surfaces are closed first.
    """
    if len(faces) > _MOST_FACES:
        return None
    packed = io.BytesIO()
    np.savez(packed, points=points, faces=faces)
    settings = f"coacd {_VERSION} {CONCAVITY} {_MOST_PIECES}".encode()
    key = hashlib.sha256(settings + points.tobytes() + faces.tobytes()).hexdigest()
    kept = load_kept(key)
    if kept is not None:
        return [part.vertices for part in kept]
    _log.warning("cutting a hollow mesh of %d triangles into convex pieces; that is done once", len(faces))
    # Foreign code on foreign meshes: should it crash or never end, this process does not.
    command = [sys.executable, "-P", "-m", "trundle.physics.decompose"]
    try:
        done = subprocess.run(command, input=packed.getvalue(), capture_output=True, timeout=_PATIENCE_S, check=True)
        with np.load(io.BytesIO(done.stdout), allow_pickle=False) as arrays:
            pieces = [np.asarray(arrays[f"piece{i}"], dtype=np.float64) for i in range(len(arrays))]
    except (OSError, subprocess.SubprocessError, ValueError, KeyError):
        return None
    none = np.zeros((0, 3), dtype=np.int64)
    keep(key, [RawPart(names=("piece",), vertices=piece, faces=none) for piece in pieces])
    return pieces


def _main() -> int:
    """Read a mesh from standard input, write its pieces to standard output."""
    import coacd  # not on every platform

    with np.load(io.BytesIO(sys.stdin.buffer.read()), allow_pickle=False) as arrays:
        mesh = coacd.Mesh(arrays["points"], arrays["faces"])
    coacd.set_log_level("off")
    parts = coacd.run_coacd(mesh, threshold=CONCAVITY, max_convex_hull=_MOST_PIECES, seed=0)
    np.savez(sys.stdout.buffer, **{f"piece{i}": vertices for i, (vertices, _) in enumerate(parts)})
    return 0


if __name__ == "__main__":
    sys.exit(_main())
