"""Digest of everything that the results of a sweep depend on: the plan, its world as read, meshes, Python files."""

import hashlib
from collections.abc import Iterable, Iterator
from pathlib import Path

from msgspec import Struct

from trundle.model import World
from trundle.trials import Plan
from trundle.xmlnode import XmlNode


def plan_digest(plan: Plan, world: World | str, files: Iterable[Path] = ()) -> str:
    """Return a digest that changes with anything that may change a row.

    Args:
        plan: as read.
        world: world of the first row, or the text of its parameters.
        files: further files that count.
    """
    functions = {each.function[0] for each in plan.measures if each.function is not None}
    parts = [hashlib.sha256(plan.text.encode()).digest()]
    if isinstance(world, str):
        parts.append(hashlib.sha256(world.encode()).digest())
    else:
        digest, meshes = hashlib.sha256(), set[Path]()
        for part in _parts(world, meshes):
            digest.update(part.encode() + b"\0")
        parts.append(digest.digest())
        files = [*files, *sorted(meshes)]
    parts += [hashlib.sha256(path.read_bytes()).digest() for path in (*files, *sorted(functions)) if path.is_file()]
    return hashlib.sha256(b"".join(parts)).hexdigest()


def _parts(value: object, files: set[Path]) -> Iterator[str]:
    """Yield everything that is written in a world, and note its files; where it stands in a file does not count."""
    if isinstance(value, Path):
        files.add(value)
    elif isinstance(value, XmlNode):
        yield value.xml()
    elif isinstance(value, Struct):
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
