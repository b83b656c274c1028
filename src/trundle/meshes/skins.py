"""Reads skins with bones in them, and animations."""

from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from trundle.diagnostics import DescriptionError
from trundle.files import read_file
from trundle.xmlnode import XmlNode, parse_xml

from .bvh import read_bvh
from .collada_bones import metres_of, read_bones, read_motion
from .collada_file import read_collada
from .load import MOST_BYTES, joined
from .raw import MeshError
from .skeleton import Motion, Skin


def load_skin(path: Path) -> Skin:
    """Read a .dae whose mesh is bound to bones; parts that are bound to none are left out.

    Raises:
        MeshError: unreadable, or no mesh in it is bound.
    """
    return _load_skin(path, _stat(path))


def load_motion(path: Path) -> Motion:
    """Read the animation of a .dae or .bvh; the numbers of a .bvh are metres.

    Raises:
        MeshError: unreadable, or nothing moves in it.
    """
    return _load_motion(path, _stat(path))


@lru_cache(maxsize=32)
def _load_skin(path: Path, state: tuple[int, int]) -> Skin:
    del state
    data = _data(path)
    root = _tree(data, path)
    metres = metres_of(root)
    bones = read_bones(root, metres)
    try:
        parts = [part for part in read_collada(data, skins=True) if part.skin is not None and len(part.faces)]
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from None
    except Exception as error:  # pycollada fails in its own ways
        raise MeshError(f"{path}: not readable as .dae: {' '.join(str(error).split())[:200]}") from None
    if not parts:
        raise MeshError(f"{path}: no mesh in it is bound to bones")
    numbers = {name: number for number, bone in reversed(list(enumerate(bones))) for name in (bone.id, bone.name)}
    skins = [part.skin for part in parts if part.skin is not None]
    lost = sorted({name for skin in skins for name in skin.bones if name not in numbers})
    if lost:
        raise MeshError(f"{path}: its skin is bound to {lost[0]!r}, which is no bone in it")
    widest = max(skin.influences.shape[1] for skin in skins)
    firsts = np.cumsum([0, *(len(skin.bones) for skin in skins)])
    to_bones = np.concatenate([skin.bone_from_skin for skin in skins])
    to_bones[:, :3, 3] *= metres
    bound = np.concatenate([skin.bound for skin in skins]) * metres
    return Skin(
        mesh=joined(parts, path, center=False),
        bones=bones,
        bound=np.column_stack([bound, np.ones(len(bound))]),
        ties=np.array([numbers[name] for skin in skins for name in skin.bones], dtype=np.intp),
        bone_from_skin=to_bones,
        influences=np.concatenate(
            [_padded(skin.influences, widest) + first for skin, first in zip(skins, firsts, strict=False)]
        ),
        weights=np.concatenate([_padded(skin.weights, widest) for skin in skins]),
    )


@lru_cache(maxsize=32)
def _load_motion(path: Path, state: tuple[int, int]) -> Motion:
    del state
    try:
        if path.suffix.lower() == ".bvh":
            return read_bvh(_data(path).decode(errors="replace"))
        root = _tree(_data(path), path)
        return read_motion(root, metres_of(root))
    except MeshError as error:
        raise MeshError(f"{path}: {error}") from None


def _stat(path: Path) -> tuple[int, int]:
    if path.suffix.lower() not in (".dae", ".bvh"):
        raise MeshError(f"{path}: bones are read from .dae and .bvh files")
    try:
        stat = path.stat()
    except OSError as error:
        raise MeshError(f"{path}: {error.strerror}") from None
    return stat.st_mtime_ns, stat.st_size


def _data(path: Path) -> bytes:
    try:
        return read_file(path, most=MOST_BYTES)
    except OSError as error:
        raise MeshError(f"{path}: {error.strerror}") from None


def _tree(data: bytes, path: Path) -> XmlNode:
    try:
        return parse_xml(data, name=str(path))
    except DescriptionError as error:
        raise MeshError(f"{error.at}: {error.what}") from None


def _padded(values: NDArray[Any], width: int) -> NDArray[Any]:
    return np.pad(values, ((0, 0), (0, width - values.shape[1])))
