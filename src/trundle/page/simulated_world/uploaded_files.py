"""Uploaded models that a saved file needs: their folders are copied next to it, where `model://` finds them."""

import re
from collections.abc import Mapping
from pathlib import Path
from xml.sax.saxutils import escape

from trundle.robots.packages import Packages

_TEXTS = frozenset({".dae", ".material", ".sdf", ".urdf", ".world", ".xacro", ".xml"})
_MAX_TEXT_BYTES = 64 * 1024 * 1024


def with_upload_uris(sdf: bytes, packages: Packages) -> bytes:
    """Return a document in which the files of uploaded models have model:// URIs."""
    for folder in packages.added_models:
        sdf = sdf.replace(f"file://{folder.resolve()}/".encode(), b"model://")
    return sdf


def needed_uploads(sdf: bytes, packages: Packages) -> dict[str, Path]:
    """Return the folders, by name, of the uploaded models that a document refers to, directly or through others."""
    unused = {model.name: model for folder in packages.added_models for model in folder.iterdir()}
    needed: dict[str, Path] = {}
    waiting = [sdf]
    while waiting:
        text = waiting.pop()
        for name in [name for name in unused if _is_named(name, text)]:
            needed[name] = unused.pop(name)
            waiting += _texts(needed[name])
    return dict(sorted(needed.items()))


def copies(uploads: Mapping[str, Path], target: Path) -> dict[Path, Path]:
    """Return target → source of the files of models, each model in a folder of its name below `target`."""
    return {
        target / name / file.relative_to(folder): file for name, folder in uploads.items() for file in _files(folder)
    }


def _is_named(model: str, text: bytes) -> bool:
    uri = rb"(?:model|package)://" + re.escape(escape(model).encode())
    return re.search(uri + rb"[/<\"'\s]", text) is not None


def _texts(folder: Path) -> list[bytes]:
    texts = (file for file in _files(folder) if file.suffix.lower() in _TEXTS)
    return [file.read_bytes() for file in texts if file.stat().st_size <= _MAX_TEXT_BYTES]


def _files(folder: Path) -> list[Path]:
    return sorted(path for path in folder.rglob("*") if path.is_file())
