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

from .catalog import BUILTIN_NODES, NODELETS, OURS_ALWAYS
from .host import BuiltinNode, NodeHost
from .python_interpreter import can_run, is_script
from .unsupported_nodes import ALTERNATIVES, OVER_THE_WIRE

_NOT_SEARCHED = frozenset({"__pycache__", "node_modules", "build"})
_SOURCES_NAMED = 2
_PROGRAMS_NAMED = 5
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
    """Neither; the launch continues without the node."""

    why: str


def find_node(
    package: str,
    type_name: str,
    find_package: FindPackage,
    *,
    env: Mapping[str, str],
    arguments: str = "",
    words: Sequence[str] = (),
) -> Executable | BuiltinReplacement | MissingNode:
    """Find a node: an executable in the package's folder, a built-in replacement, or a program in a build folder.

    The replacement takes precedence over programs of installed packages, as its window needs no display and its
    messages no sockets. It also replaces scripts in a source workspace whose ROS modules (rospy, messages) are missing.

    Args:
        package: package name.
        type_name: executable name.
        find_package: returns a package's folder.
        env: environment of the process.
        arguments: command line, which names a nodelet's class.
        words: command line with the node's remappings and name, for advice to run the real node elsewhere.
    """
    target = BUILTIN_NODES.get((package, type_name))
    if target is not None and package in OURS_ALWAYS:
        return BuiltinReplacement(target)
    folder = find_package(package)
    plain: Path | None = None
    faults: list[str] = []
    """Programs that cannot run here, with the reason."""
    if folder is not None:
        for path in _files(folder, type_name):
            if not os.access(path, os.X_OK):
                plain = plain or path
            elif fault := compiled_fault(path, env):
                faults.append(f"{path} was built on another machine: {fault}")
            elif target is None or (folder.parent.name != "share" and can_run(path, env)):
                return Executable(path)
    if target is not None:
        missing = _nodelet(arguments, find_package, env, words) if type_name == "nodelet" else None
        return missing or BuiltinReplacement(target)
    for built in () if folder is None else _built(package, type_name, folder, env):
        if (fault := compiled_fault(built, env)) is None:
            return Executable(built)
        faults.append(f"{built} was built on another machine: {fault}")
    if plain is not None:
        return Executable(plain) if is_script(plain) else MissingNode(f"{plain} is not executable; run chmod +x on it")
    way_out = f"; {ALTERNATIVES[package]}" if package in ALTERNATIVES else ""
    if way_out.endswith(OVER_THE_WIRE):
        way_out = f"{way_out}: {package_in_container(package, _rosrun(package, type_name, words), env)}"
    if folder is not None:
        why = faults[0] if faults else f"no executable {type_name!r} in {folder}"
        why = f"{why}, and no stand-in for {package}/{type_name}"
        hint = _to_compile(folder, package, type_name, env, words) or _programs_there(package, folder, env)
        return MissingNode(f"{why}{hint}{way_out}")
    known = sorted(name for owner, name in BUILTIN_NODES if owner == package)
    there_is = f"; stand-ins of that package: {', '.join(known)}" if known else way_out
    is_fetched = package in STOCK_WITH_FILES or package not in (*STOCK, *ALTERNATIVES)
    published = repository_hint(package) if is_fetched else ""
    fetched = f"{published}: trundle pack get {package}" if published else ""
    return MissingNode(f"no package {package!r}, and no stand-in for {package}/{type_name}{fetched}{there_is}")


def _rosrun(package: str, name: str, words: Sequence[str]) -> str:
    return shlex.join(["rosrun", package, name, *words])


def _to_compile(folder: Path, package: str, name: str, env: Mapping[str, str], words: Sequence[str]) -> str:
    """Hint to append for a missing program that its package's CMakeLists.txt builds."""
    program = next((each for each in cmake_programs(folder) if each.name == name), None)
    if program is None:
        return ""
    sources = ", ".join(program.sources[:_SOURCES_NAMED]) + (", …" if len(program.sources) > _SOURCES_NAMED else "")
    target = f" (target {program.target!r})" if program.target != name else ""
    line = source_in_container(folder, _rosrun(package, name, words), env)
    where = f"{program.file}:{program.line}"
    built = f"; C++ not compiled yet: {where} builds it{target} from {sources}; catkin_make compiles it"
    return f"{built}, here or in a container: {line}"


def _programs_there(package: str, folder: Path, env: Mapping[str, str]) -> str:
    """Hint to append for a program that is neither in a package nor built by it."""
    names = sorted(program_names(package, folder, env=env))
    more = f" and {len(names) - _PROGRAMS_NAMED} more" if len(names) > _PROGRAMS_NAMED else ""
    return f"; its programs: {', '.join(names[:_PROGRAMS_NAMED])}{more}" if names else ""


def missing_nodelet(name: str, find_package: FindPackage, env: Mapping[str, str], words: Sequence[str] = ()) -> str:
    """Error message for a nodelet without replacement.

    Args:
        name: of its class.
        find_package: as `find_node`.
        env: as `find_node`.
        words: its arguments, remappings and name, for advice to run it elsewhere.
    """
    what = f"nodelet {name}: compiled code without a stand-in; available: {', '.join(NODELETS)}"
    package, slash, _ = name.partition("/")
    if not slash:
        return what
    folder, command = find_package(package), _rosrun("nodelet", "nodelet", ["standalone", name, *words])
    if folder is None or not os.path.isfile(folder / "CMakeLists.txt"):
        line = package_in_container(package, command, env)
    else:
        line = source_in_container(folder, command, env, needs="nodelet")
    return f"{what}; {OVER_THE_WIRE}: {line}"


def _nodelet(
    arguments: str, find_package: FindPackage, env: Mapping[str, str], words: Sequence[str]
) -> MissingNode | None:
    """Missing nodelet class of a nodelet command line; None if it is available."""
    after = [word for word in words if not word.startswith("--")]
    match arguments.split():
        case ["load" | "standalone" as how, name, *_] if name not in NODELETS:
            rest = after[3 if how == "load" else 2 :]  # the class, and the manager that would load it
            return MissingNode(missing_nodelet(name, find_package, env, rest))
        case _:
            return None


def _built(package: str, name: str, folder: Path, env: Mapping[str, str]) -> Iterator[Path]:
    """Programs installed by catkin or colcon outside the package's folder."""
    paths = (path for home in program_folders(package, folder, env) for path in _files(home, name))
    return (path for path in paths if os.access(path, os.X_OK))


def program_names(package: str, folder: Path | None, *, env: Mapping[str, str]) -> set[str]:
    """Names that `find_node` resolves in a package."""
    found = {name for owner, name in BUILTIN_NODES if owner == package}
    for home in [folder, *program_folders(package, folder, env)] if folder is not None else ():
        for root, folders, files in os.walk(home):
            folders[:] = [each for each in folders if not each.startswith(".") and each not in _NOT_SEARCHED]
            found.update(name for name in files if os.access(os.path.join(root, name), os.X_OK))
    return found


def same_named_programs(folder: Path, program: Path) -> list[Path]:
    """All programs of a package with the same name, including `program`."""
    return [path for path in _files(folder, program.name) if os.access(path, os.X_OK)]


def _files(folder: Path, name: str) -> Iterator[Path]:
    """Files of this name in a package, in rosrun's search order; the name may contain folders."""
    direct = folder / name
    if "/" in name:
        if os.path.isfile(direct) and folder.resolve() in direct.resolve().parents:
            yield direct
        return
    for root, folders, files in os.walk(folder):
        folders[:] = sorted(f for f in folders if not f.startswith(".") and f not in _NOT_SEARCHED)
        if name in files:
            yield Path(root) / name
