"""Uploaded models that a saved file needs: their folders are copied beside it, where `model://` finds them."""

import re
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape

from trundle.robots.packages import Packages

_TEXTS = frozenset({".dae", ".material", ".sdf", ".urdf", ".world", ".xacro", ".xml"})
_MAX_TEXT_BYTES = 64 * 1024 * 1024


def with_uploads_named(sdf: bytes, packages: Packages) -> bytes:
    """Return a document with the files of uploaded models as model:// URIs."""
    for folder in packages.added_models:
        sdf = sdf.replace(f"file://{folder.resolve()}/".encode(), b"model://")
    return sdf


def needed_uploads(sdf: bytes, packages: Packages) -> dict[str, Path]:
    """Return the folders, by name, of the uploaded models that a document names, and of those that these name."""
    left = {each.name: each for folder in packages.added_models for each in folder.iterdir()}
    needed: dict[str, Path] = {}
    waiting = [sdf]
    while waiting:
        text = waiting.pop()
        for name in [name for name in left if _is_named(name, text)]:
            needed[name] = left.pop(name)
            waiting += _texts(needed[name])
    return dict(sorted(needed.items()))


def copies(uploads: Mapping[str, Path], beside: Path) -> dict[Path, Path]:
    """Return the files of models by their places in folders of the models' names."""
    return {
        beside / name / file.relative_to(folder): file for name, folder in uploads.items() for file in _files(folder)
    }


def _is_named(model: str, text: bytes) -> bool:
    uri = rb"(?:model|package)://" + re.escape(escape(model).encode())
    return re.search(uri + rb"[/<\"'\s]", text) is not None


def _texts(folder: Path) -> list[bytes]:
    texts = (file for file in _files(folder) if file.suffix.lower() in _TEXTS)
    return [file.read_bytes() for file in texts if file.stat().st_size <= _MAX_TEXT_BYTES]


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file())
