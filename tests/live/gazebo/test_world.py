"""World behind /gazebo: models spawned, wrenches applied, pauses and resets by services."""

import asyncio
from itertools import pairwise
from pathlib import Path

import pytest
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes.gazebo import GazeboServer, SpawnModel
from trundle.ros import Message, Node, to_nsec

_BALL = """<sdf version="1.6"><model name="as_written"><pose>0 0 1 0 0 0</pose><link name="link">
<inertial><mass>2</mass><inertia><ixx>0.02</ixx><iyy>0.02</iyy><izz>0.02</izz></inertia></inertial>
<collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>"""
_INERTIAL = """<inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>"""
_ARM = f"""<robot name="arm"><link name="world"/>
<link name="base">{_INERTIAL}</link>
<link name="rod">{_INERTIAL}</link>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/></joint>
<joint name="turn" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 0 1"/>
<limit lower="-2" upper="2" effort="10" velocity="1"/></joint></robot>"""


def test_a_spawned_model_is_at_its_pose_and_falls_when_unpaused(gazebo: Gazebo) -> None:
    assert gazebo.spawn(_BALL, "ball", x=3.0).success

    pose = gazebo.state("ball").pose
    assert (pose.position.x, pose.position.z) == (3.0, 1.0)
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")
    fallen = gazebo.state("ball")
    assert fallen.pose.position.z == pytest.approx(0.1, abs=2e-3)
    assert fallen.success


def test_remappings_of_the_server_hold_for_plugins(bare_gazebo: Gazebo) -> None:
    """As in roscpp, where they are those of the process; mir_gazebo moves its controllers' topics so."""
    bare_gazebo.start(remappings={"robot/truth": "odom"})
    plugin = """<plugin name="p" filename="libgazebo_ros_p3d.so"><robotNamespace>/robot</robotNamespace>
<bodyName>link</bodyName><topicName>truth</topicName></plugin></model>"""
    assert bare_gazebo.spawn(_BALL.replace("</model>", plugin), "ball").success

    messages = bare_gazebo.subscribe("/odom", "nav_msgs/Odometry")
    bare_gazebo.call("unpause_physics")
    until(lambda: messages)
    assert messages[0].child_frame_id == "link"


def test_duplicate_model_name_is_refused_with_gazebos_message(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball")
    again = gazebo.spawn(_BALL, "ball")

    assert not again.success
    assert again.status_message == "SpawnModel: Failure - model name ball already exist."


@pytest.mark.parametrize(
    ("xml", "reason"),
    [
        ("", "its text is empty"),
        ("<sdf version='1.6'/>", ""),
        ("<robot", "not well-formed"),
        ("<sdf version='1.6'><model name='a'/><model name='b'/></sdf>", ""),
    ],
)
def test_invalid_model_text_is_refused_with_a_reason(gazebo: Gazebo, xml: str, reason: str) -> None:
    response = gazebo.spawn(xml, "x")

    assert not response.success
    assert reason in response.status_message
    assert "x" not in gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").model_names


def test_time_continues_when_models_are_spawned_and_deleted(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "first")
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.spawn(_BALL, "second", x=1.0)
    assert gazebo.state("first").pose.position.z == pytest.approx(0.1, abs=2e-3)
    kind = "gazebo_msgs/DeleteModel"
    assert gazebo.call("delete_model", kind, model_name="first").success

    properties = gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties")
    assert properties.sim_time > 1.0
    assert list(properties.model_names) == ["ground_plane", "second"]
    assert "no model 'first'" in gazebo.call("delete_model", kind, model_name="first").status_message


def test_model_state_is_set_and_read_relative_to_another_model(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "one", x=1.0)
    gazebo.spawn(_BALL, "two", x=2.0)
    half_turn = {"position": {"x": 5.0, "z": 1.0}, "orientation": {"z": 1.0}}
    state = {"model_name": "two", "pose": half_turn, "reference_frame": "world"}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state).success

    assert gazebo.state("two").pose.position.x == pytest.approx(5.0)
    assert gazebo.state("one", relative_to="two").pose.position.x == pytest.approx(4.0)
    assert gazebo.state("one", relative_to="two::link").pose.position.x == pytest.approx(4.0)
    assert "no model 'three'" in gazebo.state("three").status_message


def test_a_wrench_acts_for_its_duration(gazebo: Gazebo) -> None:
    """2 kg under 4 N for half a second: 1 m/s."""
    gazebo.spawn(_BALL.replace("<pose>0 0 1", "<pose>0 0 100"), "ball")
    push = {"body_name": "ball::link", "wrench": {"force": {"x": 4.0}}, "duration": {"nanosec": 500_000_000}}
    assert gazebo.call("apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", **push).success
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)

    assert gazebo.state("ball").twist.linear.x == pytest.approx(1.0, rel=1e-3)


def test_reset_world_keeps_time_and_reset_simulation_zeroes_it(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball")
    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")
    gazebo.call("reset_world")
    assert gazebo.state("ball").pose.position.z == pytest.approx(1.0)
    assert gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time >= 1.0

    gazebo.call("reset_simulation")
    assert gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time == 0.0


def test_joint_properties_are_read_and_positions_set(gazebo: Gazebo) -> None:
    assert gazebo.spawn(_ARM, "arm").success
    fields = {"model_name": "arm", "joint_names": ["turn"], "joint_positions": [0.5]}
    assert gazebo.call("set_model_configuration", "gazebo_msgs/SetModelConfiguration", **fields).success
    joint = gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name="turn")
    assert (joint.type, list(joint.position)) == (0, [0.5])

    model = gazebo.call("get_model_properties", "gazebo_msgs/GetModelProperties", model_name="arm")
    assert "turn" in list(model.joint_names)
    bad = gazebo.call(
        "set_model_configuration", "gazebo_msgs/SetModelConfiguration", model_name="arm", joint_names=["x"]
    )
    assert bad.status_message == "SetModelConfiguration: 1 joints, but 0 positions"


def test_positions_of_missing_joints_are_ignored(gazebo: Gazebo) -> None:
    """As Gazebo does: a launch file sets the joints of an arm that the robot has only with another argument."""
    assert gazebo.spawn(_ARM, "arm").success
    fields = {"model_name": "arm", "joint_names": ["arm::none", "turn"], "joint_positions": [2.0, 0.5]}

    response = gazebo.call("set_model_configuration", "gazebo_msgs/SetModelConfiguration", **fields)

    assert response.success
    assert response.status_message == "SetModelConfiguration: success; model 'arm' has no joint 'none'"
    joint = gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name="turn")
    assert list(joint.position) == [0.5]


def test_states_are_published_while_there_are_subscribers(gazebo: Gazebo) -> None:
    messages: list[Message] = []
    gazebo.spawn(_BALL, "ball")
    gazebo.client.subscribe("/gazebo/link_states", "gazebo_msgs/LinkStates", messages.append)
    until(lambda: messages)
    assert "ball::link" in messages[0].name


_OFF = """<sdf version="1.6"><model name="off"><link name="link"><pose>0 0 0.5 0 0 1.570796326794896</pose>
<inertial><mass>1</mass></inertial></link></model></sdf>"""


def test_published_states_equal_those_of_the_services(gazebo: Gazebo) -> None:
    """Includes a model whose link is not at its origin, and one without a moving body."""
    assert gazebo.spawn(_OFF, "off", x=2.0).success
    turning = {"position": {"x": 1.0, "z": 3.0}, "orientation": {"z": 1.0}}
    target = {"model_name": "off", "pose": turning, "twist": {"linear": {"x": 0.25}, "angular": {"z": 0.5}}}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=target).success
    models = gazebo.subscribe("/gazebo/model_states", "gazebo_msgs/ModelStates")
    links = gazebo.subscribe("/gazebo/link_states", "gazebo_msgs/LinkStates")
    until(lambda: models and links)

    row = list(models[-1].name).index("off")
    state = gazebo.state("off")
    assert (models[-1].pose[row], models[-1].twist[row]) == (state.pose, state.twist)
    assert (models[-1].pose[row].position.x, models[-1].pose[row].position.z) == (1.0, pytest.approx(3.0))
    row = list(links[-1].name).index("off::link")
    link_state = gazebo.call("get_link_state", "gazebo_msgs/GetLinkState", link_name="off::link").link_state
    assert (links[-1].pose[row], links[-1].twist[row]) == (link_state.pose, link_state.twist)
    assert "ground_plane::link" in list(links[-1].name)


def test_clock_has_every_step_for_subscribers_without_a_queue_limit(gazebo: Gazebo) -> None:
    """A subscriber with a queue of one, as a stand-in has, gets every tenth step: it does not shorten strides."""
    stamps: list[int] = []
    time = gazebo.client.subscribe(
        "/clock", "rosgraph_msgs/Clock", lambda m: stamps.append(m.clock.nanosec), queue_size=1
    )
    until(lambda: time.publishers)
    gazebo.call("unpause_physics")
    until(lambda: len(stamps) > 20)
    assert {stamp % 10_000_000 for stamp in stamps} == {0}

    gazebo.subscribe("/clock", "rosgraph_msgs/Clock")
    until(lambda: any(b - a == 1_000_000 for a, b in pairwise(stamps)))


def test_spawn_model_spawns_from_a_parameter_and_unpauses(gazebo: Gazebo) -> None:
    gazebo.loop.run(gazebo.client.params.set("/robot_description", _ARM))
    words = ["-urdf", "-param", "robot_description", "-model", "arm", "-x", "1", "-z", "2", "-J", "turn", "0.25"]
    words.append("-unpause")
    node = Node("/spawn", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

    async def spawn() -> int:
        return await asyncio.create_task(SpawnModel(node, words, gazebo.host).run())

    assert gazebo.loop.run(spawn(), timeout_s=PATIENCE_S) == 0
    assert gazebo.state("arm").pose.position.z == pytest.approx(2.0)
    assert gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").pause is False
    gazebo.loop.run(node.shutdown())


@pytest.mark.parametrize(
    "words",
    [
        "-urdf -param nothing -model a",
        "-urdf -model a",
        "-sdf -file /no/where -model a",
        "-colour red",
        "-x",
        "-urdf -sdf -param p -model a",
        "-urdf -param p",
        "-trimesh -param p -model a",
        "-trimesh -file /no/where -model a -trimesh_mass 1",
    ],
)
def test_spawn_model_reports_invalid_arguments_and_exits_with_1(gazebo: Gazebo, words: str, capsys) -> None:
    node = Node("/spawn", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

    assert gazebo.loop.run(SpawnModel(node, words.split(), gazebo.host).run(), timeout_s=PATIENCE_S) == 1
    assert "spawn_model: " in capsys.readouterr().err
    gazebo.loop.run(node.shutdown())


def test_velocity_is_kept_when_another_model_is_spawned(gazebo: Gazebo) -> None:
    """9.8 m/s after one second of free fall."""
    gazebo.spawn(_BALL.replace("<pose>0 0 1", "<pose>0 0 100"), "ball")
    gazebo.call("unpause_physics")
    gazebo.until_s(0.5)
    gazebo.spawn(_BALL, "other", x=1.0)
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")
    seconds = gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time

    assert gazebo.state("ball").twist.linear.z == pytest.approx(-9.8 * seconds, rel=1e-3)


def test_set_model_state_sets_the_velocity(gazebo: Gazebo) -> None:
    gazebo.spawn(_BALL, "ball")
    state = {"model_name": "ball", "pose": {"position": {"z": 50.0}}, "twist": {"linear": {"x": 2.0}}}
    assert gazebo.call("set_model_state", "gazebo_msgs/SetModelState", model_state=state).success
    assert gazebo.state("ball").twist.linear.x == pytest.approx(2.0)

    gazebo.call("unpause_physics")
    gazebo.until_s(1.0)
    gazebo.call("pause_physics")
    seconds = gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time
    assert gazebo.state("ball").pose.position.x == pytest.approx(2.0 * seconds, rel=1e-3)


def test_a_spawned_camera_publishes_images(gazebo: Gazebo) -> None:
    camera = '<sensor name="eye" type="camera"><update_rate>10</update_rate><camera><image><width>64</width>'
    camera += "<height>48</height></image></camera></sensor></link>"
    messages: list[Message] = []
    assert gazebo.spawn(_BALL.replace("</link>", camera), "robot").success
    gazebo.client.subscribe("/robot/link/eye/image_raw", "sensor_msgs/Image", messages.append)
    gazebo.call("unpause_physics")
    until(lambda: messages)
    assert (messages[0].width, messages[0].height) == (64, 48)


def test_a_paused_start_names_the_service_that_unpauses(gazebo: Gazebo) -> None:
    until(lambda: "the world is paused; /gazebo/unpause_physics starts it" in gazebo.lines)


def test_a_plugin_that_raises_pauses_the_world_and_is_named(gazebo: Gazebo, tmp_path: Path) -> None:
    (tmp_path / "bad.py").write_text(
        "from trundle.gazebo.plugins import Plugin\n\n\nclass Bad(Plugin):\n    @classmethod\n"
        "    def load(cls, sim, model, node, tag):\n        return cls()\n\n"
        "    def before_step(self, sim):\n        raise ValueError('no such thing')\n"
    )
    plugin = '<plugin name="bad" filename="libbad.so"/></model>'
    assert gazebo.spawn(_BALL.replace("</model>", plugin), "robot").success
    gazebo.call("unpause_physics")
    message = "plugin bad.py: before_step: ValueError: no such thing; the simulation is paused"
    until(lambda: any(message in line for line in gazebo.lines))
    printed = next(line for line in gazebo.lines if message in line)
    assert f'File "{tmp_path / "bad.py"}", line 10, in before_step' in printed
    assert gazebo.call("get_physics_properties", "gazebo_msgs/GetPhysicsProperties").pause is True


def test_a_server_that_was_killed_can_be_started_again(gazebo: Gazebo, tmp_path: Path, capsys) -> None:
    """As respawn_gazebo does: the new world has no models of the old one."""
    (tmp_path / "bad.world").write_text("<sdf version='1.6'><world")
    gazebo.spawn(_BALL, "old")
    gazebo.loop.run(gazebo.server.shutdown())
    failing = Node("/gazebo", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    until(lambda: not gazebo.world.is_open)
    server = GazeboServer(failing, [str(tmp_path / "bad.world")], gazebo.host)
    assert gazebo.loop.run(server.run(), timeout_s=PATIENCE_S) == 1
    gazebo.loop.run(failing.shutdown())

    again = Node("/gazebo", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    gazebo.loop.spawn(GazeboServer(again, ["-u"], gazebo.host).run())
    gazebo.loop.run(gazebo.client.wait_for_service("/gazebo/unpause_physics", PATIENCE_S), timeout_s=PATIENCE_S)
    gazebo.loop.run(again.wait_registered())
    models = gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").model_names
    assert list(models) == ["ground_plane"]


def test_time_begins_when_all_services_are_registered(bare_gazebo: Gazebo, monkeypatch: pytest.MonkeyPatch) -> None:
    """A client that finds one service finds them all, also with a slow master."""
    gazebo = bare_gazebo
    server = Node("/gazebo", loop=gazebo.loop, master_uri=gazebo.client.master_uri)
    gazebo.loop.run(server.wait_registered(), PATIENCE_S)
    times: dict[str, int] = {}
    call = server.master.call

    async def call_slowly(method: str, *arguments: object) -> object:
        if method == "registerService":
            await asyncio.sleep(0.05)
            times[str(arguments[0])] = gazebo.world.simulation.time_ns
        return await call(method, *arguments)

    monkeypatch.setattr(server.master, "call", call_slowly)
    gazebo.loop.spawn(GazeboServer(server, [], gazebo.host).run())
    until(lambda: gazebo.world.is_ready and gazebo.world.simulation.time_ns > 0)

    assert set(times.values()) == {0}
    assert {"/gazebo/spawn_urdf_model", "/gazebo/set_model_state", "/gazebo/set_parameters"} <= times.keys()


def test_calls_are_answered_after_an_error_on_the_simulations_thread(
    gazebo: Gazebo, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    failed: list[bool] = []

    def fail(*_: object, **__: object) -> bool:
        failed.append(True)
        raise ValueError("the page's fault")

    with monkeypatch.context() as failing:
        failing.setattr(gazebo.world._window, "update", fail)
        until(lambda: len(failed) > 2)

        assert gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").success
    assert caplog.text.count("the simulation goes on after an error: ValueError: the page's fault") == 1


def test_a_second_server_is_refused_and_leaves_the_first_alone(gazebo: Gazebo, capsys) -> None:
    second = Node("/second", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

    assert gazebo.loop.run(GazeboServer(second, [], gazebo.host).run(), timeout_s=PATIENCE_S) == 1
    assert "a simulation is already running" in capsys.readouterr().err
    gazebo.loop.run(second.shutdown())
    assert gazebo.call("get_world_properties", "gazebo_msgs/GetWorldProperties").success


def test_topics_end_with_their_model_unless_another_model_shares_them(gazebo: Gazebo) -> None:
    imu = "<sensor name='s' type='imu'><topic>{}</topic><update_rate>100</update_rate></sensor>"
    model = "<sdf version='1.6'><model name='m'><static>1</static><link name='l'>{}</link></model></sdf>"

    def topics() -> set[str]:
        return set(dict(gazebo.loop.run(gazebo.client.master.call("getPublishedTopics", "/")))) & {"/own", "/both"}

    gazebo.spawn(model.format(imu.format("/own") + imu.format("/both").replace("'s'", "'t'")), "one")
    gazebo.spawn(model.format(imu.format("/both")), "two", x=1.0)
    until(lambda: topics() == {"/own", "/both"})
    gazebo.call("delete_model", "gazebo_msgs/DeleteModel", model_name="one")
    until(lambda: topics() == {"/both"})

    messages = gazebo.subscribe("/both", "sensor_msgs/Imu")
    gazebo.call("unpause_physics")
    until(lambda: messages)


def test_performance_metrics_hold_the_sensors_rates(gazebo: Gazebo) -> None:
    camera = "<camera><horizontal_fov>1</horizontal_fov><image><width>8</width><height>6</height></image></camera>"
    sensors = "".join(
        f"<sensor name='{name}' type='{kind}'><always_on>1</always_on><update_rate>{rate}</update_rate>{more}</sensor>"
        for name, kind, rate, more in (("turn", "imu", 100, ""), ("eye", "camera", 20, camera))
    )
    gazebo.spawn(
        f"<sdf version='1.6'><model name='m'><static>1</static><link name='l'>{sensors}</link></model></sdf>", "m"
    )
    messages = gazebo.subscribe("/gazebo/performance_metrics", "gazebo_msgs/PerformanceMetrics")
    gazebo.call("unpause_physics")
    until(lambda: len(messages) > 1)

    first, second = messages[:2]
    metrics = {sensor.name: sensor for sensor in second.sensors}
    assert second.real_time_factor > 0
    assert metrics["turn"].fps == -1
    seconds = (to_nsec(second.header.stamp) - to_nsec(first.header.stamp)) / 1e9
    for name, rate_hz in (("turn", 100), ("eye", 20)):
        assert metrics[name].sim_update_rate * seconds == pytest.approx(rate_hz * seconds, abs=1.01)
    assert metrics["eye"].fps == metrics["eye"].real_update_rate > 0


def test_sensor_noise_continues_when_models_are_spawned(gazebo: Gazebo) -> None:
    """A sensor that restarted with each spawned model would draw its first numbers again."""
    noise = "<noise type='gaussian'><mean>0</mean><stddev>1</stddev></noise>"
    turn = "".join(f"<{axis}>{noise}</{axis}>" for axis in "xyz")
    imu = f"<sensor name='s' type='imu'><update_rate>100</update_rate><imu><angular_velocity>{turn}</angular_velocity>"
    model = "<sdf version='1.6'><model name='m'><static>1</static><link name='l'>{}</link></model></sdf>"
    gazebo.spawn(model.format(imu + "</imu></sensor>"), "still")
    turns: list[float] = []

    def record_turn(message: Message) -> None:
        turns.append(message.angular_velocity.x)

    gazebo.client.subscribe("/still/l/s/imu", "sensor_msgs/Imu", record_turn)
    gazebo.call("unpause_physics")
    for name in ("one", "two"):
        count = len(turns) + 5
        until(lambda count=count: len(turns) >= count)
        gazebo.spawn(model.format(""), name)
    gazebo.call("delete_model", "gazebo_msgs/DeleteModel", model_name="one")
    count = len(turns) + 5
    until(lambda: len(turns) >= count)

    assert len(set(turns)) == len(turns)
