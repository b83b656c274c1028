"""Packages of the workspace around the working directory."""

import os
from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.robots.packages import Packages, program_folders

ROBOT = (
    "<robot name='arm'><link name='base'><inertial><mass value='1'/>"
    "<inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial></link></robot>"
)


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace with one package and the output folders of a build."""
    arm = tmp_path / "ws/src/robots/arm"
    for folder in (arm / "src/arm", tmp_path / "ws/build/arm", tmp_path / "ws/devel/share"):
        folder.mkdir(parents=True)
    (arm / "package.xml").write_text("<package><name>arm</name></package>")
    (arm / "arm.urdf").write_text(ROBOT)
    return tmp_path / "ws"


@pytest.mark.parametrize("here", [".", "build/arm", "devel", "src", "src/robots/arm", "src/robots/arm/src/arm"])
def test_packages_are_found_from_any_folder_of_the_workspace(workspace: Path, here: str) -> None:
    packages = Packages({"HOME": "/nobody"}, start=workspace / here)

    assert packages.find_package("arm") == workspace / "src/robots/arm"


def test_a_description_is_found_by_its_package(
    workspace: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(workspace)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)

    assert main(["check", "package://arm/arm.urdf"]) == 0
    assert f"package://arm/arm.urdf: info: using the workspace {workspace}" in capsys.readouterr().out
    assert main(["run", "package://arm/arm.urdf", "--headless", "--no-ros", "--duration", "0.01"]) == 0
    assert f"using the workspace {workspace}\n" in capsys.readouterr().err


def test_a_folder_with_programs_in_src_is_not_a_workspace(workspace: Path, tmp_path: Path) -> None:
    (tmp_path / "program/src/deep").mkdir(parents=True)

    assert Packages({"HOME": "/nobody"}, start=tmp_path / "program").find_package("arm") is None


@pytest.mark.parametrize("name", ["robot_description", "robot-master"])
def test_a_package_in_the_working_folder_is_found_by_its_name(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], name: str
) -> None:
    """The state after a clone: no workspace, and an empty path."""
    folder = tmp_path / "robot-master"
    (folder / "launch").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>robot_description</name></package>")
    (folder / "launch/show.launch").write_text('<launch><param name="p" textfile="$(find other)/a.txt"/></launch>')
    other = tmp_path / "other"
    other.mkdir()
    (other / "package.xml").write_text("<package><name>other</name></package>")
    (other / "a.txt").write_text("a")
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("ROS_PACKAGE_PATH", raising=False)

    assert main(["launch", "--dump-params", name, "show.launch"]) == 0
    assert capsys.readouterr().out.strip() == "/p: a"


def test_folders_in_the_working_folder_need_a_manifest_and_a_home_folder_is_not_searched(tmp_path: Path) -> None:
    for folder in (tmp_path / "home", tmp_path / "group/deep"):
        folder.mkdir(parents=True)
        (folder / "package.xml").write_text("<package><name>thing</name></package>")
    (tmp_path / "plain/launch").mkdir(parents=True)
    packages = Packages({"HOME": str(tmp_path / "home")}, start=tmp_path)

    assert [packages.find_package(name) for name in ("thing", "home", "deep", "plain", "..")] == [None] * 5
    assert "thing" not in packages.ros_packages()


@pytest.mark.skipif(os.name == "nt", reason="Windows has no sticky folders")
@pytest.mark.parametrize("left", ["launch/other.launch", "package.xml", "src/other/package.xml"])
def test_a_package_in_a_temporary_folder_is_not_the_robots_package(tmp_path: Path, left: str) -> None:
    """Any user may create files in /tmp: they make it neither a package nor a workspace."""
    (tmp_path / "shared" / left).parent.mkdir(parents=True)
    (tmp_path / "shared" / left).write_text("<package><name>other</name></package>")
    (tmp_path / "shared/mine").mkdir()
    (tmp_path / "shared/other/launch").mkdir(parents=True)
    (tmp_path / "shared").chmod(0o1777)

    packages = Packages({"HOME": "/nobody"}, start=tmp_path / "shared/mine")

    assert packages.find_package("other") is None
    assert not packages.package_folders()


def test_a_repository_with_a_src_of_its_own_is_built_by_the_workspace(tmp_path: Path) -> None:
    package = tmp_path / "ws/src/repository/src/arm"
    package.mkdir(parents=True)
    built = tmp_path / "ws/devel/lib/arm"
    built.mkdir(parents=True)

    assert program_folders("arm", package, {}) == [built]
