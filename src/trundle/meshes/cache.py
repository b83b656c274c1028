"""Meshes that took long to read, kept on disk under a key made of the file's bytes.

A cache that cannot be written, whose files are damaged, or that another user could write, costs time and nothing else.
"""

import contextlib
import io
import json
import os
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from msgspec.structs import asdict

from trundle.ownership import home_folder, is_owned_by_user

from .raw import RawPart

VERSION = 4
"""Part of every key; raised where a reader gives something else for the same bytes."""
_MAX_BYTES = 512 * 1024 * 1024


def folder() -> Path:
    """Below XDG_CACHE_HOME, or ~/.cache."""
    root = os.environ.get("XDG_CACHE_HOME") or home_folder(os.environ) / ".cache"
    return Path(root) / "trundle" / "meshes"


def load_parts(key: str) -> list[RawPart] | None:
    """What was kept under a key; None where nothing was, or it is damaged."""
    path = folder() / f"{key}.npz"
    if not is_owned_by_user(path.parent):  # what another user put there would be taken for the mesh
        return None
    try:
        data = path.read_bytes()
        parts = _unpacked(data)
        os.utime(path)  # the longest unused go first
    except FileNotFoundError:
        return None
    except Exception:  # damage takes any form
        with contextlib.suppress(OSError):
            path.unlink()
        return None
    return parts


def save_parts(key: str, parts: Sequence[RawPart]) -> None:
    """Keep parts under a key, and let go of what was not used for longest."""
    packed = _packed(parts)
    if len(packed) > _MAX_BYTES // 8:
        return
    try:
        folder().mkdir(mode=0o700, parents=True, exist_ok=True)
        if not is_owned_by_user(folder()):
            return
        _write(folder() / f"{key}.npz", packed)
        _trim()
    except OSError:
        return


def _write(path: Path, data: bytes) -> None:
    """Whole or not at all, also where Ctrl-C comes in between."""
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
        try:
            file.write(data)
            file.close()
            os.replace(file.name, path)
        except BaseException:
            os.unlink(file.name)
            raise


def _packed(parts: Sequence[RawPart]) -> bytes:
    arrays: dict[str, Any] = {}
    heads: list[dict[str, Any]] = []
    for i, part in enumerate(parts):
        head = asdict(part)
        for name in ("vertices", "faces", "uv", "normals"):
            array = head.pop(name)
            if array is not None:
                arrays[f"{name}{i}"] = array
        if isinstance(part.texture, bytes):
            head["texture"] = None
            arrays[f"texture{i}"] = np.frombuffer(part.texture, dtype=np.uint8)
        heads.append(head)
    arrays["heads"] = np.frombuffer(json.dumps(heads).encode(), dtype=np.uint8)
    buffer = io.BytesIO()
    np.savez(buffer, **arrays)
    return buffer.getvalue()


def _unpacked(data: bytes) -> list[RawPart]:
    if zipfile.ZipFile(io.BytesIO(data)).testzip() is not None:
        raise ValueError("damaged")
    with np.load(io.BytesIO(data), allow_pickle=False) as arrays:
        heads = json.loads(arrays["heads"].tobytes())
        return [
            RawPart(
                names=tuple(head["names"]),
                vertices=arrays[f"vertices{i}"],
                faces=arrays[f"faces{i}"],
                rgba=None if head["rgba"] is None else tuple(head["rgba"]),
                texture=arrays[f"texture{i}"].tobytes() if f"texture{i}" in arrays else head["texture"],
                tint=tuple(head["tint"]),
                uv=arrays.get(f"uv{i}"),
                normals=arrays.get(f"normals{i}"),
            )
            for i, head in enumerate(heads)
        ]


def _trim() -> None:
    files = sorted((path.stat().st_mtime, path.stat().st_size, path) for path in folder().iterdir())
    total = sum(size for _, size, _ in files)
    for _, size, path in files:
        if total <= _MAX_BYTES:
            return
        path.unlink(missing_ok=True)
        total -= size
