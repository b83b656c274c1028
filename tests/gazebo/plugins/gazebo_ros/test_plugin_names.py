"""Topics and frames of each plugin of gazebo_ros where <robotNamespace> is missing, empty and present.

The expected values are those of the sources: gazebo_plugins (branches indigo-devel to noetic-devel),
hector_gazebo_plugins and velodyne_gazebo_plugins; docs/decisions/0014 has what differs.
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from tests.gazebo.plugins.stage import ARM, BODY, Wires, load

from trundle.gazebo.model_plugins import attach_sensor_plugins
from trundle.ros import DISTROS
from trundle.sim.sensors import mount_sensors

ROOT, MODEL = "", "m"
BALL = '<collision name="ball"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>'
RAY = """<ray><scan><horizontal><samples>3</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal>
</scan><range><min>0.1</min><max>9</max></range></ray>"""


@dataclass(frozen=True, kw_only=True)
class Row:
    """One plugin, with the tags that it needs."""

    file: str
    tags: str = ""
    topics: str = ""
    """Topics and services in its namespace."""
    absolute: str = ""
    """Topics outside of it."""
    frames: str = ""
    """Frames that get a prefix."""
    plain: str = ""
    """Frames that never do."""
    missing: str = ROOT
    """Namespace if <robotNamespace> is missing."""
    empty: str = ROOT
    """Namespace if it is empty."""
    prefix: str = "tf_prefix"
    """What precedes a frame: the parameter; or without it, up to Melodic, the namespace; or always the namespace."""
    sensor: str = ""
    """Type of the sensor that has the plugin."""


def _of_model(file: str, tags: str, topics: str, frames: str = "", **more: str) -> Row:
    return Row(file=f"libgazebo_ros_{file}.so", tags=tags, topics=topics, frames=frames, **more)


def _of_sensor(file: str, sensor: str, topics: str, **more: str) -> Row:
    return Row(file=f"libgazebo_ros_{file}.so", sensor=sensor, topics=topics, **more)


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
    _of_model("diff_drive", WHEELS + EXTRAS, f"{DRIVEN} joint_states", "odom base_footprint base arm", **GAZEBO_ROS),
    _of_model("tricycle_drive", THREE + EXTRAS, f"{DRIVEN} joint_states", "odom base_link base hinge", **GAZEBO_ROS),
    _of_model("joint_state_publisher", "", "joint_states", **GAZEBO_ROS),
    _of_model("skid_steer_drive", f"{FOUR}<broadcastTF>true</broadcastTF>", DRIVEN, "odom base_footprint"),
    _of_model("planar_move", "", DRIVEN, "odom base_footprint"),
    _of_model("force_based_move", "<robotBaseFrame>arm</robotBaseFrame>", DRIVEN, "odom arm"),
    _of_model("imu", ON_ARM, "", "arm", absolute="/default_imu"),
    _of_model("imu", f"{ON_ARM}<topicName>imu</topicName><serviceName>tare</serviceName>", "imu tare", "arm"),
    _of_model("p3d", f"{ON_ARM}<topicName>truth</topicName>", "truth", "world arm"),
    _of_model("p3d", f"{ON_ARM}<topicName>truth</topicName><frameName>/map</frameName>", "truth", "arm", plain="map"),
    _of_model("f3d", f"{ON_ARM}<topicName>felt</topicName>", "felt", "world"),
    _of_model("force", f"{ON_ARM}<topicName>push</topicName>", "push"),
    _of_model("ft_sensor", "<jointName>hinge</jointName><topicName>ft</topicName>", "ft", "arm"),
    _of_model("joint_pose_trajectory", "", "set_joint_trajectory"),
    _of_model("vacuum_gripper", f"{ON_ARM}<topicName>grasps</topicName>", "grasps on off"),
    Row(file=f"{HECTOR}imu.so", tags=ON_ARM, topics="imu imu/calibrate", frames="arm"),
    Row(file=f"{HECTOR}gps.so", tags=ON_ARM, topics="fix fix_velocity", plain="world"),
    Row(file=f"{HECTOR}magnetic.so", tags=ON_ARM, topics="magnetic", frames="arm"),
    Row(file=f"{HECTOR}baro.so", tags=ON_ARM, topics="pressure_height altimeter", frames="arm"),
    Row(file=f"{HECTOR}sonar.so", sensor="ray", topics="sonar", plain="sonar_link"),
    Row(file=f"{HECTOR}sonar.so", sensor="ray", tags="<frameId>s</frameId>", topics="sonar", frames="s"),
    _of_sensor("laser", "ray", "scan", absolute="/world", plain="world", **SCANS),
    _of_sensor("laser", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f", **SCANS),
    _of_sensor("gpu_laser", "gpu_ray", "s", tags="<topicName>s</topicName>", plain="world", **SCANS),
    _of_sensor("block_laser", "ray", "points", absolute="/world", plain="world"),
    _of_sensor("block_laser", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f"),
    _of_sensor("velodyne_laser", "ray", "", absolute="/points", plain="world", prefix="namespace"),
    _of_sensor(
        "velodyne_laser",
        "ray",
        "s",
        tags="<topicName>s</topicName><frameName>f</frameName>",
        frames="f",
        prefix="namespace",
    ),
    _of_sensor("range", "ray", "", absolute="/range", plain="world"),
    _of_sensor("range", "ray", "s", tags="<topicName>s</topicName><frameName>f</frameName>", frames="f"),
    _of_sensor("imu_sensor", "imu", "imu_data", tags="<updateRateHZ>50</updateRateHZ>", frames="arm", missing=MODEL),
    _of_sensor("bumper", "contact", "bumper_states", frames="world"),
    _of_sensor(
        "bumper", "contact", "b", tags="<bumperTopicName>b</bumperTopicName><frameName>f</frameName>", frames="f"
    ),
]


def _play(folder: Path, row: Row, namespace: str, wires: Wires) -> None:
    """Load the row's plugin in a world and run it until each has published."""
    plugin = f'<plugin name="p" filename="{row.file}">{row.tags}{namespace}</plugin>'
    inside = {"contact": "<contact><collision>ball</collision></contact>", "imu": ""}.get(row.sensor, RAY)
    start = f'<sensor name="s" type="{row.sensor}"><update_rate>50</update_rate>'
    sensor = f"{start}{inside}{plugin}</sensor>" if row.sensor else ""
    body = ARM.replace('<link name="arm">', f'<link name="arm">{BALL}{sensor}') + ("" if row.sensor else plugin)
    node: Any = wires
    sim = load(folder, body, wires=node)
    sensors = mount_sensors(sim)
    attach_sensor_plugins(sensors, node, sim)
    for each in sensors:
        each.start(sim)
    sim.run(0.26)
    assert sim.report.warnings == []


def _names(wires: Wires) -> tuple[set[str], set[str]]:
    """All topics and services, and all frames that were published."""
    frames: set[str] = set()
    for topic, messages in wires.said.items():
        headers = [message for message in messages if topic != "/tf"]
        headers += [transform for message in messages if topic == "/tf" for transform in message.transforms]
        for message in headers:
            frames |= {message.header.frame_id} if hasattr(message, "header") else set[str]()
            frames |= {message.child_frame_id} if hasattr(message, "child_frame_id") else set[str]()
    return ({*wires.said, *wires.heard_by, *wires.services} - {"/tf"}), frames - {""}


@pytest.mark.parametrize("written", ["missing", "", "/", "/r/"])
@pytest.mark.parametrize("row", ROWS, ids=lambda row: f"{row.file}{row.tags[:24]}")
def test_topics_and_frames_are_the_originals(tmp_path: Path, row: Row, written: str) -> None:
    """One robot, with the parameter tf_prefix of its namespace, as spawn_model's <group ns> gives it."""
    wires = Wires({"/r/tf_prefix": "/p", "/m/tf_prefix": "q"})
    tag = "" if written == "missing" else f"<robotNamespace>{written}</robotNamespace>"
    _play(tmp_path, row, tag, wires)

    namespace = {"missing": row.missing, "": row.empty}.get(written, written.strip("/"))
    places = [namespace, ROOT] if written == "missing" else [namespace]
    expected = {f"/{place}/{topic}".replace("//", "/") for place in places for topic in row.topics.split()}
    prefix = {"r": "p/", "m": "q/", "": ""}[namespace]
    if row.prefix == "namespace" and namespace:
        prefix = f"{namespace}/"
    topics, frames = _names(wires)
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
def test_without_tf_prefix_the_namespace_takes_its_place_up_to_melodic(tmp_path: Path, row: Row, distro: str) -> None:
    wires = Wires(profile=DISTROS[distro])
    _play(tmp_path, row, "<robotNamespace>r</robotNamespace>", wires)

    in_place = row.prefix == "namespace" or (row.prefix == "else_namespace" and distro != "noetic")
    frames = _names(wires)[1]
    assert frames == {f"{'r/' if in_place else ''}{name}" for name in row.frames.split()} | set(row.plain.split())


def test_tf_prefix_is_looked_for_upwards_and_an_absolute_frame_has_none(tmp_path: Path) -> None:
    wires = Wires({"/a/tf_prefix": "near", "/tf_prefix": "far"})
    tags = f"{WHEELS}<odometryFrame>/map</odometryFrame>"
    row = _of_model("diff_drive", tags, "")

    _play(tmp_path, row, "<robotNamespace>a/b</robotNamespace>", wires)

    assert _names(wires)[1] == {"map", "near/base_footprint"}


def _drive(file: str, tags: str = "") -> str:
    return f'<plugin name="p" filename="libgazebo_ros_{file}.so">{WHEELS}{FOUR}{tags}</plugin>'


def _other(plugin: str) -> str:
    return f'<model name="n"><pose>5 0 0 0 0 0</pose>{ARM}{plugin}</model>'


def test_with_a_second_robot_neither_has_topics_at_the_root(tmp_path: Path) -> None:
    wires: Any = Wires()

    sim = load(tmp_path, ARM + _drive("diff_drive"), others=_other(_drive("diff_drive")), wires=wires)

    assert sorted(wires.heard_by) == ["/m/cmd_vel", "/n/cmd_vel"]
    assert {"/m/odom", "/n/odom"} <= {*wires.said}
    assert "/odom" not in wires.said
    (warning,) = (line.partition("warning: ")[2] for line in sim.report.warnings if "'m'" in line)
    assert warning == (
        "this model and 'm' both send odom -> base_footprint; a parameter tf_prefix in the namespace of each keeps "
        "them apart"
    )


@pytest.mark.parametrize("other", ["skid_steer_drive", "planar_move"])
def test_a_lone_drive_gives_the_root_up_to_one_that_listens_there(tmp_path: Path, other: str) -> None:
    wires: Any = Wires()

    load(tmp_path, ARM + _drive("diff_drive"), others=_other(_drive(other)), wires=wires)

    assert {topic: len(calls) for topic, calls in wires.heard_by.items()} == {"/m/cmd_vel": 1, "/cmd_vel": 1}


def test_two_robots_on_one_command_topic_are_named(tmp_path: Path) -> None:
    """As in the original both obey it."""
    wires: Any = Wires()
    fields = "<odometryFrame>{0}</odometryFrame>"

    sim = load(
        tmp_path,
        ARM + _drive("skid_steer_drive", fields.format("a")),
        others=_other(_drive("planar_move", fields.format("b"))),
        wires=wires,
    )

    assert [line.partition("warning: ")[2] for line in sim.report.warnings if "one command" in line] == [
        "one command on /cmd_vel moves this model and 'm'; with a <robotNamespace> each has its own topic"
    ]
    assert not [line for line in sim.report.warnings if "both send" in line]


def test_scenery_with_a_camera_leaves_the_root_to_the_robot(tmp_path: Path) -> None:
    wires: Any = Wires()
    camera = f"""<link name="post">{BODY.format(1)}<sensor name="s" type="camera"><camera/>
<plugin name="p" filename="libgazebo_ros_camera.so"/></sensor></link>"""

    load(tmp_path, ARM + _drive("diff_drive"), others=f'<model name="n">{camera}</model>', wires=wires)

    assert sorted(wires.heard_by) == ["/cmd_vel", "/m/cmd_vel"]
