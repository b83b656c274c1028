"""Digest of everything that the results of a sweep depend on: the plan, what it simulates, files by their content."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from msgspec import Struct

from trundle.meshes import MeshError, load_mesh
from trundle.model import PluginTag, World
from trundle.plugins import find_user_file
from trundle.trials import Plan
from trundle.xmlnode import XmlNode

_MESHES = frozenset({".dae", ".obj", ".glb", ".stl"})


@dataclass(frozen=True, slots=True, kw_only=True)
class RunInputs:
    """Inputs of a run beside its plan."""

    worlds: tuple[World, ...]
    """Worlds and spawned models, as read."""
    texts: tuple[str, ...] = ()
    files: tuple[Path, ...] = ()


def plan_digest(plan: Plan, inputs: RunInputs) -> str:
    """Return a digest that changes with anything that may change a row.

    Args:
        plan: as read.
        inputs: of the first row.
    """
    functions = {each.function[0] for each in plan.measures if each.function is not None}
    files = {*inputs.files, *functions}
    digest = hashlib.sha256()
    for part in (plan.text, *inputs.texts, *(part for world in inputs.worlds for part in _parts(world, files))):
        digest.update(part.encode() + b"\0")
    for path in sorted(files | _textures(files)):
        if path.is_file():
            digest.update(hashlib.sha256(path.read_bytes()).digest())
    return digest.hexdigest()


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


def _textures(files: Iterable[Path]) -> set[Path]:
    """Return the images that meshes name."""
    found: set[Path] = set()
    for path in files:
        if path.suffix.lower() in _MESHES:
            with suppress(MeshError):  # the run says so
                found |= {part.texture for part in load_mesh(path).parts if isinstance(part.texture, Path)}
    return found
