"""Compiled kits in the cache: which are kept."""

import os
from pathlib import Path

import pytest

from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock
from trundle.ros.sdk import compiled_kit
from trundle.ros.sdk.kit_cache import mark_used, note_workspace, trim
from trundle.ros.sdk.toolchain import Toolchain


def _kit(root: Path, name: str, age_s: int, *, compiler: str = "g++") -> Path:
    folder = root / name
    (folder / "lib").mkdir(parents=True)
    mark_used(folder, compiler)
    os.utime(folder / "ready", (1e9 - age_s, 1e9 - age_s))
    return folder


def test_the_newest_kits_of_each_compiler_and_those_of_workspaces_stay(tmp_path: Path) -> None:
    root, devel = tmp_path / "sdk", tmp_path / "ws/devel"
    devel.mkdir(parents=True)
    used = _kit(root, "used", 100)
    kits = [_kit(root, f"kit{age}", age) for age in range(6)]
    clang = _kit(root, "clang", 1000, compiler="clang++")
    note_workspace(kits[5], devel)
    note_workspace(kits[4], devel)
    note_workspace(kits[4], devel)
    locked = _kit(root, "locked", 2000)
    lock = FileLock(locked)
    (root / "unfinished").mkdir()

    trim(root, used)
    lock.release()

    assert {path.name for path in root.iterdir()} == {
        *("used", "kit0", "kit1", "kit2"),  # four of g++
        "kit4",  # the workspace's; kit5 was its kit before
        *(clang.name, "locked", "unfinished"),
    }
    (devel / ".trundle_kit").unlink()
    trim(root, used)
    assert not kits[4].exists(), "the workspace is gone"


def test_old_unfinished_kits_are_removed(tmp_path: Path) -> None:
    used, old = _kit(tmp_path, "used", 0), tmp_path / "old"
    old.mkdir()
    os.utime(old, (1e9, 1e9))
    trim(tmp_path, used)
    assert [path.name for path in tmp_path.iterdir()] == ["used"]


def _program(file: Path, *lines: str) -> str:
    file.write_text("\n".join(["#!/bin/sh", *lines, ""]))
    file.chmod(0o755)
    return str(file)


def test_a_build_of_the_kit_tells_how_far_it_is(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    """Programs stand for the compiler's tools: a real build takes minutes."""
    ninja = _program(
        tmp_path / "ninja",
        f'echo "$@" > {tmp_path}/arguments',
        "for i in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do printf '%s' \"[$i/20] \"; echo compile; done",
        "echo odd; test -z \"$FAILS\" || { echo 'error: no such header'; exit 1; }",
    )
    tools = Toolchain(_program(tmp_path / "c++"), "c++ 1", _program(tmp_path / "cmake"), ninja, None)
    environment = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "PATH": os.environ["PATH"]}

    with pytest.raises(UsageError, match=r"cannot be compiled by .*c\+\+:\n(.*\n)*error: no such header"):
        compiled_kit(tools, {**environment, "FAILS": "1"})
    capfd.readouterr()
    kit = compiled_kit(tools, environment, jobs="1")

    told = capfd.readouterr().err.splitlines()
    assert told[0] == "-- compiling the C++ development kit, once for this compiler"
    assert told[1:] == [f"--   {built} of 20" for built in range(2, 21, 2)]
    assert " -j 1 install" in (tmp_path / "arguments").read_text()
    assert (kit.folder / "ready").exists()
    compiled_kit(tools, environment)
    assert capfd.readouterr().err == ""


def test_a_build_that_another_environment_did_not_finish_is_begun_anew(tmp_path: Path) -> None:
    """CMake refuses a build whose sources lie elsewhere; an own one goes on."""
    cmake = _program(
        tmp_path / "cmake",
        "test ! -e $4/CMakeCache.txt || echo went on >> $4/../went_on",
        "mkdir -p $4 && echo CMAKE_HOME_DIRECTORY:INTERNAL=$2 > $4/CMakeCache.txt",
    )
    ninja = _program(tmp_path / "ninja", 'test -z "$FAILS"')
    tools = Toolchain(_program(tmp_path / "c++"), "c++ 1", cmake, ninja, None)
    environment = {"XDG_CACHE_HOME": str(tmp_path / "cache"), "PATH": os.environ["PATH"]}
    for _ in range(2):
        with pytest.raises(UsageError, match="cannot be compiled"):
            compiled_kit(tools, {**environment, "FAILS": "1"})
    (folder,) = (tmp_path / "cache/trundle/sdk").iterdir()
    assert (folder / "went_on").read_text() == "went on\n"

    (folder / "build/CMakeCache.txt").write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/elsewhere/sdk\n")
    compiled_kit(tools, environment)
    assert (folder / "went_on").read_text() == "went on\n"
