"""Temporary folder of uploaded models, removed at the end of the page."""

import asyncio
import os
import shutil
import tempfile
from collections.abc import Callable, Mapping
from pathlib import Path, PurePosixPath

import msgspec
from aiohttp import BodyPartReader, MultipartReader

from trundle.base.diagnostics import UsageError
from trundle.base.output_folder import is_portable
from trundle.robots.packages import HELD_SUFFIX, Packages, is_stand_in

from .archive import unpack
from .model import find_models
from .tree import MAX_BYTES, UploadTree

_MAX_RUN_BYTES = 4 * MAX_BYTES
_CHUNK_BYTES = 256 * 1024
_TIMEOUT_S = 600.0
_ARCHIVE = ".zip"


class UploadedModels(msgspec.Struct, frozen=True):
    """Answer to an upload."""

    models: tuple[str, ...]
    """Names of the models that can now be inserted."""


class Uploads:
    """Receives one upload at a time; used on the loop only."""

    def __init__(
        self, on_created: Callable[[Path], None], environment: Mapping[str, str], *, folder: Path | None = None
    ) -> None:
        """Create it.

        Args:
            on_created: called with the folder after its creation; each of its folders is a model.
            environment: variables with the model path, whose models cannot be replaced by uploads.
            folder: folder of an earlier server; None: the first upload creates one.
        """
        self._on_created, self._environment = on_created, environment
        self._folder = folder
        self._is_busy = False

    async def receive(self, parts: MultipartReader) -> list[str]:
        """Receive a model's files or its .zip, and return the names of the models that `model://` now finds.

        Args:
            parts: form with a file in each field; the field's name is the path.

        Raises:
            UsageError: the upload has no model or is refused.
        """
        if self._is_busy:
            raise UsageError("another model is being uploaded")
        self._is_busy = True
        try:
            folder = self._open_folder()
            with tempfile.TemporaryDirectory(prefix="trundle-upload-", dir=folder.parent) as staging:
                tree = UploadTree(Path(staging) / "sent", max_bytes=_MAX_RUN_BYTES - _size(folder))
                async with asyncio.timeout(_TIMEOUT_S):
                    first = await _write_parts(parts, tree)
                return await asyncio.to_thread(self._install, tree, first, folder)
        except TimeoutError:
            raise UsageError(f"the upload took more than {_TIMEOUT_S:.0f} s") from None
        except OSError as error:
            raise UsageError(f"the upload cannot be stored: {error.strerror}") from None
        finally:
            self._is_busy = False

    def _install(self, tree: UploadTree, first: str, folder: Path) -> list[str]:
        """Move the models of an upload into the folder, replacing earlier ones of the same names."""
        archive, root = tree.root / first, tree.root
        if first.lower().endswith(_ARCHIVE) and archive.is_file():
            opened = UploadTree(root.with_name("opened"), max_bytes=_MAX_RUN_BYTES - _size(folder))
            opened.root.mkdir()
            unpack(archive, opened)
            root = opened.root
        models = find_models(root, PurePosixPath(first).stem)
        present = Packages(self._environment, start=Path.cwd()).models()
        for name in models:
            if not is_portable(name):
                raise UsageError(f"{name!r} is not a valid folder name")
            if name in present and not is_stand_in(present[name] / name):
                raise UsageError(f"a model {name!r} is on the model path already; rename the uploaded folder")
        for name, source in models.items():
            _hold_code(source)
            if (folder / name).exists():
                (folder / name).rename(tree.root.with_name(f"before {name}"))
            source.rename(folder / name)
        return list(models)

    def _open_folder(self) -> Path:
        """Return the folder, which is created for the first upload."""
        if self._folder is None:
            self._folder = Path(tempfile.mkdtemp(prefix="trundle-models-")) / "models"
            self._folder.mkdir()
            self._on_created(self._folder)
        return self._folder

    def close(self) -> None:
        """Remove all uploads."""
        if self._folder is not None:
            shutil.rmtree(self._folder.parent, ignore_errors=True)


def _hold_code(folder: Path) -> None:
    """Rename a model's files of code, so that nothing runs them before the user consents, and libraries never."""
    for file in [file for file in folder.rglob("*") if file.suffix.lower() in (".py", ".so", ".dylib")]:
        file.rename(f"{file}{HELD_SUFFIX}")


async def _write_parts(parts: MultipartReader, tree: UploadTree) -> str:
    """Write a form's files into a tree; return the first part of the first file's path."""
    tree.root.mkdir()
    first = ""
    while (part := await parts.next()) is not None:
        if not isinstance(part, BodyPartReader) or not part.name:
            raise UsageError("a file of the form has no name")
        first = first or part.name.partition("/")[0]
        file = tree.create(part.name)
        if file is None:
            await part.release()
            continue
        with file:
            while piece := await part.read_chunk(_CHUNK_BYTES):
                tree.write(file, piece)
    if not first:
        raise UsageError("no file was sent")
    return first


def _size(folder: Path) -> int:
    """Return the size of a folder's files [B]."""
    return sum(os.lstat(os.path.join(parent, name)).st_size for parent, _, names in os.walk(folder) for name in names)
