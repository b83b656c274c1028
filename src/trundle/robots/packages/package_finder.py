"""Resolution of package://, model://, file:// and relative URIs to paths."""

import os
import re
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from urllib.parse import unquote

from trundle.assets import ASSETS
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError, did_you_mean
from trundle.base.files import is_stream, read_text
from trundle.robots.repositories import repository_hint

from .confinement import Confinement
from .env_hooks import hook_prefix, hook_variables
from .gazebo_paths import GazeboPaths, is_shipped, is_stand_in
from .package_cache import PackageCache
from .ros_packages import RosPackages
from .stock import DESCRIPTIONS, STOCK
from .workspace import package_confinement

ALLOW_OUTSIDE = "TRUNDLE_ALLOW_OUTSIDE"
"""Environment variable; 1 allows descriptions to read any file; set by `--allow-outside`."""
LENIENT = "TRUNDLE_LENIENT"
"""Environment variable; 1 ignores parts from missing packages; set by `--lenient`."""

HELD_SUFFIX = ".held"
"""Suffix of uploaded code files, which are not loaded as plugins until a user agrees."""

_SHIPPED_PACKAGES = ASSETS / "ros_packages"
_MAX_SHOWN = 200
"""Maximum length of a name or URI in a message."""
_FUEL_MODEL = re.compile(r"/models/([^/]+)(?:/(?:\d+|tip)(?:/files(/.*[^/]))?)?/?$")
"""Path of a model on Fuel, or of a file of one of its versions."""
_MAX_NAMED = 3
_MAY_CONFIGURE = re.compile(r"\b(configure_file|include|add_subdirectory)\s*\(", re.IGNORECASE)
"""Commands of CMake that configure files, or read others that may."""


class Packages:
    """Packages, models and worlds of one environment, as seen from one file or folder."""

    def __init__(self, environment: Mapping[str, str], *, start: Path, fallback: "Packages | None" = None) -> None:
        """Create a finder.

        Args:
            environment: environment with ROS_PACKAGE_PATH, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH and HOME.
            start: file or folder whose package and workspace are searched too.
            fallback: finder to share the cache with; its packages are searched last.
        """
        start = start.absolute()
        self._environment = environment
        self._start = start
        self._cache = PackageCache(environment) if fallback is None else fallback._cache
        self._fallback = fallback

    def around(self, file: Path) -> "Packages":
        """Return a finder for another file, with this one as its fallback."""
        if file.absolute() == self._start:
            return self
        return Packages(self._environment, start=file, fallback=self)

    def for_included(self, file: Path) -> "Packages":
        """Return the finder for a file that another one includes: this one, but for Trundle's own files."""
        return self.around(file) if is_shipped(file) and not is_shipped(self._start) else self

    def find_package(self, name: str) -> Path | None:
        """Return the folder of a ROS package, or None."""
        folder = self._ros.find(name)
        if name not in self._cache.shadowed:
            other = self._ros.shadowed(name)
            message = f"of two packages {name!r} the file's own workspace wins: {folder}, not {other}"
            self._cache.shadowed[name] = "" if other is None else message
        return folder

    def find_folder(self, name: str) -> Path | None:
        """Return the folder of `$(find name)`.

        The folder of a stock package that is not installed does not exist; a sensor description package has a stand-in.
        Missing files that CMake would configure are written first.
        """
        folder = self.find_package(name)
        if folder is not None and folder not in self._cache.configured and not folder.is_relative_to(ASSETS):
            self._cache.configured[folder] = _write_configured_files(folder)
        folder = folder or DESCRIPTIONS.get(name)
        return folder or (_SHIPPED_PACKAGES / name if name in STOCK else None)

    def stand_in_package(self, path: Path) -> str | None:
        """Return the package whose stand-in contains a file, existing or not; None for other files."""
        return next((name for name, folder in DESCRIPTIONS.items() if path.is_relative_to(folder)), None)

    def absent_package(self, file: Path) -> str | None:
        """Return the missing package to which a missing file belongs; None if the file or its package exists."""
        if os.path.exists(file):
            return None
        parts = file.relative_to(_SHIPPED_PACKAGES).parts if file.is_relative_to(_SHIPPED_PACKAGES) else ()
        return parts[0] if parts and parts[0] in STOCK else self.stand_in_package(file)

    @property
    def is_lenient(self) -> bool:
        """True to ignore parts from missing packages."""
        return self._environment.get(LENIENT) == "1"

    def workspace_of(self, package: Path) -> Path | None:
        """Return the workspace of `start` if it contains a package; None if ROS_PACKAGE_PATH does."""
        return self._ros.workspace_of(package)

    def warn_of_finds(self, report: Diagnostics, at: Source) -> None:
        """Warn once of packages on ROS_PACKAGE_PATH that a file's own workspace shadows, and of files found elsewhere
        than their URIs say.
        """
        for path, (source, message) in self._cache.moved.items():
            if message:
                self._cache.moved[path] = source, ""
                report.warn(source, message, "missing-file")
        for name, message in self._cache.shadowed.items():
            if message:
                self._cache.shadowed[name] = ""
                report.warn(at, message, "shadowed-package")

    @property
    def configured_files(self) -> list[Path]:
        """Files written by `find_folder`."""
        return [path for written in self._cache.configured.values() for path in written]

    def hook_variables(self) -> dict[str, dict[str, str]]:
        """Return the variables of packages' environment hooks that the environment lacks, by package."""
        by_package: dict[str, dict[str, str]] = {}
        for name, folder in self.ros_packages().items():
            if variables := hook_variables(name, folder, self.find_package, self._environment):
                by_package[name] = variables
        return by_package

    def variable(self, name: str) -> str | None:
        """Return an environment variable: the user's, else a package's environment hook's."""
        if name in self._environment:
            return self._environment[name]
        for package, folder in self.ros_packages().items():
            if name.startswith(hook_prefix(package)):
                variables = hook_variables(package, folder, self.find_package, self._environment)
                if name in variables:
                    return variables[name]
        return None

    def skipped_folders(self) -> Mapping[Path, str]:
        """Return the folders skipped by the search, with the reason."""
        self._ros.all()
        return self._cache.skipped

    def package_folders(self) -> list[Path]:
        """Return the folders searched for ROS packages: ROS_PACKAGE_PATH, and the workspace of `start`."""
        return list(self._ros.roots)

    def ros_packages(self) -> Mapping[str, Path]:
        """Return every ROS package by name."""
        return self._ros.all()

    def not_found_message(self, name: str) -> str:
        """Return an error message for a missing package."""
        searched = ", ".join(str(folder) for folder in self._ros.searched())
        where = f"looked below {searched}" if searched else "ROS_PACKAGE_PATH is not set"
        skipped = [f"{folder} ({why})" for folder, why in self._cache.skipped.items()]
        if skipped:
            rest = f" and {len(skipped) - _MAX_NAMED} more" if len(skipped) > _MAX_NAMED else ""
            where += f", but not in {', '.join(skipped[:_MAX_NAMED])}{rest}"
        where += "; put the folder that holds it on ROS_PACKAGE_PATH"
        hint = repository_hint(name)
        suggestion = "" if hint else did_you_mean(name, self._ros.all())
        return f"no package {_shown(name)!r}{suggestion}; {where}{hint}"

    def find_model(self, name: str) -> Path:
        """Return the folder of `model://name`.

        Raises:
            UsageError: no such model; the message lists the folders searched.
        """
        folder = self._gazebo.find_model(name)
        if folder is None:
            raise UsageError(
                f"no model {_shown(name)!r}{did_you_mean(name, self.models())}; {self._where_models_are()}",
                id="missing-model",
            )
        return folder

    def add_models(self, folder: Path) -> None:
        """Append a folder to the model path, also of finders made by `around`."""
        if folder not in self._cache.added_models:
            self._cache.added_models.append(folder)

    @property
    def added_models(self) -> Sequence[Path]:
        """Folders added by `add_models`."""
        return self._cache.added_models

    def models(self) -> Mapping[str, Path]:
        """Return the folders of all models by name, as found by `find_model`."""
        return self._gazebo.models()

    def find_world(self, name: str) -> Path | None:
        """Return a world file on GAZEBO_RESOURCE_PATH or of Trundle, as for `gazebo worlds/empty.world`."""
        path = self._gazebo.find_resource(name)
        return path if path is not None and os.path.isfile(path) else None

    def worlds(self) -> list[str]:
        """Return the names of Trundle's worlds."""
        return sorted(path.name for path in (ASSETS / "worlds").glob("*.world"))

    def model_folders(self) -> list[Path]:
        """Return the folders of models, in Gazebo's order."""
        return self._gazebo.model_folders

    def material_folders(self) -> list[Path]:
        """Return the folders that Gazebo searches for material scripts by default."""
        tries = (
            folder / sub / "materials/scripts" for folder in self._gazebo.resource_folders for sub in (".", "media")
        )
        return [folder for folder in tries if os.path.isdir(folder)]

    def resolve(self, uri: str, *, folder: Path, at: Source) -> Path:
        """Return the file of a URI in a description.

        Args:
            uri: package://, model://, file://, or a path relative to the containing file.
            folder: folder of the containing file.
            at: position of the URI.

        Raises:
            DescriptionError: the file is missing, or outside the readable folders.
        """
        root, path = self._located(uri, folder, at)
        decoded = path.parent / unquote(path.name)
        if not os.path.exists(path) and os.path.exists(decoded):
            path = decoded
        if not os.path.exists(path) and is_stand_in(path) and os.path.exists(path.with_suffix(".obj")):
            path = path.with_suffix(".obj")
        label = "" if root is None else f"{_shown(uri)}: "  # the message already has the path
        if not os.path.exists(path) and (moved := self._of_another_machine(path)) is not None:
            self._cache.moved.setdefault(str(path), (at, f"no such file {_shown(str(path))}; {moved} is used"))
            return moved
        if not os.path.exists(path):
            raise DescriptionError(at, f"{label}no such file {_shown(str(path))}", "missing-file")
        if is_stream(path):
            raise DescriptionError(at, f"{label}{path} is a pipe, a device or a socket, not a file", "unreadable-file")
        self.check_readable(path, at, name=uri, root=root)
        return path

    def _of_another_machine(self, path: Path) -> Path | None:
        """Return the file of a package or model that an absolute path of its author's machine means.

        Worlds saved by Gazebo have such paths: /home/me/catkin_ws/src/arm/worlds/bowl.dae.
        """
        if not path.is_absolute() or path.is_relative_to(ASSETS):
            return None
        for i in range(len(path.parts) - 2, 0, -1):
            name = path.parts[i]
            for folder in (self._ros.find(name), self._gazebo.find_model(name)):
                found = None if folder is None else folder.joinpath(*path.parts[i + 1 :])
                if folder is not None and found is not None and os.path.isfile(found):
                    return found if Confinement([folder], wide=self._cache.wide).allows(found) else None
        return None

    def check_readable(self, path: Path, at: Source, *, name: str, root: Path | None = None) -> None:
        """Refuse a file that is neither below `root` nor in the readable folders.

        Raises:
            DescriptionError: the file is elsewhere.
        """
        if self._environment.get(ALLOW_OUTSIDE) == "1":
            return
        is_named = root is not None and Confinement([root], wide=self._cache.wide).allows(path)
        if not (
            self._in_package.allows(path)
            or is_named
            or self._in_ros.allows(path)
            or self._in_gazebo.allows(path)
            or self._in_added.allows(path)
        ):
            raise DescriptionError(
                at,
                f"{name} leads to {path}; a description reads only below its own folders, the packages and the "
                "resource paths; --allow-outside lifts that",
                "outside-folders",
            )

    @cached_property
    def _ros(self) -> RosPackages:
        fallback = None if self._fallback is None else self._fallback._ros
        return RosPackages(self._environment, self._start, self._cache, fallback=fallback)

    @cached_property
    def _gazebo(self) -> GazeboPaths:
        return GazeboPaths(self._environment, self._start, self._ros, self._cache)

    @cached_property
    def _in_package(self) -> Confinement:
        return package_confinement(self._start, self._cache.wide)

    @cached_property
    def _in_ros(self) -> Confinement:
        return Confinement([*self._ros.roots, *self._ros.all().values(), *DESCRIPTIONS.values()], wide=self._cache.wide)

    @cached_property
    def _in_gazebo(self) -> Confinement:
        return Confinement([*self._gazebo.model_folders, *self._gazebo.resource_folders], wide=self._cache.wide)

    @property
    def _in_added(self) -> Confinement:
        return Confinement(self._cache.added_models, wide=self._cache.wide)

    def _located(self, uri: str, folder: Path, at: Source) -> tuple[Path | None, Path]:
        """Return the root folder of the URI's package or model, and the path."""
        scheme, separator, rest = uri.partition("://")
        if not separator:
            scheme, rest = "file", uri
        match scheme:
            case "http" | "https":
                return self._downloaded(uri, at)
            case "package" | "model":
                return self._in_package_or_model(scheme, rest, uri, at)
            case "file" if rest.startswith("/"):
                return None, Path(unquote(rest)) if separator else Path(rest)
            case "file":
                resource = None if os.path.exists(folder / rest) else self._gazebo.find_resource(rest)
                return None, resource or folder / rest
            case _:
                fallback = "package://, model://, file:// or relative paths"
                raise DescriptionError(
                    at, f"{_shown(uri)}: {_shown(scheme)}:// is not supported; use {fallback}", "uri-scheme"
                )

    def _in_package_or_model(self, scheme: str, rest: str, uri: str, at: Source) -> tuple[Path, Path]:
        """Find a package, else a model; for model://, a model, else a package: the conversion of URDF to SDF turns
        package:// into model://.
        """
        name, _, inside = rest.lstrip("/").partition("/")
        package = self.find_package(name) if scheme == "package" else None
        folder = package or self._gazebo.find_model(name) or self.find_package(name)
        if folder is not None:
            return folder, folder / inside
        no_model = f"no model {_shown(name)!r}{did_you_mean(name, self.models())}; {self._where_models_are()}"
        reason = self.not_found_message(name) if scheme == "package" else no_model
        raise DescriptionError(
            at, f"{_shown(uri)}: {reason}", "missing-package" if scheme == "package" else "missing-model"
        )

    def _downloaded(self, url: str, at: Source) -> tuple[Path, Path]:
        folder = self._gazebo.find_downloaded(url)
        if folder is not None:
            return folder, folder
        model = _FUEL_MODEL.search(unquote(url))
        local, inside = ("", "") if model is None else (model[1].lower().replace(" ", "_"), model[2] or "")
        if "fuel" not in url:
            advice = "copy the file beside this one"
        elif local and self._gazebo.find_model(local) is not None:
            advice = f"write model://{local}{inside}, which is here"
        else:
            advice = "fetch it with `gz fuel download -u URL`, or put its folder on GAZEBO_MODEL_PATH"
        raise DescriptionError(at, f"{_shown(url)}: nothing is fetched from the network; {advice}", "remote-uri")

    def _where_models_are(self) -> str:
        looked = ", ".join(map(str, self._gazebo.model_folders))
        return f"looked in {looked}; put its folder's parent on GAZEBO_MODEL_PATH"


def _shown(name: str) -> str:
    return name if len(name) <= _MAX_SHOWN else f"{name[:_MAX_SHOWN]}…"


def _write_configured_files(package: Path) -> list[Path]:
    """Write the missing files that a package's CMakeLists.txt configures, and return them."""
    try:
        text = read_text(package / "CMakeLists.txt")
    except OSError:
        return []
    if not _MAY_CONFIGURE.search(text):
        return []
    from .configured_files import write_configured_files  # lazy: only few packages need a reader of CMake's language

    return write_configured_files(package, replace=False)
