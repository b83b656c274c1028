"""Saving the running world as SDF, below the folder where the simulation was started."""

import os
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.output_folder import find_target, save_files
from trundle.page import SaveWorld
from trundle.robots.description import save_world
from trundle.robots.model import World
from trundle.robots.packages import Packages

from ..requests.answers import FilesExist, SavedWorld, WorldText
from .controls import reason_of
from .uploaded_files import copies, needed_uploads, with_upload_uris

_SUFFIXES = (".sdf", ".world")
_MAX_LOST = 20
_MAX_WAITING = 4


class WorldSaver:
    """Writes worlds on its own thread; `respond` is called there with the request's id, an error or answer."""

    def __init__(self, respond: Callable[..., None], packages: Packages, root: Path) -> None:
        """Create it.

        Args:
            respond: answers a request.
            packages: resolves URIs.
            root: folder that worlds are saved below.
        """
        self._respond = respond
        self._packages = packages
        self._root = root
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-save")
        self._waiting = 0
        self._newest: str | None = None
        """Path of the file saved last, relative to the root."""
        self._announced: str | None = None

    def offered_file(self, world: World) -> str | None:
        """Return the path to offer for saving, relative to the root; None: the root is not writable.

        It is the file saved last, the world's source file, or a name from the world's.
        """
        if not os.access(self._root, os.W_OK):
            return None
        if self._newest is not None and (self._root / self._newest).is_file():
            return self._newest
        source = Path(os.path.abspath(world.at.file))
        if source.is_relative_to(self._root) and source.suffix in _SUFFIXES and source.is_file():
            return source.relative_to(self._root).as_posix()
        return f"{re.sub(r'[^A-Za-z0-9_-]+', '_', world.name).strip('_') or 'world'}.sdf"

    def poll_newest(self) -> bool:
        """Tell if the file saved last has changed since the last call."""
        is_new = self._newest != self._announced
        self._announced = self._newest
        return is_new

    def save(self, request_id: int, request: SaveWorld, world: World, seed: int) -> None:
        """Queue a request to save a world; return at once.

        Args:
            request_id: request to answer.
            request: file to write.
            world: flat world in its current state.
            seed: simulation's seed.

        Raises:
            UsageError: too many requests wait.
        """
        if self._waiting >= _MAX_WAITING:
            raise UsageError(f"{_MAX_WAITING} worlds are being saved already")
        self._waiting += 1
        self._thread.submit(self._run, request_id, request, world, seed)

    def _run(self, request_id: int, request: SaveWorld, world: World, seed: int) -> None:
        try:
            self._respond(request_id, answer=self._saved(request, world, seed))
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except Exception as error:  # a fault of the writer must not end the simulation
            self._respond(request_id, f"the world cannot be saved: {type(error).__name__}: {error}")
        finally:
            self._waiting -= 1

    def _saved(self, request: SaveWorld, world: World, seed: int) -> SavedWorld | WorldText | FilesExist:
        name = request.file
        file = self._root / "world.sdf" if name is None else find_world(self._root, name)
        saved = save_world(world, file=file, packages=self._packages, seed=seed)
        sdf = with_upload_uris(saved.sdf, self._packages)
        uploads = needed_uploads(sdf, self._packages)
        if name is None:
            needed = (f"the uploaded model {model!r}: put its folder next to the file" for model in uploads)
            return WorldText(sdf=sdf.decode(), lost=(*needed, *saved.lost)[:_MAX_LOST])
        exists = save_files(self._root, {**copies(uploads, file.parent), file: sdf}, replace=request.replace)
        if exists is not None:
            return FilesExist(exists=exists)
        self._newest = name
        return SavedWorld(file=name, lost=saved.lost[:_MAX_LOST])

    def close(self) -> None:
        """Stop after the current world."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def find_world(root: Path, name: str) -> Path:
    """Return the path of a world's file; raises UsageError."""
    return find_target(root, name, example="worlds/mine.sdf", suffixes=_SUFFIXES)
