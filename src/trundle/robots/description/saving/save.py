"""Saving of a world as SDF: edits of its original file, which keep comments and unknown elements."""

import os
from pathlib import Path

from msgspec import Struct

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlDocument
from trundle.robots.model import World, flattened
from trundle.robots.packages import Packages

from ..read import load_text
from .differences import differences
from .new_elements import Elements
from .world_document import WorldDocument, is_editable, new_document

_ROUNDS = 5
"""Maximum number of rounds of edits; an edit may move other elements whose poses are relative to the edited one."""
_PATCHED_ROUNDS = 3
"""Number of rounds after which elements that still differ are written anew from the model."""
_NEWEST = "1.12"
"""Version assumed for a file that states none."""


class SavedWorld(Struct, frozen=True, kw_only=True):
    """World as SDF, and the differences that SDF cannot express."""

    sdf: bytes
    lost: tuple[str, ...]
    """Differences from the world when the text is read again."""


def save_world(world: World, *, file: Path, packages: Packages, seed: int = 0) -> SavedWorld:
    """Return a world as SDF, without velocities: a loaded world starts at rest.

    Args:
        world: flat world at its current poses; links away from their joints' zeros have an initial pose.
        file: path of the saved file, the base of relative URIs.
        packages: resolves URIs.
        seed: seed of random placement with which the world was read.

    Raises:
        DescriptionError: the world cannot be read back.
    """
    source = Path(world.at.file)
    editable = world.sdf_version is not None and is_editable(_version(world.sdf_version))
    document = _source_document(source) if editable else None
    if document is None:
        document, source = new_document(world), file
    elements = Elements(packages, file.parent, _version(document.root.get("version") or _NEWEST))
    edited = WorldDocument(document, source, elements)
    current = _read(edited.text(), file, packages, seed)
    for number in range(_ROUNDS):
        if not differences(current, world):
            break
        edited.change(current, world, rewrite=number >= _PATCHED_ROUNDS)
        current = _read(edited.text(), file, packages, seed)
    return SavedWorld(sdf=edited.text(), lost=tuple(differences(current, world)))


def _source_document(source: Path) -> XmlDocument | None:
    """Return the document of a world's file; None if it cannot be read or has no <world>."""
    if not os.path.isfile(source):
        return None
    try:
        document = XmlDocument.read(source)
    except DescriptionError:
        return None
    root = document.root
    return document if root.tag == "sdf" and root.find("world") is not None else None


def _read(text: bytes, file: Path, packages: Packages, seed: int) -> World:
    around = packages.around(file)
    loaded = load_text(text, name=file.name, folder=file.parent, packages=around, report=Diagnostics(), seed=seed)
    return flattened(loaded.world)


def _version(text: str) -> tuple[int, int]:
    major, minor = text.split(".")
    return int(major), int(minor)
