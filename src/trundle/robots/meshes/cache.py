"""Disk cache of meshes that are slow to read, keyed by the file's content.

A cache that is read-only, damaged or writable by another user only costs time.
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

from trundle.base.ownership import home_folder, is_owned_by_user

from .raw import RawPart

VERSION = 4
"""Version in every key; increased when a reader's result changes for the same bytes."""
_MAX_BYTES = 512 * 1024 * 1024


def cache_folder() -> Path:
    """Return the folder below XDG_CACHE_HOME, or ~/.cache."""
    root = os.environ.get("XDG_CACHE_HOME") or home_folder(os.environ) / ".cache"
    return Path(root) / "trundle" / "meshes"


def load_parts(key: str) -> list[RawPart] | None:
    """Load the parts of a key; None if missing or damaged."""
    path = cache_folder() / f"{key}.npz"
    if not is_owned_by_user(path.parent):  # a file of another user could be any mesh
        return None
    try:
        data = path.read_bytes()
        parts = _unpacked(data)
        os.utime(path)  # marks the file as recently used
    except FileNotFoundError:
        return None
    except Exception:  # a damaged file may raise anything
        with contextlib.suppress(OSError):
            path.unlink()
        return None
    return parts


def save_parts(key: str, parts: Sequence[RawPart]) -> None:
    """Save parts under a key, and remove the least recently used files beyond the limit."""
    packed = _packed(parts)
    if len(packed) > _MAX_BYTES // 8:
        return
    try:
        cache_folder().mkdir(mode=0o700, parents=True, exist_ok=True)
        if not is_owned_by_user(cache_folder()):
            return
        _write(cache_folder() / f"{key}.npz", packed)
        _trim()
    except OSError:
        return


def _write(path: Path, data: bytes) -> None:
    """Write atomically, even with Ctrl-C in between."""
    with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
        try:
            file.write(data)
            file.close()
            os.replace(file.name, path)
        except BaseException:
            Path(file.name).unlink(missing_ok=True)  # the file is missing if Ctrl-C came just after the move
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
    files = sorted((path.stat().st_mtime, path.stat().st_size, path) for path in cache_folder().iterdir())
    total = sum(size for _, size, _ in files)
    for _, size, path in files:
        if total <= _MAX_BYTES:
            return
        path.unlink(missing_ok=True)
        total -= size
