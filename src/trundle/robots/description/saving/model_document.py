"""SDF of a single model: its original text, or its description written as SDF."""

from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.base.xmlnode import XmlDocument
from trundle.robots.model import Model, World, flattened
from trundle.robots.packages import Packages

from ..read import load_text
from ..writing import write_sdf, written_uri
from .differences import different_fields
from .new_elements import Elements
from .world_document import is_editable

_EMPTY = (1, 7)
_PLACEMENT = frozenset({"world_from_model", "name", "at"})


def copy_model(model: Model, *, packages: Packages, folder: Path) -> bytes:
    """Return a model as an SDF document: its original text with comments if unchanged, else a newly written one.

    Args:
        model: flat model with every joint at zero.
        packages: resolves URIs.
        folder: base of relative URIs.
    """
    text = _source_text(model, packages, folder)
    if text is not None and _is_same(text, model, packages, folder):
        return text
    world = World(name="", at=model.at, models=(model,))
    document = XmlDocument(write_sdf(world, is_world=False, uri_of=written_uri, report=Diagnostics()), name=model.name)
    _remove_placement(document)
    return document.text()


def _source_text(model: Model, packages: Packages, folder: Path) -> bytes | None:
    """Return the element that a model was read from as a document; None if it cannot be copied."""
    try:
        version = XmlDocument.read(Path(model.at.file)).root.get("version") or ""
        major, minor = (int(part) for part in version.split("."))
    except (DescriptionError, ValueError):
        return None
    if not is_editable((major, minor)):
        return None
    element = Elements(packages, folder, (major, minor)).copied(model)
    if element is None:
        return None
    document = XmlDocument(f'<sdf version="{version}">\n</sdf>', name=model.name)
    document.root.insert(element)
    _remove_placement(document)
    return document.text()


def _remove_placement(document: XmlDocument) -> None:
    """Remove the pose of a model in its world."""
    model = document.root.find("model")
    pose = None if model is None else model.find("pose")
    if pose is not None:
        pose.remove()
    if model is not None:
        model.set("placement_frame", None)


def _is_same(text: bytes, model: Model, packages: Packages, folder: Path) -> bool:
    try:
        loaded = load_text(text, name=model.name, folder=folder, packages=packages, report=Diagnostics())
    except DescriptionError:
        return False
    (read,) = flattened(loaded.world).models
    return all(path.split(".")[0] in _PLACEMENT for path in different_fields(read, model))


def move_uris(text: bytes, *, old_folder: Path, new_folder: Path, packages: Packages) -> bytes:
    """Return a document with its relative URIs rewritten from one folder to another."""
    document = XmlDocument(text, name="model.sdf")
    Elements(packages, new_folder, _EMPTY).move_uris(document.root, old_folder)
    return document.text()
