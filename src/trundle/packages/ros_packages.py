"""Where ROS packages live: by the name in package.xml, and by the name of the folder."""

import os
import re
from collections import deque
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TypeAlias

from .workspace import MANIFESTS, PARTS, own_package, workspaces

_DEEPEST = 8
"""How far below a package path packages are looked for; rospack has no bound, real workspaces need five."""
_MOST_GUESSED = 5000
"""Folders looked at where nobody said that packages are: a home folder has more than one wants to wait for."""
_NOT_CRAWLED = frozenset({"build", "node_modules", "__pycache__"})
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NAME = re.compile(r"<name>\s*([\w.-]+)\s*</name>")
_IGNORED_BY = ("CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE")
_ALONE_BY = frozenset({*MANIFESTS, "rospack_nosubdirs"})
"""Below a folder with one of these there are no packages."""
SHIPPED = Path(__file__).parent / "ros"
"""Packages of our own: for the few stock ones that launch files only take a file from, and the examples."""
_INSTALLED = Path("/usr/share")
"""Debian's packages of ROS; its rospack looks there last, whatever ROS_PACKAGE_PATH says."""
_CHECKOUT_EXAMPLES = Path(__file__).parents[3] / "examples"


_Folder: TypeAlias = tuple[Path, str | None]
"""A folder that may be meant by its own name, and the name that its manifest gives it, if it has one."""


class RosPackages:
    """An index of the packages below some folders, made when first asked."""

    def __init__(self, environment: Mapping[str, str], start: Path, known: "RosPackages | None" = None) -> None:
        """Look along ROS_PACKAGE_PATH, in the workspace around `start`, then beside the package `start` is in.

        Args:
            environment: says where packages are.
            start: a file or folder.
            known: an index whose walks through folders need not be made again.
        """
        entries = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        start = start.resolve()
        self.roots = [*(Path(entry).expanduser().absolute() for entry in entries if entry), *workspaces(start)]
        """Folders that are there to hold packages."""
        own = own_package(start)
        self._guessed = [] if own is None or own.parent in self.roots else [own, own.parent]
        self._walks: dict[tuple[Path, int | None], list[_Folder]] = {} if known is None else known._walks
        self._by_name: dict[str, Path] | None = None
        self._folders: dict[str, Path] = {}

    def find(self, name: str) -> Path | None:
        """The folder of a package: by its manifest's name, else by the folder's own name."""
        return self.all().get(name) or self._folders.get(name)

    def all(self) -> Mapping[str, Path]:
        """Every package that has a manifest, by name; the first of a name wins."""
        if self._by_name is None:
            self._by_name = {}
            for root in self.roots:
                self._crawl(root)
            for root in self._guessed:
                self._crawl(root, most=_MOST_GUESSED)
            self._crawl(SHIPPED)
            if (_CHECKOUT_EXAMPLES / "smartcar").is_dir():
                self._crawl(_CHECKOUT_EXAMPLES)
            for folder, name in _installed():
                if name not in self._folders:
                    self._by_name.setdefault(name, folder)
        return self._by_name

    def searched(self) -> list[Path]:
        """Where `find` looks, in order."""
        return [*self.roots, *self._guessed[1:]]

    def _crawl(self, root: Path, *, most: int | None = None) -> None:
        assert self._by_name is not None
        if (root, most) not in self._walks:
            self._walks[root, most] = list(_packages_below(root, most))
        for folder, name in self._walks[root, most]:
            if name is not None:
                self._by_name.setdefault(name, folder)
            self._folders.setdefault(folder.name, folder)


def _installed() -> Iterator[tuple[Path, str]]:
    """Those right below the system's folder: it holds much else, so none is looked for further down."""
    if _INSTALLED.is_dir():
        folders = (Path(entry.path) for entry in os.scandir(_INSTALLED))
        yield from ((folder, _package_name(folder)) for folder in folders if (folder / MANIFESTS[0]).is_file())


def _packages_below(root: Path, most: int | None) -> Iterator["_Folder"]:
    for folder, names in _walk(root, most):
        if not names.isdisjoint(MANIFESTS):
            yield folder, _package_name(folder)
        elif not names.isdisjoint(PARTS):
            yield folder, None


def _walk(root: Path, most: int | None) -> Iterator[tuple[Path, set[str]]]:
    """Every folder and the names in it, the nearest first; what lies inside a package is not looked at."""
    waiting = deque([(root, 0)])
    looked_at = 0
    while waiting and (most is None or looked_at < most):
        folder, depth = waiting.popleft()
        looked_at += 1
        try:
            with os.scandir(folder) as listing:
                entries = sorted(listing, key=lambda entry: entry.name)
        except OSError:
            continue
        names = {entry.name for entry in entries}
        if names.intersection(_IGNORED_BY):
            continue
        yield folder, names
        if depth < _DEEPEST and names.isdisjoint(_ALONE_BY):
            waiting.extend((Path(entry.path), depth + 1) for entry in entries if _may_hold_packages(entry))


def _may_hold_packages(entry: os.DirEntry[str]) -> bool:
    return not entry.name.startswith(".") and entry.name not in _NOT_CRAWLED and entry.is_dir()


def _package_name(folder: Path) -> str:
    """What the manifest calls a package; of one in manifest.xml (rosbuild) the folder is the name.

    No XML is parsed: rospack's own reader minds little, and of a large workspace hundreds are read.
    """
    try:
        text = (folder / MANIFESTS[0]).read_text(errors="replace")
    except OSError:
        return folder.name
    found = _NAME.search(_COMMENT.sub("", text))
    return found[1] if found else folder.name
