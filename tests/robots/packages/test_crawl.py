"""Search for packages below a folder, among other files."""

import os
import sys
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.robots.packages import Packages

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="links take a right of their own there")


def package(folder: Path) -> Path:
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(f"<package><name>{folder.name}</name></package>")
    return folder


def packages_at(root: Path) -> Packages:
    return Packages({"ROS_PACKAGE_PATH": str(root), "HOME": "/nobody"}, start=root.parent / "elsewhere")


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Packages beside links that are cyclic, broken or lead upwards."""
    root = tmp_path / "ws"
    package(root / "z")
    (root / "loop").symlink_to(root / "loop")
    (root / "round").symlink_to(root)
    (root / "nowhere").symlink_to(tmp_path / "gone")
    return root


def test_cyclic_and_broken_links_are_skipped(workspace: Path) -> None:
    packages = packages_at(workspace)

    assert packages.find_package("z") == workspace / "z"
    assert packages.skipped_folders() == {workspace / "loop": "Too many levels of symbolic links"}
    assert f"but not in {workspace}/loop (Too many levels of symbolic links)" in packages.not_found_message("y")


def test_two_links_upwards_cost_no_more_than_one(workspace: Path) -> None:
    """Each would be searched again below the other, eight folders deep."""
    for number in range(12):
        (workspace / f"up{number}").symlink_to(workspace)

    assert packages_at(workspace).find_package("z") == workspace / "z"


def test_a_file_beside_such_links_is_checked(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    robot = workspace / "z/z.urdf"
    inertial = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
    mesh = "<visual><geometry><mesh filename='package://y/z.stl'/></geometry></visual>"
    robot.write_text(f"<robot name='z'><link name='base'>{inertial}{mesh}</link></robot>")
    monkeypatch.chdir(workspace)

    assert main(["check", str(robot)]) == 0
    assert "z.urdf:1: warning: " in capsys.readouterr().out


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may look into every folder")
def test_an_unreadable_folder_is_skipped(tmp_path: Path) -> None:
    package(tmp_path / "ws/z")
    (tmp_path / "ws/shut").mkdir(mode=0)

    packages = packages_at(tmp_path / "ws")

    assert packages.find_package("z") == tmp_path / "ws/z"
    assert packages.skipped_folders() == {tmp_path / "ws/shut": "Permission denied"}


@pytest.mark.parametrize("mark", ["AMENT_IGNORE", "COLCON_IGNORE"])
def test_ignore_files_of_ros_2_have_no_effect(tmp_path: Path, mark: str) -> None:
    """Robots for both versions put one beside their ROS 1 packages; rospkg respects CATKIN_IGNORE only."""
    arm = package(tmp_path / "ws/ros1/arm")
    (arm.parent / mark).touch()
    (arm / mark).touch()

    assert packages_at(tmp_path / "ws").find_package("arm") == arm


def test_a_manifest_that_is_a_pipe_does_not_block(tmp_path: Path) -> None:
    os.makedirs(tmp_path / "ws/y")
    os.mkfifo(tmp_path / "ws/y/package.xml")

    assert packages_at(tmp_path / "ws").find_package("y") == tmp_path / "ws/y"
