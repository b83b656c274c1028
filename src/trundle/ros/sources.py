"""Where the text of definitions comes from: what is shipped here, folders a user adds, packages on the package path."""

import os
import re
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path

_SHIPPED = Path(__file__).parent / "definitions"
DEBIAN_SHARE = "/usr/share"
"""Debian's rospkg looks here last, whatever ROS_PACKAGE_PATH says."""


@dataclass(slots=True)
class Definitions:
    """Texts by type name ('geometry_msgs/Twist'), read from a package's folder when one of its types is asked for."""

    messages: dict[str, str]
    services: dict[str, str]
    folders: dict[str, Path]
    """Package → the folder that holds its `msg/`, `srv/` and `action/`; those not read yet."""
    _on_path: Mapping[str, Path] | None = None
    _looked_up: set[str] = field(default_factory=set[str])

    @classmethod
    def shipped(cls) -> "Definitions":
        """What comes with Trundle because the message library lacks it."""
        folders = {path.name: path for path in sorted(_SHIPPED.iterdir()) if path.is_dir()}
        return cls({}, {}, folders)

    @property
    def on_path(self) -> Mapping[str, Path]:
        """Folders of the packages on ROS_PACKAGE_PATH and around the working directory."""
        if self._on_path is None:
            from trundle.packages import Packages  # only where a type is asked for that nobody brought

            self._on_path = Packages(os.environ, start=Path.cwd()).ros_packages()
        return self._on_path

    def load_package(self, package: str) -> None:
        """Read the texts that are shipped or were added for a package, once."""
        folder = self.folders.pop(package, None)
        if folder is not None:
            self._read(package, folder)

    def load_from_path(self, package: str) -> None:
        """As `load_package`, from a package on the package path; what is known already stays as it is."""
        if package not in self._looked_up:
            self._looked_up.add(package)
            if (folder := self.on_path.get(package)) is not None:
                self._read(package, folder)

    def service_text(self, type_name: str) -> str:
        """The text of a known service type: as installed, with its comments, if that means the same."""
        known = self.services[type_name]
        text = self.installed(type_name, "srv")
        return text if text is not None and _bare(text) == _bare(known) else known

    def installed(self, type_name: str, kind: str = "msg") -> str | None:
        """The text of a type as an installed ROS has it, with its comments, where `rosbag check` looks too."""
        package, _, name = type_name.partition("/")
        for share in (*os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep), DEBIAN_SHARE):
            path = Path(share, package, kind, f"{name}.{kind}")
            if share and path.is_file():
                with suppress(OSError):
                    return _text(path)
        return None

    def load_all(self) -> None:
        """Read everything there is."""
        for package in list(self.folders):
            self.load_package(package)
        for package in self.on_path:
            self.load_from_path(package)

    def _read(self, package: str, folder: Path) -> None:
        for path in sorted(folder.glob("msg/*.msg")):
            self.messages.setdefault(f"{package}/{path.stem}", _text(path))
        for path in sorted(folder.glob("action/*.action")):
            for name, text in split_action(f"{package}/{path.stem}", _text(path)).items():
                self.messages.setdefault(name, text)
        for path in sorted(folder.glob("srv/*.srv")):
            self.services.setdefault(f"{package}/{path.stem}", _text(path))


def split_service(text: str) -> tuple[str, str]:
    """Split a .srv text into request and response."""
    request, separator, response = re.sub(r"^\s*---[^\n]*$", "\0", text, count=1, flags=re.MULTILINE).partition("\0")
    return (request, response.lstrip("\n")) if separator else (text, "")


def split_action(name: str, text: str) -> dict[str, str]:
    """Write the seven messages that an action stands for, from its text: goal, result and feedback."""
    goal, rest = split_service(text)
    result, feedback = split_service(rest)
    package, _, base = name.partition("/")
    texts = {
        "Action": f"{base}ActionGoal action_goal\n{base}ActionResult action_result\n"
        f"{base}ActionFeedback action_feedback\n",
        "ActionGoal": f"Header header\nactionlib_msgs/GoalID goal_id\n{base}Goal goal\n",
        "ActionResult": f"Header header\nactionlib_msgs/GoalStatus status\n{base}Result result\n",
        "ActionFeedback": f"Header header\nactionlib_msgs/GoalStatus status\n{base}Feedback feedback\n",
        "Goal": goal,
        "Result": result,
        "Feedback": feedback,
    }
    return {f"{package}/{base}{part}": part_text for part, part_text in texts.items()}


def _bare(text: str) -> list[str]:
    """What a text says beside its comments."""
    lines = (" ".join(line.partition("#")[0].split()) for line in text.splitlines())
    return [line for line in lines if line]


def _text(path: Path) -> str:
    return path.read_text(encoding="utf-8", errors="replace").replace("\r\n", "\n")
