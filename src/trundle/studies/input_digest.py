"""Digest of inputs: texts, worlds, and files by content."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from msgspec import Struct

from trundle.base.xmlnode import XmlNode
from trundle.gazebo.plugins import find_user_file
from trundle.robots.meshes import referenced_files
from trundle.robots.model import PluginTag, World


def input_digest(texts: Iterable[str], worlds: Iterable[World], files: Iterable[Path]) -> str:
    """Return a digest of the content of all inputs.

    Args:
        texts: texts; their order matters.
        worlds: worlds with their included models, meshes, textures and plugin code; positions in files do not matter.
        files: further files; files referenced by meshes among them are included.
    """
    all_files, digest = set(files), hashlib.sha256()
    for part in (*texts, *(part for world in worlds for part in _parts(world, all_files))):
        digest.update(part.encode("utf-8", "surrogateescape") + b"\0")
    for path in sorted(all_files.union(*map(referenced_files, all_files))):
        digest.update(_content(path))
    return digest.hexdigest()


def _content(path: Path) -> bytes:
    """Return the digest of a file, also of a missing or unreadable one."""
    try:
        return hashlib.sha256(path.read_bytes() if path.is_file() else b"").digest()
    except OSError as error:
        return hashlib.sha256(str(error.errno).encode()).digest()


def _parts(value: object, files: set[Path]) -> Iterator[str]:
    """Yield all values of a world, except for positions in files, and collect its files."""
    if isinstance(value, Path):
        files.add(value)
    elif isinstance(value, XmlNode):
        yield value.xml()
    elif isinstance(value, Struct):
        if isinstance(value, PluginTag) and (code := find_user_file(value, os.environ)) is not None:
            files.add(code)
        yield type(value).__name__
        for name in value.__struct_fields__:
            if name != "at":
                yield name
                yield from _parts(getattr(value, name), files)
    elif isinstance(value, tuple):
        yield f"{len(value)}"
        for item in value:
            yield from _parts(item, files)
    else:
        yield repr(value)
