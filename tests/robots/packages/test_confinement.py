"""A home folder is not a package, whatever it holds, and neither is its parent."""

import os
import sys
from pathlib import Path

import pytest

from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.robots import packages as room
from trundle.robots.description import expand_xacro
from trundle.robots.packages import Packages
from trundle.robots.packages.confinement import WideFolders

AT = Source("robot.urdf", 7)
REFUSED = "reads only below its own folders"


def write(path: Path, text: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


@pytest.fixture
def home(tmp_path: Path) -> Path:
    """A home folder with a secret in it."""
    write(tmp_path / "home/ann/.ssh/id", "key: 7")
    write(tmp_path / "home/ann/.netrc")
    write(tmp_path / "home/ann/diary/today.yaml")
    return tmp_path / "home/ann"


def resolve(uri: str, start: Path, home: Path, **environment: str) -> Path:
    packages = Packages({"HOME": str(home), **environment}, start=start)
    return packages.resolve(uri, folder=start.parent, at=AT)


@pytest.mark.parametrize("holds", ["models/", "launch/", "urdf/", "package.xml", "manifest.xml", "model.config"])
@pytest.mark.parametrize("file", ["robot.xacro", "urdf/robot.xacro", "work/robot.xacro"])
def test_a_home_folder_is_not_a_package_whatever_it_contains(home: Path, holds: str, file: str) -> None:
    if holds.endswith("/"):
        (home / holds).mkdir()
    else:
        write(home / holds, "<package><name>ann</name></package>")
    read = f"${{xacro.load_yaml('{home}/.ssh/id')['key']}}"
    start = write(
        home / file, f"<robot xmlns:xacro='http://ros.org/wiki/xacro' name='r'><link name=\"{read}\"/></robot>"
    )
    packages = Packages({"HOME": str(home)}, start=start)

    with pytest.raises(DescriptionError, match=REFUSED):
        expand_xacro(start, {}, packages=packages, report=Diagnostics())


@pytest.mark.parametrize("uri", ["file://{home}/.netrc", "file://{home}/diary/today.yaml", "package://ann/.ssh/id"])
@pytest.mark.parametrize("path", ["ROS_PACKAGE_PATH", "GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"])
def test_a_search_path_with_home_or_its_parent_does_not_allow_reading_it(home: Path, path: str, uri: str) -> None:
    write(home / "package.xml", "<package><name>ann</name></package>")
    start = write(home / "robot.urdf")
    for folder in (home, home.parent):
        with pytest.raises(DescriptionError):
            resolve(uri.format(home=home), start, home, **{path: str(folder)})


def test_a_robot_in_a_home_folder_reads_the_files_beside_it(home: Path) -> None:
    start = write(home / "robot.urdf")
    mesh, other = write(home / "wheel.stl"), write(home / "meshes/arm.stl")

    assert resolve("wheel.stl", start, home) == mesh
    assert resolve("meshes/arm.stl", start, home) == other
    with pytest.raises(DescriptionError, match=REFUSED):
        resolve("diary/today.yaml", start, home)
    assert resolve("diary/today.yaml", start, home, **{room.ALLOW_OUTSIDE: "1"}).is_file()


def test_packages_and_models_below_a_home_folder_can_be_read(home: Path) -> None:
    start = write(home / "robot.urdf")
    write(home / "ws/arm/package.xml", "<package><name>arm</name></package>")
    mesh = write(home / "ws/arm/extra/arm.stl")
    sdf = write(home / "models/cup/extra/cup.sdf")
    write(home / "models/cup/model.config")

    assert resolve("package://arm/extra/arm.stl", start, home, ROS_PACKAGE_PATH=str(home / "ws")) == mesh
    assert resolve("model://cup/extra/cup.sdf", start, home) == sdf


@pytest.mark.parametrize("folder", ["urdf", "robots"])
def test_without_a_manifest_a_file_reads_its_folder_and_packages(tmp_path: Path, home: Path, folder: str) -> None:
    """Published tutorials often have no package.xml; the folder they are copied into is not the package."""
    start = write(tmp_path / f"arm/{folder}/arm.urdf")
    (tmp_path / "arm/meshes").mkdir()
    texture = write(tmp_path / "arm/textures/red.png")
    common = write(tmp_path / "arm/common.xacro")
    write(tmp_path / "arm/others/secret.stl")

    assert resolve("../textures/red.png", start, home).samefile(texture)
    assert resolve("../common.xacro", start, home).samefile(common)
    with pytest.raises(DescriptionError, match=REFUSED):
        resolve("../others/secret.stl", start, home)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="drives have letters there")
def test_the_root_of_a_disk_is_no_package_either(tmp_path: Path) -> None:
    with pytest.raises(DescriptionError, match=REFUSED):
        resolve("file:///etc/passwd", write(tmp_path / "robot.urdf"), tmp_path, ROS_PACKAGE_PATH="/")


def test_a_link_that_is_gone_while_it_is_read_is_no_package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With ROS_PACKAGE_PATH=/ the links of processes that end meanwhile are met."""
    wide = WideFolders({})

    def raise_missing(_path: object, **_: object) -> str:
        raise FileNotFoundError(2, "gone")

    monkeypatch.setattr(os.path, "realpath", raise_missing)
    assert tmp_path / "link" in wide
