"""Parts of a package that run without building, and its C++ targets, which must be compiled."""

import os
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from trundle.robots.packages import (
    CMakeProgram,
    build_prefixes,
    cmake_libraries,
    cmake_programs,
    compiled_fault,
    program_folders,
)

_SOURCES = (".cpp", ".cc", ".cxx", ".c", ".c++")
_KINDS = {
    ".msg": "messages",
    ".srv": "services",
    ".action": "actions",
    ".launch": "launch files",
    ".urdf": "robots",
    ".xacro": "xacro files",
    ".world": "worlds",
    ".sdf": "models",
    ".cfg": "reconfigure options",
}
_NOT_SEARCHED = frozenset({"build", "devel", "install", "__pycache__"})


@dataclass(frozen=True, slots=True, kw_only=True)
class CppTarget:
    """Program or library in C++."""

    target: CMakeProgram
    is_library: bool
    built: Path | None
    """The compiled file; None if it is not built."""
    fault: str | None
    """Reason why this machine cannot load the compiled file."""


@dataclass(frozen=True, slots=True, kw_only=True)
class PackageBuild:
    """Build report of one package."""

    ready: tuple[str, ...]
    """Parts that run without building, with their number: `2 messages`."""
    targets: tuple[CppTarget, ...]


def report_package(packages: Mapping[str, Path], name: str, environment: Mapping[str, str]) -> PackageBuild:
    """Report on a package's files and the targets of its CMakeLists.txt.

    Args:
        packages: name → folder of the workspace's packages, which are built together.
        name: name of the package.
        environment: variables that name the folders of installed packages.
    """
    folder = packages[name]
    counts: Counter[str] = Counter()
    for root, folders, files in os.walk(folder):
        folders[:] = [child for child in folders if not child.startswith(".") and child not in _NOT_SEARCHED]
        for file in files:
            kind = _KINDS.get(Path(file).suffix.lower()) or _script(Path(root, file))
            counts.update([kind] if kind else [])
    homes = program_folders(name, folder, environment)
    shared = [prefix / "lib" for prefix in build_prefixes(name, folder, environment)]
    programs = [
        _target(program, _existing(homes, program.name), environment, is_library=False)
        for program in cmake_programs(folder)
    ]
    libraries = [
        _target(
            library, _existing(shared, f"lib{library.name}.so", f"lib{library.name}.a"), environment, is_library=True
        )
        for library in cmake_libraries(folder)
        if any(source.endswith(_SOURCES) or "*" in source for source in library.sources)
    ]
    return PackageBuild(
        ready=tuple(f"{count} {kind}" for kind, count in sorted(counts.items())),
        targets=(*programs, *libraries),
    )


def _target(target: CMakeProgram, built: Path | None, environment: Mapping[str, str], *, is_library: bool) -> CppTarget:
    fault = None if built is None else compiled_fault(built, environment)
    return CppTarget(target=target, is_library=is_library, built=built, fault=fault)


def _script(file: Path) -> str | None:
    return "Python programs" if file.suffix == ".py" and os.access(file, os.X_OK) else None


def _existing(folders: list[Path], *names: str) -> Path | None:
    return next((folder / name for folder in folders for name in names if os.path.isfile(folder / name)), None)
