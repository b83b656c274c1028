"""Executables that a CMakeLists.txt builds."""

from pathlib import Path

from trundle.packages import CMakeProgram, cmake_programs

TEXT = """cmake_minimum_required(VERSION 3.0)
project(my_robot)  # add_executable(not_this src/no.cpp)
#[[ add_executable(nor_this
    src/no.cpp) ]]
set(SOURCES src/base.cpp "src/wheel.cpp")
add_executable(${PROJECT_NAME}_node ${SOURCES})
if(CATKIN_ENABLE_TESTING)
  ADD_EXECUTABLE( laser_node
                  src/laser.cpp ) # two lines
endif()
set_target_properties(laser_node PROPERTIES PREFIX "" OUTPUT_NAME laser)
file(GLOB ALL src/all/*.cpp)
rosbuild_add_executable(old EXCLUDE_FROM_ALL ${ALL} ${UNKNOWN}/x.cpp)
add_subdirectory(tools)
add_subdirectory(.)
"""


def test_targets_sources_and_names_are_read(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(TEXT)
    (tmp_path / "tools").mkdir()
    (tmp_path / "tools/CMakeLists.txt").write_text("cs_add_executable(${PROJECT_NAME}_tool tool.cpp)")

    first = {program.target: program for program in reversed(cmake_programs(tmp_path))}

    file = tmp_path / "CMakeLists.txt"
    base = CMakeProgram(
        name="my_robot_node", target="my_robot_node", sources=("src/base.cpp", "src/wheel.cpp"), file=file, line=6
    )
    laser = CMakeProgram(name="laser", target="laser_node", sources=("src/laser.cpp",), file=file, line=8)
    assert first["my_robot_node"] == base
    assert first["laser_node"] == laser
    assert first["old"].sources == ("src/all/*.cpp", "${UNKNOWN}/x.cpp")
    assert first["my_robot_tool"].file == tmp_path / "tools/CMakeLists.txt"
    assert "not_this" not in first
    assert "nor_this" not in first


def test_a_package_without_a_cmake_file_builds_nothing(tmp_path: Path) -> None:
    assert cmake_programs(tmp_path) == []


def test_exponentially_growing_variables_are_given_up(tmp_path: Path) -> None:
    doubled = "set(A ${A} ${A} ${A}${A})\n" * 100
    (tmp_path / "CMakeLists.txt").write_text(f"set(A a)\n{doubled}add_executable(fly ${{A}})")
    assert [program.name for program in cmake_programs(tmp_path)] == ["fly"]
