"""Search for a material by name in a description's scripts, and for its texture."""

import os
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.base.files import read_text
from trundle.base.xmlnode import XmlNode
from trundle.robots.model import Material
from trundle.robots.packages import Packages, is_stand_in

from .script import Block, parse_script
from .surface import name_of, parent_of, read_surface

_MAX_BYTES = 4 * 1024 * 1024
_DEFAULT = "media/materials/scripts/gazebo.material"
"""Gazebo's own script, whose colors are built in."""


def find_material(name: str, script: XmlNode, *, packages: Packages, report: Diagnostics) -> Material | None:
    """Return the material of that name, or None if no script has it.

    Args:
        name: name of the material.
        script: element whose <uri> children name script files, folders of scripts and folders of textures.
        packages: resolves URIs; scripts in its resource folders are searched too, as in Gazebo.
        report: receives warnings of unreadable files.
    """
    folder = Path(script.at.file).parent
    paths = [path for uri in script.all("uri") if (path := _resolved(uri, folder, packages, report)) is not None]
    search_paths = [*paths, *packages.material_folders()]
    materials: dict[str, Block] = {}
    for file in _scripts(search_paths):
        for material in _read(file, report):
            materials.setdefault(name_of(material), material)
    if name not in materials:
        return None
    at = materials[name].at
    parent = parent_of(materials[name])
    if parent is not None and parent not in materials:
        report.warn(
            at, f"material {name!r}: no material {parent!r} to inherit from; it is left out", "missing-material"
        )
    surface = read_surface(name, materials)
    texture = None
    if surface.texture is not None:
        texture = _texture(surface.texture, [Path(at.file), *search_paths], at, packages, report)
    return Material(
        ambient=surface.ambient,
        diffuse=surface.diffuse,
        specular=surface.specular,
        emissive=surface.emissive,
        texture=texture,
        texture_scale=surface.texture_scale,
    )


def _resolved(uri: XmlNode, folder: Path, packages: Packages, report: Diagnostics) -> Path | None:
    try:
        return packages.resolve(uri.text, folder=folder, at=uri.at)
    except DescriptionError as error:
        if not uri.text.endswith(_DEFAULT) and not _is_in_stand_in(uri.text, packages):
            report.warn(error.at, f"{error.what}; it is left out", error.id)
        return None


def _is_in_stand_in(uri: str, packages: Packages) -> bool:
    """True if a model:// URI is in a stand-in, which has no scripts; the caller warns of the unknown material."""
    scheme, _, rest = uri.partition("://")
    try:
        return scheme == "model" and is_stand_in(packages.find_model(rest.partition("/")[0]))
    except UsageError:
        return False


def _scripts(paths: Iterable[Path]) -> list[Path]:
    files: list[Path] = []
    for path in paths:
        files += sorted(path.glob("*.material")) if path.is_dir() else [path] * (path.suffix == ".material")
    return files


def _read(file: Path, report: Diagnostics) -> tuple[Block, ...]:
    try:
        return _materials(file, file.stat().st_mtime_ns)
    except DescriptionError as error:
        report.warn(error.at, f"{error.what}; this material script is left out", error.id)
    except OSError as error:
        report.warn(
            Source(str(file)), f"cannot be read: {error.strerror}; this material script is left out", "unreadable-file"
        )
    return ()


@lru_cache(maxsize=256)
def _materials(file: Path, _changed_ns: int) -> tuple[Block, ...]:
    top = parse_script(read_text(file, max_bytes=_MAX_BYTES), name=str(file))
    return tuple(block for block in top.blocks if block.header[0] == "material" and len(block.header) > 1)


def _texture(
    name: str, search_paths: Iterable[Path], at: Source, packages: Packages, report: Diagnostics
) -> Path | None:
    """Find a texture file in a named folder, or in `textures` beside the scripts."""
    for search_path in search_paths:
        folder = search_path if search_path.is_dir() else search_path.parent
        for path in (folder / name, folder.parent / "textures" / name):
            if os.path.isfile(path):
                try:
                    packages.check_readable(path, at, name=f"texture {name!r}", root=folder.parent)
                except DescriptionError as error:
                    report.warn(error.at, f"{error.what}; it is left out", error.id)
                    return None
                return path
    report.warn(at, f"no texture {name!r} in the folders named, nor in a folder textures beside the script", "texture")
    return None
