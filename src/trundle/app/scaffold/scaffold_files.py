"""Files of each kind of scaffold, and their writer."""

import os
import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

_TEMPLATES = Path(__file__).with_name("templates")
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_CAMEL_CASE = re.compile(r"[A-Z][A-Za-z0-9]*")
_EXECUTABLE = (".py",)
ROBOTS = ("differential", "car", "arm", "quadruped")


@dataclass(frozen=True, slots=True, kw_only=True)
class Scaffold:
    """Files of one kind, and their next steps."""

    files: Mapping[str, str]
    """Path with @NAME@ → template."""
    next_steps: tuple[str, ...]
    """Commands that run the scaffold."""
    cmake: str = ""
    """Template of what the package's CMakeLists.txt gets."""
    needs_package: bool = False
    """True: ROS finds the file only in a package."""
    is_camel_case: bool = False


def _robot(kind: str) -> Scaffold:
    controlled = kind != "differential"
    return Scaffold(
        files={
            "urdf/@NAME@.urdf.xacro": f"{kind}.urdf.xacro",
            "launch/@NAME@.launch": f"{kind}.launch" if controlled else "differential.launch",
            "test/test_@NAME@.py": f"test_{kind}.py",
        },
        next_steps=("trundle run urdf/@NAME@.urdf.xacro", "trundle launch launch/@NAME@.launch", "pytest test"),
    )


_NODE = {
    "scripts/@NAME@.py": "node.py",
    "test/@NAME@.test": "node.test",
    "test/check_@NAME@.py": "check_node.py",
}


_CPP_NODE = {
    "src/@NAME@.cpp": "cpp_node.cpp",
    "test/@NAME@.test": "cpp_node.test",
    "test/check_@NAME@.py": "check_node.py",
}
_CPP = {
    "package": Scaffold(
        files={**_CPP_NODE, "launch/@NAME@.launch": "cpp_package.launch"},
        next_steps=(
            "trundle shell -c catkin_make                       # in the workspace, whose src has the package",
            "trundle launch @NAME@ @NAME@.launch",
            "trundle shell -c 'catkin_make run_tests'",
        ),
        cmake="cpp_node.cmake",
    ),
    "node": Scaffold(
        files=_CPP_NODE,
        next_steps=(
            "trundle shell -c catkin_make                       # in the workspace",
            "trundle exec @PACKAGE@ @NAME@",
            "trundle shell -c 'catkin_make run_tests'",
        ),
        needs_package=True,
        cmake="cpp_node.cmake",
    ),
    "plugin": Scaffold(
        files={
            "models/@NAME@/model.config": "model.config",
            "models/@NAME@/model.sdf": "cpp_plugin.sdf",
            "models/@NAME@/CMakeLists.txt": "cpp_plugin.cmake",
            "models/@NAME@/@NAME@.cc": "cpp_plugin.cc",
            "test/test_@NAME@.py": "test_cpp_plugin.py",
        },
        next_steps=(
            "trundle shell -c 'cmake -S models/@NAME@ -B models/@NAME@/build && make -C models/@NAME@/build'",
            "trundle run models/@NAME@",
            "pytest test",
        ),
    ),
}
"""Scaffolds in C++, by kind."""


def scaffolds(robot: str = ROBOTS[0], *, is_cpp: bool = False) -> dict[str, Scaffold]:
    """Return the scaffolds by kind.

    Args:
        robot: one of ROBOTS.
        is_cpp: True for those in C++: plugins, packages and nodes.
    """
    if is_cpp:
        return _CPP
    return {
        "package": Scaffold(
            files={**_NODE, "launch/@NAME@.launch": "package.launch"},
            next_steps=("cd @NAME@", "trundle launch launch/@NAME@.launch", "trundle test test/@NAME@.test"),
        ),
        "robot": _robot(robot),
        "world": Scaffold(
            files={"worlds/@NAME@.world": "world.world", "test/test_@NAME@.py": "test_world.py"},
            next_steps=("trundle run worlds/@NAME@.world", "pytest test"),
        ),
        "plugin": Scaffold(
            files={
                "models/@NAME@/model.config": "model.config",
                "models/@NAME@/model.sdf": "plugin.sdf",
                "models/@NAME@/@NAME@.py": "plugin.py",
                "test/test_@NAME@.py": "test_plugin.py",
            },
            next_steps=("trundle run models/@NAME@", "pytest test"),
        ),
        "node": Scaffold(
            files=_NODE,
            next_steps=("trundle exec @PACKAGE@ @NAME@.py", "trundle test test/@NAME@.test"),
            needs_package=True,
        ),
        "launch": Scaffold(
            files={"launch/@NAME@.launch": "launch.launch", "test/test_@NAME@_launch.py": "test_launch.py"},
            next_steps=("trundle launch launch/@NAME@.launch", "pytest test"),
        ),
        "message": Scaffold(
            files={"msg/@NAME@.msg": "message.msg", "test/test_@NAME@_message.py": "test_message.py"},
            next_steps=("trundle msg show @PACKAGE@/@NAME@", "pytest test"),
            needs_package=True,
            is_camel_case=True,
        ),
    }


def write_scaffold(scaffold: Scaffold, name: str, folder: Path, *, package: str) -> list[Path]:
    """Write the files; return their paths.

    Args:
        scaffold: scaffold to write.
        name: name of the package, robot, world or other kind.
        folder: folder to write to, such as a package's.
        package: name of the package; empty: none.

    Raises:
        UsageError: an invalid name, or a file that exists or cannot be written; then nothing is written.
    """
    check_name(name, is_camel_case=scaffold.is_camel_case)
    values = {"@NAME@": name, "@PACKAGE@": package, "@CLASS@": "".join(part.title() for part in name.split("_"))}
    texts = {
        folder / _substitute(path, values): _substitute(
            (_TEMPLATES / f"{template}.in").read_text(encoding="utf-8"), values
        )
        for path, template in scaffold.files.items()
    }
    for path in texts:
        if os.path.lexists(path):
            raise UsageError(f"{path} exists already; nothing is written")
    try:
        for path, text in texts.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            write_atomically(path, text, replace=False)
            if text.startswith("#!") and path.suffix in _EXECUTABLE:
                path.chmod(0o755)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    return list(texts)


def append_target(scaffold: Scaffold, name: str, folder: Path, *, package: str) -> Path | None:
    """Append the node's target to the package's CMakeLists.txt; return its path, None if the scaffold has no target.

    Raises:
        UsageError: the file cannot be written.
    """
    if not scaffold.cmake:
        return None
    path = folder / "CMakeLists.txt"
    target = _substitute(
        (_TEMPLATES / f"{scaffold.cmake}.in").read_text(encoding="utf-8"), {"@NAME@": name, "@PACKAGE@": package}
    )
    try:
        write_atomically(path, (path.read_text(encoding="utf-8") if path.exists() else "") + target)
    except OSError as error:
        raise UsageError(f"cannot write {error.filename}: {error.strerror}") from None
    return path


def next_steps(scaffold: Scaffold, name: str, package: str) -> list[str]:
    """Return the commands that run the written files."""
    return [_substitute(step, {"@NAME@": name, "@PACKAGE@": package}) for step in scaffold.next_steps]


def _substitute(text: str, values: Mapping[str, str]) -> str:
    for variable, value in values.items():
        text = text.replace(variable, value)
    return text


def check_name(name: str, *, is_camel_case: bool) -> None:
    """Refuse what is no name of a package, file or message.

    Raises:
        UsageError: no name.
    """
    if is_camel_case and _CAMEL_CASE.fullmatch(name) is None:
        raise UsageError(f"{name!r} is not a message name, such as WheelSpeed")
    if _NAME.fullmatch(name) is None:
        raise UsageError(f"{name!r} is not a name; letters, digits and _ are allowed, a letter first")
