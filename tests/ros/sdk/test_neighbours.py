"""catkin_make --pkg in a fresh workspace: a package gets headers and libraries of those that it needs."""

from pathlib import Path

import pytest
from tests.ros.sdk.conftest import require_compiler

from trundle.app.cli import main
from trundle.ros import sdk
from trundle.ros.sdk.kit import Kit, kit_sources

_MANIFEST = "<package format='2'><name>{name}</name><version>0.1.0</version>{depends}</package>"
_WHEELS = """\
cmake_minimum_required(VERSION 3.5)
project(wheels CXX)
find_package(catkin REQUIRED)
catkin_package(INCLUDE_DIRS include LIBRARIES wheels not_built_here)
include_directories(include ${catkin_INCLUDE_DIRS})
add_library(wheels src/wheels.cpp)
add_executable(spin src/spin.cpp)
"""
_ROVER = """\
cmake_minimum_required(VERSION 3.5)
project(rover CXX)
find_package(catkin REQUIRED COMPONENTS wheels)
include_directories(${catkin_INCLUDE_DIRS})
add_executable(drive src/drive.cpp)
target_link_libraries(drive ${catkin_LIBRARIES})
"""
_FILES = {
    "wheels/package.xml": _MANIFEST.format(name="wheels", depends=""),
    "wheels/CMakeLists.txt": _WHEELS,
    "wheels/msg/Turn.msg": "float64 angle\n",
    "wheels/include/wheels/wheels.h": "int count();\n",
    "wheels/src/wheels.cpp": "#include <wheels/wheels.h>\nint count() { return 4; }\n",
    "wheels/src/spin.cpp": "#error it is not asked for\n",
    "rover/package.xml": _MANIFEST.format(name="rover", depends="<depend>wheels</depend>"),
    "rover/CMakeLists.txt": _ROVER,
    "rover/src/drive.cpp": """\
#include <wheels/wheels.h>
#if !__has_include(<wheels/Turn.h>)
#error no header of the message
#endif
int main() { return count(); }
""",
}


def test_a_package_gets_what_it_needs_of_others_and_no_more(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    require_compiler()
    for name, text in _FILES.items():
        file = tmp_path / "src" / name
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(text)
    kit = Kit(kit_sources(), tmp_path / "kit")  # not compiled: neither package uses its libraries
    (kit.folder / "include").mkdir(parents=True)
    monkeypatch.setattr(sdk, "compiled_kit", lambda *_, **__: kit)
    monkeypatch.setenv("PWD", str(tmp_path))
    monkeypatch.delenv("CMAKE_PREFIX_PATH", raising=False)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)

    assert main(["--as", "catkin_make", "--pkg", "rover"]) == 0

    assert (tmp_path / "devel/lib/rover/drive").exists()
    assert (tmp_path / "devel/lib/libwheels.so").exists()
    assert not (tmp_path / "devel/lib/wheels/spin").exists()
