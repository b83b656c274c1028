"""RobotModel's shapes: every link in its colors, red without a material."""

from pathlib import Path

import pytest

from trundle.app.picture.robot_scene import robot_scene
from trundle.base.diagnostics import Diagnostics
from trundle.base.xmlnode import parse_xml
from trundle.robots.meshes import Mesh
from trundle.robots.model import Box, Cylinder, Sphere
from trundle.robots.packages import Packages
from trundle.robots.robot import read_robot

_URDF = """\
<robot name="car">
  <link name="wheel">
    <visual><geometry><cylinder radius="0.1" length="0.05"/></geometry></visual>
    <visual><geometry><mesh filename="package://car/hub.stl"/></geometry></visual>
  </link>
  <link name="base_link">
    <visual>
      <origin xyz="0 0 1"/>
      <geometry><box size="1 2 3"/></geometry>
      <material name="blue"><color rgba="0 0 0.8 1"/></material>
    </visual>
    <collision><geometry><sphere radius="2"/></geometry></collision>
  </link>
  <joint name="hinge" type="continuous"><parent link="base_link"/><child link="wheel"/></joint>
</robot>
"""


_HUB = """\
solid hub
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid hub
"""


@pytest.fixture
def packages(tmp_path: Path) -> Packages:
    """A package `car` with a manifest and without its mesh."""
    (tmp_path / "car").mkdir()
    (tmp_path / "car" / "package.xml").write_text("<package><name>car</name></package>")
    return Packages({"ROS_PACKAGE_PATH": str(tmp_path)}, start=tmp_path)


def test_links_are_bodies_root_first_and_visuals_keep_their_colors(packages: Packages) -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    scene = robot_scene(robot, packages, report)

    assert scene.bodies == ("base_link", "wheel")
    chassis, wheel = scene.shapes
    assert (chassis.body, chassis.geometry, chassis.rgba) == (0, Box((1.0, 2.0, 3.0)), (0.0, 0.0, 0.8, 1.0))
    assert chassis.body_from_shape.position == (0.0, 0.0, 1.0)
    assert (wheel.body, wheel.geometry, wheel.rgba) == (1, Cylinder(0.1, 0.05), (1.0, 0.0, 0.0, 1.0))


def test_collision_shapes_are_a_scene_of_the_same_bodies(packages: Packages) -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    scene = robot_scene(robot, packages, report, collisions=True)

    assert scene.bodies == ("base_link", "wheel")
    assert [shape.geometry for shape in scene.shapes] == [Sphere(2.0)]


def test_a_missing_mesh_is_a_warning_with_its_line(packages: Packages) -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    robot_scene(robot, packages, report)

    (warning,) = report.warnings
    assert warning.startswith("car.urdf:4: warning: ")
    assert "package://car/hub.stl: no such file" in warning
    assert warning.endswith("; this shape is not drawn")
    assert ": error: " not in warning


def test_a_mesh_is_found_in_its_package_and_scaled(packages: Packages, tmp_path: Path) -> None:
    (tmp_path / "car" / "hub.stl").write_text(_HUB)
    report = Diagnostics()
    text = _URDF.replace('hub.stl"', 'hub.stl" scale="2 3 4"')
    robot = read_robot(parse_xml(text, name="car.urdf"), report)

    mesh = robot_scene(robot, packages, report).shapes[2].geometry

    assert report.warnings == []
    assert isinstance(mesh, Mesh)
    assert mesh.vertices.max(axis=0).tolist() == [2.0, 3.0, 0.0]
