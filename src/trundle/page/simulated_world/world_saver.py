"""Saving of the running world as SDF, below the folder where the simulation was started."""

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
from .uploaded_files import copies, needed_uploads, with_uploads_named

_SUFFIXES = (".sdf", ".world")
_MAX_LOST = 20
_MAX_WAITING = 4


class WorldSaver:
    """Writes worlds on a thread of its own; `respond` is called there with the request's id, an error or answer."""

    def __init__(self, respond: Callable[..., None], packages: Packages, root: Path) -> None:
        """Prepare.

        Args:
            respond: answers a request.
            packages: resolve URIs.
            root: folder to write below.
        """
        self._respond = respond
        self._packages = packages
        self._root = root
        self._thread = ThreadPoolExecutor(1, thread_name_prefix="trundle-page-save")
        self._waiting = 0
        self._newest: str | None = None
        """Path from the root of the file that was saved last."""
        self._announced: str | None = None

    def offered_file(self, world: World) -> str | None:
        """Return the path to offer, from the root; None: not writable.

        The file that was saved last, the world's own, or one named after it.
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
        """Tell if another file is the newest since the last call."""
        is_other = self._newest != self._announced
        self._announced = self._newest
        return is_other

    def save(self, request_id: int, request: SaveWorld, world: World, seed: int) -> None:
        """Write a world; returns at once.

        Args:
            request_id: of the request.
            request: where to write it.
            world: flat, as it is now.
            seed: of the simulation.

        Raises:
            UsageError: too many wait.
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
        except Exception as error:  # a world that the writer does not foresee; the simulation goes on
            self._respond(request_id, f"the world cannot be saved: {type(error).__name__}: {error}")
        finally:
            self._waiting -= 1

    def _saved(self, request: SaveWorld, world: World, seed: int) -> SavedWorld | WorldText | FilesExist:
        name = request.file
        file = self._root / "world.sdf" if name is None else find_world(self._root, name)
        saved = save_world(world, file=file, packages=self._packages, seed=seed)
        sdf = with_uploads_named(saved.sdf, self._packages)
        uploads = needed_uploads(sdf, self._packages)
        if name is None:
            needed = (f"the uploaded model {each!r}: put its folder beside it" for each in uploads)
            return WorldText(sdf=sdf.decode(), lost=(*needed, *saved.lost)[:_MAX_LOST])
        exists = save_files(self._root, {**copies(uploads, file.parent), file: sdf}, replace=request.replace)
        if exists is not None:
            return FilesExist(exists=exists)
        self._newest = name
        return SavedWorld(file=name, lost=saved.lost[:_MAX_LOST])

    def close(self) -> None:
        """Stop after the world that is being saved."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def find_world(root: Path, name: str) -> Path:
    """Return the file of a world's name from the page; raises UsageError."""
    return find_target(root, name, example="worlds/mine.sdf", suffixes=_SUFFIXES)
