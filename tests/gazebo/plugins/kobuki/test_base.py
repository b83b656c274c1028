"""The base of a TurtleBot 2 in a running world: drive, bumper, cliff sensors and motor power."""

import math

import pytest
from tests.gazebo_server import Gazebo, until

_WALL = """<sdf version="1.6"><model name="wall"><static>1</static><link name="l"><pose>0.8 0 0.5 0 0 0</pose>
<collision name="c"><geometry><box><size>0.2 4 1</size></box></geometry></collision></link></model></sdf>"""
_INERTIA = "<inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia>"
_SLIDE = "<surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface>"
_RAY = """<ray><scan><horizontal><samples>3</samples><min_angle>-0.04</min_angle><max_angle>0.04</max_angle>
</horizontal></scan><range><min>0.01</min><max>0.15</max></range></ray>"""


def _contact_sensor(name: str, collision: str) -> str:
    return f"""<sensor name="{name}" type="contact"><always_on>1</always_on><update_rate>50</update_rate>
<contact><collision>{collision}</collision></contact></sensor>"""


def _cliff_sensor(name: str, y: float) -> str:
    return f"""<sensor name="{name}" type="ray"><pose>0.1 {y} 0.03 0 {math.pi / 2} 0</pose>
<update_rate>50</update_rate>{_RAY}</sensor>"""


def _wheel(side: str, y: float) -> str:
    return f"""<link name="wheel_{side}"><pose>0 {y} 0.035 {-math.pi / 2} 0 0</pose>
<inertial><mass>0.05</mass><inertia><ixx>1e-4</ixx><iyy>1e-4</iyy><izz>1e-4</izz></inertia></inertial>
<collision name="rim"><geometry><cylinder><radius>0.035</radius><length>0.02</length></cylinder></geometry></collision>
{_contact_sensor(f"drop_{side}", "rim")}</link>
<joint name="{side}" type="revolute"><parent>base_footprint</parent><child>wheel_{side}</child>
<axis><xyz>0 1 0</xyz><use_parent_model_frame>1</use_parent_model_frame></axis></joint>"""


def _caster(x: float) -> str:
    ball = "<geometry><sphere><radius>0.015</radius></sphere></geometry>"
    return f'<collision name="caster{x}"><pose>{x} 0 0.015 0 0 0</pose>{ball}{_SLIDE}</collision>'


_PARAMETERS = """<left_wheel_joint_name>left</left_wheel_joint_name><publish_tf>1</publish_tf>
<right_wheel_joint_name>right</right_wheel_joint_name><wheel_separation>0.23</wheel_separation>
<wheel_diameter>0.07</wheel_diameter><torque>1.0</torque><velocity_command_timeout>0.6</velocity_command_timeout>
<cliff_sensor_left_name>cliff_left</cliff_sensor_left_name><cliff_sensor_right_name>cliff_right</cliff_sensor_right_name>
<cliff_sensor_center_name>cliff_front</cliff_sensor_center_name><imu_name>imu</imu_name>
<cliff_detection_threshold>0.04</cliff_detection_threshold><bumper_name>bumpers</bumper_name>
<wheel_drop_left_sensor_name>drop_left</wheel_drop_left_sensor_name>
<wheel_drop_right_sensor_name>drop_right</wheel_drop_right_sensor_name><update_rate>100</update_rate>"""
_ROBOT = f"""<sdf version="1.6"><model name="mobile_base"><link name="base_footprint">
<inertial><pose>0 0 0.05 0 0 0</pose><mass>2.4</mass>{_INERTIA}</inertial>{_caster(0.12)}{_caster(-0.12)}
<collision name="body"><pose>0 0 0.08 0 0 0</pose><geometry><cylinder><radius>0.17</radius><length>0.08</length>
</cylinder></geometry></collision>{_contact_sensor("bumpers", "body")}
{_cliff_sensor("cliff_left", 0.08)}{_cliff_sensor("cliff_front", 0.0)}{_cliff_sensor("cliff_right", -0.08)}
<sensor name="imu" type="imu"><update_rate>50</update_rate></sensor></link>
{_wheel("left", 0.115)}{_wheel("right", -0.115)}
<plugin name="kobuki" filename="libgazebo_ros_kobuki.so">{_PARAMETERS}</plugin></model></sdf>"""
_BASE = "/mobile_base"


@pytest.fixture
def kobuki(gazebo: Gazebo) -> Gazebo:
    response = gazebo.spawn(_ROBOT, "mobile_base")
    assert response.success, response.status_message
    gazebo.call("unpause_physics")
    return gazebo


def test_the_base_drives_until_its_bumper_touches_a_wall(kobuki: Gazebo) -> None:
    kobuki.spawn(_WALL, "wall")
    odometry = kobuki.subscribe("/odom", "nav_msgs/Odometry")
    bumps = kobuki.subscribe(f"{_BASE}/events/bumper", "kobuki_msgs/BumperEvent")
    core = kobuki.subscribe(f"{_BASE}/sensors/core", "kobuki_msgs/SensorState")
    states = kobuki.subscribe("/joint_states", "sensor_msgs/JointState")
    drive = kobuki.advertise(f"{_BASE}/commands/velocity", "geometry_msgs/Twist")

    def driving() -> bool:
        drive({"linear": {"x": 0.3}})
        return bool(bumps) and bool(core[-1].bumper)

    until(driving)
    assert (bumps[0].bumper, bumps[0].state) == (1, 1)
    assert core[-1].bumper & 2
    message = odometry[-1]
    assert message.pose.pose.position.x == pytest.approx(kobuki.state("mobile_base").pose.position.x, abs=0.05)
    assert (message.header.frame_id, message.child_frame_id) == ("odom", "base_footprint")
    assert max(message.twist.twist.linear.x for message in odometry) == pytest.approx(0.3, abs=0.05)
    assert (message.pose.covariance[0], message.pose.covariance[35], message.twist.covariance[0]) == (0.1, 0.05, 0.0)
    assert list(states[-1].name) == ["left", "right"]


def test_odometry_takes_yaw_from_the_gyro_and_commands_expire(kobuki: Gazebo) -> None:
    odometry = kobuki.subscribe("/odom", "nav_msgs/Odometry")
    imu = kobuki.subscribe(f"{_BASE}/sensors/imu_data", "sensor_msgs/Imu")
    drive = kobuki.advertise(f"{_BASE}/commands/velocity", "geometry_msgs/Twist")

    def turning() -> bool:
        drive({"angular": {"z": 0.8}})
        return bool(odometry) and odometry[-1].twist.twist.angular.z > 0.7

    until(turning)
    until(lambda: imu and imu[-1].angular_velocity.z > 0.7)
    assert imu[-1].linear_acceleration.z == pytest.approx(9.8, abs=1.0)
    assert imu[-1].orientation_covariance[8] == 0.05
    until(lambda: abs(odometry[-1].twist.twist.angular.z) < 0.05)
    orientation = odometry[-1].pose.pose.orientation
    true_orientation = kobuki.state("mobile_base").pose.orientation
    assert math.atan2(orientation.z, orientation.w) == pytest.approx(
        math.atan2(true_orientation.z, true_orientation.w), abs=0.05
    )
    kobuki.advertise(f"{_BASE}/commands/reset_odometry", "std_msgs/Empty")({})
    until(lambda: abs(odometry[-1].pose.pose.orientation.z) < 0.01)


def test_a_lifted_base_reports_cliffs_and_stops_without_power(kobuki: Gazebo) -> None:
    cliffs = kobuki.subscribe(f"{_BASE}/events/cliff", "kobuki_msgs/CliffEvent")
    drops = kobuki.subscribe(f"{_BASE}/events/wheel_drop", "kobuki_msgs/WheelDropEvent")
    core = kobuki.subscribe(f"{_BASE}/sensors/core", "kobuki_msgs/SensorState")
    until(lambda: core and core[-1].cliff == 0 and core[-1].wheel_drop == 0)
    lifted = {"model_name": "mobile_base", "pose": {"position": {"z": 30.0}, "orientation": {"w": 1.0}}}
    kobuki.call("set_model_state", "gazebo_msgs/SetModelState", model_state=lifted)
    until(lambda: {event.sensor for event in cliffs if event.state == 1} == {0, 1, 2})
    until(lambda: {event.wheel for event in drops if event.state == 1} == {0, 1})
    until(lambda: core[-1].cliff == 7 and core[-1].wheel_drop == 3)

    states = kobuki.subscribe("/joint_states", "sensor_msgs/JointState")
    drive = kobuki.advertise(f"{_BASE}/commands/velocity", "geometry_msgs/Twist")

    def spinning() -> bool:
        drive({"linear": {"x": 0.3}})
        return bool(states) and states[-1].velocity[0] > 5.0

    until(spinning)
    kobuki.advertise(f"{_BASE}/commands/motor_power", "kobuki_msgs/MotorPower")({"state": 0})

    def stopped() -> bool:
        drive({"linear": {"x": 0.3}})
        return abs(states[-1].velocity[0]) < 0.1

    until(stopped)


def test_a_missing_sensor_is_reported(gazebo: Gazebo) -> None:
    invalid = _ROBOT.replace("<bumper_name>bumpers", "<bumper_name>nose")
    assert gazebo.spawn(invalid, "mobile_base").success
    until(
        lambda: any("no sensor 'nose'; sensors here: bumpers, " in str(warning) for warning in gazebo.report.warnings)
    )
