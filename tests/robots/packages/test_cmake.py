"""Executables that a CMakeLists.txt builds."""

from pathlib import Path

from trundle.robots.packages import CMakeProgram, cmake_libraries, cmake_programs

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


def test_targets_of_a_loop_over_files_have_their_names(tmp_path: Path) -> None:
    (tmp_path / "CMakeLists.txt").write_text(
        "file(GLOB NODES node/*.cpp)\n"
        "foreach(_file ${NODES})\n"
        "  get_filename_component(_name ${_file} NAME_WE)\n"
        "  add_executable(${_name} ${_file})\n"
        "endforeach()\n"
        "foreach(each left right)\nadd_library(${each}_wheel ${PROJECT_SOURCE_DIR}/src/${each}.cpp)\nendforeach()\n"
    )
    (tmp_path / "node").mkdir()
    for name in ("simulator", "keyboard"):
        (tmp_path / f"node/{name}.cpp").touch()

    assert [(target.name, target.sources, target.line) for target in cmake_programs(tmp_path)] == [
        ("keyboard", ("node/keyboard.cpp",), 4),
        ("simulator", ("node/simulator.cpp",), 4),
    ]
    assert [(target.name, target.sources) for target in cmake_libraries(tmp_path)] == [
        ("left_wheel", ("src/left.cpp",)),
        ("right_wheel", ("src/right.cpp",)),
    ]


def test_endless_loops_and_deep_blocks_are_given_up(tmp_path: Path) -> None:
    loops = "foreach(i RANGE 9999)\n" * 3 + "set(A ${A}a)\n" + "endforeach()\n" * 3
    (tmp_path / "CMakeLists.txt").write_text(f"add_executable(fly f.cpp)\n{'if(A)' * 5000}{loops}{'endif()' * 5000}")
    assert [program.name for program in cmake_programs(tmp_path)] == ["fly"]
