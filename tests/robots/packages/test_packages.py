"""URIs resolved in workspaces, on Gazebo's paths and among Trundle's own files."""

from pathlib import Path

import pytest

from trundle.app.cli import main
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, UsageError
from trundle.robots import packages as room
from trundle.robots.description import expand_xacro
from trundle.robots.packages import Packages

AT = Source("robot.urdf", 7)
XACRO = "<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>{}</robot>"


def write(path: Path, text: str = "") -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def package(folder: Path, *, name: str | None = None, export: str = "") -> Path:
    """A package folder with a manifest and a mesh."""
    write(folder / "package.xml", f"<package><name>{name or folder.name}</name><export>{export}</export></package>")
    write(folder / "meshes/arm.stl")
    return folder


def model(folder: Path) -> Path:
    write(folder / "model.config", "<model><sdf version='1.6'>model.sdf</sdf></model>")
    write(folder / "model.sdf", f"<sdf version='1.6'><model name='{folder.name}'><link name='l'/></model></sdf>")
    return folder


def resolve(uri: str, start: Path, **environment: str) -> Path:
    base = start if start.is_dir() else start.parent
    return Packages({"HOME": str(start.anchor) + "nobody", **environment}, start=start).resolve(uri, folder=base, at=AT)


def test_a_package_is_found_by_its_manifests_name_and_by_its_folders(tmp_path: Path) -> None:
    package(tmp_path / "ws/arm-master", name="arm_description")
    path = {"ROS_PACKAGE_PATH": str(tmp_path / "ws")}

    by_name = resolve("package://arm_description/meshes/arm.stl", tmp_path, **path)
    by_folder = resolve("package://arm-master/meshes/arm.stl", tmp_path, **path)

    assert by_name == by_folder == tmp_path / "ws/arm-master/meshes/arm.stl"


def test_a_path_relative_to_the_working_directory_becomes_absolute(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The path is passed on to readers, which look for files beside it."""
    package(tmp_path / "ws" / "robot")
    monkeypatch.chdir(tmp_path)

    assert (
        Packages({"ROS_PACKAGE_PATH": "ws"}, start=tmp_path / "elsewhere").find_package("robot")
        == tmp_path / "ws/robot"
    )


@pytest.mark.parametrize("space", ["src/group", "devel/share", "install/share", "install/hand/share"])
def test_every_folder_of_a_workspace_is_searched(tmp_path: Path, space: str) -> None:
    start = write(package(tmp_path / "src/robots/arm") / "urdf/arm.urdf")
    hand = package(tmp_path / space / "hand")

    assert resolve("package://hand/meshes/arm.stl", start) == hand / "meshes/arm.stl"


def test_without_a_workspace_the_neighbours_of_the_package_are_searched(tmp_path: Path) -> None:
    start = write(tmp_path / "arm/urdf/arm.urdf")  # a tutorial without package.xml
    write(tmp_path / "hand/meshes/palm.stl")

    assert resolve("package://hand/meshes/palm.stl", start) == tmp_path / "hand/meshes/palm.stl"
    assert resolve("../meshes/own.stl", write(tmp_path / "arm/meshes/own.stl").parent.parent / "urdf").name == "own.stl"


def test_an_ignored_folder_holds_no_packages(tmp_path: Path) -> None:
    package(tmp_path / "old/hand")
    write(tmp_path / "old/CATKIN_IGNORE")

    with pytest.raises(DescriptionError, match=r"robot\.urdf:7: error: package://hand/x: no package 'hand'; looked"):
        resolve("package://hand/x", tmp_path, ROS_PACKAGE_PATH=str(tmp_path))


def test_packages_of_the_system_are_found_last(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Debian's rospack searches /usr/share, which ROS_PACKAGE_PATH does not name."""
    share, workspace = tmp_path / "share", tmp_path / "ws"
    monkeypatch.setattr("trundle.robots.packages.ros_packages._INSTALLED", share)
    package(share / "hand")
    package(share / "arm")
    package(share / "gazebo_ros")
    package(share / "doc/deep")
    write(share / "leg/meshes/leg.stl")
    write(workspace / "arm/meshes/arm.stl")

    packages = Packages({"ROS_PACKAGE_PATH": str(workspace)}, start=tmp_path / "elsewhere")

    assert packages.find_package("hand") == packages.ros_packages()["hand"] == share / "hand"
    assert packages.find_package("arm") == workspace / "arm"
    assert (packages.find_package("deep"), packages.find_package("leg")) == (None, None)
    assert packages.find_package("gazebo_ros") != share / "gazebo_ros"


def test_below_rospack_nosubdirs_are_no_packages(tmp_path: Path) -> None:
    """rospack does the same; the folder itself may be a package."""
    package(tmp_path / "hand")
    write(tmp_path / "hand/rospack_nosubdirs")
    package(tmp_path / "old/arm")
    write(tmp_path / "old/rospack_nosubdirs")
    assert list(Packages({"ROS_PACKAGE_PATH": str(tmp_path)}, start=tmp_path).ros_packages())[:1] == ["hand"]
    with pytest.raises(DescriptionError, match="no package 'arm'"):
        resolve("package://arm/x", tmp_path, ROS_PACKAGE_PATH=str(tmp_path))


def test_package_and_model_stand_for_one_another(tmp_path: Path) -> None:
    package(tmp_path / "ws/hand")
    model(tmp_path / "models/cup")
    environment = {"ROS_PACKAGE_PATH": str(tmp_path / "ws"), "GAZEBO_MODEL_PATH": str(tmp_path / "models")}

    assert resolve("model://hand/meshes/arm.stl", tmp_path, **environment).is_file()
    assert resolve("package://cup/model.sdf", tmp_path, **environment).is_file()


def test_models_come_from_home_first_and_then_the_path_in_order(tmp_path: Path) -> None:
    home, first, second = (model(tmp_path / each / "cup") for each in ("home/.gazebo/models", "a", "b"))
    path = {"GAZEBO_MODEL_PATH": f"{first.parent}:{second.parent}"}

    assert resolve("model://cup", tmp_path, **path) == first
    assert resolve("model://cup", tmp_path, HOME=str(tmp_path / "home"), **path) == home


def test_a_package_exports_its_models_and_media(tmp_path: Path) -> None:
    export = '<gazebo_ros gazebo_model_path="${prefix}/stuff" gazebo_media_path="${prefix}"/>'
    gazebo = package(tmp_path / "ws/arm_gazebo", export=export)
    cup = model(gazebo / "stuff/cup")
    write(gazebo / "worlds/kitchen.world")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "ws")}, start=tmp_path)

    assert packages.find_model("cup") == cup
    assert packages.find_world("worlds/kitchen.world") == gazebo / "worlds/kitchen.world"
    assert packages.resolve("file://worlds/kitchen.world", folder=tmp_path, at=AT).is_file()


def test_manifests_are_read_once_for_all_files_of_an_environment(tmp_path: Path) -> None:
    gazebo = package(tmp_path / "ws/arm_gazebo", export='<gazebo_ros gazebo_model_path="${prefix}"/>')
    cup = model(gazebo / "cup")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "ws")}, start=tmp_path)
    assert packages.around(tmp_path / "a/a.world").find_model("cup") == cup

    (gazebo / "package.xml").unlink()

    assert packages.around(tmp_path / "b/b.world").find_model("cup") == cup


def test_models_near_the_file_are_found_after_those_on_the_path(tmp_path: Path) -> None:
    world = write(tmp_path / "project/worlds/kitchen.world")
    near = model(tmp_path / "project/models/cup")
    named = model(tmp_path / "named/cup")

    assert resolve("model://cup", world) == near
    assert resolve("model://cup", world, GAZEBO_MODEL_PATH=str(named.parent)) == named


def test_a_missing_model_is_reported_with_the_searched_folders(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=rf"no model 'cup'; looked in .*{tmp_path}/m.*on GAZEBO_MODEL_PATH"):
        Packages({"GAZEBO_MODEL_PATH": str(tmp_path / "m")}, start=tmp_path).find_model("cup")


def test_a_folder_on_the_path_twice_is_reported_once(tmp_path: Path) -> None:
    export = '<gazebo_ros gazebo_model_path="${prefix}/models"/>'
    arm = package(tmp_path / "ws/src/arm", export=export)
    (tmp_path / "link").symlink_to(tmp_path / "ws/src")
    path = f"{tmp_path}/ws/src:{tmp_path}/link:{tmp_path}/ws/src/"
    packages = Packages({"ROS_PACKAGE_PATH": path, "GAZEBO_MODEL_PATH": f"{arm}/models"}, start=arm / "meshes")

    assert packages.not_found_message("hand").startswith(f"no package 'hand'; looked below {tmp_path}/ws/src; put ")
    with pytest.raises(UsageError) as caught:
        packages.find_model("cup")
    assert str(caught.value).count(f"{arm}/models") == 1


def test_a_fuel_model_comes_from_the_cache_of_gazebos_own_tool_or_not_at_all(tmp_path: Path) -> None:
    url = "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Coffee Cup"
    cached = tmp_path / ".gz/fuel/fuel.gazebosim.org/openrobotics/models/coffee cup"
    with pytest.raises(DescriptionError, match="nothing is fetched from the network; fetch it with `gz fuel"):
        resolve(url, tmp_path, HOME=str(tmp_path))
    for version in ("9", "10"):
        model(cached / version)

    assert resolve(url, tmp_path, HOME=str(tmp_path)) == cached / "10"
    assert resolve(url.replace(" ", "%20") + "/9", tmp_path, HOME=str(tmp_path)) == cached / "9"


@pytest.mark.parametrize(
    ("uri", "message"),
    [
        (
            "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane",
            "write model://ground_plane, which is here",
        ),
        (
            "https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane/3/files/meshes/plane.dae",
            "write model://ground_plane/meshes/plane.dae, which is here",
        ),
        ("http://example.org/cup.dae", "nothing is fetched from the network; copy the file beside this one"),
        ("ftp://example.org/cup.dae", "ftp:// is not supported; use package://, model://, file:// or relative paths"),
        ("meshes/lost.dae", "no such file .*meshes/lost.dae"),
        ("file:///nowhere/lost.dae", "no such file /nowhere/lost.dae"),
        ("model://", "no model ''"),
        ("package://../etc/passwd", "no package '..'"),
    ],
)
def test_an_unresolved_uri_is_one_error_with_a_remedy(tmp_path: Path, uri: str, message: str) -> None:
    with pytest.raises(DescriptionError, match=message) as caught:
        resolve(uri, tmp_path)
    named = uri if "://" in uri and not uri.startswith("file:") else "no such file"
    assert str(caught.value).startswith(f"robot.urdf:7: error: {named}")
    assert str(caught.value).count(uri.removeprefix("file://")) == 1


@pytest.mark.parametrize("uri", ["file:///home/author/ws/src/repo/arm/{}", "/home/author/.gazebo/models/arm/{}"])
def test_a_path_of_the_authors_machine_is_found_in_the_package_or_model(tmp_path: Path, uri: str) -> None:
    """Worlds that Gazebo saved have absolute paths."""
    package(tmp_path / "ws/repo/arm")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "ws")}, start=tmp_path / "else/room.world")
    report = Diagnostics()

    found = packages.resolve(uri.format("meshes/arm.stl"), folder=tmp_path, at=AT)
    packages.warn_of_finds(report, Source("room.world"))
    packages.warn_of_finds(report, Source("room.world"))

    assert found == tmp_path / "ws/repo/arm/meshes/arm.stl"
    named = uri.format("meshes/arm.stl").removeprefix("file://")
    assert report.warnings == [f"robot.urdf:7: warning: no such file {named}; {found} is used"]
    with pytest.raises(DescriptionError, match="no such file"):
        packages.resolve(uri.format("../secret.stl"), folder=tmp_path, at=AT)


def test_spaces_may_be_percent_encoded(tmp_path: Path) -> None:
    mesh = write(tmp_path / "left arm.stl")

    assert resolve("left%20arm.stl", tmp_path) == resolve("left arm.stl", tmp_path) == mesh


class TestReadingOutside:
    """A description reads only below its package and the path given by the user."""

    @pytest.fixture
    def robot(self, tmp_path: Path) -> Path:
        write(tmp_path / "secret.stl")
        package(tmp_path / "ws/arm")
        return write(tmp_path / "ws/arm/urdf/arm.urdf")

    @pytest.mark.parametrize(
        "uri", ["../../../secret.stl", "package://arm/../../secret.stl", "model://arm/../../secret.stl"]
    )
    def test_parent_directories_are_refused(self, robot: Path, uri: str) -> None:
        with pytest.raises(DescriptionError, match="--allow-outside lifts that"):
            resolve(uri, robot)

    def test_an_absolute_path_is_refused(self, robot: Path, tmp_path: Path) -> None:
        with pytest.raises(DescriptionError, match="reads only below"):
            resolve(f"file://{tmp_path}/secret.stl", robot)
        with pytest.raises(DescriptionError, match="reads only below"):
            resolve("/etc/passwd", robot)

    def test_a_symbolic_link_is_refused(self, robot: Path, tmp_path: Path) -> None:
        (robot.parent / "link.stl").symlink_to(tmp_path / "secret.stl")
        with pytest.raises(DescriptionError, match="reads only below"):
            resolve("link.stl", robot)

    def test_files_outside_can_be_allowed(self, robot: Path, tmp_path: Path) -> None:
        allowed = {room.ALLOW_OUTSIDE: "1"}
        assert resolve("../../../secret.stl", robot, **allowed).samefile(tmp_path / "secret.stl")

    def test_other_packages_and_linked_ones_are_not_outside(self, robot: Path, tmp_path: Path) -> None:
        hand = package(tmp_path / "ws/hand")
        foot = package(tmp_path / "elsewhere/foot")
        (tmp_path / "ws/foot").symlink_to(foot)

        assert resolve("../../hand/meshes/arm.stl", robot).samefile(hand / "meshes/arm.stl")
        assert resolve(f"file://{hand}/meshes/arm.stl", robot).samefile(hand / "meshes/arm.stl")
        assert resolve("package://foot/meshes/arm.stl", robot).samefile(foot / "meshes/arm.stl")

    def test_the_command_line_has_an_option_for_it(
        self, robot: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
    ) -> None:
        monkeypatch.setenv(room.ALLOW_OUTSIDE, "0")
        mesh = "<visual><geometry><mesh filename='../../../secret.stl'/></geometry></visual>"
        inertial = "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'/></inertial>"
        robot.write_text(f"<robot name='arm'><link name='base'>{inertial}{mesh}</link></robot>")

        assert main(["check", str(robot)]) == 0
        assert "secret.stl; a description reads only below its own folders" in capsys.readouterr().out
        assert main(["check", str(robot), "--allow-outside"]) == 0
        assert "reads only below" not in capsys.readouterr().out

    @pytest.mark.parametrize(
        "prying",
        [
            "<xacro:include filename='{secret}'/>",
            "<xacro:include filename='$(find arm)/../../secret.xml'/>",
            "<link name='${{xacro.load_yaml(\"{secret}\")}}'/>",
        ],
    )
    def test_a_xacro_is_refused(self, robot: Path, tmp_path: Path, prying: str) -> None:
        secret = write(tmp_path / "secret.xml", "<robot><link name='secret'/></robot>")
        inside = prying.format(secret=secret)
        path = write(robot.with_name("arm.xacro"), XACRO.format(inside))
        allowing = Packages({room.ALLOW_OUTSIDE: "1"}, start=robot)

        with pytest.raises(DescriptionError, match="reads only below") as refused:
            expand_xacro(path, {}, packages=Packages({}, start=robot), report=Diagnostics())
        assert str(refused.value).count(": error: ") == 1
        assert "secret" in expand_xacro(path, {}, packages=allowing, report=Diagnostics())

    def test_a_xacro_reads_yaml_of_its_own(self, robot: Path) -> None:
        write(robot.parent.parent / "config/arm.yaml", "mass: 7")
        mass = '${xacro.load_yaml("../config/arm.yaml")["mass"]}'
        path = write(robot.with_name("arm.xacro"), XACRO.format(f"<link name='{mass}'/>"))
        assert 'name="7"' in expand_xacro(path, {}, packages=Packages({}, start=robot), report=Diagnostics())


def test_comments_of_a_manifest_do_not_name_the_package(tmp_path: Path) -> None:
    manifest = "<package>\n<!-- <name>old</name> -->\n<name>\n  new\n</name>\n<author>& unescaped</package>"
    write(tmp_path / "src/folder/package.xml", manifest)
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "src")}, start=tmp_path)

    assert packages.find_package("new") == tmp_path / "src/folder"
    assert packages.find_package("old") is None


def test_a_name_with_a_slip_is_told_the_nearest(tmp_path: Path) -> None:
    for name in ("arm_description", "hand"):
        (tmp_path / name).mkdir()
        (tmp_path / name / "package.xml").write_text(f"<package><name>{name}</name></package>")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path)}, start=tmp_path)

    assert packages.not_found_message("arm_descripton").startswith(
        "no package 'arm_descripton' (did you mean 'arm_description'?); looked below "
    )
    with pytest.raises(UsageError, match=r"no model 'rp2' \(did you mean 'rp2w'\?\); looked in "):
        packages.find_model("rp2")
    assert "did you mean" not in packages.not_found_message("hunt"), "too different"


def test_a_published_name_is_no_slip_of_another(tmp_path: Path) -> None:
    (tmp_path / "package.xml").write_text("<package><name>hector_quadrotor_description</name></package>")
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path)}, start=tmp_path)

    why = packages.not_found_message("hector_sensors_description")

    assert "did you mean" not in why
    assert "it is published at https://github.com/tu-darmstadt-ros-pkg/hector_models" in why


def test_a_files_own_workspace_wins_over_a_package_of_the_same_name_on_the_path(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    for workspace_name in ("old", "new"):
        folder = package(tmp_path / workspace_name / "src/arm")
        write(
            folder / "launch/arm.launch", f"<launch><param name='from' value='{workspace_name}'/>$(find arm)</launch>"
        )
        write(folder / "launch/go.launch", "<launch><include file='$(find arm)/launch/arm.launch'/></launch>")
    old, new = tmp_path / "old/src", tmp_path / "new/src"
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(old))
    monkeypatch.chdir(tmp_path)

    assert main(["launch", str(new / "arm/launch/go.launch"), "--dump-params"]) == 0
    printed = capsys.readouterr()
    assert "/from: new" in printed.out
    message = f"of two packages 'arm' the file's own workspace wins: {new / 'arm'}, not {old / 'arm'}"
    assert f"{new}/arm/launch/go.launch: warning: {message} [shadowed-package]" in printed.err.splitlines()

    assert main(["launch", "arm", "go.launch", "--dump-params"]) == 0
    printed = capsys.readouterr()
    assert "/from: old" in printed.out
    assert "own workspace wins" not in printed.err


def test_a_workspace_behind_a_link_is_spelled_as_on_the_path(tmp_path: Path) -> None:
    launch = write(package(tmp_path / "disk/src/arm") / "launch/go.launch")
    (tmp_path / "ws").symlink_to(tmp_path / "disk")
    spelled = tmp_path / "ws/src/arm"
    packages = Packages({"ROS_PACKAGE_PATH": str(tmp_path / "ws/src")}, start=spelled / "launch" / launch.name)
    report = Diagnostics()

    assert packages.find_package("arm") == spelled
    packages.warn_of_finds(report, Source("go.launch"))
    assert report.warnings == []


def test_a_file_elsewhere_finds_the_packages_of_the_file_that_names_it(tmp_path: Path) -> None:
    """As a model that a launch spawns, whose text is a file in a folder of logs."""
    arm = package(tmp_path / "ws/src/arm")
    hand = package(tmp_path / "ws/src/hand")
    (hand / "package.xml").rename(hand / "plain.xml")
    launched = Packages({"HOME": "/nobody"}, start=write(arm / "launch/go.launch"))

    spawned = launched.around(write(tmp_path / "logs/spawned/arm.urdf"))

    assert spawned.find_package("arm") == arm
    assert spawned.find_package("hand") == hand
    base = tmp_path / "logs/spawned"
    assert spawned.resolve("package://arm/meshes/arm.stl", folder=base, at=AT) == arm / "meshes/arm.stl"
