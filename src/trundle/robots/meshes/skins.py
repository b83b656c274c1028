"""Loaders of skinned meshes and skeleton animations."""

from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.base.files import read_file

from .bvh import read_bvh
from .collada.bones import metres_of, read_bones, read_motion
from .collada.scene import read_collada, read_tree
from .load import MAX_BYTES, joined, mesh_errors
from .mesh import MeshError
from .skeleton import Motion, Skin


def load_skin(path: Path) -> Skin:
    """Read a .dae whose mesh is bound to bones; unbound parts are dropped.

    Raises:
        MeshError: unreadable, or no mesh is bound.
    """
    with mesh_errors(path):
        return _load_skin(path, _state(path))


def load_motion(path: Path) -> Motion:
    """Read the animation of a .dae or .bvh; lengths in a .bvh are metres.

    Raises:
        MeshError: unreadable, or without animation.
    """
    with mesh_errors(path):
        return _load_motion(path, _state(path))


@lru_cache(maxsize=32)
def _load_skin(path: Path, state: tuple[int, int]) -> Skin:
    del state
    data = read_file(path, max_bytes=MAX_BYTES)
    root = read_tree(data)
    metres = metres_of(root)
    bones = read_bones(root, metres)
    parts = [part for part in read_collada(data, skins=True) if part.skin is not None and len(part.faces)]
    if not parts:
        raise MeshError("no mesh in it is bound to bones")
    numbers = {name: number for number, bone in reversed(list(enumerate(bones))) for name in (bone.id, bone.name)}
    skins = [part.skin for part in parts if part.skin is not None]
    lost = sorted({name for skin in skins for name in skin.bones if name not in numbers})
    if lost:
        raise MeshError(f"its skin is bound to {lost[0]!r}, which is not a bone in it")
    widest = max(skin.influences.shape[1] for skin in skins)
    firsts = np.cumsum([0, *(len(skin.bones) for skin in skins)])
    to_bones = np.concatenate([skin.bone_from_skin for skin in skins])
    to_bones[:, :3, 3] *= metres
    bound = np.concatenate([skin.bound for skin in skins]) * metres
    return Skin(
        mesh=joined(parts, path, center=False),
        bones=bones,
        bound=np.column_stack([bound, np.ones(len(bound))]),
        joint_indices=np.array([numbers[name] for skin in skins for name in skin.bones], dtype=np.intp),
        bone_from_skin=to_bones,
        influences=np.concatenate(
            [_padded(skin.influences, widest) + first for skin, first in zip(skins, firsts, strict=False)]
        ),
        weights=np.concatenate([_padded(skin.weights, widest) for skin in skins]),
    )


@lru_cache(maxsize=32)
def _load_motion(path: Path, state: tuple[int, int]) -> Motion:
    del state
    data = read_file(path, max_bytes=MAX_BYTES)
    if path.suffix.lower() == ".bvh":
        return read_bvh(data.decode(errors="replace"))
    root = read_tree(data)
    return read_motion(root, metres_of(root))


def _state(path: Path) -> tuple[int, int]:
    if path.suffix.lower() not in (".dae", ".bvh"):
        raise MeshError("bones are read from .dae and .bvh files")
    stat = path.stat()
    return stat.st_mtime_ns, stat.st_size


def _padded(values: NDArray[Any], width: int) -> NDArray[Any]:
    return np.pad(values, ((0, 0), (0, width - values.shape[1])))
