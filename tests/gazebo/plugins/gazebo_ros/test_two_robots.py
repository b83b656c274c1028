"""Two robots of one URDF in two namespaces: separate topics, frames and commands."""

import math
from typing import Any

import pytest
from tests.gazebo_server import Gazebo, until

_INERTIA = '<inertia ixx="0.05" ixy="0" ixz="0" iyy="0.05" iyz="0" izz="0.05"/>'
_TURNED = math.pi / 2


def _wheel(name: str, y: float) -> str:
    link = f"""<link name="{name}"><inertial><mass value="1"/>{_INERTIA}</inertial>
<collision><geometry><sphere radius="0.1"/></geometry></collision></link>"""
    ends = f'<parent link="base_link"/><child link="{name}"/><origin xyz="0 {y} 0"/><axis xyz="0 1 0"/>'
    return f'{link}<joint name="{name}_joint" type="continuous">{ends}</joint>'


def _sensor(kind: str, inside: str, plugin: str, tags: str) -> str:
    return f"""<sensor type="{kind}" name="{kind}"><update_rate>20</update_rate>{inside}
<plugin name="{kind}_plugin" filename="libgazebo_ros_{plugin}.so">{tags}</plugin></sensor>"""


_SCAN = """<ray><scan><horizontal><samples>3</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>
</scan><range><min>.2</min><max>5</max></range></ray>"""
_CAMERA = "<camera><image><width>16</width><height>12</height></image></camera>"
_SENSORS = (
    _sensor("ray", _SCAN, "laser", "<topicName>scan</topicName><frameName>scan_link</frameName>")
    + _sensor("camera", _CAMERA, "camera", "<cameraName>cam</cameraName><frameName>cam_link</frameName>")
    + _sensor("imu", "", "imu_sensor", "<topicName>imu</topicName><frameName>imu_link</frameName>")
)
_FOOT = '<collision><origin xyz="{} 0 -.05"/><geometry><sphere radius=".05"/></geometry></collision>'
_ROBOT = f"""<robot name="bot"><link name="base_link"><inertial><mass value="3"/>{_INERTIA}</inertial>
{_FOOT.format(-0.2)}{_FOOT.format(0.2)}</link>{_wheel("left", 0.2)}{_wheel("right", -0.2)}
<gazebo reference="base_link"><mu1>0</mu1><mu2>0</mu2>{_SENSORS}</gazebo>
<gazebo><plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>left_joint</leftJoint>
<rightJoint>right_joint</rightJoint><wheelSeparation>.4</wheelSeparation><wheelDiameter>.2</wheelDiameter>
<robotBaseFrame>base_link</robotBaseFrame></plugin></gazebo></robot>"""


def _spawn_both(gazebo: Gazebo) -> None:
    for number, name in enumerate(("alpha", "beta"), 1):
        pose = {"position": {"y": 3.0 * number, "z": 0.1}}
        response = gazebo.call(
            "spawn_urdf_model",
            "gazebo_msgs/SpawnModel",
            model_name=name,
            model_xml=_ROBOT,
            robot_namespace=f"/r{number}/",
            initial_pose=pose,
        )
        assert response.success, response.status_message
    gazebo.call("unpause_physics")


def _frames(gazebo: Gazebo) -> tuple[set[tuple[str, str]], dict[str, str]]:
    """Return the edges on /tf, and the header's frame of each topic."""
    messages: dict[str, list[Any]] = {"tf": gazebo.subscribe("/tf", "tf2_msgs/TFMessage")}
    kinds = {"odom": "nav_msgs/Odometry", "scan": "sensor_msgs/LaserScan", "imu": "sensor_msgs/Imu"}
    kinds["cam/camera_info"] = "sensor_msgs/CameraInfo"
    for number in (1, 2):
        messages |= {f"/r{number}/{name}": gazebo.subscribe(f"/r{number}/{name}", kind) for name, kind in kinds.items()}
    until(lambda: all(messages.values()) and len(messages["tf"]) > 10)
    edges = {
        (transform.header.frame_id, transform.child_frame_id)
        for message in messages.pop("tf")
        for transform in message.transforms
    }
    return edges, {topic: received[-1].header.frame_id for topic, received in messages.items()}


@pytest.mark.parametrize(
    ("distro", "params", "prefixes"),
    [
        ("noetic", {"/r1/tf_prefix": "r1_tf", "/r2/tf_prefix": "r2_tf"}, ("r1_tf/", "r2_tf/")),
        ("melodic", {"/r1/tf_prefix": "r1_tf"}, ("r1_tf/", "r2/")),
        ("noetic", {}, ("", "")),
    ],
)
def test_frames_have_the_tf_prefix_of_their_namespace(
    bare_gazebo: Gazebo, distro: str, params: dict[str, str], prefixes: tuple[str, str]
) -> None:
    """The imu's frame has only the parameter's prefix, as in the original."""
    gazebo = bare_gazebo
    gazebo.start(distro)
    for name, value in params.items():
        gazebo.loop.run(gazebo.client.params.set(name, value))

    _spawn_both(gazebo)
    edges, headers = _frames(gazebo)

    assert edges == {(f"{prefix}odom", f"{prefix}base_link") for prefix in prefixes}
    for number, prefix in enumerate(prefixes, 1):
        assert headers[f"/r{number}/odom"] == f"{prefix}odom"
        assert headers[f"/r{number}/scan"] == f"{prefix}scan_link"
        assert headers[f"/r{number}/cam/camera_info"] == f"{prefix}cam_link"
        imu_prefix = f"r{number}_tf/" if f"/r{number}/tf_prefix" in params else ""
        assert headers[f"/r{number}/imu"] == f"{imu_prefix}imu_link"
    warnings = [line for line in gazebo.report.warnings if "both send odom -> base_link; a parameter tf_prefix" in line]
    assert len(warnings) == (0 if params else 1)


def test_a_command_moves_only_the_robot_of_its_namespace(gazebo: Gazebo) -> None:
    _spawn_both(gazebo)
    first, second = gazebo.subscribe("/r1/odom", "nav_msgs/Odometry"), gazebo.subscribe("/r2/odom", "nav_msgs/Odometry")
    start = gazebo.state("beta").pose.position.x

    gazebo.advertise("/r1/cmd_vel", "geometry_msgs/Twist")({"linear": {"x": 0.5}})
    until(lambda: first and first[-1].pose.pose.position.x > 0.3 and second)

    assert gazebo.state("beta").pose.position.x == pytest.approx(start, abs=0.01)


@pytest.mark.parametrize(
    ("distro", "tag", "yaw"),
    [
        ("noetic", "", _TURNED),
        ("noetic", "true", 0.0),
        ("melodic", "", 0.0),
        ("melodic", "false", _TURNED),
        ("kinetic", "true", 0.0),
    ],
)
def test_the_imu_reference_is_the_world_from_noetic_on(bare_gazebo: Gazebo, distro: str, tag: str, yaw: float) -> None:
    """As in REP 145; earlier, the reference is the first pose."""
    gazebo = bare_gazebo
    gazebo.start(distro)
    reference = f"<initialOrientationAsReference>{tag}</initialOrientationAsReference>" if tag else ""
    tags = f"<updateRateHZ>0</updateRateHZ><frameName>i</frameName>{reference}"
    model = f"""<sdf version="1.6"><model name="post"><pose>0 0 1 0 0 {_TURNED}</pose><static>1</static>
<link name="l">{_sensor("imu", "<always_on>1</always_on>", "imu_sensor", tags)}</link></model></sdf>"""

    assert gazebo.spawn(model, "post").success
    gazebo.call("unpause_physics")
    messages = gazebo.subscribe("/post/imu_data", "sensor_msgs/Imu")
    until(lambda: messages)

    orientation = messages[-1].orientation
    assert 2.0 * math.atan2(orientation.z, orientation.w) == pytest.approx(yaw, abs=1e-3)
    assert gazebo.report.warnings == []
