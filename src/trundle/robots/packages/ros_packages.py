"""Index of ROS packages, by the name in package.xml and by folder name."""

import os
import re
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path

from trundle.assets import ASSETS
from trundle.base.files import read_text
from trundle.base.ownership import home_folder

from .crawl import MANIFESTS, Crawl
from .package_cache import Folder, PackageCache
from .workspace import PARTS, distinct_folders, own_package, workspaces

_MAX_GUESSED = 5000
"""Most folders visited where no path was given, such as in a home folder."""
_MAX_RIGHT_BELOW = 500
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NAME = re.compile(r"<name>\s*([\w.-]+)\s*</name>")
SHIPPED = ASSETS / "ros_packages"
"""Trundle's packages: substitutes for stock packages of which launch files use a file, and the examples."""
_INSTALLED = Path("/usr/share")
"""Folder of Debian's ROS packages, which its rospack searches last, whatever ROS_PACKAGE_PATH is."""
_CHECKOUT_EXAMPLES = ASSETS.parents[2] / "examples"


def fetched_folder(environment: Mapping[str, str]) -> Path:
    """Return the folder of repositories that were fetched for the user, below XDG_DATA_HOME or ~/.local/share."""
    root = environment.get("XDG_DATA_HOME") or home_folder(environment) / ".local/share"
    return Path(root, "trundle", "packages")


class RosPackages:
    """Index of packages, built on first use."""

    def __init__(
        self,
        environment: Mapping[str, str],
        start: Path,
        cache: PackageCache,
        *,
        earlier: "RosPackages | None" = None,
    ) -> None:
        """Search ROS_PACKAGE_PATH, the workspace around `start`, beside the package of `start`, then inside it.

        The workspace of a file comes before ROS_PACKAGE_PATH.

        Args:
            environment: with the search paths.
            start: a file or folder.
            cache: earlier results of the same environment.
            earlier: searched last, such as the packages of the launch file that names `start`.
        """
        entries = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        start = self._start = _real(start)
        self._cache = cache
        self._on_path = [Path(os.path.expanduser(entry)).absolute() for entry in entries if entry]
        self._around = [self._as_on_path(space) for space in workspaces(start)]
        first = self._around if os.path.isfile(start) else []
        others = [] if earlier is None else earlier.roots
        self.roots = distinct_folders([*first, *self._on_path, *self._around, *others])
        """Folders of packages."""
        self._earlier = earlier
        own = own_package(start, cache.wide)
        self._guessed = [] if own is None or own.parent in map(_real, self.roots) else [own, own.parent]
        self._fetched = fetched_folder(environment)
        self._by_name: dict[str, Path] | None = None
        self._folders: dict[str, Path] = {}

    def _as_on_path(self, folder: Path) -> Path:
        """Return a folder without links as ROS_PACKAGE_PATH spells it, if it is there."""
        for entry in self._on_path:
            real = _real(entry)
            if folder.is_relative_to(real):
                return entry / folder.relative_to(real)
        return folder

    def find(self, name: str) -> Path | None:
        """Return the folder of a package, by its manifest's name, else by folder name."""
        found = self.all().get(name) or self._folders.get(name) or self._right_below.get(name)
        return found or (self._earlier.find(name) if self._earlier is not None else None)

    def all(self) -> Mapping[str, Path]:
        """Return every package with a manifest, by name; the first of a name wins."""
        if self._by_name is None:
            self._by_name = {}
            for root in self.roots:
                self._crawl(root)
            for root in self._guessed:
                self._crawl(root, most=_MAX_GUESSED)
            for name, folder in ({} if self._earlier is None else self._earlier.all()).items():
                self._by_name.setdefault(name, folder)
            self._crawl(self._fetched)
            self._crawl(SHIPPED)
            if os.path.isdir(_CHECKOUT_EXAMPLES / "smartcar"):
                self._crawl(_CHECKOUT_EXAMPLES)
            if self._cache.installed is None:
                self._cache.installed = list(_installed())
            for folder, name in self._cache.installed:
                if name not in self._folders:
                    self._by_name.setdefault(name, folder)
        return self._by_name

    def passed_over(self, name: str) -> Path | None:
        """Return the package of this name on ROS_PACKAGE_PATH, if the one of the file's own workspace is found."""
        found = self.find(name)
        if found is None or not any(found.is_relative_to(root) for root in self._around):
            return None
        others = (
            folder
            for root in self._on_path
            for folder, named in self._cache.crawls.get((root, None), [])
            if named == name
        )
        other = next(others, None)
        inside = [root.parent for root in self._around]
        return None if other is None or any(other.is_relative_to(each) for each in inside) else other

    def workspace_of(self, folder: Path) -> Path | None:
        """Return the workspace around `start` that contains a package; None if it is elsewhere or on
        ROS_PACKAGE_PATH.
        """
        if any(folder.is_relative_to(root) for root in self._on_path):
            return None
        space = next((space for space in self._around if folder.is_relative_to(space)), None)
        return None if space is None else space.parent.parent if space.name == "share" else space.parent

    def searched(self) -> list[Path]:
        """Return the folders that `find` searches, in order."""
        return [*self.roots, *self._guessed[1:]]

    @cached_property
    def _right_below(self) -> Mapping[str, Path]:
        """Packages directly in `start`, if it is a plain folder, by manifest and by folder name.

        They are found by name only, and not part of `all`.
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
        if walk.most is None:  # a package folder given by the user
            self._cache.skipped.update(walk.skipped)


def _real(folder: Path) -> Path:
    return Path(os.path.realpath(folder))


def _installed() -> Iterator[tuple[Path, str]]:
    """Yield the packages directly in the system's folder, without descending."""
    if os.path.isdir(_INSTALLED):
        folders = (Path(entry.path) for entry in os.scandir(_INSTALLED))
        yield from ((folder, _package_name(folder)) for folder in folders if os.path.isfile(folder / MANIFESTS[0]))


def _package_name(folder: Path) -> str:
    """Return the name in the manifest; with manifest.xml (rosbuild) the folder name.

    No XML is parsed: rospack's own reader is tolerant, and large workspaces have hundreds of manifests.
    """
    try:
        text = read_text(folder / MANIFESTS[0])
    except OSError:
        return folder.name
    found = _NAME.search(_COMMENT.sub("", text))
    return found[1] if found else folder.name
