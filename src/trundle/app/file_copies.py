"""Copies the files that a written description needs into folders beside it."""

import os
import re
import shutil
from pathlib import Path

from trundle.base.diagnostics import Diagnostics, Source, UsageError
from trundle.base.files import read_text
from trundle.robots.description import written_uri
from trundle.robots.meshes import MeshError, Texture, load_mesh, png_of

_MAX_BYTES = 256 * 1024 * 1024
_LIBRARY = re.compile(r"^\s*mtllib\s+(.+?)\s*$", re.MULTILINE)


_IMAGES = frozenset({".bmp", ".dds", ".jpeg", ".jpg", ".png", ".tga", ".tif", ".tiff"})


class FileCopies:
    """Assigns every file a path in `meshes` or `textures` beside the output; `copy` writes them."""

    def __init__(self, output: Path, report: Diagnostics) -> None:
        self._output = output
        self._report = report
        self._places: dict[Path, Path] = {}
        """File → path relative to the output's folder."""
        self._pictures: dict[Texture, tuple[Path, bytes] | None] = {}
        """Texture → (relative path, PNG bytes); None: it cannot be decoded."""

    def relative_uri(self, path: Path | None, uri: str) -> str:
        """Relative URI of a file; one that was not found keeps its URI."""
        if path is None:
            return written_uri(path, uri)
        path = path.resolve()
        if path not in self._places:
            taken = {str(place).lower() for place in self._places.values()}
            folder = "textures" if path.suffix.lower() in _IMAGES else "meshes"
            place, number = Path(folder, path.name), 1
            while str(place).lower() in taken:
                number += 1
                place = Path(folder, f"{path.stem}_{number}{path.suffix}")
            self._places[path] = place
        return self._places[path].as_posix()

    def png_path(self, texture: Texture) -> str | None:
        """Relative path of an image as PNG, the one format that MuJoCo reads; None: it cannot be decoded."""
        if texture not in self._pictures:
            data = png_of(texture)
            name = texture.stem if isinstance(texture, Path) else "inside"
            place = Path("textures", f"{name}_{len(self._pictures)}.png")
            self._pictures[texture] = None if data is None else (place, data)
        found = self._pictures[texture]
        return None if found is None else found[0].as_posix()

    def copy(self) -> None:
        """Copy the files, their textures and material libraries with them.

        Raises:
            UsageError: the folders cannot be written.
        """
        folder = self._output.parent
        try:
            for path, place in self._places.items():
                target = folder / place
                _copy(path, target)
                for extra in _companions(path):
                    inside = extra.is_relative_to(path.parent)
                    _copy(extra, target.parent / (extra.relative_to(path.parent) if inside else extra.name))
            pictures = [each for each in self._pictures.values() if each is not None]
            for place, data in pictures:
                (folder / place).parent.mkdir(exist_ok=True)
                (folder / place).write_bytes(data)
        except OSError as error:
            raise UsageError(f"cannot write below {folder}: {error.strerror}") from None
        if count := len(self._places) + len(pictures):
            self._report.info(Source(str(self._output)), f"{count} files were copied beside it")


def _companions(path: Path) -> list[Path]:
    """Material libraries and textures that a mesh file names."""
    if path.suffix.lower() in _IMAGES:
        return []
    found: list[Path] = []
    if path.suffix.lower() == ".obj":
        libraries = _LIBRARY.findall(read_text(path, max_bytes=_MAX_BYTES))
        named = (Path(os.path.realpath(path.parent / name)) for name in libraries)
        found += [file for file in named if os.path.isfile(file)]
    try:
        found += [part.texture.resolve() for part in load_mesh(path).parts if isinstance(part.texture, Path)]
    except MeshError:
        return found  # the material libraries may be readable all the same
    return [file for file in dict.fromkeys(found) if file.is_relative_to(path.parent.parent)]


def _copy(source: Path, target: Path) -> None:
    if source != target.resolve():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
