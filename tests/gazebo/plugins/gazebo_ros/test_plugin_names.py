"""Topics and frames of each plugin of gazebo_ros with a missing, empty and set <robotNamespace>.

The expected values are those of the sources: gazebo_plugins (branches indigo-devel to noetic-devel),
hector_gazebo_plugins and velodyne_gazebo_plugins; docs/decisions/0014 lists the differences.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.plugin_world import ARM, BODY, FakeNode, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.ros import DISTROS
from trundle.sim.sensors import mount_sensors

ROOT, MODEL = "", "m"
BALL = '<collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
RAY = """<ray><scan><horizontal><samples>3</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>
</scan><range><min>0.1</min><max>9</max></range></ray>"""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One plugin with its parameters, and the names expected of it."""

    file: str
    tags: str = ""
    topics: str = ""
    """Topics and services in its namespace."""
    absolute: str = ""
    """Topics outside of its namespace."""
    frames: str = ""
    """Frames with the prefix."""
    plain: str = ""
    """Frames without a prefix."""
    missing: str = ROOT
    """Namespace if <robotNamespace> is missing."""
    empty: str = ROOT
    """Namespace if it is empty."""
    prefix: str = "tf_prefix"
    """Rule for the prefix of frames; see `NameRule.prefix`."""
    sensor: str = ""
    """Type of the sensor with the plugin; empty: a model plugin."""


def _model_row(file: str, tags: str, topics: str, frames: str = "", **fields: str) -> Row:
    return Row(file=f"libgazebo_ros_{file}.so", tags=tags, topics=topics, frames=frames, **fields)


def _sensor_row(file: str, sensor: str, topics: str, **fields: str) -> Row:
    return Row(file=f"libgazebo_ros_{file}.so", sensor=sensor, topics=topics, **fields)


GAZEBO_ROS: dict[str, str] = {"missing": MODEL, "empty": MODEL, "prefix": "else_namespace"}
WHEELS = "<leftJoint>hinge</leftJoint><rightJoint>hinge</rightJoint>"
EXTRAS = "<publishWheelJointState>true</publishWheelJointState><publishWheelTF>true</publishWheelTF>"
FOUR = "".join(f"<{name}Joint>hinge</{name}Joint>" for name in ("leftFront", "leftRear", "rightFront", "rightRear"))
THREE = "".join(
    f"<{name}>hinge</{name}>"
    for name in ("steeringJoint", "actuatedWheelJoint", "encoderWheelLeftJoint", "encoderWheelRightJoint")
)
ON_ARM = "<bodyName>arm</bodyName>"
HECTOR = "libhector_gazebo_ros_"
DRIVEN = "cmd_vel odom"
SCANS: dict[str, str] = {"empty": MODEL, "prefix": "else_namespace"}

ROWS = [
    _model_row("diff_drive", WHEELS + EXTRAS, f"{DRIVEN} joint_states", "odom base_footprint base arm", **GAZEBO_ROS),
    _model_row("tricycle_drive", THREE + EXTRAS, f"{DRIVEN} joint_states", "odom base_link base hinge", **GAZEBO_ROS),
    _model_row("joint_state_publisher", "", "joint_states", **GAZEBO_ROS),
    _model_row("skid_steer_drive", f"{FOUR}<broadcastTF>true</broadcastTF>", DRIVEN, "odom base_footprint"),
    _model_row("planar_move", "", DRIVEN, "odom base_footprint"),
    _model_row("force_based_move", "<robotBaseFrame>arm</robotBaseFrame>", DRIVEN, "odom arm"),
    _model_row("imu", ON_ARM, "", "arm", absolute="/default_imu"),
    _model_row("imu", f"{ON_ARM}<topicName>imu</topicName><serviceName>tare</serviceName>", "imu tare", "arm"),
    _model_row("p3d", f"{ON_ARM}<topicName>truth</topicName>", "truth", "world arm"),
    _model_row("p3d", f"{ON_ARM}<topicName>truth</topicName><frameName>/map</frameName>", "truth", "arm", plain="map"),
    _model_row("f3d", f"{ON_ARM}<topicName>felt</topicName>", "felt", "world"),
    _model_row("force", f"{ON_ARM}<topicName>push</topicName>", "push"),
    _model_row("ft_sensor", "<jointName>hinge</jointName><topicName>ft</topicName>", "ft", "arm"),
    _model_row("joint_pose_trajectory", "", "set_joint_trajectory"),
    _model_row("vacuum_gripper", f"{ON_ARM}<topicName>grasps</topicName>", "grasps on off"),
    Row(file=f"{HECTOR}imu.so", tags=ON_ARM, topics="imu imu/calibrate", frames="arm"),
    Row(file=f"{HECTOR}gps.so", tags=ON_ARM, topics="fix fix_velocity", plain="world"),
    Row(file=f"{HECTOR}magnetic.so", tags=ON_ARM, topics="magnetic", frames="arm"),
    Row(file=f"{HECTOR}baro.so", tags=ON_ARM, topics="pressure_height altimeter", frames="arm"),
    Row(file=f"{HECTOR}sonar.so", sensor="ray", topics="sonar", plain="sonar_link"),
    Row(file=f"{HECTOR}sonar.so", sensor="ray", tags="<frameId>s</frameId>", topics="sonar", frames="s"),
    _sensor_row("laser", "ray", "scan", absolute="/world", plain="world", **SCANS),
    _sensor_row("laser", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f", **SCANS),
    _sensor_row("gpu_laser", "gpu_ray", "s", tags="<topicName>s</topicName>", plain="world", **SCANS),
    _sensor_row("block_laser", "ray", "points", absolute="/world", plain="world"),
    _sensor_row("block_laser", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f"),
    _sensor_row("velodyne_laser", "ray", "", absolute="/points", plain="world", prefix="namespace"),
    _sensor_row(
        "velodyne_laser",
        "ray",
        "s",
        tags="<topicName>s</topicName><frameName>f</frameName>",
        frames="f",
        prefix="namespace",
    ),
    _sensor_row("range", "ray", "", absolute="/range", plain="world"),
    _sensor_row("range", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f"),
    _sensor_row("imu_sensor", "imu", "imu_data", tags="<updateRateHZ>50</updateRateHZ>", frames="arm", missing=MODEL),
    _sensor_row("bumper", "contact", "bumper_states", frames="world"),
    _sensor_row(
        "bumper", "contact", "b", tags="<bumperTopicName>b</bumperTopicName><frameName>f</frameName>", frames="f"
    ),
]


def _run_plugin(folder: Path, row: Row, namespace: str, node: Any) -> None:
    """Load the row's plugin in a world and run it until it has published."""
    plugin = f'<plugin name="p" filename="{row.file}">{row.tags}{namespace}</plugin>'
    inside = {"contact": "<contact><collision>ball</collision></contact>", "imu": ""}.get(row.sensor, RAY)
    start = f'<sensor name="s" type="{row.sensor}"><update_rate>50</update_rate>'
    sensor = f"{start}{inside}{plugin}</sensor>" if row.sensor else ""
    body = ARM.replace('<link name="arm">', f'<link name="arm">{BALL}{sensor}') + ("" if row.sensor else plugin)
    sim = load(folder, body, node=node)
    sensors = mount_sensors(sim)
    attach_sensor_plugins(sensors, node, sim)
    for sensor in sensors:
        sensor.start(sim)
    sim.run(0.26)
    assert sim.report.warnings == []


def _published_names(node: FakeNode) -> tuple[set[str], set[str]]:
    """Return all topics and services, and all published frames."""
    frames: set[str] = set()
    for topic, messages in node.published.items():
        headers = [message for message in messages if topic != "/tf"]
        headers += [transform for message in messages if topic == "/tf" for transform in message.transforms]
        for message in headers:
            frames |= {message.header.frame_id} if hasattr(message, "header") else set[str]()
            frames |= {message.child_frame_id} if hasattr(message, "child_frame_id") else set[str]()
    return ({*node.published, *node.subscribers, *node.services} - {"/tf"}), frames - {""}


@pytest.mark.parametrize("tag_text", ["missing", "", "/", "/r/"])
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.file}{row.tags[:24]}")
def test_topics_and_frames_are_the_originals(tmp_path: Path, row: Row, tag_text: str) -> None:
    """One robot, with the parameter tf_prefix in its namespace."""
    node = FakeNode({"/r/tf_prefix": "/p", "/m/tf_prefix": "q"})
    tag = "" if tag_text == "missing" else f"<robotNamespace>{tag_text}</robotNamespace>"
    _run_plugin(tmp_path, row, tag, node)

    namespace = {"missing": row.missing, "": row.empty}.get(tag_text, tag_text.strip("/"))
    namespaces = [namespace, ROOT] if tag_text == "missing" else [namespace]
    expected = {f"/{prefix_}/{topic}".replace("//", "/") for prefix_ in namespaces for topic in row.topics.split()}
    prefix = {"r": "p/", "m": "q/", "": ""}[namespace]
    if row.prefix == "namespace" and namespace:
        prefix = f"{namespace}/"
    topics, frames = _published_names(node)
    assert topics == expected | set(row.absolute.split())
    assert frames == {f"{prefix}{name}" for name in row.frames.split()} | set(row.plain.split())


@pytest.mark.parametrize(
    ("row", "distro"),
    [
        pytest.param(row, distro, id=f"{row.file}{row.tags[:24]}-{distro}")
        for row in ROWS
        for distro in (DISTROS if row.prefix == "else_namespace" else ["melodic"])
        if row.frames
    ],
)
def test_without_tf_prefix_the_namespace_is_the_prefix_up_to_melodic(tmp_path: Path, row: Row, distro: str) -> None:
    node = FakeNode(profile=DISTROS[distro])
    _run_plugin(tmp_path, row, "<robotNamespace>r</robotNamespace>", node)

    has_prefix = row.prefix == "namespace" or (row.prefix == "else_namespace" and distro != "noetic")
    frames = _published_names(node)[1]
    assert frames == {f"{'r/' if has_prefix else ''}{name}" for name in row.frames.split()} | set(row.plain.split())


def test_tf_prefix_is_inherited_and_absolute_frames_have_none(tmp_path: Path) -> None:
    node = FakeNode({"/a/tf_prefix": "near", "/tf_prefix": "far"})
    tags = f"{WHEELS}<odometryFrame>/map</odometryFrame>"
    row = _model_row("diff_drive", tags, "")

    _run_plugin(tmp_path, row, "<robotNamespace>a/b</robotNamespace>", node)

    assert _published_names(node)[1] == {"map", "near/base_footprint"}


def _drive(file: str, tags: str = "") -> str:
    return f'<plugin name="p" filename="libgazebo_ros_{file}.so">{WHEELS}{FOUR}{tags}</plugin>'


def _other(plugin: str) -> str:
    return f'<model name="n"><pose>5 0 0 0 0 0</pose>{ARM}{plugin}</model>'


def test_two_robots_have_no_topics_at_the_root(tmp_path: Path) -> None:
    node: Any = FakeNode()

    sim = load(tmp_path, ARM + _drive("diff_drive"), other_models=_other(_drive("diff_drive")), node=node)

    assert sorted(node.subscribers) == ["/m/cmd_vel", "/n/cmd_vel"]
    assert {"/m/odom", "/n/odom"} <= {*node.published}
    assert "/odom" not in node.published
    (warning,) = (line.partition("warning: ")[2] for line in sim.report.warnings if "'m'" in line)
    assert warning == (
        "this model and 'm' both send odom -> base_footprint; a parameter tf_prefix in each namespace separates them"
    )


@pytest.mark.parametrize("other", ["skid_steer_drive", "planar_move"])
def test_a_drive_leaves_the_root_topic_to_a_drive_that_subscribes_there(tmp_path: Path, other: str) -> None:
    node: Any = FakeNode()

    load(tmp_path, ARM + _drive("diff_drive"), other_models=_other(_drive(other)), node=node)

    assert {topic: len(calls) for topic, calls in node.subscribers.items()} == {"/m/cmd_vel": 1, "/cmd_vel": 1}


def test_two_robots_on_one_command_topic_are_reported(tmp_path: Path) -> None:
    """As in the original, the command moves both."""
    node: Any = FakeNode()
    fields = "<odometryFrame>{0}</odometryFrame>"

    sim = load(
        tmp_path,
        ARM + _drive("skid_steer_drive", fields.format("a")),
        other_models=_other(_drive("planar_move", fields.format("b"))),
        node=node,
    )

    assert [line.partition("warning: ")[2] for line in sim.report.warnings if "one command" in line] == [
        "one command on /cmd_vel moves this model and 'm'; with a <robotNamespace> each has its own topic"
    ]
    assert not [line for line in sim.report.warnings if "both send" in line]


def test_a_camera_of_a_static_model_leaves_the_root_to_the_robot(tmp_path: Path) -> None:
    node: Any = FakeNode()
    camera = f"""<link name="post">{BODY.format(1)}<sensor name="s" type="camera"><camera/>
<plugin name="p" filename="libgazebo_ros_camera.so"/></sensor></link>"""

    load(tmp_path, ARM + _drive("diff_drive"), other_models=f'<model name="n">{camera}</model>', node=node)

    assert sorted(node.subscribers) == ["/cmd_vel", "/m/cmd_vel"]
