"""Digest of what results depend on: texts, worlds, and files by their content."""

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
    """Return a digest that changes with the content of anything given.

    Args:
        texts: in their order.
        worlds: as read; included models, meshes, their textures and the code of plugins count, places in files do not.
        files: further files; those that meshes among them name count, too.
    """
    found, digest = set(files), hashlib.sha256()
    for part in (*texts, *(part for world in worlds for part in _parts(world, found))):
        digest.update(part.encode("utf-8", "surrogateescape") + b"\0")
    for path in sorted(found.union(*map(referenced_files, found))):
        digest.update(_content(path))
    return digest.hexdigest()


def _content(path: Path) -> bytes:
    """Return the digest of a file; a missing or unreadable one has its own."""
    try:
        return hashlib.sha256(path.read_bytes() if path.is_file() else b"").digest()
    except OSError as error:
        return hashlib.sha256(str(error.errno).encode()).digest()


def _parts(value: object, files: set[Path]) -> Iterator[str]:
    """Yield everything that is written in a world, and note its files; where it stands in a file does not count."""
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
        for each in value:
            yield from _parts(each, files)
    else:
        yield repr(value)
