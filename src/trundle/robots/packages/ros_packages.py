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
from .workspace import PARTS, distinct_folders, enclosing_package, workspaces

_MAX_GUESSED = 5000
"""Maximum number of folders visited around `start` outside of workspaces, such as in a home folder."""
_MAX_DIRECT = 500
_COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
_NAME = re.compile(r"<name>\s*([\w.-]+)\s*</name>")
SHIPPED = ASSETS / "ros_packages"
"""Trundle's packages: stand-ins for stock packages with files that launch files use, and the examples."""
_INSTALLED = Path("/usr/share")
"""Folder of Debian's ROS packages, which its rospack searches last, even without ROS_PACKAGE_PATH."""
_CHECKOUT_EXAMPLES = ASSETS.parents[2] / "examples"


def fetched_folder(environment: Mapping[str, str]) -> Path:
    """Return the folder of repositories fetched for the user, below XDG_DATA_HOME or ~/.local/share."""
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
        fallback: "RosPackages | None" = None,
    ) -> None:
        """Search ROS_PACKAGE_PATH, the workspace around `start`, beside the package of `start`, then inside it.

        The workspace of a file comes before ROS_PACKAGE_PATH.

        Args:
            environment: environment with the search paths.
            start: file or folder.
            cache: results of earlier searches in the same environment.
            fallback: packages searched last, such as those of the launch file that names `start`.
        """
        entries = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        start = self._start = _real(start)
        self._cache = cache
        self._on_path = [Path(os.path.expanduser(entry)).absolute() for entry in entries if entry]
        self._workspace_folders = [self._as_on_path(space) for space in workspaces(start)]
        file_workspace = self._workspace_folders if os.path.isfile(start) else []
        others = [] if fallback is None else fallback.roots
        self.roots = distinct_folders([*file_workspace, *self._on_path, *self._workspace_folders, *others])
        """Folders of packages."""
        self._fallback = fallback
        package = enclosing_package(start, cache.wide)
        self._guessed = [] if package is None or package.parent in map(_real, self.roots) else [package, package.parent]
        self._fetched = fetched_folder(environment)
        self._by_name: dict[str, Path] | None = None
        self._folders: dict[str, Path] = {}

    def _as_on_path(self, folder: Path) -> Path:
        """Return a resolved folder as spelled on ROS_PACKAGE_PATH, if it is on it."""
        for entry in self._on_path:
            real = _real(entry)
            if folder.is_relative_to(real):
                return entry / folder.relative_to(real)
        return folder

    def find(self, name: str) -> Path | None:
        """Return a package's folder, by its manifest's name, else by folder name."""
        folder = self.all().get(name) or self._folders.get(name) or self._direct_packages.get(name)
        return folder or (self._fallback.find(name) if self._fallback is not None else None)

    def all(self) -> Mapping[str, Path]:
        """Return every package with a manifest, by name; the first of duplicate names wins."""
        if self._by_name is None:
            self._by_name = {}
            for root in self.roots:
                self._crawl(root)
            for root in self._guessed:
                self._crawl(root, max_folders=_MAX_GUESSED)
            for name, folder in ({} if self._fallback is None else self._fallback.all()).items():
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

    def shadowed(self, name: str) -> Path | None:
        """Return the package on ROS_PACKAGE_PATH that one of the same name in the file's workspace shadows, or None."""
        selected = self.find(name)
        if selected is None or not any(selected.is_relative_to(root) for root in self._workspace_folders):
            return None
        others = (
            folder
            for root in self._on_path
            for folder, package in self._cache.crawls.get((root, None), [])
            if package == name
        )
        other = next(others, None)
        workspaces_ = [root.parent for root in self._workspace_folders]
        return None if other is None or any(other.is_relative_to(workspace) for workspace in workspaces_) else other

    def workspace_of(self, folder: Path) -> Path | None:
        """Return the workspace of `start` if it contains a package; None if ROS_PACKAGE_PATH does."""
        if any(folder.is_relative_to(root) for root in self._on_path):
            return None
        space = next((space for space in self._workspace_folders if folder.is_relative_to(space)), None)
        return None if space is None else space.parent.parent if space.name == "share" else space.parent

    def searched(self) -> list[Path]:
        """Return the folders searched by `find`, in order."""
        return [*self.roots, *self._guessed[1:]]

    @cached_property
    def _direct_packages(self) -> Mapping[str, Path]:
        """Packages directly in `start`, if it is a plain folder, by manifest name and by folder name.

        `find` finds them; `all` does not contain them.
        """
        walk = Crawl(self._start, max_folders=_MAX_DIRECT, max_depth=1)
        packages = [(folder, name) for folder, name in self._packages_below(walk) if name is not None]
        return {folder.name: folder for folder, _ in packages} | {name: folder for folder, name in packages}

    def _crawl(self, root: Path, *, max_folders: int | None = None) -> None:
        assert self._by_name is not None
        walks = self._cache.crawls
        if (root, max_folders) not in walks:
            walks[root, max_folders] = list(self._packages_below(Crawl(root, max_folders=max_folders)))
        for folder, name in walks[root, max_folders]:
            if name is not None:
                self._by_name.setdefault(name, folder)
            self._folders.setdefault(folder.name, folder)

    def _packages_below(self, walk: Crawl) -> Iterator[Folder]:
        for folder, names in walk:
            has_manifest = not names.isdisjoint(MANIFESTS)
            if (has_manifest or not names.isdisjoint(PARTS)) and folder not in self._cache.wide:
                yield folder, _package_name(folder) if has_manifest else None
        if walk.max_folders is None:  # the user has named this folder
            self._cache.skipped.update(walk.skipped)


def _real(folder: Path) -> Path:
    return Path(os.path.realpath(folder))


def _installed() -> Iterator[tuple[Path, str]]:
    """Yield the packages directly in the system's folder, without descending."""
    if os.path.isdir(_INSTALLED):
        folders = (Path(entry.path) for entry in os.scandir(_INSTALLED))
        yield from ((folder, _package_name(folder)) for folder in folders if os.path.isfile(folder / MANIFESTS[0]))


def _package_name(folder: Path) -> str:
    """Return the name in package.xml; the folder name for a manifest.xml (rosbuild).

    No XML is parsed: rospack's reader is as tolerant, and large workspaces have hundreds of manifests.
    """
    try:
        text = read_text(folder / MANIFESTS[0])
    except OSError:
        return folder.name
    match = _NAME.search(_COMMENT.sub("", text))
    return match[1] if match else folder.name
