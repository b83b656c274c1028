"""Workspace of checked-out repositories, and what catkin_make makes of its targets."""

import os
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

from trundle.base.diagnostics import DescriptionError, Diagnostics
from trundle.robots.launch import LaunchNode, LaunchPlan, ParamCommand, read_launch
from trundle.robots.packages import Packages

_REPORTED = re.compile(r"^--   (?P<kind>program|library) (?P<name>\S+) \(.*?\): (?P<state>.+)$")
_FIND = re.compile(r"\$\(find (?P<package>[\w-]+)\)(?P<path>/[\w./-]+)")
_BESIDE = re.compile(r"filename=\"(?P<path>[\w./-]+)\"")
_TIMEOUT_S = 3600
_MAX_FILES = 200
_MAX_BYTES = 1 << 20


class Target(NamedTuple):
    """Target of a package, and what catkin_make says of it."""

    package: str
    kind: str
    name: str
    state: str

    @property
    def file(self) -> Path | None:
        """The compiled file."""
        return Path(self.state.removeprefix("built: ")) if self.state.startswith("built: ") else None


class Workspace:
    """Workspace of linked repositories."""

    def __init__(self, base: Path, repositories: Iterable[Path]) -> None:
        self.base = base
        (base / "src").mkdir(parents=True, exist_ok=True)
        for folder in repositories:
            link = base / "src" / folder.name
            if not link.exists():
                link.symlink_to(folder.resolve(), target_is_directory=True)
        self.environment = {
            name: value for name, value in os.environ.items() if not name.startswith(("ROS", "CMAKE_P"))
        }

    def build(self) -> list[Target]:
        """Run catkin_make, and return its report."""
        command = [sys.executable, "-m", "trundle", "--as", "catkin_make"]
        environment = {**self.environment, "PWD": str(self.base)}
        done = subprocess.run(
            command, cwd=self.base, env=environment, capture_output=True, text=True, check=False, timeout=_TIMEOUT_S
        )
        (self.base / "log").write_text(done.stdout + done.stderr)
        return self.reported()

    def reported(self) -> list[Target]:
        """Return what the last catkin_make reported."""
        targets: list[Target] = []
        package = ""
        for line in (self.base / "log").read_text(errors="replace").splitlines():
            if line.startswith("-- +++ processing catkin package: "):
                package = line.split("'")[1]
            elif (reported := _REPORTED.match(line)) is not None:
                targets.append(Target(package, reported["kind"], reported["name"], reported["state"]))
        return targets

    @cached_property
    def folders(self) -> dict[str, Path]:
        """Packages of the sources: name → folder."""
        source = self.base / "src"
        return dict(Packages({**self.environment, "ROS_PACKAGE_PATH": str(source)}, start=source).ros_packages())

    def running_environment(self, **variables: str) -> dict[str, str]:
        """Return the environment of programs, as after `source devel/setup.bash`."""
        devel = self.base / "devel"
        paths = {"ROS_PACKAGE_PATH": self.base / "src", "CMAKE_PREFIX_PATH": devel, "GAZEBO_PLUGIN_PATH": devel / "lib"}
        return {**self.environment, **{name: str(path) for name, path in paths.items()}, **variables}

    def launch_of(self, target: Target) -> tuple[LaunchPlan, LaunchNode] | None:
        """Return the launch that starts a program, and its node there."""
        for file in self._files("*.launch"):
            if target.name not in file.read_text(errors="replace"):
                continue
            plan = self._plan(file)
            if plan is None:
                continue
            for node in plan.nodes:
                if (node.package, node.type) == (target.package, target.name):
                    return plan, node
        return None

    def launches_that_name(self, words: Iterable[str]) -> Iterator[Path]:
        """Yield the launch files that start Gazebo with a world, robot or parameters that name one of some words."""
        pattern = re.compile("|".join(re.escape(word) for word in words))
        for file in self._files("*.launch"):
            if "gazebo" not in file.read_text(errors="replace"):
                continue
            plan = self._plan(file)
            if plan and any(pattern.search(text) for text in self._texts(plan)):
                yield file

    def _plan(self, file: Path) -> LaunchPlan | None:
        """Read a launch file; None if it needs arguments, or what is not here."""
        source = self.base / "src"
        packages = Packages({**self.environment, "ROS_PACKAGE_PATH": str(source)}, start=source)
        try:
            return read_launch(file, packages=packages, report=Diagnostics(), env=self.environment)
        except (DescriptionError, OSError):
            return None

    def _texts(self, plan: LaunchPlan) -> Iterator[str]:
        """Yield a launch's parameters, and the files that its commands and nodes name, with those that these name."""
        if not any(node.package == "gazebo_ros" for node in plan.nodes):
            return
        lines = [node.arguments for node in plan.nodes]
        for param in plan.params:
            if isinstance(param.value, ParamCommand):
                lines.append(param.value.line)
            else:
                yield str(param.value)
        for word in re.split(r"[\s'\"]+", " ".join(lines)):
            if word.startswith("/"):
                yield from self._closure(Path(word))

    def descriptions_that_name(self, word: str) -> Iterator[Path]:
        """Yield worlds and robots that name a word."""
        for pattern in ("*.world", "*.sdf", "*.urdf", "*.xacro", "*.gazebo"):
            yield from (file for file in self._files(pattern) if word in file.read_text(errors="replace"))

    def _files(self, pattern: str) -> list[Path]:
        return sorted(file for folder in self.folders.values() for file in folder.rglob(pattern) if file.is_file())

    def _closure(self, file: Path) -> Iterator[str]:
        """Yield the texts of a file, and of the files that it names by `$(find package)`."""
        seen: set[Path] = set()
        waiting = [file]
        while waiting and len(seen) < _MAX_FILES:
            path = waiting.pop()
            if path in seen or not path.is_file() or path.stat().st_size > _MAX_BYTES:
                continue
            seen.add(path)
            text = path.read_text(errors="replace")
            yield text
            waiting += [
                self.folders[found["package"]] / found["path"].lstrip("/")
                for found in _FIND.finditer(text)
                if found["package"] in self.folders
            ]
            waiting += [path.parent / found["path"] for found in _BESIDE.finditer(text)]
