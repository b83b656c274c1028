"""Saving of the running world as SDF, below the folder where the simulation was started."""

import os
import re
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path, PurePosixPath

from trundle.atomic_write import write_atomically
from trundle.description import save_world
from trundle.diagnostics import TrundleError, UsageError
from trundle.model import World
from trundle.packages import Packages
from trundle.page import SaveWorld

from .controls import reason_of

_SUFFIXES = (".sdf", ".world")
_PART = re.compile(r"\w[\w .+-]{0,99}")
"""Name of a file or folder: neither hidden, nor `..`, nor with separators of any system."""
_MAX_LOST = 20
_MAX_WAITING = 4


class WorldSaver:
    """Writes worlds on a thread of its own; `respond` is called there with the request's id, an error or fields."""

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

    def offered_file(self, world: World) -> str | None:
        """Return the path to offer, from the root: the world's own file, or one named after it; None: not writable."""
        if not os.access(self._root, os.W_OK):
            return None
        source = Path(os.path.abspath(world.at.file))
        if source.is_relative_to(self._root) and source.suffix in _SUFFIXES and source.is_file():
            return source.relative_to(self._root).as_posix()
        return f"{re.sub(r'[^A-Za-z0-9_-]+', '_', world.name).strip('_') or 'world'}.sdf"

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
            self._respond(request_id, **self._saved(request, world, seed))
        except TrundleError as error:
            self._respond(request_id, reason_of(error))
        except Exception as error:  # a world that the writer does not foresee; the simulation goes on
            self._respond(request_id, f"the world cannot be saved: {type(error).__name__}: {error}")
        finally:
            self._waiting -= 1

    def _saved(self, request: SaveWorld, world: World, seed: int) -> dict[str, object]:
        file = self._root / "world.sdf" if request.file is None else find_target(self._root, request.file)
        if request.file is not None and file.exists() and not request.replace:
            return {"exists": request.file}
        saved = save_world(world, file=file, packages=self._packages, seed=seed)
        sdf, uploaded = name_uploads(saved.sdf.decode(), self._packages)
        lost = {"lost": (*uploaded, *saved.lost)[:_MAX_LOST]}
        if request.file is None:
            return {"sdf": sdf, **lost}
        if not write_file(self._root, file, sdf.encode(), replace=request.replace):
            return {"exists": request.file}
        return {"file": request.file, **lost}

    def close(self) -> None:
        """Stop after the world that is being saved."""
        self._thread.shutdown(wait=False, cancel_futures=True)


def name_uploads(sdf: str, packages: Packages) -> tuple[str, list[str]]:
    """Return a world with files of uploaded models as model:// URIs, and what of them it needs."""
    needed: list[str] = []
    for folder in packages.added_models:
        sdf = sdf.replace(f"file://{folder.resolve()}/", "model://")
        names = sorted(each.name for each in folder.iterdir() if f"model://{each.name}/" in sdf)
        needed += [f"the files of the uploaded model {name!r}: put its folder on GAZEBO_MODEL_PATH" for name in names]
    return sdf, needed


def find_target(root: Path, name: str) -> Path:
    """Return the file of a name from the page, below a folder.

    Raises:
        UsageError: it leads elsewhere, or is no name for a world.
    """
    parts = name.split("/")
    if not all(map(is_file_name, parts)):
        raise UsageError(
            f"{name!r}: a world is saved below the folder where Trundle was started; write a name such as "
            "worlds/mine.sdf, of letters, digits, blanks and . _ + -"
        )
    if PurePosixPath(name).suffix not in _SUFFIXES:
        raise UsageError(f"{name!r}: the name of a world ends in {' or '.join(_SUFFIXES)}")
    target = root.joinpath(*parts)
    check_inside(root, target)
    return target


def is_file_name(part: str) -> bool:
    """True for the name of a file or folder that can be written on any system."""
    return _PART.fullmatch(part) is not None and not part.endswith((" ", "."))


def check_inside(root: Path, target: Path) -> None:
    """Refuse a file that a link leads out of the root, or that is none."""
    folder = target.parent
    while not os.path.lexists(folder):
        folder = folder.parent
    inside = Path(os.path.realpath(folder)).is_relative_to(os.path.realpath(root))
    if not inside or target.is_symlink():
        raise UsageError(f"{target.relative_to(root)}: a link leads elsewhere; choose another name")
    if not folder.is_dir() or (target.exists() and not target.is_file()):
        raise UsageError(f"{target.relative_to(root)}: this is no file; choose another name")


def write_file(root: Path, file: Path, content: bytes, *, replace: bool) -> bool:
    """Write a file; False: another one has come into the way.

    Raises:
        UsageError: it cannot be written.
    """
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        check_inside(root, file)
        if replace:
            write_atomically(file, content)
            return True
        with file.open("xb") as new:
            new.write(content)
    except FileExistsError:
        return False
    except OSError as error:
        raise UsageError(f"cannot write {file.relative_to(root)}: {error.strerror}") from None
    return True
