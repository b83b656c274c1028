"""Copies the files of a written description into folders beside it."""

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
    """Assigns each file a path in `meshes` or `textures` beside the output; `copy` writes the files."""

    def __init__(self, output: Path, report: Diagnostics) -> None:
        self._output = output
        self._report = report
        self._targets: dict[Path, Path] = {}
        """File → path relative to the output's folder."""
        self._pictures: dict[Texture, tuple[Path, bytes] | None] = {}
        """Texture → (relative path, PNG bytes); None: it cannot be decoded."""

    def relative_uri(self, path: Path | None, uri: str) -> str:
        """Return the relative URI of a file; a missing file keeps its URI."""
        if path is None:
            return written_uri(path, uri)
        path = path.resolve()
        if path not in self._targets:
            used = {str(target).lower() for target in self._targets.values()}
            folder = "textures" if path.suffix.lower() in _IMAGES else "meshes"
            target, number = Path(folder, path.name), 1
            while str(target).lower() in used:
                number += 1
                target = Path(folder, f"{path.stem}_{number}{path.suffix}")
            self._targets[path] = target
        return self._targets[path].as_posix()

    def png_path(self, texture: Texture) -> str | None:
        """Return the relative path of an image as PNG, MuJoCo's only format; None: it cannot be decoded."""
        if texture not in self._pictures:
            data = png_of(texture)
            name = texture.stem if isinstance(texture, Path) else "inside"
            target = Path("textures", f"{name}_{len(self._pictures)}.png")
            self._pictures[texture] = None if data is None else (target, data)
        result = self._pictures[texture]
        return None if result is None else result[0].as_posix()

    def copy(self) -> None:
        """Copy the files with their textures and material libraries.

        Raises:
            UsageError: the folders cannot be written.
        """
        folder = self._output.parent
        try:
            for path, relative_path in self._targets.items():
                target = folder / relative_path
                _copy(path, target)
                for extra in _companions(path):
                    is_inside = extra.is_relative_to(path.parent)
                    _copy(extra, target.parent / (extra.relative_to(path.parent) if is_inside else extra.name))
            pictures = [picture for picture in self._pictures.values() if picture is not None]
            for target, data in pictures:
                (folder / target).parent.mkdir(exist_ok=True)
                (folder / target).write_bytes(data)
        except OSError as error:
            raise UsageError(f"cannot write below {folder}: {error.strerror}") from None
        if count := len(self._targets) + len(pictures):
            self._report.info(Source(str(self._output)), f"{count} files were copied beside it")


def _companions(path: Path) -> list[Path]:
    """Return the material libraries and textures of a mesh file."""
    if path.suffix.lower() in _IMAGES:
        return []
    result: list[Path] = []
    if path.suffix.lower() == ".obj":
        libraries = _LIBRARY.findall(read_text(path, max_bytes=_MAX_BYTES))
        library_paths = (Path(os.path.realpath(path.parent / name)) for name in libraries)
        result += [file for file in library_paths if os.path.isfile(file)]
    try:
        result += [part.texture.resolve() for part in load_mesh(path).parts if isinstance(part.texture, Path)]
    except MeshError:
        return result  # the material libraries may still be readable
    return [file for file in dict.fromkeys(result) if file.is_relative_to(path.parent.parent)]


def _copy(source: Path, target: Path) -> None:
    if source != target.resolve():
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(source, target)
