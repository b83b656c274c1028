"""RobotModel's shapes: every link, in its colours, red where it has none."""

from trundle.diagnostics import Diagnostics
from trundle.model import Box, Cylinder, Sphere
from trundle.robot import read_robot
from trundle.viewer import robot_scene
from trundle.xmlnode import parse_xml

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


def test_links_are_bodies_root_first_and_visuals_keep_their_colours() -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    scene = robot_scene(robot, report)

    assert scene.bodies == ("base_link", "wheel")
    chassis, wheel = scene.shapes
    assert (chassis.body, chassis.geometry, chassis.rgba) == (0, Box((1.0, 2.0, 3.0)), (0.0, 0.0, 0.8, 1.0))
    assert chassis.body_from_shape.position == (0.0, 0.0, 1.0)
    assert (wheel.body, wheel.geometry, wheel.rgba) == (1, Cylinder(0.1, 0.05), (1.0, 0.0, 0.0, 1.0))


def test_collision_shapes_are_a_scene_of_the_same_bodies() -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    scene = robot_scene(robot, report, collisions=True)

    assert scene.bodies == ("base_link", "wheel")
    assert [shape.geometry for shape in scene.shapes] == [Sphere(2.0)]


def test_a_mesh_is_named_not_dropped() -> None:
    report = Diagnostics()
    robot = read_robot(parse_xml(_URDF, name="car.urdf"), report)

    robot_scene(robot, report)

    assert "car.urdf:4: warning: package://car/hub.stl: the page of a graph does not draw meshes yet" in str(
        report.warnings
    )
