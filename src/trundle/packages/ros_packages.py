"""Where ROS packages live: by the name in package.xml, and by the name of the folder."""

import os
import re
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path

from trundle.diagnostics import DescriptionError
from trundle.xmlnode import read_xml

MANIFESTS = ("package.xml", "manifest.xml")
_DEEPEST = 8
"""How far below a package path packages are looked for; rospack has no bound, real workspaces need five."""
_PARTS = ("launch", "urdf", "meshes")
_NOT_CRAWLED = frozenset({"build", "node_modules", "__pycache__"})
_NAME = re.compile(r"<name>\s*([\w.-]+)\s*</name>")
_IGNORED_BY = ("CATKIN_IGNORE", "AMENT_IGNORE", "rospack_nosubdirs")


class RosPackages:
    """An index of the packages below some folders, made when first asked."""

    def __init__(self, environment: Mapping[str, str], start: Path) -> None:
        """Look along ROS_PACKAGE_PATH, then in the workspace around `start`, then in the folders above it."""
        entries = environment.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
        self.roots = [Path(entry).expanduser() for entry in entries if entry]
        self._around = list(_around(start.resolve()))
        self._by_name: dict[str, Path] | None = None
        self._folders: dict[str, Path] = {}

    def find(self, name: str) -> Path | None:
        """The folder of a package: by its manifest's name, else by the folder's own name."""
        return self.all().get(name) or self._folders.get(name)

    def all(self) -> Mapping[str, Path]:
        """Every package that has a manifest, by name; the first of a name wins."""
        if self._by_name is None:
            self._by_name = {}
            for root in [*self.roots, *self._around]:
                self._crawl(root)
        return self._by_name

    def searched(self) -> list[Path]:
        """Where `find` looks, in order."""
        return [*self.roots, *self._around]

    def _crawl(self, root: Path) -> None:
        assert self._by_name is not None
        for folder, is_package in _walk(root, depth=0):
            self._folders.setdefault(folder.name, folder)
            if is_package:
                self._by_name.setdefault(_package_name(folder), folder)


def _walk(folder: Path, *, depth: int) -> Iterator[tuple[Path, bool]]:
    """Every folder and whether it is a package; what lies inside a package is not looked at."""
    try:
        with os.scandir(folder) as listing:
            entries = sorted(listing, key=lambda entry: entry.name)
    except OSError:
        return
    names = {entry.name for entry in entries}
    if names.intersection(_IGNORED_BY):
        return
    is_package = not names.isdisjoint(MANIFESTS)
    yield folder, is_package
    if is_package or depth >= _DEEPEST:
        return
    for entry in entries:
        if entry.name.startswith(".") or entry.name in _NOT_CRAWLED:
            continue
        if entry.is_dir():
            yield from _walk(Path(entry.path), depth=depth + 1)


def _package_name(folder: Path) -> str:
    for manifest in MANIFESTS[:1]:
        try:
            name = read_xml(folder / manifest).string("name")
        except DescriptionError:  # rospack's own reader minds less
            name = _named_in(folder / manifest)
        if name:
            return name
    return folder.name  # manifest.xml (rosbuild) has no name: the folder is the name


def _named_in(manifest: Path) -> str:
    try:
        found = _NAME.search(manifest.read_text(errors="replace"))
    except OSError:
        return ""
    return found[1] if found else ""


def _around(start: Path) -> Iterable[Path]:
    """The folder that holds the package `start` is in, and a workspace's `src` above.

    A published tutorial often has no package.xml: a folder with a `launch`, `urdf` or `meshes` in it is a package too.
    """
    folder = start if start.is_dir() else start.parent
    above = [folder, *folder.parents]
    for each in above:
        if any((each / part).exists() for part in (*MANIFESTS, *_PARTS)):
            yield each.parent
            break
    for each in above:
        if each.name == "src" and each.parent != each:
            yield each
            break
