"""Sources of message definitions: shipped with Trundle, added folders, packages on the package path, published ones.

Shipped definitions, of the standard packages, come first. Definitions published by nodes come last, since a package
on the path may be of another release.
"""

import os
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

from trundle.assets import ASSETS
from trundle.base.files import read_text

from .definition_files import definition_files

_SHIPPED = ASSETS / "messages/definitions"
_PUBLISHED = ASSETS / "messages/published"
"""Folder with a file per package; each definition in it begins with `MSG: `, `SRV: ` or `ACTION: ` and its name."""
_DIVIDER = "=" * 80 + "\n"
MAX_CHARACTERS = 1_000_000
"""Maximum length of a definition, also from peers; the longest of a desktop installation is below 100,000."""
_SEPARATOR = re.compile(r"^\s*---[^\n]*$", re.MULTILINE)
DEBIAN_SHARE = "/usr/share"
"""Debian's rospkg searches this folder last, regardless of ROS_PACKAGE_PATH."""


class Origin(NamedTuple):
    """File and first line of a definition."""

    path: Path
    line: int = 1


class Definitions:
    """Definitions by type name ('geometry_msgs/Twist'); a package is read when one of its types is first used."""

    def __init__(self, folders: dict[str, Path], on_path: Mapping[str, Path] | None = None) -> None:
        """Create without types.

        Args:
            folders: package → folder with `msg/`, `srv/` and `action/`.
            on_path: package → folder, of the package path; None: search it.
        """
        self.messages: dict[str, str] = {}
        self.services: dict[str, str] = {}
        self._folders = {package: [folder] for package, folder in folders.items()}
        """Package → folders, for packages not read yet."""
        self.origins: dict[str, Origin] = {}
        """Origins of definitions that were read from files."""
        self.unreadable: dict[str, str] = {}
        """Type with `.msg` or `.srv` → reason why its file cannot be read."""
        self._on_path = on_path
        self._looked_up: set[str] = set()
        self._published: set[str] = set()

    @classmethod
    def shipped(cls) -> "Definitions":
        """Definitions shipped with Trundle, which rosbags lacks."""
        folders = {path.name: path for path in sorted(_SHIPPED.iterdir()) if path.is_dir()}
        return cls(folders)

    @property
    def on_path(self) -> Mapping[str, Path]:
        """Folders of the packages on ROS_PACKAGE_PATH and around the working directory."""
        if self._on_path is None:
            from trundle.robots.packages import Packages  # lazy: only for types not found elsewhere

            self._on_path = Packages(os.environ, start=Path.cwd()).ros_packages()
        return self._on_path

    def add_package(self, package: str, folder: Path) -> None:
        """Add a package's folder, which is read on first use; earlier definitions are kept."""
        self._folders.setdefault(package, []).append(folder)

    def load_package(self, package: str) -> None:
        """Read a shipped or added package, once."""
        for folder in self._folders.pop(package, []):
            self._read(package, folder)

    def load_from_path(self, package: str) -> None:
        """Read a package on the package path, once; earlier definitions are kept."""
        if package not in self._looked_up:
            self._looked_up.add(package)
            if (folder := self.on_path.get(package)) is not None:
                self._read(package, folder)

    def load_published(self, package: str) -> None:
        """Read a published package, unless the one on the package path has definitions; earlier ones are kept."""
        if package in self._published or (package in self.on_path and self._has_any(package)):
            return
        self._published.add(package)
        for kind, name, text in published_definitions(package):
            origin = Origin(_PUBLISHED / f"{package}.txt")
            match kind:
                case "msg":
                    self._add(self.messages, name, text, origin)
                case "srv":
                    self._add(self.services, name, text, origin)
                case _:
                    for part, (_, part_text) in split_action(name, text).items():
                        self._add(self.messages, part, part_text, origin)

    def _has_any(self, package: str) -> bool:
        return any(name.startswith(f"{package}/") for name in (*self.messages, *self.services))

    def service_text(self, type_name: str) -> str:
        """Definition of a registered service type; if the installed one differs only in comments, the installed one."""
        text = self.services[type_name]
        installed = self.installed(type_name, "srv")
        if installed is not None and _without_comments(installed) == _without_comments(text):
            return installed
        return text

    def installed(self, type_name: str, kind: str = "msg") -> str | None:
        """Definition in the installed ROS, with its comments; `rosbag check` searches the same folders."""
        package, _, name = type_name.partition("/")
        for share in (*os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep), DEBIAN_SHARE):
            path = Path(share, package, kind, f"{name}.{kind}")
            if share and path.is_file():
                with suppress(OSError):
                    return read_text(path, max_bytes=MAX_CHARACTERS)
        return None

    def load_all(self) -> None:
        """Read every package."""
        for package in list(self._folders):
            self.load_package(package)
        for package in self.on_path:
            self.load_from_path(package)
        for path in sorted(_PUBLISHED.glob("*.txt")):
            self.load_published(path.stem)

    def add_part(self, name: str, text: str, line: int, *, of: str) -> None:
        """Add the request or response of a service."""
        self.messages[name] = text
        if (origin := self.origins.get(of)) is not None:
            self.origins[name] = Origin(origin.path, line)

    def _read(self, package: str, folder: Path) -> None:
        for name, path, text in self._files(package, folder, "msg"):
            self._add(self.messages, name, text, Origin(path))
        for name, path, text in self._files(package, folder, "action"):
            for part, (line, part_text) in split_action(name, text).items():
                self._add(self.messages, part, part_text, Origin(path, line))
        for name, path, text in self._files(package, folder, "srv"):
            self._add(self.services, name, text, Origin(path))

    def _files(self, package: str, folder: Path, kind: str) -> Iterator[tuple[str, Path, str]]:
        """Read the files of a kind; an unreadable one is recorded and skipped."""
        for path in definition_files(folder, kind):
            name = f"{package}/{path.stem}"
            try:
                yield name, path, read_text(path, max_bytes=MAX_CHARACTERS)
            except OSError as error:
                file_name = f"{name}Action.msg" if kind == "action" else f"{name}.{kind}"
                self.unreadable.setdefault(file_name, f"{path}:1: cannot be read: {error.strerror}")

    def _add(self, texts: dict[str, str], name: str, text: str, origin: Origin) -> None:
        if name not in texts:
            texts[name] = text
            self.origins[name] = origin


def published_definitions(package: str) -> Iterator[tuple[str, str, str]]:
    """Yield kind (msg, srv or action), name and text of a published package's definitions; none if it is unknown."""
    path = _PUBLISHED / f"{package}.txt"
    if not path.is_file():
        return
    for part in path.read_text(encoding="utf-8").split(_DIVIDER):
        head, _, text = part.partition("\n")
        kind, _, name = head.partition(": ")
        yield kind.lower(), name, text


def split_service(text: str, line: int = 1) -> tuple[tuple[int, str], tuple[int, str]]:
    """Split a .srv definition into (first line, text) of request and response; `line` is the first of `text`."""
    separator = _SEPARATOR.search(text)
    if separator is None:
        return (line, text), (line, "")
    response = text[separator.end() :].lstrip("\n")
    return (line, text[: separator.start()]), (line + text[: len(text) - len(response)].count("\n"), response)


def split_action(name: str, text: str) -> dict[str, tuple[int, str]]:
    """Generate the seven messages of an action from its goal, result and feedback.

    Returns:
        name → (first line in the action's text, definition).
    """
    goal, (line, rest) = split_service(text)
    result, feedback = split_service(rest, line)
    package, _, base = name.partition("/")
    texts = {
        "Action": (
            1,
            f"{base}ActionGoal action_goal\n{base}ActionResult action_result\n{base}ActionFeedback action_feedback\n",
        ),
        "ActionGoal": (1, f"Header header\nactionlib_msgs/GoalID goal_id\n{base}Goal goal\n"),
        "ActionResult": (1, f"Header header\nactionlib_msgs/GoalStatus status\n{base}Result result\n"),
        "ActionFeedback": (1, f"Header header\nactionlib_msgs/GoalStatus status\n{base}Feedback feedback\n"),
        "Goal": goal,
        "Result": result,
        "Feedback": feedback,
    }
    return {f"{package}/{base}{part}": definition for part, definition in texts.items()}


def _without_comments(text: str) -> list[str]:
    """Lines without comments, blank lines and extra spaces."""
    lines = (" ".join(line.partition("#")[0].split()) for line in text.splitlines())
    return [line for line in lines if line]
