"""Animation of bodies: tracks of translation and rotation over time."""

import numpy as np
from numpy.typing import NDArray

from .document import Document

_Array = NDArray[np.float64]
_DECIMALS = 6
"""Decimals of positions [m] and quaternions, so that the keys of a body at rest are equal and left out."""
_XYZW = [4, 5, 6, 3]
"""Columns of a pose, x y z qw qx qy qz, in the order of a glTF quaternion."""


def add_animation(document: Document, name: str, times: _Array, poses: _Array) -> None:
    """Add an animation of all moving bodies, after the scene with their first poses.

    Args:
        document: document with nodes of bodies, `extras.body` 0, 1, ….
        name: name of the animation.
        times: (N,) ascending [s]; the animation begins at the first.
        poses: (N, bodies, 7) x y z [m], qw qx qy qz of each body in the world.
    """
    nodes = document.body_nodes()
    samplers: list[dict[str, object]] = []
    channels: list[dict[str, object]] = []
    for body in range(poses.shape[1]):
        quaternions = _continuous(poses[:, body, _XYZW])
        for path, values in (("translation", poses[:, body, :3]), ("rotation", quaternions)):
            rounded = np.round(values, _DECIMALS)
            keys = _keys(rounded)
            if len(keys) < 2 or body not in nodes:
                continue
            sampler: dict[str, object] = {
                "input": document.numbers(times[keys] - times[0], bounded=True),
                "output": document.numbers(rounded[keys]),
                "interpolation": "LINEAR",
            }
            channels.append({"sampler": len(samplers), "target": {"node": nodes[body], "path": path}})
            samplers.append(sampler)
    if channels:
        document.add("animations", {"name": name, "samplers": samplers, "channels": channels})


def _continuous(quaternions: _Array) -> _Array:
    """Return unit quaternions (N, 4) with continuous signs."""
    unit = quaternions / np.linalg.norm(quaternions, axis=1, keepdims=True)
    turns = np.where((unit[1:] * unit[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)
    return unit * np.concatenate([[1.0], np.cumprod(turns)])[:, None]


def _keys(values: _Array) -> NDArray[np.intp]:
    """Return the indices of values (N, K) that differ from a neighbour, and both ends; nothing if all are equal."""
    changes = (values[1:] != values[:-1]).any(axis=1)
    if not changes.any():
        return np.zeros(0, dtype=np.intp)
    is_key = np.concatenate([[True], changes]) | np.concatenate([changes, [True]])
    return np.flatnonzero(is_key)
