"""Where files live: package://, model://, file:// and relative URIs become paths, or one sentence that says why not."""

import os
from collections.abc import Mapping
from pathlib import Path

from trundle.diagnostics import DescriptionError, Source, UsageError

from .ros_packages import RosPackages

SHIPPED = Path(__file__).parent / "models"
"""Models of our own: sun, ground_plane and the example robots."""
_CHECKOUT_EXAMPLES = Path(__file__).parents[3] / "examples"
_REMOTE = ("http://", "https://")


class Packages:
    """Everything a description may refer to, as one environment has it."""

    def __init__(self, environment: Mapping[str, str], *, start: Path) -> None:
        """Look with these variables, around a file or folder.

        Args:
            environment: ROS_PACKAGE_PATH, GAZEBO_MODEL_PATH, GAZEBO_RESOURCE_PATH and HOME are read.
            start: whose package and workspace are searched too.
        """
        self._environment = environment
        self._ros = RosPackages(environment, start)
        home = Path(environment.get("HOME", "/tmp"))
        self.model_folders = [
            home / ".gazebo" / "models",
            *_paths(environment.get("GAZEBO_MODEL_PATH", "")),
            SHIPPED,
            *([_CHECKOUT_EXAMPLES] if (_CHECKOUT_EXAMPLES / "rp2w").is_dir() else []),
        ]
        self.resource_folders = _paths(environment.get("GAZEBO_RESOURCE_PATH", ""))

    def around(self, file: Path) -> "Packages":
        """The same, searched around another file."""
        return Packages(self._environment, start=file)

    def find_package(self, name: str) -> Path | None:
        """The folder of a ROS package, or None."""
        return self._ros.find(name)

    def ros_packages(self) -> Mapping[str, Path]:
        """Every ROS package there is, by name."""
        return self._ros.all()

    def why_not_found(self, name: str) -> str:
        """One sentence for a package that is not there."""
        looked = ", ".join(str(folder) for folder in self._ros.searched())
        where = f"looked below {looked}" if looked else "ROS_PACKAGE_PATH is not set"
        return f"no package {name!r}; {where}; put the folder that holds it on ROS_PACKAGE_PATH"

    def find_model(self, name: str) -> Path:
        """The folder of `model://name`.

        Raises:
            UsageError: there is none, with where was looked.
        """
        for folder in self.model_folders:
            if (folder / name).is_dir():
                return folder / name
        looked = ", ".join(map(str, self.model_folders))
        raise UsageError(f"no model {name!r}; looked in {looked}; put its folder's parent on GAZEBO_MODEL_PATH")

    def find_world(self, name: str) -> Path | None:
        """A world file along GAZEBO_RESOURCE_PATH, as `gazebo worlds/empty.world` finds it."""
        tries = [folder / sub / name for folder in self.resource_folders for sub in (".", "worlds")]
        return next((path for path in tries if path.is_file()), None)

    def resolve(self, uri: str, *, beside: Path, at: Source) -> Path:
        """The file that a URI in a description means.

        Args:
            uri: package://, model://, file://, or a path relative to the file it stands in.
            beside: the folder of that file.
            at: where it stands.

        Raises:
            DescriptionError: nothing there, or outside what a description may read.
        """
        if uri.startswith(_REMOTE):
            raise DescriptionError(at, f"{uri}: nothing is fetched from the network; copy it beside the model")
        scheme, separator, rest = uri.partition("://")
        if not separator:
            scheme, rest = "", uri
        root, path = self._located(scheme, rest, beside, uri, at)
        resolved = Path(os.path.normpath(path))
        if root is not None and not resolved.is_relative_to(os.path.normpath(root)):
            raise DescriptionError(at, f"{uri} leads out of {root}; a description reads only below its own folders")
        if not resolved.exists():
            raise DescriptionError(at, f"{uri}: no such file {resolved}")
        return resolved

    def _located(self, scheme: str, rest: str, beside: Path, uri: str, at: Source) -> tuple[Path | None, Path]:
        name, _, inside = rest.lstrip("/").partition("/")
        if scheme in ("package", "model"):
            folder = self._package_or_model(name, first=scheme)
            if folder is None:
                looked = ", ".join(map(str, [*self._ros.searched(), *self.model_folders]))
                raise DescriptionError(at, f"{uri}: no {scheme} {name!r}; looked in {looked}")
            return folder, folder / inside
        if scheme == "file" and rest.startswith("/"):
            return None, Path(rest)
        for folder in [beside, *self.resource_folders]:
            if (folder / rest).exists():
                return folder, folder / rest
        return beside, beside / rest

    def _package_or_model(self, name: str, *, first: str) -> Path | None:
        """URDF says package://, its conversion to SDF model://; each stands for the other where it finds nothing."""
        package = self.find_package(name)
        model = next((folder / name for folder in self.model_folders if (folder / name).is_dir()), None)
        return (package or model) if first == "package" else (model or package)


def _paths(value: str) -> list[Path]:
    return [Path(entry).expanduser() for entry in value.split(os.pathsep) if entry]
