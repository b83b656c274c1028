"""Worlds, stand-ins and packages that Trundle ships: they read without findings, and are labelled."""

import math
from pathlib import Path

import numpy as np
import pytest

from trundle.assets import ASSETS
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source
from trundle.gazebo.nodes import catalog
from trundle.gazebo.plugins.ros_control.catalog import CONTROLLERS
from trundle.robots.description import load
from trundle.robots.launch import read_launch
from trundle.robots.meshes import load_mesh
from trundle.robots.model import Box, Cylinder, MeshFile, Model
from trundle.robots.packages import Packages, model_file, refuse_template

HERE = Path(__file__).parent
PACKAGES = Packages({"HOME": "/nobody"}, start=HERE)
STAND_INS = ASSETS / "stand_ins"


@pytest.mark.parametrize("name", PACKAGES.worlds())
def test_every_world_reads_without_a_warning(name: str) -> None:
    report = Diagnostics()

    loaded = load(f"worlds/{name}", report, packages=PACKAGES)

    assert loaded.kind == "world"
    assert report.warnings == []
    again = load(name, report, packages=PACKAGES).world
    assert [_parts(model) for model in again.models] == [_parts(model) for model in loaded.world.models]


def _parts(model: Model) -> tuple[Source, list[str], list[str]]:
    return model.at, [link.name for link in model.links], [joint.name for joint in model.joints]


def test_a_missing_world_is_reported_with_the_available_ones() -> None:
    with pytest.raises(DescriptionError, match=r"mud.world: error: no such file .*: .*blank.world, .*empty.world"):
        load("worlds/mud.world", Diagnostics(), packages=PACKAGES)


def test_every_stand_in_is_a_labelled_body_on_the_ground() -> None:
    names = sorted(path.name for path in STAND_INS.iterdir())
    assert {"dumpster", "construction_cone", "jersey_barrier", "construction_barrel"} <= set(names)
    for name in names:
        report = Diagnostics()
        (model,) = load(f"model://{name}", report, packages=PACKAGES).world.models

        assert model.name == name
        assert len(model.links[0].collisions) == len(model.links[0].visuals) > 0
        assert report.warnings == []
        assert [f.what for f in report.findings if "stand-in" in f.what], name


def test_stand_ins_have_the_size_of_the_originals() -> None:
    """The originals' figures, measured on the meshes of the public model database."""
    (model,) = load("model://beer", Diagnostics(), packages=PACKAGES).world.models
    assert model.links[0].collisions[0].geometry == Cylinder(0.055, 0.23)
    assert model.links[0].inertial.mass == 0.39
    assert model.links[0].inertial.moments[2] == pytest.approx(0.39 * 0.11**2 / 6, rel=1e-3)
    (model,) = load("model://dumpster", Diagnostics(), packages=PACKAGES).world.models
    assert model.links[0].collisions[0].geometry == Box((2.505, 1.535, 1.773))
    assert math.isclose(model.links[0].collisions[0].link_from_collision.position[2], 0.885)


def test_turtlebot3_drives_between_nine_pillars_in_a_hexagon() -> None:
    """Figures measured on the original's meshes; a world saved by Gazebo names them."""
    (model,) = load("model://turtlebot3_world", Diagnostics(), packages=PACKAGES).world.models
    shapes = [(each.link_from_collision.position, each.geometry) for each in model.links[0].collisions]

    pillars = {(x, y) for (x, y, _), shape in shapes if shape == Cylinder(0.15, 0.5)}
    assert pillars == {(x, y) for x in (-1.1, 0.0, 1.1) for y in (-1.1, 0.0, 1.1)}
    walls = [(math.hypot(x, y), shape.size) for (x, y, _), shape in shapes if isinstance(shape, Box)]
    assert len(walls) == 6
    for middle, (thickness, length, height) in walls:
        assert middle - thickness / 2 == pytest.approx(11.7315 / 4 * math.cos(math.pi / 6), abs=1e-3)
        assert (length, height) == (pytest.approx(13.198 / 4, abs=1e-3), 1.27)
    sizes = {path.stem: np.ptp(load_mesh(path).vertices, axis=0) for path in STAND_INS.glob("turtlebot3_world/*/*.obj")}
    assert sizes["wall"] == pytest.approx([22.86, 26.396, 5.08], abs=1e-3)
    assert sizes["hexagon"] == pytest.approx([2.9328, 2.54, 2.54], abs=1e-3)


def test_robots_start_in_the_corridor_of_the_office(tmp_path: Path) -> None:
    """The original measures 58.6 by 45.7 m, and its origin is inside; from there a robot can drive into a room."""
    world = load("worlds/willowgarage.world", Diagnostics(), packages=PACKAGES).world
    office = next(model for model in world.models if model.name == "willowgarage")
    walls = [
        (x + office.world_from_model.position[0], y + office.world_from_model.position[1], size.size[0], size.size[1])
        for wall in office.links[0].collisions
        if isinstance(size := wall.geometry, Box)
        for x, y, _ in [wall.link_from_collision.position]
    ]
    assert max(x + width / 2 for x, _, width, _ in walls) - min(x - width / 2 for x, _, width, _ in walls) == 58.64

    def is_free(at_x: float, at_y: float) -> bool:
        return not any(
            abs(at_x - x) < width / 2 + 0.4 and abs(at_y - y) < depth / 2 + 0.4 for x, y, width, depth in walls
        )

    assert is_free(0.0, 0.0)
    assert all(is_free(2.0 + 0.1 * i, 0.0) for i in range(24))
    assert all(is_free(4.43, -0.1 * i) for i in range(50))


def test_a_model_of_the_same_name_comes_before_its_stand_in(tmp_path: Path) -> None:
    own = tmp_path / "beer"
    own.mkdir()
    (own / "model.config").write_text("<model><sdf version='1.6'>b.sdf</sdf></model>")
    (own / "b.sdf").write_text("<sdf version='1.6'><model name='b'><link name='l'/></model></sdf>")
    packages = Packages({"GAZEBO_MODEL_PATH": str(tmp_path)}, start=HERE)
    report = Diagnostics()

    assert load("model://beer", report, packages=packages).world.name == "b"
    assert not [f for f in report.findings if "stand-in" in f.what]


def _tutorials_folder(home: Path) -> Packages:
    """Packages of a user who has models with the names of Trundle's, as the Gazebo tutorial says."""
    for name in ("rp2w", "ball", "sun", "beer"):
        folder = home / ".gazebo/models" / name
        folder.mkdir(parents=True)
        (folder / "model.config").write_text("<model><sdf version='1.4'>model.sdf</sdf></model>")
        text = "<sdf version='1.4'><model name='my_robot'><link name='user'/></model></sdf>"
        (folder / "model.sdf").write_text(text)
    return Packages({"HOME": str(home)}, start=HERE)


@pytest.mark.parametrize("name", ["rp2w_at_home.world", "rp2w.world", "living_room.world", "empty.world"])
def test_a_shipped_world_takes_trundles_models_where_a_user_has_some_of_the_same_name(
    name: str, tmp_path: Path
) -> None:
    shipped = load(name, Diagnostics(), packages=PACKAGES).world
    theirs = load(name, Diagnostics(), packages=_tutorials_folder(tmp_path)).world

    assert [_parts(model) for model in theirs.models] == [_parts(model) for model in shipped.models]
    assert theirs.lights == shipped.lights


def test_a_users_file_takes_the_users_models_and_trundles_own_those_of_trundle(tmp_path: Path) -> None:
    packages = _tutorials_folder(tmp_path)
    world = tmp_path / "my.world"
    includes = "".join(f"<include><uri>model://{name}</uri></include>" for name in ("ball", "rp2w_camsave"))
    world.write_text(f"<sdf version='1.6'><world name='w'>{includes}</world></sdf>")

    (named,) = load("model://rp2w", Diagnostics(), packages=packages).world.models
    ball, camsave = load(str(world), Diagnostics(), packages=packages).world.models

    assert [link.name for link in named.links] == [link.name for link in ball.links] == ["user"]
    assert "chassis" in [link.name for link in camsave.links]


def test_the_tutorials_display_launch_is_there_for_others_to_include(tmp_path: Path) -> None:
    folder = PACKAGES.find_package("urdf_tutorial")
    assert folder is not None
    assert (folder / "urdf.rviz").read_text() == (folder / "rviz/urdf.rviz").read_text()

    plan = read_launch(
        folder / "launch/display.launch", packages=PACKAGES, report=Diagnostics(), arguments={"model": "r.urdf"}, env={}
    )

    assert [node.type for node in plan.nodes][1:] == ["robot_state_publisher", "rviz"]


def test_files_that_launch_files_take_from_stock_packages_are_there(tmp_path: Path) -> None:
    """Clearpath's and PAL's robots include them; each would stop the launch, not only its own node."""
    launch = tmp_path / "drive.launch"
    launch.write_text(
        """<launch>
        <rosparam command="load" file="$(find joint_state_controller)/joint_state_controller.yaml"/>
        <rosparam command="load" file="$(find imu_sensor_controller)/imu_sensor_controller.yaml"/>
        <rosparam command="load" file="$(find force_torque_sensor_controller)/force_torque_sensor_controller.yaml"/>
        <include file="$(find interactive_marker_twist_server)/launch/interactive_markers.launch">
          <arg name="config" value="planar"/>
        </include>
        <include file="$(find twist_mux)/launch/twist_mux.launch"><arg name="cmd_vel_out" value="go"/></include>
        </launch>"""
    )

    plan = read_launch(launch, packages=PACKAGES, report=Diagnostics(), arguments={}, env={})

    values = {param.name: param.value for param in plan.params}
    kinds = {str(value) for name, value in values.items() if name.endswith("_controller/type")}
    assert len(kinds) == 3
    assert kinds <= set(CONTROLLERS)
    assert values["/twist_marker_server/max_positive_linear_velocity/y"] == 1
    assert ("cmd_vel_out", "go") in next(node for node in plan.nodes if node.name == "twist_mux").remappings


@pytest.mark.parametrize(
    ("mesh", "scale", "size"),
    [
        ("cube_20k/meshes/cube_20k.stl", 0.5, (1.0, 1.0, 1.0)),
        ("dumpster/meshes/dumpster.dae", 1.5, (2.505, 1.535, 1.773)),
        ("construction_cone/meshes/construction_cone.dae", 10.0, None),
    ],
)
def test_a_mesh_that_a_saved_world_names_is_as_large_as_the_stand_in(
    mesh: str, scale: float, size: tuple[float, float, float] | None, tmp_path: Path
) -> None:
    """Gazebo saves a world with the mesh's URI where its <include> was: TurtleBot's playground, Clearpath's races."""
    (tmp_path / "saved.sdf").write_text(
        f"""<sdf version="1.4"><model name="m"><link name="l"><collision name="c"><geometry>
        <mesh><uri>model://{mesh}</uri><scale>{scale} {scale} {scale}</scale></mesh>
        </geometry></collision></link></model></sdf>"""
    )
    report = Diagnostics()

    world = load(str(tmp_path / "saved.sdf"), report, packages=PACKAGES).world

    shape = world.models[0].links[0].collisions[0].geometry
    assert isinstance(shape, MeshFile)
    assert shape.path is not None
    assert report.warnings == []
    assert [f.what for f in report.findings] == [
        f"model://{Path(mesh).parts[0]} is not on GAZEBO_MODEL_PATH; plain shapes of about its size are used"
    ]
    corners = load_mesh(shape.path).vertices * shape.scale
    if size is not None:
        assert np.ptp(corners, axis=0) == pytest.approx(size, abs=1e-3)
    assert 0.3 < np.ptp(corners, axis=0).max() < 3.0


def test_meshes_of_stand_ins_can_be_read_and_enclose_something() -> None:
    meshes = sorted(STAND_INS.glob("*/meshes/*"))
    assert len(meshes) > 70
    for path in meshes:
        mesh = load_mesh(path)
        a, b, c = (mesh.vertices[mesh.faces[:, i]].astype(float) for i in range(3))
        assert np.einsum("ij,ij->", np.cross(a, b), c) > 0, path


def test_every_stock_package_with_a_stand_in_can_be_found_where_none_is_installed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """An unused argument's default must not stop a launch; a file that is used and missing is named."""
    monkeypatch.setattr("trundle.robots.packages.ros_packages._INSTALLED", tmp_path / "none")
    packages = Packages({"HOME": "/nobody"}, start=HERE)
    plugins = {"gazebo_plugins", "gazebo_ros_control", "hector_gazebo_plugins", "velodyne_gazebo_plugins"}
    nodes = {package for package, _ in catalog.BUILTIN_NODES}
    names = {kind.partition("/")[0] for kind in CONTROLLERS} | nodes | plugins | {"xacro"}
    assert [name for name in sorted(names) if packages.find_folder(name) is None] == []
    assert packages.find_package("rviz") is None
    launch = tmp_path / "show.launch"
    launch.write_text(
        """<launch><arg name="view" default="$(find rviz)/default.rviz"/>
        <node pkg="rviz" type="rviz" name="rviz" args="-d $(arg view)"/></launch>"""
    )
    (node,) = read_launch(launch, packages=packages, report=Diagnostics(), arguments={}, env={}).nodes
    assert node.arguments.endswith("/rviz/default.rviz")

    launch.write_text('<launch>\n<rosparam file="$(find joint_state_publisher)/a.yaml"/></launch>')
    with pytest.raises(
        DescriptionError, match=r"show\.launch:2: error: .*; its stand-in has no a\.yaml \[missing-package\]$"
    ):
        read_launch(launch, packages=packages, report=Diagnostics(), arguments={}, env={})


def test_an_installed_package_comes_before_the_stock_one(tmp_path: Path) -> None:
    (tmp_path / "rviz").mkdir()
    (tmp_path / "rviz/package.xml").write_text("<package><name>rviz</name></package>")

    assert Packages({"ROS_PACKAGE_PATH": str(tmp_path)}, start=HERE).find_folder("rviz") == tmp_path / "rviz"


class TestModelConfig:
    """Choice of the SDF file of a model folder."""

    def folder(self, tmp_path: Path, *entries: str) -> Path:
        (tmp_path / "model.config").write_text(f"<model>{''.join(entries)}</model>")
        for name in ("old.sdf", "new.sdf", "future.sdf"):
            (tmp_path / name).write_text("<sdf/>")
        return tmp_path

    def test_the_newest_version_that_can_be_read_wins(self, tmp_path: Path) -> None:
        entries = [
            f"<sdf version='{version}'>{name}.sdf</sdf>"
            for version, name in (("1.9", "old"), ("1.10", "new"), ("1.99", "future"))
        ]
        report = Diagnostics()

        assert model_file(self.folder(tmp_path, *entries), report).name == "new.sdf"
        assert report.findings == []

    def test_a_file_newer_than_any_rule_is_read_with_a_warning(self, tmp_path: Path) -> None:
        report = Diagnostics()

        assert model_file(self.folder(tmp_path, "<sdf version='2.0'>future.sdf</sdf>"), report).name == "future.sdf"
        (warning,) = report.warnings
        assert warning.endswith("model.config:1: warning: SDF 2.0 is newer than 1.12; it is read as 1.12")

    @pytest.mark.parametrize("text", ["lost.sdf", "../../../etc/passwd", "/etc/passwd", ""])
    def test_a_file_that_is_not_in_the_folder_is_refused(self, tmp_path: Path, text: str) -> None:
        with pytest.raises(DescriptionError, match=rf"no file '{text}' in .*; there is: future.sdf, model.config, new"):
            model_file(self.folder(tmp_path, f"<sdf version='1.6'>{text}</sdf>"), Diagnostics())

    def test_a_folder_without_one_lists_what_it_has(self, tmp_path: Path) -> None:
        with pytest.raises(DescriptionError, match=r"no model\.config in this folder; there is: nothing"):
            model_file(tmp_path, Diagnostics())


@pytest.mark.parametrize(("name", "output"), [("city.world.erb", "city.world"), ("arm.rsdf", "arm.sdf")])
def test_a_template_is_refused_with_how_to_expand_it(tmp_path: Path, name: str, output: str) -> None:
    path = tmp_path / name
    path.write_text("<% 3.times do %>")

    with pytest.raises(DescriptionError, match=rf"expand it first: erb {name} > {output}"):
        load(str(path), Diagnostics(), packages=PACKAGES)
    with pytest.raises(DescriptionError):
        refuse_template(path)


def test_the_rp2w_that_saves_its_pictures_is_otherwise_the_rp2w() -> None:
    report = Diagnostics()

    (model,) = load("model://rp2w_camsave", report, packages=PACKAGES).world.models
    (plain,) = load("model://rp2w", Diagnostics(), packages=PACKAGES).world.models

    assert [link.name for link in model.links] == [link.name for link in plain.links]
    cameras = [camera for link in model.links for sensor in link.sensors for camera in sensor.cameras]
    assert [camera.save_path for camera in cameras] == [
        "/tmp/rp2w_camsave/netbook_webcam",
        "/tmp/rp2w_camsave/my_sensor",
    ]
    assert report.warnings == []


def test_a_world_of_the_examples_is_found_by_its_name() -> None:
    found = PACKAGES.find_world("physics/cart.world")

    assert found is not None
    assert "libmotors.so" in found.read_text()
    assert (found.parent / "motors.py").is_file()
