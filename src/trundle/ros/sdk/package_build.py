"""Builds a package by CMake and Ninja with the development kit, target by target."""

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Generator, Iterator, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from .kit import Kit, header_packages
from .toolchain import Toolchain
from .zig import zig_definitions

_FAILED = re.compile(r"^FAILED: (?:\[code=\d+\] )?(?P<file>\S+)")
_OBJECT = re.compile(r"(?:^|/)CMakeFiles/([^/]+)\.dir/")
_ERROR = re.compile(r"(?:fatal )?error: (?P<text>.+)")
_UNDEFINED = re.compile(r"undefined reference to (?P<text>.+)")
_NO_LIBRARY = re.compile(r"cannot find (?P<text>-l[^\s:]+)")
_COMPILER = re.compile(r"^CMAKE_CXX_COMPILER:\w+=(?P<path>.*)$", re.MULTILINE)
_CMAKE_ERROR = re.compile(
    r"^CMake Error(?: at (?P<where>[^\s:]+:\d+))?[^\n]*\n(?P<text>(?:[ \t]*\S[^\n]*\n|\n(?=  ))*)", re.MULTILINE
)


class BuildResult(NamedTuple):
    """Result of the build of a package."""

    is_configured: bool
    """False: CMake stopped, and nothing is built."""
    missing: tuple[str, ...]
    """Packages and libraries that CMake did not find."""
    failures: dict[str, str]
    """Target, or file that it makes → first error."""


class PackageBuilder:
    """Builder of a workspace's packages, each in a folder of its own."""

    def __init__(
        self,
        kit: Kit,
        toolchain: Toolchain,
        *,
        build: Path,
        devel: Path,
        install: Path,
        underlays: Sequence[str],
        definitions: Sequence[str],
        environment: Mapping[str, str],
    ) -> None:
        """Create a builder.

        Args:
            kit: compiled kit.
            toolchain: compiler and tools.
            build: folder of the packages' build folders.
            devel: devel space.
            install: install space.
            underlays: devel spaces of the workspaces that this one extends.
            definitions: arguments of CMake, such as -DCMAKE_BUILD_TYPE=Debug.
            environment: variables of the tools.
        """
        self._toolchain = toolchain
        self._build, self._devel = build, devel
        self._environment = dict(environment)
        cmake = kit.sources / "catkin/cmake"
        self._settings = [
            *("-G", "Ninja", f"-DCMAKE_MAKE_PROGRAM={toolchain.ninja}", f"-DCMAKE_CXX_COMPILER={toolchain.compiler}"),
            *(f"-Dcatkin_DIR={cmake}", f"-DCMAKE_PROJECT_INCLUDE={cmake / 'find.cmake'}"),
            *(f"-DTRUNDLE_SDK={kit.sources}", f"-DTRUNDLE_KIT={kit.folder}", f"-DTRUNDLE_PYTHON={sys.executable}"),
            *(f"-DTRUNDLE_HEADER_PACKAGES={';'.join(header_packages())}", f"-DTRUNDLE_UNDERLAYS={';'.join(underlays)}"),
            *(f"-DTRUNDLE_BOOST_PREFIX={toolchain.boost or ''}", f"-DCMAKE_PREFIX_PATH={';'.join(toolchain.prefixes)}"),
            *zig_definitions(toolchain.compiler),
            *(f"-DCATKIN_DEVEL_PREFIX={devel}", f"-DCMAKE_INSTALL_PREFIX={install}"),
            *("-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_POLICY_VERSION_MINIMUM=3.5", "-DCMAKE_POLICY_DEFAULT_CMP0054=NEW"),
            *("-Wno-dev", "-Wno-deprecated", "--no-warn-unused-cli", *definitions),
        ]

    def build(
        self, name: str, folder: Path, *, jobs: str | None, targets: Sequence[str] = ()
    ) -> Iterator[str | BuildResult]:
        """Build a package; yield the tools' lines, and at the end the result.

        Args:
            name: name of the package.
            folder: its folder.
            jobs: number of compilers that run at the same time; None: one for each processor.
            targets: targets of Ninja; empty: all.
        """
        is_tested = any(target == "tests" or target.startswith("run_tests") for target in targets)
        code, text, lacks = yield from self._configure(name, folder, is_tested)
        if code:
            yield BuildResult(False, lacks, {"CMake": _cmake_error(text)})
            return
        ninja = self._ninja(name, jobs)
        built = ""
        if is_tested:  # tests run nodes, and load libraries that are built for tests alone
            _, built = yield from self._run([*ninja, "all"])
        code, text = yield from self._run([*ninja, *targets])
        text = built + text
        yield BuildResult(True, lacks, _failures(text) or ({"ninja": text.splitlines()[-1]} if code and text else {}))

    def build_exports(self, name: str, folder: Path, *, jobs: str | None) -> Iterator[str]:
        """Configure a package, and build the libraries that it exports by catkin_package(); yield the tools' lines.

        Args:
            name: name of the package.
            folder: its folder.
            jobs: number of compilers that run at the same time; None: one for each processor.
        """
        code, _, _ = yield from self._configure(name, folder, False)
        if not code and (self._devel / f"share/{name}/cmake/{name}Config.cmake").exists():
            yield from self._run([*self._ninja(name, jobs), "trundle_exports"])

    def _configure(
        self, name: str, folder: Path, is_tested: bool
    ) -> Generator[str, None, tuple[int, str, tuple[str, ...]]]:
        """Run CMake; return its code and text, and what it did not find."""
        build = self._build / name
        missing = build / "trundle_missing.txt"
        missing.unlink(missing_ok=True)
        _forget_other_compiler(build, self._toolchain.compiler)
        configure = [self._toolchain.cmake, "-S", str(folder), "-B", str(build)]
        configure.append(f"-DCATKIN_ENABLE_TESTING={'ON' if is_tested else 'OFF'}")
        code, text = yield from self._run([*configure, *self._settings])
        return code, text, tuple(dict.fromkeys(missing.read_text().split())) if missing.exists() else ()

    def _ninja(self, name: str, jobs: str | None) -> list[str]:
        parallel = [] if jobs is None else ["-j", jobs]
        return [self._toolchain.ninja, "-C", str(self._build / name), "-k", "0", *parallel]

    def _run(self, command: list[str]) -> Generator[str, None, tuple[int, str]]:
        lines: list[str] = []
        environment = {**self._environment, "NINJA_STATUS": "[%f/%t] "}
        with subprocess.Popen(
            command, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
        ) as process:
            assert process.stdout is not None
            for line in process.stdout:
                lines.append(line)
                yield line.rstrip("\n")
        return process.returncode, "".join(lines)


def _forget_other_compiler(build: Path, compiler: str) -> None:
    """Remove what CMake noted of another compiler: it would begin again without its arguments."""
    cache = build / "CMakeCache.txt"
    noted = _COMPILER.search(cache.read_text(encoding="utf-8", errors="replace")) if cache.exists() else None
    if noted is not None and noted["path"] != compiler:
        cache.unlink()
        shutil.rmtree(build / "CMakeFiles", ignore_errors=True)


def _failures(text: str) -> dict[str, str]:
    """Return the targets that Ninja could not build, or the files that they make, each with its first error."""
    failures: dict[str, str] = {}
    target = ""
    for line in text.splitlines():
        if (failed := _FAILED.match(line)) is not None:
            compiled = _OBJECT.search(failed["file"])
            name = os.path.basename(failed["file"])
            target = (
                compiled[1] if compiled else name.removeprefix("lib").removesuffix(".so") if ".so" in name else name
            )
            failures.setdefault(target, "")
        elif target and not failures[target]:
            failures[target] = _error(line)
    return failures


def _error(line: str) -> str:
    """Return the error in a line of a compiler or linker; empty if there is none."""
    if (undefined := _UNDEFINED.search(line)) is not None:
        return f"undefined: {undefined['text']}"
    if (library := _NO_LIBRARY.search(line)) is not None:
        return f"no library {library['text']}"
    error = _ERROR.search(line)
    return "" if error is None else error["text"]


def _cmake_error(text: str) -> str:
    match = _CMAKE_ERROR.search(text)
    if match is None:
        return (text.strip().splitlines() or ["CMake failed"])[-1]
    where = f"{os.path.basename(match['where'])}: " if match["where"] else ""
    return where + " ".join(match["text"].split())
