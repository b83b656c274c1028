"""Model plugins of gazebo_ros: spawned, and commanded and read by topics."""

import math
from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until

from trundle.ros import DISTROS

_INERTIA = "<inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia>"
TWIST, ODOMETRY = "geometry_msgs/Twist", "nav_msgs/Odometry"


def _wheel(name: str, x: float, y: float) -> str:
    return f"""<link name="{name}"><pose>{x} {y} 0.1 {-math.pi / 2} 0 0</pose>
<inertial><mass>0.5</mass>{_INERTIA}</inertial>
<collision name="c"><geometry><cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>
</link><joint name="{name}_joint" type="revolute"><parent>chassis</parent><child>{name}</child>
<axis><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis></joint>"""


def _car(plugin: str, wheels: str) -> str:
    slide = "<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"
    ball = "<geometry><sphere><radius>0.05</radius></sphere></geometry>"
    feet = "".join(
        f'<collision name="f{x}"><pose>{x} 0 -0.05 0 0 0</pose>{ball}{slide}</collision>' for x in (0.15, -0.15)
    )
    return f"""<sdf version="1.6"><model name="car"><link name="chassis"><pose>0 0 0.1 0 0 0</pose>
<inertial><mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>{feet}</link>
{wheels}{plugin}</model></sdf>"""


def _plugin(name: str, parameters: str = "") -> str:
    return f'<plugin name="p" filename="libgazebo_ros_{name}.so">{parameters}</plugin>'


_TWO = _wheel("left", 0.0, 0.2) + _wheel("right", 0.0, -0.2)
_DIFF = """<leftJoint>left_joint</leftJoint><rightJoint>right_joint</rightJoint><wheelSeparation>0.4</wheelSeparation>
<wheelDiameter>0.2</wheelDiameter><wheelTorque>5</wheelTorque><robotNamespace>/r</robotNamespace>
<publishWheelJointState>true</publishWheelJointState><publishWheelTF>true</publishWheelTF>"""


def _yaw(message: Any) -> float:
    orientation = message.pose.pose.orientation
    return 2.0 * math.atan2(orientation.z, orientation.w)


@pytest.mark.parametrize("source", ["world", "encoder"])
def test_a_differential_drive_drives_and_publishes_odometry(gazebo: Gazebo, source: str) -> None:
    parameters = f"{_DIFF}<odometrySource>{source}</odometrySource>"
    assert gazebo.spawn(_car(_plugin("diff_drive", parameters), _TWO), "car").success
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/r/odom", ODOMETRY)
    frames = gazebo.subscribe("/tf", "tf2_msgs/TFMessage")
    states = gazebo.subscribe("/r/joint_states", "sensor_msgs/JointState")
    drive = gazebo.advertise("/r/cmd_vel", TWIST)
    drive({"linear": {"x": 0.5}})
    until(lambda: odometry and odometry[-1].pose.pose.position.x > 0.4)
    drive({"linear": {"x": 0.5}, "angular": {"z": 0.5}})
    until(lambda: _yaw(odometry[-1]) > 0.3)

    assert odometry[-1].twist.twist.linear.x == pytest.approx(0.5, abs=0.02)
    assert odometry[-1].twist.twist.angular.z == pytest.approx(0.5, abs=0.03)
    assert (odometry[0].header.frame_id, odometry[0].child_frame_id) == ("odom", "base_footprint")
    assert odometry[0].pose.covariance[14] == 1e12
    assert list(states[-1].name) == ["left_joint", "right_joint"]
    drive({})
    until(lambda: abs(odometry[-1].twist.twist.linear.x) < 1e-3)
    estimate, truth = odometry[-1].pose.pose.position, gazebo.state("car").pose.position
    assert (estimate.x, estimate.y) == (pytest.approx(truth.x, abs=0.03), pytest.approx(truth.y, abs=0.03))
    assert {"base_footprint", "left", "right"} <= {t.child_frame_id for m in frames for t in m.transforms}


@pytest.mark.parametrize(
    ("distro", "legacy", "sign"),
    [("noetic", "<legacyMode>true</legacyMode>", -1), ("kinetic", "", -1), ("melodic", "", 1)],
)
def test_old_packages_mirror_the_turn(gazebo: Gazebo, distro: str, legacy: str, sign: int) -> None:
    gazebo.server.profile = DISTROS[distro]
    gazebo.spawn(_car(_plugin("diff_drive", f"{_DIFF}{legacy}"), _TWO), "car")
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/r/odom", ODOMETRY)
    gazebo.advertise("/r/cmd_vel", TWIST)({"angular": {"z": 0.5}})
    until(lambda: odometry and sign * _yaw(odometry[-1]) > 0.2)


def test_four_wheels_drive(gazebo: Gazebo) -> None:
    wheels = "".join(
        _wheel(f"{side}_{row}", x, y)
        for side, y in (("left", 0.2), ("right", -0.2))
        for row, x in (("front", 0.2), ("rear", -0.2))
    )
    parameters = "<wheelDiameter>0.2</wheelDiameter><broadcastTF>true</broadcastTF><covariance_x>0.5</covariance_x>"
    assert gazebo.spawn(_car(_plugin("skid_steer_drive", parameters), wheels), "car").success
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/odom", ODOMETRY)
    frames = gazebo.subscribe("/tf", "tf2_msgs/TFMessage")
    gazebo.advertise("/cmd_vel", TWIST)({"linear": {"x": 0.5}})
    until(lambda: odometry and odometry[-1].pose.pose.position.x > 0.4)
    assert odometry[-1].pose.covariance[0] == 0.5
    assert frames


_STEERED = f"""{_wheel("left", -0.2, 0.2)}{_wheel("right", -0.2, -0.2)}
<link name="fork"><pose>0.3 0 0.1 0 0 0</pose><inertial><mass>0.5</mass>{_INERTIA}</inertial></link>
<joint name="steer" type="revolute"><parent>chassis</parent><child>fork</child><axis><xyz>0 0 1</xyz></axis></joint>
{_wheel("front", 0.3, 0.0).replace("<parent>chassis", "<parent>fork")}"""
_TRICYCLE = """<steeringJoint>steer</steeringJoint><actuatedWheelJoint>front_joint</actuatedWheelJoint>
<encoderWheelLeftJoint>left_joint</encoderWheelLeftJoint><encoderWheelRightJoint>right_joint</encoderWheelRightJoint>
<actuatedWheelDiameter>0.2</actuatedWheelDiameter><encoderWheelDiameter>0.2</encoderWheelDiameter>
<encoderWheelSeparation>0.4</encoderWheelSeparation><publishWheelJointState>true</publishWheelJointState>
<wheelAcceleration>20</wheelAcceleration><steeringSpeed>2</steeringSpeed>"""


@pytest.mark.parametrize("source", ["world", "encoder"])
def test_a_tricycle_turns_about_the_intersection_of_its_axles(gazebo: Gazebo, source: str) -> None:
    """With 0.5 m between the axles, a steered wheel at 0.3 m/s and 0.4 rad turns the car at 0.3 sin(0.4)/0.5 rad/s."""
    parameters = f"{_TRICYCLE}<odometrySource>{source}</odometrySource>"
    feet = '<collision name="f-0.15">'
    car = _car(_plugin("tricycle_drive", parameters), _STEERED)
    assert gazebo.spawn(car.replace(feet, '<collision name="unused"><pose>0 0 9 0 0 0</pose>', 1), "car").success
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/odom", ODOMETRY)
    states = gazebo.subscribe("/joint_states", "sensor_msgs/JointState")
    gazebo.advertise("/cmd_vel", TWIST)({"linear": {"x": 0.3}, "angular": {"z": 0.4}})
    until(lambda: odometry and _yaw(odometry[-1]) > 0.5)

    assert odometry[-1].twist.twist.angular.z == pytest.approx(0.3 * math.sin(0.4) / 0.5, rel=0.1)
    assert (odometry[-1].header.frame_id, odometry[-1].child_frame_id) == ("odom", "base_link")
    assert dict(zip(states[-1].name, states[-1].position, strict=True))["steer"] == pytest.approx(0.4, abs=0.01)


_BOX = f"""<sdf version="1.6"><model name="box"><pose>0 0 2 0 0 0</pose><link name="body">
<inertial><mass>2</mass>{_INERTIA}</inertial></link>{{plugin}}</model></sdf>"""


def test_planar_move_follows_commands_without_falling(gazebo: Gazebo) -> None:
    parameters = "<robotNamespace>box</robotNamespace><cmdTimeout>0.3</cmdTimeout>"
    gazebo.spawn(_BOX.format(plugin=_plugin("planar_move", parameters)), "box")
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/box/odom", ODOMETRY)
    drive = gazebo.advertise("/box/cmd_vel", TWIST)

    def moved() -> bool:
        drive({"linear": {"x": 0.5, "y": 0.25}})
        return bool(odometry) and odometry[-1].pose.pose.position.x > 0.2

    until(moved)
    until(lambda: odometry[-1].twist.twist.linear.x == pytest.approx(0.0, abs=1e-6))  # no more commands
    position = odometry[-1].pose.pose.position
    assert position.y == pytest.approx(position.x / 2, rel=0.01)
    assert 0.0 <= 2.0 - position.z < 0.01 * gazebo.time_s, "a step of gravity moves it by g·dt² before it is set again"


def test_planar_move_without_the_y_axis_moves_only_forward(gazebo: Gazebo) -> None:
    gazebo.spawn(_BOX.format(plugin=_plugin("planar_move", "<enableYAxis>false</enableYAxis>")), "box")
    gazebo.call("unpause_physics")
    odometry = gazebo.subscribe("/odom", ODOMETRY)
    gazebo.advertise("/cmd_vel", TWIST)({"linear": {"x": 0.5, "y": 0.25}})
    until(lambda: odometry and odometry[-1].pose.pose.position.x > 0.2)

    assert odometry[-1].pose.pose.position.y == pytest.approx(0.0, abs=1e-6)


_ARM = f"""<sdf version="1.6"><model name="arm"><pose>0 0 2 0 0 0</pose><link name="base">
<inertial><mass>2</mass>{_INERTIA}</inertial></link><link name="rod"><pose>0.5 0 0 0 0 0</pose>
<inertial><mass>1</mass>{_INERTIA}</inertial></link>
<joint name="fix" type="fixed"><parent>world</parent><child>base</child></joint>
<joint name="turn" type="revolute"><parent>base</parent><child>rod</child><axis><xyz>0 0 1</xyz></axis></joint>
{{plugin}}</model></sdf>"""


def test_joints_take_the_positions_of_a_trajectory_and_are_published(gazebo: Gazebo) -> None:
    plugins = _plugin("joint_state_publisher", "<jointName>turn</jointName>").replace('"p"', '"q"')
    gazebo.spawn(_ARM.format(plugin=plugins + _plugin("joint_pose_trajectory")), "arm")
    gazebo.call("unpause_physics")
    states = gazebo.subscribe("/joint_states", "sensor_msgs/JointState")
    points = [{"positions": [x], "time_from_start": {"nanosec": 200_000_000}} for x in (1.0, 0.5, 0.25)]
    publish = gazebo.advertise("/set_joint_trajectory", "trajectory_msgs/JointTrajectory")
    publish({"joint_names": ["turn"], "points": points})
    until(lambda: states and states[-1].position[0] == pytest.approx(0.25, abs=1e-6))

    def stamp_of(position: float) -> float:
        stamp = next(m.header.stamp for m in states if m.position[0] == pytest.approx(position, abs=1e-6))
        return float(stamp.sec) + stamp.nanosec * 1e-9

    assert stamp_of(0.5) - stamp_of(1.0) == pytest.approx(0.2, abs=0.02), "a point follows the time of the one before"
    assert stamp_of(0.25) - stamp_of(0.5) == pytest.approx(0.2, abs=0.02)

    kind = "gazebo_msgs/SetJointTrajectory"
    invalid = {"joint_names": ["turn"], "points": [{"positions": []}]}
    call = gazebo.client.call_service("/set_joint_trajectory", kind, {"joint_trajectory": invalid})
    response = gazebo.loop.run(call)
    assert (response.success, response.status_message) == (False, "each point needs 1 positions")


def test_a_mimic_joint_follows_its_leader(gazebo: Gazebo) -> None:
    mimic = """<plugin name="m" filename="libroboticsgroup_gazebo_mimic_joint_plugin.so"><joint>turn</joint>
<mimicJoint>tip</mimicJoint><multiplier>-2</multiplier><offset>0.1</offset></plugin>"""
    tip = f"""<link name="end"><pose>1 0 0 0 0 0</pose><inertial><mass>0.1</mass>{_INERTIA}</inertial></link>
<joint name="tip" type="revolute"><parent>rod</parent><child>end</child><axis><xyz>0 0 1</xyz></axis></joint>"""
    publisher = _plugin("joint_state_publisher", "<jointName>turn tip</jointName>").replace('"p"', '"q"')
    gazebo.spawn(_ARM.format(plugin=tip + mimic + publisher + _plugin("joint_pose_trajectory")), "arm")
    gazebo.call("unpause_physics")
    states = gazebo.subscribe("/joint_states", "sensor_msgs/JointState")
    publish = gazebo.advertise("/set_joint_trajectory", "trajectory_msgs/JointTrajectory")
    publish({"joint_names": ["turn"], "points": [{"positions": [0.5]}]})

    def follows() -> bool:
        turn, tip = states[-1].position
        return abs(turn) > 0.1 and tip == pytest.approx(0.1 - 2 * turn, abs=0.02)

    until(lambda: states and follows())


def test_p3d_publishes_the_true_pose_of_a_link(gazebo: Gazebo) -> None:
    parameters = "<bodyName>rod</bodyName><topicName>truth</topicName><xyzOffset>0 0 1</xyzOffset>"
    relative = "<bodyName>rod</bodyName><topicName>arm_truth</topicName><frameName>base</frameName>"
    plugins = _plugin("p3d", parameters) + _plugin("p3d", relative).replace('"p"', '"q"')
    assert gazebo.spawn(_ARM.format(plugin=plugins), "arm", x=1.0).success
    gazebo.call("unpause_physics")
    truth, relative_truth = gazebo.subscribe("/truth", ODOMETRY), gazebo.subscribe("/arm_truth", ODOMETRY)
    until(lambda: truth and relative_truth)

    position = truth[-1].pose.pose.position
    assert (position.x, position.z) == (pytest.approx(1.5), pytest.approx(3.0))
    assert (truth[-1].header.frame_id, truth[-1].child_frame_id) == ("world", "rod")
    assert relative_truth[-1].pose.pose.position.x == pytest.approx(0.5)
    assert relative_truth[-1].header.frame_id == "base"


def test_plugins_with_one_name_all_publish(gazebo: Gazebo) -> None:
    parameters = [f"<bodyName>body</bodyName><topicName>truth{i}</topicName>" for i in range(3)]
    gazebo.spawn(_BOX.format(plugin="".join(_plugin("p3d", parameter) for parameter in parameters)), "box")
    gazebo.call("unpause_physics")
    topics = [gazebo.subscribe(f"/truth{i}", ODOMETRY) for i in range(3)]

    def all_publish_for_a_second() -> bool:
        return all(
            len(messages) > 1 and (messages[-1].header.stamp.sec - messages[0].header.stamp.sec) > 1
            for messages in topics
        )

    until(all_publish_for_a_second)


def test_a_wrench_from_a_topic_pushes(gazebo: Gazebo) -> None:
    parameters = "<bodyName>body</bodyName><topicName>push</topicName>"
    gazebo.spawn(_BOX.format(plugin=_plugin("force", parameters)), "box")
    gazebo.advertise("/push", "geometry_msgs/Wrench")({"force": {"x": 1.0, "z": 2 * 9.8}})
    gazebo.call("unpause_physics")
    until(lambda: gazebo.state("box").twist.linear.x > 0.3)
    assert gazebo.state("box").pose.position.z == pytest.approx(2.0, abs=0.05)


def test_the_applied_wrench_of_a_link_is_published(gazebo: Gazebo) -> None:
    plugins = _plugin("force", "<bodyName>body</bodyName><topicName>push</topicName>")
    plugins += _plugin("f3d", "<bodyName>body</bodyName><topicName>felt</topicName>").replace('"p"', '"q"')
    gazebo.spawn(_BOX.format(plugin=plugins), "box")
    wrenches = gazebo.subscribe("/felt", "geometry_msgs/WrenchStamped")
    gazebo.advertise("/push", "geometry_msgs/Wrench")({"force": {"x": 1.5}, "torque": {"z": 0.25}})
    gazebo.call("unpause_physics")
    until(lambda: wrenches and wrenches[-1].wrench.force.x == 1.5)
    assert (wrenches[-1].wrench.force.z, wrenches[-1].wrench.torque.z) == (0.0, 0.25)
    assert wrenches[-1].header.frame_id == "world"


@pytest.mark.parametrize(
    ("name", "parameters", "reason"),
    [
        ("p3d", "<bodyName>body</bodyName>", "<topicName> is missing"),
        ("force", "<bodyName>nose</bodyName>", "no link 'nose'"),
        ("diff_drive", "", "no joint 'left_joint'"),
    ],
)
def test_a_plugin_that_cannot_be_loaded_is_reported(gazebo: Gazebo, name: str, parameters: str, reason: str) -> None:
    assert gazebo.spawn(_BOX.format(plugin=_plugin(name, parameters)), "box").success
    until(lambda: any(reason in warning for warning in gazebo.report.warnings))
