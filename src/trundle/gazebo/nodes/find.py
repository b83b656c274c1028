"""Resolves the package and type of a node in a launch file."""

import importlib
import os
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias, cast

from trundle.robots.packages import (
    STOCK,
    STOCK_WITH_FILES,
    cmake_programs,
    compiled_fault,
    package_in_container,
    program_folders,
    source_in_container,
)
from trundle.robots.repositories import repository_hint
from trundle.ros import Node

from .catalog import ALWAYS_REPLACED, BUILTIN_NODES, NODELETS
from .host import BuiltinNode, NodeHost
from .python_interpreter import can_run, is_script
from .unsupported_nodes import ALTERNATIVES, OVER_THE_WIRE

_NOT_SEARCHED = frozenset({"__pycache__", "node_modules", "build"})
_MAX_LISTED_SOURCES = 2
_MAX_LISTED_PROGRAMS = 5
BuiltinNodeClass: TypeAlias = Callable[[Node, list[str], NodeHost], BuiltinNode]
FindPackage: TypeAlias = Callable[[str], Path | None]


@dataclass(frozen=True, slots=True)
class Executable:
    """An executable of the package, run as a process."""

    path: Path


@dataclass(frozen=True, slots=True)
class BuiltinReplacement:
    """A built-in replacement, run in this process."""

    target: str
    """module:Class"""

    def load(self) -> BuiltinNodeClass:
        """Import the class."""
        module, _, name = self.target.partition(":")
        return cast(BuiltinNodeClass, getattr(importlib.import_module(module), name))

    @property
    def command(self) -> tuple[str, ...] | None:
        """Arguments of the equivalent `trundle` command, if this is a command-line tool."""
        return getattr(self.load(), "command", None)


@dataclass(frozen=True, slots=True)
class MissingNode:
    """There is neither an executable nor a stand-in; the launch continues without the node."""

    reason: str


def find_node(
    package: str,
    type_name: str,
    find_package: FindPackage,
    *,
    env: Mapping[str, str],
    arguments: str = "",
    command_line: Sequence[str] = (),
) -> Executable | BuiltinReplacement | MissingNode:
    """Find a node: an executable in the package's folder, a built-in replacement, or a program in a build folder.

    A replacement takes precedence over programs of installed packages, since its window needs no display and its
    messages no sockets; not over those that a source workspace has compiled, which people build to run them. It also
    replaces scripts of a source workspace whose ROS modules (rospy, messages) are missing.

    Args:
        package: package name.
        type_name: executable name.
        find_package: returns a package's folder.
        env: environment of the process.
        arguments: command line, which names a nodelet's class.
        command_line: command line with the node's remappings and name, for advice on running the real node elsewhere.
    """
    target = BUILTIN_NODES.get((package, type_name))
    if target is not None and package in ALWAYS_REPLACED:
        return BuiltinReplacement(target)
    folder = find_package(package)
    not_executable: Path | None = None
    faults: list[str] = []
    """Programs that cannot run here, with the reason."""
    if folder is not None:
        for path in _files(folder, type_name):
            if not os.access(path, os.X_OK):
                not_executable = not_executable or path
            elif fault := compiled_fault(path, env):
                faults.append(f"{path} was built on another machine: {fault}")
            elif target is None or (folder.parent.name != "share" and can_run(path, env)):
                return Executable(path)
    if target is not None:
        own = () if folder is None or folder.parent.name == "share" else _built_programs(package, type_name, folder, {})
        for built in own:
            if compiled_fault(built, env) is None:
                return Executable(built)
        if type_name == "nodelet" and (program := _compiled_nodelet(arguments, find_package, env)) is not None:
            return Executable(program)
        missing = _find_missing_nodelet(arguments, find_package, env, command_line) if type_name == "nodelet" else None
        return missing or BuiltinReplacement(target)
    for built in () if folder is None else _built_programs(package, type_name, folder, env):
        if (fault := compiled_fault(built, env)) is None:
            return Executable(built)
        faults.append(f"{built} was built on another machine: {fault}")
    if not_executable is not None:
        return (
            Executable(not_executable)
            if is_script(not_executable)
            else MissingNode(f"{not_executable} is not executable; run chmod +x on it")
        )
    alternative = f"; {ALTERNATIVES[package]}" if package in ALTERNATIVES else ""
    if alternative.endswith(OVER_THE_WIRE):
        alternative = f"{alternative}: {package_in_container(package, _rosrun(package, type_name, command_line), env)}"
    if folder is not None:
        message = faults[0] if faults else f"no executable {type_name!r} in {folder}"
        message = f"{message}, and no stand-in for {package}/{type_name}"
        hint = _compile_hint(folder, package, type_name, env, command_line) or _program_hint(package, folder, env)
        return MissingNode(f"{message}{hint}{alternative}")
    stand_ins = sorted(name for owner, name in BUILTIN_NODES if owner == package)
    available = f"; stand-ins of that package: {', '.join(stand_ins)}" if stand_ins else alternative
    is_fetched = package in STOCK_WITH_FILES or package not in (*STOCK, *ALTERNATIVES)
    repository = repository_hint(package) if is_fetched else ""
    fetch_hint = f"{repository}: trundle pack get {package}" if repository else ""
    return MissingNode(f"no package {package!r}, and no stand-in for {package}/{type_name}{fetch_hint}{available}")


def _rosrun(package: str, name: str, arguments: Sequence[str]) -> str:
    return shlex.join(["rosrun", package, name, *arguments])


def _compile_hint(folder: Path, package: str, name: str, env: Mapping[str, str], command_line: Sequence[str]) -> str:
    """Return a hint for a missing program that its package's CMakeLists.txt builds; "" if it builds none."""
    program = next((candidate for candidate in cmake_programs(folder) if candidate.name == name), None)
    if program is None:
        return ""
    sources = ", ".join(program.sources[:_MAX_LISTED_SOURCES]) + (
        ", …" if len(program.sources) > _MAX_LISTED_SOURCES else ""
    )
    target = f" (target {program.target!r})" if program.target != name else ""
    line = source_in_container(folder, _rosrun(package, name, command_line), env)
    location = f"{program.file}:{program.line}"
    hint = f"; C++ not compiled yet: {location} builds it{target} from {sources}; catkin_make compiles it"
    return f"{hint}, here or in a container: {line}"


def _program_hint(package: str, folder: Path, env: Mapping[str, str]) -> str:
    """Return a hint that lists a package's programs, for a program that the package neither has nor builds."""
    names = sorted(program_names(package, folder, env=env))
    more = f" and {len(names) - _MAX_LISTED_PROGRAMS} more" if len(names) > _MAX_LISTED_PROGRAMS else ""
    return f"; its programs: {', '.join(names[:_MAX_LISTED_PROGRAMS])}{more}" if names else ""


def missing_nodelet(
    name: str, find_package: FindPackage, env: Mapping[str, str], command_line: Sequence[str] = ()
) -> str:
    """Error message for a nodelet without replacement.

    Args:
        name: nodelet's class.
        find_package: returns a package's folder.
        env: environment of the process.
        command_line: nodelet's arguments, remappings and name, for advice on running it elsewhere.
    """
    message = f"nodelet {name}: compiled code without a stand-in; available: {', '.join(NODELETS)}"
    package, slash, _ = name.partition("/")
    if not slash:
        return message
    folder, command = find_package(package), _rosrun("nodelet", "nodelet", ["standalone", name, *command_line])
    if folder is None or not os.path.isfile(folder / "CMakeLists.txt"):
        line = package_in_container(package, command, env)
    else:
        message += f"; catkin_make compiles {package}, after which launch files load it"
        line = source_in_container(folder, command, env, needs="nodelet")
    return f"{message}; {OVER_THE_WIRE}: {line}"


def _find_missing_nodelet(
    arguments: str, find_package: FindPackage, env: Mapping[str, str], command_line: Sequence[str]
) -> MissingNode | None:
    """Return the class of a nodelet command line if no stand-in has it; None if one has."""
    positional = [argument for argument in command_line if not argument.startswith("--")]
    match arguments.split():
        case ["load" | "standalone" as mode, name, *_] if name not in NODELETS:
            remaining = positional[3 if mode == "load" else 2 :]  # the arguments after the class and the manager
            return MissingNode(missing_nodelet(name, find_package, env, remaining))
        case _:
            return None


def _compiled_nodelet(arguments: str, find_package: FindPackage, env: Mapping[str, str]) -> Path | None:
    """Return the C++ development kit's `nodelet`, which catkin_make links into workspaces with nodelets.

    It loads the nodelets that are compiled there; those with a replacement need neither it nor its managers.
    """
    folders = [Path(entry, "_") for entry in env.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if entry]
    match arguments.split():
        case ["load" | "standalone", name, *_]:
            folder = None if name in NODELETS else find_package(name.partition("/")[0])
            folders = [] if folder is None else [folder]
        case ["manager" | "unload", *_]:
            pass
        case _:
            return None
    homes = (home for folder in folders for home in program_folders("nodelet", folder, env))
    return next((home / "nodelet" for home in homes if (home / "nodelet").is_symlink()), None)


def _built_programs(package: str, name: str, folder: Path, env: Mapping[str, str]) -> Iterator[Path]:
    """Yield programs installed by catkin or colcon outside the package's folder."""
    paths = (path for home in program_folders(package, folder, env) for path in _files(home, name))
    return (path for path in paths if os.access(path, os.X_OK))


def program_names(package: str, folder: Path | None, *, env: Mapping[str, str]) -> set[str]:
    """Return the names that `find_node` resolves in a package."""
    names = {name for owner, name in BUILTIN_NODES if owner == package}
    for home in [folder, *program_folders(package, folder, env)] if folder is not None else ():
        for root, folders, files in os.walk(home):
            folders[:] = [name for name in folders if not name.startswith(".") and name not in _NOT_SEARCHED]
            names.update(name for name in files if os.access(os.path.join(root, name), os.X_OK))
    return names


def same_named_programs(folder: Path, program: Path) -> list[Path]:
    """Return all programs of a package with the same name, including `program`."""
    return [path for path in _files(folder, program.name) if os.access(path, os.X_OK)]


def _files(folder: Path, name: str) -> Iterator[Path]:
    """Yield the files with a name in a package, in rosrun's search order; the name may contain folders."""
    direct = folder / name
    if "/" in name:
        if os.path.isfile(direct) and folder.resolve() in direct.resolve().parents:
            yield direct
        return
    seen: set[str] = set()
    for root, folders, files in os.walk(folder, followlinks=True):
        if (real := os.path.realpath(root)) in seen:  # a link to a folder above
            folders.clear()
            continue
        seen.add(real)
        folders[:] = sorted(f for f in folders if not f.startswith(".") and f not in _NOT_SEARCHED)
        if name in files:
            yield Path(root) / name
