"""Sensor plugins of gazebo_ros: their topics, frames and readings."""

import io
import math
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from PIL import Image
from tests.gazebo_server import Gazebo, until

_INERTIA = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
_RAYS = """<ray><scan><horizontal><samples>5</samples><min_angle>-0.2</min_angle><max_angle>0.2</max_angle></horizontal>
</scan><range><min>0.1</min><max>10</max></range></ray>"""
_CAMERA = """<camera><horizontal_fov>1.0</horizontal_fov><image><width>32</width><height>24</height></image>
<clip><near>0.1</near><far>20</far></clip></camera>"""
_WALL = """<sdf version="1.6"><model name="wall"><static>1</static><link name="l"><pose>2.5 0 1 0 0 0</pose>
<collision name="c"><geometry><box><size>1 10 10</size></box></geometry></collision>
<visual name="v"><geometry><box><size>1 10 10</size></box></geometry></visual></link></model></sdf>"""


def _sensor(kind: str, inside: str, plugin: str, parameters: str, *, name: str = "eye") -> str:
    return f"""<sensor name="{name}" type="{kind}"><update_rate>50</update_rate>{inside}
<plugin name="{name}_plugin" filename="libgazebo_ros_{plugin}.so">{parameters}</plugin></sensor>"""


def _mast(sensors: str, plugin: str = "") -> str:
    """Return a model with sensors, fixed to the world at 1 m height."""
    return f"""<sdf version="1.6"><model name="mast"><link name="head"><pose>0 0 1 0 0 0</pose>
<inertial><mass>2</mass>{_INERTIA}</inertial>{sensors}</link>
<joint name="fix" type="fixed"><parent>world</parent><child>head</child></joint>{plugin}</model></sdf>"""


def _spawn_sensors(gazebo: Gazebo, sensors: str, plugin: str = "") -> None:
    assert gazebo.spawn(_WALL, "wall").success
    response = gazebo.spawn(_mast(sensors, plugin), "mast")
    assert response.success, response.status_message
    gazebo.call("unpause_physics")


def _first_message(gazebo: Gazebo, topic: str, kind: str) -> Any:
    messages = gazebo.subscribe(topic, kind)
    until(lambda: messages)
    return messages[-1]


@pytest.mark.parametrize("plugin", ["laser", "gpu_laser"])
def test_a_laser_scans_on_its_topic_in_its_frame(gazebo: Gazebo, plugin: str) -> None:
    kind = "gpu_ray" if plugin == "gpu_laser" else "ray"
    parameters = "<topicName>/bot/scan</topicName><frameName>/hokuyo_link</frameName>"
    _spawn_sensors(gazebo, _sensor(kind, _RAYS, plugin, parameters))
    scan = _first_message(gazebo, "/bot/scan", "sensor_msgs/LaserScan")

    assert scan.header.frame_id == "hokuyo_link"
    assert len(scan.ranges) == 5
    assert scan.ranges[2] == pytest.approx(2.0, abs=1e-3)
    topics = dict(gazebo.loop.run(gazebo.client.master.call("getTopicTypes")))
    assert "/mast/head/eye/scan" not in topics  # the plugin's topic replaces it


def test_a_sensor_without_a_plugin_has_a_frame_below_its_urdf_link(gazebo: Gazebo) -> None:
    """The sensor is on a lumped link, whose frame only robot_state_publisher sends."""
    inertia = '<inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial>'
    joint = '<joint name="j" type="fixed"><parent link="base"/><child link="mast"/><origin xyz="0 0 1"/></joint>'
    sensor = '<gazebo reference="mast"><sensor name="mast" type="imu"><always_on>1</always_on></sensor></gazebo>'
    gazebo.spawn(f'<robot name="bot"><link name="base">{inertia}</link><link name="mast"/>{joint}{sensor}</robot>', "b")
    gazebo.call("unpause_physics")
    imu = _first_message(gazebo, "/b/base/mast/imu", "sensor_msgs/Imu")
    (mounting,) = _first_message(gazebo, "/tf_static", "tf2_msgs/TFMessage").transforms

    assert imu.header.frame_id == mounting.child_frame_id == "mast_sensor"
    assert mounting.header.frame_id == "base"
    assert mounting.transform.translation.z == pytest.approx(1.0)


def test_velodyne_and_ros_2_ray_plugins_publish_point_clouds(gazebo: Gazebo) -> None:
    ros = "<ros><namespace>/lidar</namespace><remapping>~/out:=cloud</remapping></ros>"
    sensors = _sensor("ray", _RAYS, "velodyne_laser", "<topicName>/velodyne</topicName><frameName>v</frameName>")
    sensors += _sensor("ray", _RAYS, "ray_sensor", f"{ros}<frame_name>f</frame_name>", name="second")
    _spawn_sensors(gazebo, sensors)
    for topic, frame in (("/velodyne", "v"), ("/lidar/cloud", "f")):
        cloud = _first_message(gazebo, topic, "sensor_msgs/PointCloud2")
        assert (cloud.header.frame_id, cloud.width) == (frame, 5)


def test_a_sonar_publishes_the_nearest_range(gazebo: Gazebo) -> None:
    parameters = "<topicName>sonar</topicName><frameName>sonar_link</frameName><fov>0.4</fov>"
    _spawn_sensors(gazebo, _sensor("ray", _RAYS, "range", f"{parameters}<radiation>infrared</radiation>"))
    message = _first_message(gazebo, "/sonar", "sensor_msgs/Range")

    assert message.range == pytest.approx(2.0, abs=1e-3)
    assert (message.radiation_type, message.header.frame_id) == (1, "sonar_link")
    assert message.field_of_view == pytest.approx(0.4)
    assert (message.min_range, message.max_range) == (pytest.approx(0.1), pytest.approx(10.0))


def test_a_camera_has_the_topics_frame_and_calibration_of_its_plugin(gazebo: Gazebo) -> None:
    parameters = """<robotNamespace>r</robotNamespace><cameraName>front</cameraName><frameName>camera_link</frameName>
<imageTopicName>image_raw</imageTopicName><hackBaseline>0.07</hackBaseline><distortionK1>0.01</distortionK1>
<CxPrime>9</CxPrime><Cy>9</Cy>"""
    _spawn_sensors(gazebo, _sensor("camera", _CAMERA, "camera", parameters))
    image = _first_message(gazebo, "/r/front/image_raw", "sensor_msgs/Image")
    info = _first_message(gazebo, "/r/front/camera_info", "sensor_msgs/CameraInfo")

    assert (image.width, image.height, image.encoding) == (32, 24, "rgb8")
    assert image.header.frame_id == info.header.frame_id == "camera_link"
    focal = 16 / math.tan(0.5)
    assert info.K[0] == pytest.approx(focal)
    assert (info.K[2], info.K[5], info.P[2], info.P[6]) == (16.5, 9.0, 16.5, 9.0)
    assert info.P[3] == pytest.approx(-0.07 * focal)
    assert list(info.D) == pytest.approx([0.01, 0, 0, 0, 0])


@pytest.mark.parametrize(("kind", "plugin"), [("camera", "camera"), ("depth", "openni_kinect")])
def test_set_camera_info_changes_what_a_camera_says_of_itself(gazebo: Gazebo, kind: str, plugin: str) -> None:
    """As camera_info_manager's in the originals; camera_calibration calls it at COMMIT."""
    parameters = "<cameraName>front</cameraName><frameName>camera_link</frameName>"
    parameters += "<cameraInfoTopicName>camera_info</cameraInfoTopicName>"
    _spawn_sensors(gazebo, _sensor(kind, _CAMERA, plugin, parameters))
    matrix = [20.0, 0.0, 15.0, 0.0, 21.0, 11.0, 0.0, 0.0, 1.0]
    info = {"width": 32, "height": 24, "distortion_model": "plumb_bob", "D": [0.1, 0, 0, 0, 0], "K": matrix}
    client = gazebo.client.call_service
    answer = gazebo.loop.run(client("/front/set_camera_info", "sensor_msgs/SetCameraInfo", {"camera_info": info}))

    assert answer.success
    messages = gazebo.subscribe("/front/camera_info", "sensor_msgs/CameraInfo")
    until(lambda: messages and list(messages[-1].K) == matrix)  # one that was on its way may come first
    assert list(messages[-1].D) == [0.1, 0, 0, 0, 0]
    assert messages[-1].header.frame_id == "camera_link"


@pytest.mark.parametrize(
    ("pixels", "format_", "channels"),
    [
        ("R8G8B8", "rgb8; jpeg compressed bgr8", (0, 1, 2)),
        ("B8G8R8", "bgr8; jpeg compressed bgr8", (2, 1, 0)),
        ("L8", "mono8; jpeg compressed ", (0,)),
    ],
)
def test_a_camera_publishes_compressed_images_as_image_transport(
    gazebo: Gazebo, pixels: str, format_: str, channels: tuple[int, ...]
) -> None:
    """They show what the raw ones do, within what JPEG loses."""
    camera = _CAMERA.replace("<image>", f"<image><format>{pixels}</format>")
    _spawn_sensors(gazebo, _sensor("camera", camera, "camera", "<cameraName>front</cameraName>"))
    compressed = _first_message(gazebo, "/front/image_raw/compressed", "sensor_msgs/CompressedImage")
    raw = _first_message(gazebo, "/front/image_raw", "sensor_msgs/Image")

    assert compressed.format == format_
    assert compressed.header.stamp.sec + compressed.header.stamp.nanosec > 0
    picture = np.asarray(Image.open(io.BytesIO(bytes(compressed.data)))).reshape(24, 32, -1)
    wanted = np.asarray(raw.data, np.uint8).reshape(24, 32, -1)[..., channels]
    assert np.abs(picture.astype(int) - wanted).mean() < 4.0


def test_deep_images_are_not_compressed(gazebo: Gazebo) -> None:
    """As image_transport, which compresses eight bits."""
    camera = _CAMERA.replace("<image>", "<image><format>L16</format>")
    _spawn_sensors(gazebo, _sensor("camera", camera, "camera", "<cameraName>front</cameraName>"))
    _first_message(gazebo, "/front/image_raw", "sensor_msgs/Image")

    topics = dict(gazebo.loop.run(gazebo.client.master.call("getTopicTypes")))
    assert "/front/image_raw/compressed" not in topics


@pytest.mark.parametrize(
    ("sensor", "trigger", "kind", "image_topic"),
    [
        (_CAMERA.replace("<camera>", "<camera><triggered>1</triggered>"), "/mast/head/eye/trigger", "Bool", None),
        (_CAMERA, "/front/image_trigger", "Empty", "/front/image_raw"),
    ],
    ids=["sdf", "plugin"],
)
def test_a_triggered_camera_waits_for_its_trigger(
    gazebo: Gazebo, sensor: str, trigger: str, kind: str, image_topic: str | None
) -> None:
    """One trigger gives one image, while an untriggered camera shows that cameras run."""
    if image_topic is None:
        eye = f'<sensor name="eye" type="camera"><update_rate>50</update_rate>{sensor}</sensor>'
    else:
        eye = _sensor("camera", sensor, "triggered_camera", "<cameraName>front</cameraName>")
    _spawn_sensors(gazebo, eye + f'<sensor name="other" type="camera"><update_rate>50</update_rate>{_CAMERA}</sensor>')
    trigger_publisher = gazebo.client.advertise(trigger, f"std_msgs/{kind}")
    messages = gazebo.subscribe(image_topic or "/mast/head/eye/image_raw", "sensor_msgs/Image")
    other_messages = gazebo.subscribe("/mast/head/other/image_raw", "sensor_msgs/Image")
    until(lambda: trigger_publisher.has_subscribers and len(other_messages) > 5)
    assert not messages
    trigger_publisher.publish({"data": True} if kind == "Bool" else {})
    until(lambda: messages)
    count = len(other_messages)
    until(lambda: len(other_messages) > count + 5)
    assert len(messages) == 1


def test_a_kinect_publishes_depths_and_points_within_its_cutoff(gazebo: Gazebo) -> None:
    parameters = (
        "<cameraName>kinect</cameraName><frameName>optical</frameName><pointCloudCutoffMax>2.05</pointCloudCutoffMax>"
    )
    _spawn_sensors(gazebo, _sensor("depth", _CAMERA, "openni_kinect", parameters))
    depths = _first_message(gazebo, "/kinect/depth/image_raw", "sensor_msgs/Image")
    cloud = _first_message(gazebo, "/kinect/points", "sensor_msgs/PointCloud2")

    assert (depths.encoding, depths.header.frame_id) == ("32FC1", "optical")
    values = memoryview(bytes(depths.data)).cast("f")
    assert values[12 * 32 + 16] == pytest.approx(2.0, abs=1e-3)
    assert math.isnan(values[0]) or values[0] <= 2.05
    assert (cloud.width, cloud.height) == (32, 24)


@pytest.mark.parametrize(("plugin", "has_depth"), [("depth_camera", True), ("openni_kinect", False)])
def test_only_a_kinect_has_a_maximum_depth_by_default(gazebo: Gazebo, plugin: str, has_depth: bool) -> None:
    """The wall is at 7 m; a Kinect's range is 5 m."""
    assert gazebo.spawn(_WALL.replace("2.5 0 1", "7.5 0 1"), "wall").success
    sensor = _sensor("depth", _CAMERA, plugin, "<cameraName>eye</cameraName><frameName>f</frameName>")
    assert gazebo.spawn(_mast(sensor), "mast").success
    gazebo.call("unpause_physics")
    depth = _first_message(gazebo, "/eye/depth/image_raw", "sensor_msgs/Image")

    middle = np.frombuffer(bytes(depth.data), "<f4").reshape(depth.height, depth.width)[12, 16]
    assert (middle == pytest.approx(7.0, abs=0.05)) if has_depth else np.isnan(middle)


def test_an_imu_measures_gravity_at_the_rate_of_its_plugin(gazebo: Gazebo) -> None:
    parameters = "<topicName>imu</topicName><frameName>imu_link</frameName><updateRateHZ>20</updateRateHZ>"
    parameters += "<gaussianNoise>0.01</gaussianNoise><xyzOffset>0 0 0</xyzOffset><rpyOffset>0 0 1</rpyOffset>"
    parameters += "<robotNamespace>/</robotNamespace>"
    _spawn_sensors(gazebo, _sensor("imu", "", "imu_sensor", parameters))
    messages = gazebo.subscribe("/imu", "sensor_msgs/Imu")
    until(lambda: len(messages) > 5)

    stamps = [m.header.stamp.sec + m.header.stamp.nanosec * 1e-9 for m in messages]
    assert min(b - a for a, b in pairwise(stamps[1:])) > 0.035  # the sensor has 50 Hz
    assert messages[-1].linear_acceleration.z == pytest.approx(9.8, abs=0.2)
    assert messages[-1].orientation_covariance[0] == pytest.approx(1e-4)
    assert messages[-1].header.frame_id == "imu_link"
    turn = messages[-1].orientation
    assert 2.0 * math.atan2(turn.z, turn.w) == pytest.approx(1.0, abs=0.1)
    assert not gazebo.report.warnings


def test_a_bumper_publishes_its_contacts(gazebo: Gazebo) -> None:
    contact = "<contact><collision>c</collision></contact>"
    bumper = _sensor("contact", contact, "bumper", "<bumperTopicName>bumps</bumperTopicName>")
    ball = f"""<sdf version="1.6"><model name="ball"><pose>0 0 0.1 0 0 0</pose><link name="l">
<inertial><mass>1</mass>{_INERTIA}</inertial><collision name="c"><geometry><sphere><radius>0.1</radius></sphere>
</geometry></collision>{bumper}</link></model></sdf>"""
    assert gazebo.spawn(ball, "ball").success
    gazebo.call("unpause_physics")
    messages = gazebo.subscribe("/bumps", "gazebo_msgs/ContactsState")
    until(lambda: any(message.states for message in messages))
    state = next(message for message in messages if message.states).states[0]
    assert "ball" in state.collision1_name
    assert "ground_plane" in state.collision2_name


def test_a_bumper_on_a_lumped_link_publishes_gazebos_collision_name(gazebo: Gazebo) -> None:
    """Two links are lumped into the massless root; both touch the ground."""

    def link(name: str, mass: str, size: str) -> str:
        inertia = '<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>'
        shape = f'<collision><geometry><box size="{size}"/></geometry></collision>'
        return f'<link name="{name}"><inertial><mass value="{mass}"/>{inertia}</inertial>{shape}</link>'

    def weld(parent: str, child: str, xyz: str) -> str:
        ends = f'<parent link="{parent}"/><child link="{child}"/><origin xyz="{xyz}"/>'
        return f'<joint name="{child}_joint" type="fixed">{ends}</joint>'

    contact = "<contact><collision>root_fixed_joint_lump__bumper_collision_1</collision></contact>"
    robot = f"""<robot name="plover"><link name="root"/>
{link("hull", "3", "0.4 0.4 0.2")}{weld("root", "hull", "0 0 0.1")}
{link("bumper", "0.2", "0.05 0.4 0.1")}{weld("hull", "bumper", "0.25 0 -0.05")}<gazebo reference="bumper">
{_sensor("contact", contact, "bumper", "<bumperTopicName>bumps</bumperTopicName>")}</gazebo></robot>"""
    response = gazebo.spawn(robot, "plover")
    assert response.success, response.status_message
    gazebo.call("unpause_physics")
    messages = gazebo.subscribe("/bumps", "gazebo_msgs/ContactsState")
    until(lambda: any(message.states for message in messages))

    names = {state.collision1_name for message in messages for state in message.states}
    assert names == {"plover::root::root_fixed_joint_lump__bumper_collision_1"}
    assert not gazebo.report.warnings


def test_a_force_torque_plugin_measures_the_load_of_a_joint(gazebo: Gazebo) -> None:
    """The head of 2 kg loads the joint with 19.6 N."""
    parameters = "<jointName>fix</jointName><topicName>ft</topicName>"
    plugin = f'<plugin name="ft" filename="libgazebo_ros_ft_sensor.so">{parameters}</plugin>'
    _spawn_sensors(gazebo, "", plugin)
    message = _first_message(gazebo, "/ft", "geometry_msgs/WrenchStamped")
    assert message.wrench.force.z == pytest.approx(-19.6, rel=1e-3)
    assert message.header.frame_id == "head"


def test_sensors_survive_a_spawn_and_unknown_plugins_are_reported(gazebo: Gazebo) -> None:
    sensors = _sensor("ray", _RAYS, "laser", "<topicName>scan</topicName>")
    sensors += _sensor("ray", _RAYS, "sparkle", "", name="other")
    sensors += _sensor("imu", "", "laser", "", name="wrong")
    _spawn_sensors(gazebo, sensors)
    messages = gazebo.subscribe("/scan", "sensor_msgs/LaserScan")
    until(lambda: messages)
    gazebo.spawn(_WALL.replace("2.5 0 1", "1.5 0 1"), "nearer")
    until(lambda: messages[-1].ranges[2] == pytest.approx(1.0, abs=1e-3))

    warnings = "\n".join(gazebo.report.warnings)
    assert "plugin libgazebo_ros_sparkle.so is not supported yet; the sensor has topics without" in warnings
    assert "sensor 'wrong' is of type imu; a ray sensor is needed" in warnings
