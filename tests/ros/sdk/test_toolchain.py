"""What a build says about a machine without compiler, about another build, and about targets that fail."""

import importlib.util
import os
import subprocess
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from tests.graphs import until
from tests.ros.sdk.conftest import require_compiler

from trundle.base.diagnostics import UsageError
from trundle.base.file_lock import FileLock
from trundle.ros.sdk import Toolchain, compiled_kit, find_toolchain, kit_sources
from trundle.ros.sdk.kit import _digest
from trundle.ros.sdk.package_build import _cmake_error, _failures, _forget_other_compiler
from trundle.ros.sdk.zig import zig_definitions, zig_tools


def test_without_a_compiler_a_sentence_says_what_to_install(tmp_path: Path) -> None:
    if importlib.util.find_spec("ziglang") is None:
        with pytest.raises(UsageError, match=r"there is no C\+\+ compiler; .*pip install 'trundle\[cpp\]'"):
            find_toolchain({"PATH": str(tmp_path)})
    with pytest.raises(UsageError, match="CXX names 'cc-of-mine', which is not found"):
        find_toolchain({"PATH": str(tmp_path), "CXX": "cc-of-mine"})


def test_a_build_waits_for_another_that_compiles_the_kit(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    toolchain = Toolchain("c++", "1", "cmake", "ninja", None)
    folder = tmp_path / "trundle/sdk" / _digest(kit_sources(), toolchain, "")
    folder.mkdir(parents=True)
    folder.parent.chmod(0o700)
    other = FileLock(folder)
    with ThreadPoolExecutor() as pool:
        waiting = pool.submit(compiled_kit, toolchain, {"XDG_CACHE_HOME": str(tmp_path)})
        until(lambda: "waiting for another build" in capsys.readouterr().err)
        (folder / "ready").touch()
        other.release()
        assert waiting.result().folder == folder


def test_the_kit_is_compiled_with_the_eigen_of_python(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its libraries of MoveIt are left out without Eigen; a kit without them is another kit."""
    ran: list[str] = []

    def run(command: list[object], _: object) -> tuple[int, list[str]]:
        ran.extend(map(str, command))
        return 0, []

    monkeypatch.setattr("trundle.ros.sdk.kit._run", run)
    without = Toolchain("c++", "1", "cmake", "ninja", None)
    toolchain = without._replace(eigen=tmp_path / "cmeel.prefix")
    kit = compiled_kit(toolchain, {"XDG_CACHE_HOME": str(tmp_path)})

    assert f"-DTRUNDLE_EIGEN={tmp_path}/cmeel.prefix/include/eigen3" in ran
    assert kit.folder.name != _digest(kit_sources(), without, "")


def test_each_failed_target_has_its_first_error() -> None:
    text = """\
[1/4] Building CXX object CMakeFiles/good.dir/src/good.cpp.o
FAILED: CMakeFiles/plan.dir/src/plan.cpp.o
/usr/bin/c++ -DROS_PACKAGE_NAME -o CMakeFiles/plan.dir/src/plan.cpp.o
/ws/src/plan.cpp:3:10: fatal error: moveit/move_group.h: No such file or directory
/ws/src/plan.cpp:9:1: error: another
FAILED: arm/CMakeFiles/drive.dir/a.cpp.o
/ws/src/a.cpp:9:1: error: 'x' was not declared in this scope
[4/4] Linking CXX executable /ws/devel/lib/p/lift
FAILED: /ws/devel/lib/p/lift
/usr/bin/ld: lift.cpp:(.text+0x5): undefined reference to `raise_arm()'
FAILED: /ws/devel/lib/p/speak
/usr/bin/ld: cannot find -lmsc: No such file or directory
collect2: error: ld returned 1 exit status
ninja: build stopped: cannot make progress due to previous errors.
"""
    assert _failures(text) == {
        "plan": "moveit/move_group.h: No such file or directory",
        "drive": "'x' was not declared in this scope",
        "lift": "undefined: `raise_arm()'",
        "speak": "no library -lmsc",
    }


def test_an_error_of_cmake_is_one_line_with_its_place() -> None:
    text = """\
-- Detecting CXX compile features - done
CMake Error at CMakeLists.txt:7 (add_executable):
  Cannot find source file:

    src/none.cpp


CMake Generate step failed.
"""
    assert _cmake_error(text) == "CMakeLists.txt:7: Cannot find source file: src/none.cpp"


def test_another_compiler_begins_anew(tmp_path: Path) -> None:
    cache = tmp_path / "CMakeCache.txt"
    cache.write_text("A:BOOL=ON\nCMAKE_CXX_COMPILER:STRING=/usr/bin/g++\nB:BOOL=ON\n")
    (tmp_path / "CMakeFiles").mkdir()

    _forget_other_compiler(tmp_path, "/usr/bin/g++")
    assert cache.exists()
    _forget_other_compiler(tmp_path, "/usr/bin/clang++")
    assert list(tmp_path.iterdir()) == []


def test_without_a_compiler_zigs_is_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    package = tmp_path / "site/ziglang"
    package.mkdir(parents=True)
    (package / "__init__.py").touch()
    (package / "__main__.py").write_text("import sys; print('zig', *sys.argv[1:])")
    monkeypatch.syspath_prepend(str(package.parent))
    tools = zig_tools({"XDG_CACHE_HOME": str(tmp_path / "cache")})

    assert tools is not None
    environment = {**os.environ, "PYTHONPATH": str(package.parent)}
    command = [tools / "c++", "-isystem", "/boost 1.90", "-O2"]
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert done.stdout == "zig c++ -D_LIBCPP_ENABLE_CXX17_REMOVED_UNARY_BINARY_FUNCTION -I /boost 1.90 -O2\n"
    assert zig_definitions(str(tools / "c++")) == [
        f"-DCMAKE_C_COMPILER={tools}/cc",
        f"-DCMAKE_AR={tools}/ar",
        f"-DCMAKE_RANLIB={tools}/ranlib",
        f"-DTRUNDLE_ZIG={package}/lib",
    ]
    assert zig_definitions("/usr/bin/c++") == []


def test_libraries_of_cmake_modules_are_found(tmp_path: Path) -> None:
    require_compiler()
    for file in ("include/uuid/uuid.h", "include/eigen3/Eigen/Core", "lib/libuuid.so", "lib/libuuid.dylib"):
        path = tmp_path / "prefix" / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.touch()
    (tmp_path / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.16)\nproject(tested NONE)\n"
        "find_package(UUID REQUIRED)\nfind_package(Eigen REQUIRED)\nfind_package(NoSuchLibrary REQUIRED)\n"
        'message("${UUID_INCLUDE_DIRS} ${UUID_LIBRARIES} ${EIGEN_INCLUDE_DIRS} ${Eigen_FOUND}")\n'
    )
    find = kit_sources() / "catkin/cmake/find.cmake"
    command = [find_toolchain(os.environ).cmake, "-S", tmp_path, "-B", tmp_path / "build", "--no-warn-unused-cli"]
    command += [f"-DCMAKE_PROJECT_INCLUDE={find}", f"-DCMAKE_PREFIX_PATH={tmp_path / 'prefix'}"]
    done = subprocess.run(command, capture_output=True, text=True, check=False)

    prefix = tmp_path / "prefix"
    assert f"{prefix}/include {prefix}/lib/libuuid." in done.stderr, done.stdout + done.stderr
    assert f"{prefix}/include/eigen3 TRUE\n" in done.stderr
    assert (tmp_path / "build/trundle_missing.txt").read_text() == "NoSuchLibrary\n"
