"""Where ROS packages live: by the name in package.xml, and by the name of the folder."""

import os
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from trundle.files import read_text

from .crawl import MANIFESTS, Crawl
from .package_cache import Folder, PackageCache
from .workspace import PARTS, distinct_folders, own_package, workspaces

_MAX_GUESSED = 5000
"""Folders looked at where nobody said that packages are: a home folder has more than one wants to wait for."""
_MAX_RIGHT_BELOW = 500
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NAME = re.compile(r"<name>\s*([\w.-]+)\s*</name>")
SHIPPED = Path(__file__).parent / "ros"
"""Packages of our own: for the few stock ones that launch files only take a file from, and the examples."""
_INSTALLED = Path("/usr/share")
"""Debian's packages of ROS; its rospack looks there last, whatever ROS_PACKAGE_PATH says."""
_CHECKOUT_EXAMPLES = Path(__file__).parents[3] / "examples"


class RosPackages:
    """An index of the packages below some folders, made when first asked."""

    def __init__(self, environment: Mapping[str, str], start: Path, cache: PackageCache) -> None:
        """Look along ROS_PACKAGE_PATH, in the workspace around `start`, beside the package `start` is in, then in it.

        Args:
            environment: says where packages are.
            start: a file or folder.
            cache: what the same environment found before.
        """
        entries = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        start = self._start = _real(start)
        self._cache = cache
        self._on_path = [Path(os.path.expanduser(entry)).absolute() for entry in entries if entry]
        self._around = list(workspaces(start))
        self.roots = distinct_folders([*self._on_path, *self._around])
        """Folders that are there to hold packages."""
        own = own_package(start, cache.wide)
        self._guessed = [] if own is None or own.parent in map(_real, self.roots) else [own, own.parent]
        self._by_name: dict[str, Path] | None = None
        self._folders: dict[str, Path] = {}

    def find(self, name: str) -> Path | None:
        """The folder of a package: by its manifest's name, else by the folder's own name."""
        return self.all().get(name) or self._folders.get(name) or self._right_below.get(name)

    def all(self) -> Mapping[str, Path]:
        """Every package that has a manifest, by name; the first of a name wins."""
        if self._by_name is None:
            self._by_name = {}
            for root in self.roots:
                self._crawl(root)
            for root in self._guessed:
                self._crawl(root, most=_MAX_GUESSED)
            self._crawl(SHIPPED)
            if os.path.isdir(_CHECKOUT_EXAMPLES / "smartcar"):
                self._crawl(_CHECKOUT_EXAMPLES)
            if self._cache.installed is None:
                self._cache.installed = list(_installed())
            for folder, name in self._cache.installed:
                if name not in self._folders:
                    self._by_name.setdefault(name, folder)
        return self._by_name

    def workspace_of(self, folder: Path) -> Path | None:
        """The workspace around `start` that a package is from; None: it is from elsewhere, or ROS_PACKAGE_PATH."""
        if any(folder.is_relative_to(root) for root in self._on_path):
            return None
        space = next((space for space in self._around if folder.is_relative_to(space)), None)
        return None if space is None else space.parent.parent if space.name == "share" else space.parent

    def searched(self) -> list[Path]:
        """Where `find` looks, in order."""
        return [*self.roots, *self._guessed[1:]]

    @cached_property
    def _right_below(self) -> Mapping[str, Path]:
        """Packages whose folders are in `start`, a plain folder, by their manifests' and by their folders' names.

        None of them is listed in `all`: only who asks for one by its name means it.
        """
        walk = Crawl(self._start, max_folders=_MAX_RIGHT_BELOW, deepest=1)
        found = [(folder, name) for folder, name in self._packages_below(walk) if name is not None]
        return {folder.name: folder for folder, _ in found} | {name: folder for folder, name in found}

    def _crawl(self, root: Path, *, most: int | None = None) -> None:
        assert self._by_name is not None
        walks = self._cache.crawls
        if (root, most) not in walks:
            walks[root, most] = list(self._packages_below(Crawl(root, max_folders=most)))
        for folder, name in walks[root, most]:
            if name is not None:
                self._by_name.setdefault(name, folder)
            self._folders.setdefault(folder.name, folder)

    def _packages_below(self, walk: Crawl) -> Iterator[Folder]:
        for folder, names in walk:
            has_manifest = not names.isdisjoint(MANIFESTS)
            if (has_manifest or not names.isdisjoint(PARTS)) and folder not in self._cache.wide:
                yield folder, _package_name(folder) if has_manifest else None
        if walk.most is None:  # a folder to hold packages, by what the user says
            self._cache.skipped.update(walk.skipped)


def _real(folder: Path) -> Path:
    return Path(os.path.realpath(folder))


def _installed() -> Iterator[tuple[Path, str]]:
    """Those right below the system's folder: it holds much else, so none is looked for further down."""
    if os.path.isdir(_INSTALLED):
        folders = (Path(entry.path) for entry in os.scandir(_INSTALLED))
        yield from ((folder, _package_name(folder)) for folder in folders if os.path.isfile(folder / MANIFESTS[0]))


def _package_name(folder: Path) -> str:
    """What the manifest calls a package; of one in manifest.xml (rosbuild) the folder is the name.

    No XML is parsed: rospack's own reader minds little, and of a large workspace hundreds are read.
    """
    try:
        text = read_text(folder / MANIFESTS[0])
    except OSError:
        return folder.name
    found = _NAME.search(_COMMENT.sub("", text))
    return found[1] if found else folder.name
