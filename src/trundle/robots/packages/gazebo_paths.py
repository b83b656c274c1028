"""Search paths of models, worlds and media: Gazebo's environment variables, package exports, and Trundle's assets."""

import os
from collections.abc import Iterator, Mapping
from functools import cached_property
from pathlib import Path
from urllib.parse import unquote, urlsplit

from trundle.assets import ASSETS
from trundle.base.diagnostics import DescriptionError
from trundle.base.files import read_file

from .package_cache import PackageCache
from .ros_packages import RosPackages
from .workspace import ancestor_folders, distinct_folders

CHECKOUT_EXAMPLES = [path for path in [ASSETS.parents[2] / "examples"] if os.path.isdir(path / "rp2w")]
"""Examples in a source checkout; a wheel has them in ASSETS."""
_SHIPPED = [ASSETS, *CHECKOUT_EXAMPLES]
_FUEL_CACHES = (".gz/fuel", ".ignition/fuel")
"""Download folders of newer Gazebo's tools, below HOME."""
_SUFFIXES = (".", "worlds", "models", "media/models", "Media/models", "media")
"""Subfolders that Gazebo tries below a resource path, and `worlds`."""


def is_stand_in(path: Path) -> bool:
    """True if a file belongs to a stand-in for a model of Gazebo's public database.

    A stand-in's meshes have the original names with the suffix .obj, and the original frame and unit, as worlds saved
    by Gazebo contain mesh URIs and scales in place of an <include>.
    """
    return ASSETS / "stand_ins" in path.parents


def is_shipped(path: Path) -> bool:
    """True if a file comes with Trundle: its `model://` is Trundle's own model, also where a user has one so named."""
    return any(folder in path.parents for folder in _SHIPPED) and os.path.isfile(path)


_MAX_MODELS = 5000
"""Maximum models in a list."""


class GazeboPaths:
    """Gazebo paths of one environment and start file."""

    def __init__(self, environment: Mapping[str, str], start: Path, ros: RosPackages, cache: PackageCache) -> None:
        self._home = Path(environment.get("HOME") or os.devnull)  # rather none than /tmp, where any user can write
        self._start = start
        self._ros = ros
        self._cache = cache
        self._named_models = _paths(environment.get("GAZEBO_MODEL_PATH", ""))
        self._named_resources = _paths(environment.get("GAZEBO_RESOURCE_PATH", ""))

    @property
    def model_folders(self) -> list[Path]:
        """Model folders: Gazebo's in its order, Trundle's (first for Trundle's own files), added ones."""
        return [*self._standard_model_folders, *self._cache.added_models]

    @cached_property
    def _standard_model_folders(self) -> list[Path]:
        shipped = [ASSETS / "models", *CHECKOUT_EXAMPLES]
        users = [self._home / ".gazebo" / "models", *self._named_models, *self._exported("gazebo_model_path")]
        return distinct_folders([*shipped, *users] if is_shipped(self._start) else [*users, *shipped])

    @cached_property
    def resource_folders(self) -> list[Path]:
        """Folders of worlds and media."""
        return [
            *self._named_resources,
            *self._exported("gazebo_media_path"),
            *self._exported("gazebo_resource_path"),
            ASSETS,
            *CHECKOUT_EXAMPLES,
        ]

    def find_model(self, name: str) -> Path | None:
        """Return a model's folder: on the path, else near the file, else a stand-in."""
        if not name or name in (".", ".."):
            return None
        on_path = (folder / name for folder in self.model_folders)
        near = (folder / sub / name for folder in ancestor_folders(self._start) for sub in (".", "models"))
        stand_in = ASSETS / "stand_ins" / name
        candidates = (
            *on_path,
            *(candidate for candidate in near if os.path.isfile(candidate / "model.config")),
            stand_in,
        )
        return next(
            (candidate for candidate in candidates if os.path.isdir(candidate) and candidate not in self._cache.wide),
            None,
        )

    def models(self) -> dict[str, Path]:
        """Return the folders of all models by name, as found by `find_model`."""
        near = [folder / sub for folder in ancestor_folders(self._start) for sub in (".", "models")]
        folders: dict[str, Path] = {}
        for parent in (*self.model_folders, *near, ASSETS / "stand_ins"):
            for folder in [] if parent in self._cache.wide else _folders(parent):
                if len(folders) < _MAX_MODELS and os.path.isfile(folder / "model.config"):
                    folders.setdefault(folder.name, folder)
        return folders

    def find_resource(self, name: str) -> Path | None:
        """Return a file below a resource folder, such as `worlds/empty.world` or `media/materials/scripts`."""
        if os.path.isabs(name) or ".." in Path(name).parts:
            return None
        tries = (folder / suffix / name for folder in self.resource_folders for suffix in _SUFFIXES)
        return next((path for path in tries if os.path.exists(path)), None)

    def find_downloaded(self, url: str) -> Path | None:
        """Return the folder in which `gz fuel download` or `ign fuel download` saved a URL."""
        try:
            parts = urlsplit(url)
        except ValueError:  # the URL has a bracket that is not closed
            return None
        words = [unquote(word) for word in parts.path.split("/") if word]
        if len(words) < 4 or ".." in words:
            return None
        owner, kind, name, *rest = words[1:]  # the path begins with the API version, such as 1.0
        for cache in _FUEL_CACHES:
            folder = self._home / cache / parts.netloc / owner.lower() / kind / name.lower()
            versions = sorted((int(sub.name), sub) for sub in _folders(folder) if sub.name.isdecimal())
            if rest and rest[0].isdecimal():
                versions = [version for version in versions if version[0] == int(rest[0])]
            if versions:
                return versions[-1][1]
        return None

    def _exported(self, attribute: str) -> Iterator[Path]:
        """Yield paths from `<export><gazebo_ros …>` of all packages, as libgazebo_ros_paths_plugin does."""
        for prefix, attributes in self._exports:
            for value in _paths(attributes.get(attribute, "").replace("${prefix}", str(prefix))):
                yield prefix / value

    @cached_property
    def _exports(self) -> list[tuple[Path, dict[str, str]]]:
        exports = self._cache.exports
        for folder in self._ros.all().values():
            if folder not in exports:
                exports[folder] = _gazebo_exports(folder / "package.xml")
        return [(folder, attributes) for folder in self._ros.all().values() for attributes in exports[folder]]


def _gazebo_exports(manifest: Path) -> list[dict[str, str]]:
    from trundle.base.xmlnode import read_xml  # lxml is slow to load, and most commands need no exports

    try:
        if b"gazebo_ros" not in read_file(manifest):
            return []
        export = read_xml(manifest).find("export")
    except (OSError, DescriptionError):
        return []
    return [node.attributes() for node in (export.all("gazebo_ros") if export else [])]


def _folders(folder: Path) -> list[Path]:
    try:
        return [path for path in folder.iterdir() if os.path.isdir(path)]
    except OSError:
        return []


def _paths(value: str) -> list[Path]:
    return [Path(os.path.expanduser(entry)).absolute() for entry in value.split(os.pathsep) if entry]
