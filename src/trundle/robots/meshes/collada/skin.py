"""Reader of COLLADA's <skin>: bone weights of a geometry's vertices."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..raw import RawSkin

_MAX_INFLUENCES = 8
"""Maximum number of bones that influence a vertex; the largest weights are kept."""


def read_skin(skin: Any, vertices: NDArray[np.float64], used: NDArray[np.int64]) -> RawSkin | None:
    """Read pycollada's `Skin` for some vertices of its geometry; None if a vertex is missing.

    Args:
        skin: skin with a bind_shape_matrix.
        vertices: (N, 3) used vertices of the geometry.
        used: (N,) their indices in the geometry.
    """
    names = [str(name) for name in skin.sourcebyid[skin.joint_source]]
    if not names or (len(used) and int(used[-1]) >= len(skin.joint_index)):
        return None
    amounts = np.asarray(skin.weights.data, dtype=np.float64).ravel()
    influences = np.zeros((len(used), _MAX_INFLUENCES), dtype=np.intp)
    weights = np.zeros((len(used), _MAX_INFLUENCES))
    for row, vertex in enumerate(used.tolist()):
        joints, vertex_weights = skin.joint_index[vertex], amounts[skin.weight_index[vertex]]
        order = np.argsort(-vertex_weights, kind="stable")[:_MAX_INFLUENCES]
        order = order[(joints[order] >= 0) & (joints[order] < len(names)) & (vertex_weights[order] > 0.0)]
        influences[row, : len(order)], weights[row, : len(order)] = joints[order], vertex_weights[order]
    weights[:, 0] = np.where(weights.sum(axis=1) > 0.0, weights[:, 0], 1.0)
    widest = max(int(np.count_nonzero(weights, axis=1).max(initial=1)), 1)
    weights /= weights.sum(axis=1, keepdims=True)
    matrix = np.asarray(skin.bind_shape_matrix, dtype=np.float64).reshape(4, 4)
    return RawSkin(
        bound=vertices @ matrix[:3, :3].T + matrix[:3, 3],
        bones=tuple(names),
        bone_from_skin=np.stack([np.asarray(skin.joint_matrices[name], dtype=np.float64) for name in names]),
        influences=influences[:, :widest],
        weights=weights[:, :widest],
    )
