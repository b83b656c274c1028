"""Package and type of a node resolve to a program, a stand-in or an error message."""

import importlib
from pathlib import Path

import pytest

from trundle.gazebo.nodes import BUILTIN_NODES, BuiltinReplacement, Executable, MissingNode, find_node, program_names
from trundle.gazebo.nodes.rqt_windows import PanelWindow


def program(path: Path, mode: int = 0o755) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/sh\n")
    path.chmod(mode)
    return path


@pytest.mark.parametrize("target", sorted(set(BUILTIN_NODES.values())))
def test_every_stand_in_of_the_catalog_exists(target: str) -> None:
    module, _, name = target.partition(":")
    replacement = getattr(importlib.import_module(module), name)
    assert isinstance(replacement, PanelWindow) or callable(replacement.run)


def test_a_program_of_the_package_is_preferred_to_a_stand_in(tmp_path: Path) -> None:
    path = program(tmp_path / "scripts/rviz")
    assert find_node("rviz", "rviz", lambda _: tmp_path, env={}) == Executable(path)
    path.chmod(0o644)
    assert isinstance(find_node("rviz", "rviz", lambda _: tmp_path, env={}), BuiltinReplacement)


@pytest.mark.parametrize(
    ("sources", "built"),
    [
        ("share/moveit_servo", "lib/moveit_servo"),  # /opt/ros/noetic
        ("ws/src/navigation/moveit_servo", "ws/devel/lib/moveit_servo"),
        ("ws/src/moveit_servo", "ws/install/lib/moveit_servo"),
        ("ws/src/moveit_servo", "ws/install/moveit_servo/lib/moveit_servo"),  # colcon
        ("elsewhere/moveit_servo", "prefix/lib/moveit_servo"),
    ],
)
def test_a_built_program_runs_if_there_is_no_stand_in(tmp_path: Path, sources: str, built: str) -> None:
    """roslaunch and rosrun search there too; most installed ROS programs are not scripts in a package's folder."""
    folder = tmp_path / sources
    folder.mkdir(parents=True)
    path = program(tmp_path / built / "moveit_servo")
    env = {"CMAKE_PREFIX_PATH": f"{tmp_path / 'none'}:{tmp_path / 'prefix'}"}
    assert find_node("moveit_servo", "moveit_servo", lambda _: folder, env=env) == Executable(path)
    assert program_names("moveit_servo", folder, env=env) == {"moveit_servo"}

    script = program(folder / "scripts/moveit_servo")
    assert find_node("moveit_servo", "moveit_servo", lambda _: folder, env=env) == Executable(script)


def test_what_a_workspace_compiled_is_preferred_to_a_stand_in(tmp_path: Path) -> None:
    """People who build amcl from its sources mean to run that."""
    folder = tmp_path / "ws/src/navigation/amcl"
    folder.mkdir(parents=True)
    installed = program(tmp_path / "ros/lib/amcl/amcl")
    env = {"CMAKE_PREFIX_PATH": str(tmp_path / "ros")}
    assert isinstance(find_node("amcl", "amcl", lambda _: folder, env=env), BuiltinReplacement), installed

    built = program(tmp_path / "ws/devel/lib/amcl/amcl")
    assert find_node("amcl", "amcl", lambda _: folder, env=env) == Executable(built)


def test_linked_folders_of_a_package_are_searched_once(tmp_path: Path) -> None:
    script = program(tmp_path / "shared/drive.py")
    folder = tmp_path / "src/drive"
    folder.mkdir(parents=True)
    (folder / "scripts").symlink_to(script.parent)
    (script.parent / "again").symlink_to(folder)
    assert find_node("drive", "drive.py", lambda _: folder, env={}) == Executable(folder / "scripts/drive.py")
    assert isinstance(find_node("drive", "turn.py", lambda _: folder, env={}), MissingNode)


def test_a_stand_in_is_preferred_to_an_installed_program(tmp_path: Path) -> None:
    """Debian's rviz is a program in /usr/share/rviz."""
    program(tmp_path / "lib/rviz/rviz")
    folder = program(tmp_path / "share/rviz/rviz").parent
    assert isinstance(find_node("rviz", "rviz", lambda _: folder, env={}), BuiltinReplacement)


def test_programs_in_hidden_and_build_folders_are_ignored(tmp_path: Path) -> None:
    program(tmp_path / ".git/x")
    program(tmp_path / "build/x")
    assert isinstance(find_node("p", "x", lambda _: tmp_path, env={}), MissingNode)


def test_a_type_may_contain_a_folder_but_not_leave_the_package(tmp_path: Path) -> None:
    path = program(tmp_path / "p/nodes/x")
    program(tmp_path / "outside")
    assert find_node("p", "nodes/x", lambda _: tmp_path / "p", env={}) == Executable(path)
    assert isinstance(find_node("p", "../outside", lambda _: tmp_path / "p", env={}), MissingNode)


@pytest.mark.parametrize("name", ["arbotix_driver", "arbotix_driver.py", "driver.py"])
def test_old_names_of_the_arbotix_driver_are_aliases(name: str) -> None:
    node = find_node("arbotix_python", name, lambda _: None, env={})
    assert node == BuiltinReplacement("trundle.gazebo.nodes.arbotix:ArbotixDriver")


def test_missing_programs_are_reported(tmp_path: Path) -> None:
    assert find_node("tf", "nope", lambda _: None, env={}) == MissingNode(
        "no package 'tf', and no stand-in for tf/nope; stand-ins of that package: "
        "static_transform_publisher, tf_echo, tf_monitor, view_frames"
    )
    path = program(tmp_path / "x.py", 0o644)
    assert find_node("p", "x.py", lambda _: tmp_path, env={}) == Executable(path), "a script needs no executable bit"
    path.write_text("data")
    assert find_node("p", "x.py", lambda _: tmp_path, env={}) == MissingNode(
        f"{path} is not executable; run chmod +x on it"
    )
    assert find_node("p", "y", lambda _: tmp_path, env={}) == MissingNode(
        f"no executable 'y' in {tmp_path}, and no stand-in for p/y"
    )
    for name in "gfedcba":
        program(tmp_path / name, 0o755)
    node = find_node("p", "y", lambda _: tmp_path, env={})
    assert isinstance(node, MissingNode)
    assert node.reason.endswith("no stand-in for p/y; its programs: a, b, c, d, e and 2 more")


def test_a_script_without_rospy_is_replaced_by_the_stand_in(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The tutorials clone arbotix_ros into the workspace."""
    monkeypatch.setattr("trundle.gazebo.nodes.python_interpreter._DEBIAN_MODULES", str(tmp_path / "none"))
    path = program(tmp_path / "bin/arbotix_driver")
    path.write_text("#!/usr/bin/env python\n\nimport rospy\n")
    (tmp_path / "ros/rospy").mkdir(parents=True)
    installed = {"PYTHONPATH": str(tmp_path / "ros")}
    assert find_node("arbotix_python", "arbotix_driver", lambda _: tmp_path, env=installed) == Executable(path)

    script = program(tmp_path / "scripts/talk.py")
    script.write_text("import rospy\n")
    assert find_node("p", "talk.py", lambda _: tmp_path, env={}) == Executable(script)
    node = find_node("arbotix_python", "arbotix_driver", lambda _: tmp_path, env={})
    assert node == BuiltinReplacement("trundle.gazebo.nodes.arbotix:ArbotixDriver")


def test_a_script_without_its_messages_is_replaced_by_the_stand_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Debian has rospy, but no ros_control, whose sources may lie in the workspace."""
    monkeypatch.setattr("trundle.gazebo.nodes.python_interpreter._DEBIAN_MODULES", str(tmp_path / "modules"))
    (tmp_path / "modules/rospy").mkdir(parents=True)
    path = program(tmp_path / "scripts/spawner")
    path.write_text("import rospy\nfrom controller_manager_msgs.srv import *\n")

    node = find_node("controller_manager", "spawner", lambda _: tmp_path, env={})
    assert isinstance(node, BuiltinReplacement)
    (tmp_path / "modules/controller_manager_msgs").mkdir()
    assert find_node("controller_manager", "spawner", lambda _: tmp_path, env={}) == Executable(path)


def test_an_unsupported_node_is_reported_with_a_container_command() -> None:
    node = find_node("rtabmap_ros", "rtabmap", lambda _: None, env={})
    assert isinstance(node, MissingNode)
    assert node.reason.endswith(
        "the real one can run in a container with ROS_MASTER_URI set to this master: docker run --rm -it "
        "--network host -e ROS_MASTER_URI=http://localhost:11311 ros:noetic-ros-base bash -c "
        "'apt-get update && apt-get install -y ros-noetic-rtabmap-ros && rosrun rtabmap_ros rtabmap'"
    )


def test_a_node_of_a_published_package_is_reported_with_its_repository() -> None:
    node = find_node("turtlebot3_example", "turtlebot3_client", lambda _: None, env={})
    assert isinstance(node, MissingNode)
    address = "https://github.com/ROBOTIS-GIT/turtlebot3"
    assert node.reason.endswith(f"; it is published at {address}: trundle pack get turtlebot3_example")


def test_a_rosserial_node_is_reported_with_its_python_package() -> None:
    node = find_node("rosserial_arduino", "serial_node.py", lambda _: None, env={})
    assert isinstance(node, MissingNode)
    assert node.reason.endswith("runs here: trundle pack get rosserial_python, and pip install pyserial")


def test_an_uncompiled_program_is_reported_with_its_source(tmp_path: Path) -> None:
    text = (
        "project(arm)\nadd_executable(arm_node src/arm.cpp)\nset_target_properties(arm_node PROPERTIES OUTPUT_NAME arm)"
    )
    (tmp_path / "CMakeLists.txt").write_text(text)
    missing = find_node("arm", "arm", lambda _: tmp_path, env={})
    assert isinstance(missing, MissingNode)
    assert (
        f"; C++ not compiled yet: {tmp_path}/CMakeLists.txt:2 builds it (target 'arm_node') "
        "from src/arm.cpp; catkin_make compiles it, here or in a container: docker run --rm -it --network host "
        f"-v {tmp_path}:/ws/src/{tmp_path.name}:ro "
    ) in missing.reason
    other = find_node("arm", "leg", lambda _: tmp_path, env={})
    assert isinstance(other, MissingNode)
    assert "C++" not in other.reason
