"""Compiled programs of another machine are recognised before they are started."""

import platform
import shutil
import sys
from pathlib import Path

import pytest

from trundle.gazebo.nodes import Executable, MissingNode, find_node
from trundle.robots.packages import compiled_fault

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="ELF is the format of Linux's programs")
_REAL = Path("/proc/self/exe").resolve()
_LIBRARY = b"\0libc.so.6\0"


def _copied(path: Path, old: bytes, new: bytes) -> Path:
    """A copy of this Python with a few bytes changed, in a workspace's devel folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    data = bytearray(_REAL.read_bytes())
    if old:
        assert old in data
        start = data.index(old)
        data[start : start + len(old)] = new
    path.write_bytes(data)
    path.chmod(0o755)
    return path


def _other_machine(path: Path) -> Path:
    other = 62 if platform.machine() == "aarch64" else 183
    data = _REAL.read_bytes()
    return _copied(path, data[:20], data[:18] + other.to_bytes(2, "little"))


def test_programs_of_this_machine_run(tmp_path: Path) -> None:
    shell = Path(shutil.which("sh") or "/bin/sh")
    script = tmp_path / "script"
    script.write_text("#!/bin/sh\n")
    for path in (_REAL, shell, script, tmp_path / "no_such_file"):
        assert compiled_fault(path, {}) is None


def test_another_processor_and_a_missing_library_are_named(tmp_path: Path) -> None:
    name = "ARM64" if platform.machine() != "aarch64" else "x86-64"
    foreign = _other_machine(tmp_path / "a")
    assert compiled_fault(foreign, {}) == f"it is compiled for {name}, not {platform.machine()}"
    lacking = _copied(tmp_path / "b", _LIBRARY, b"\0libq.so.6\0")
    assert compiled_fault(lacking, {}) == "libq.so.6 is not here"
    (tmp_path / "lib").mkdir()
    (tmp_path / "lib/libq.so.6").touch()
    assert compiled_fault(lacking, {"LD_LIBRARY_PATH": f":{tmp_path / 'lib'}"}) is None


def test_damaged_programs_are_left_to_the_system(tmp_path: Path) -> None:
    data = _REAL.read_bytes()
    for size in (4, 20, 64, 300, 1000):
        (tmp_path / "cut").write_bytes(data[:size])
        assert compiled_fault(tmp_path / "cut", {}) is None
    (tmp_path / "full").write_bytes(data[:64].ljust(64) + b"\xff" * 20_000)
    compiled_fault(tmp_path / "full", {})


def test_a_copied_devel_folder_counts_as_not_built(tmp_path: Path) -> None:
    package = tmp_path / "src/arm"
    package.mkdir(parents=True)
    (package / "CMakeLists.txt").write_text("add_executable(drive src/drive.cpp)\n")
    program = _other_machine(tmp_path / "devel/lib/arm/drive")

    node = find_node("arm", "drive", lambda _: package, env={})

    assert isinstance(node, MissingNode)
    assert node.reason.startswith(f"{program} was built on another machine: it is compiled for ")
    assert f"C++ not compiled yet: {package}/CMakeLists.txt:1 builds it from src/drive.cpp" in node.reason
    _copied(program, b"", b"")
    assert find_node("arm", "drive", lambda _: package, env={}) == Executable(program)
