"""Copies the files that a written description needs into a folder beside it."""

import re
import shutil
from pathlib import Path

from trundle.description import written_uri
from trundle.diagnostics import Diagnostics, Source, UsageError
from trundle.meshes import MeshError, load_mesh
from trundle.model import Heightmap, MeshFile

_LIBRARY = re.compile(r"^\s*mtllib\s+(.+?)\s*$", re.MULTILINE)


class MeshCopies:
    """Gives every mesh and terrain a place in `meshes` beside the output, and puts them there when asked."""

    def __init__(self, output: Path, report: Diagnostics) -> None:
        self._folder = output.parent / "meshes"
        self._report = report
        self._names: dict[Path, str] = {}

    def uri_of(self, shape: MeshFile | Heightmap) -> str:
        """A relative URI; that of a file that was not found stays as written."""
        if shape.path is None:
            return written_uri(shape)
        path = shape.path.resolve()
        if path not in self._names:
            taken = {name.lower() for name in self._names.values()}
            name, number = path.name, 1
            while name.lower() in taken:
                number += 1
                name = f"{path.stem}_{number}{path.suffix}"
            self._names[path] = name
        return f"{self._folder.name}/{self._names[path]}"

    def copy(self) -> None:
        """Copy the files, their textures and material libraries with them.

        Raises:
            UsageError: the folder cannot be written.
        """
        try:
            for path, name in self._names.items():
                self._folder.mkdir(parents=True, exist_ok=True)
                _copy(path, self._folder / name)
                for extra in _companions(path):
                    inside = extra.is_relative_to(path.parent)
                    _copy(extra, self._folder / (extra.relative_to(path.parent) if inside else extra.name))
        except OSError as error:
            raise UsageError(f"cannot write {self._folder}: {error.strerror}") from None
        if self._names:
            self._report.info(Source(str(self._folder)), f"{len(self._names)} files were copied here")


def _companions(path: Path) -> list[Path]:
    """What a mesh file names in its turn."""
    found: list[Path] = []
    if path.suffix.lower() == ".obj":
        libraries = _LIBRARY.findall(path.read_text(encoding="utf-8", errors="replace"))
        found += [file for name in libraries if (file := (path.parent / name).resolve()).is_file()]
    try:
        found += [part.texture.resolve() for part in load_mesh(path).parts if part.texture is not None]
    except MeshError:
        return found  # a terrain's image, or what the description's reader has named already
    return [file for file in dict.fromkeys(found) if file.is_relative_to(path.parent.parent)]


def _copy(source: Path, target: Path) -> None:
    if source != target.resolve():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
