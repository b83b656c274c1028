"""One joint commanded by ros_control and another plugin: efforts, motors and positions combine as in Gazebo."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from msgspec.structs import replace
from tests.gazebo.plugins.plugin_world import ARM, load
from tests.gazebo.plugins.ros_control.controlled import Robot, driven, fixed_robot
from tests.gazebo_server import Gazebo, until

from trundle.gazebo.plugins.ros_control.hardware import JointHardware
from trundle.gazebo.plugins.ros_control.transmissions import Interface
from trundle.sim.control import ToolboxPid
from trundle.sim.simulation import JointHandle, Simulation
from trundle.spatial import Wrench

_EFFORT, _VELOCITY, _POSITION = "EffortJointInterface", "VelocityJointInterface", "PositionJointInterface"
_INERTIA = 0.1
_STEPS = 500


def _drive(joint: JointHandle) -> None:
    joint.command_velocity(1.0, max_effort=5.0)


def _weak_drive(joint: JointHandle) -> None:
    joint.command_velocity(1.0, max_effort=0.1)


def _push(joint: JointHandle) -> None:
    joint.command_effort(0.2)


def _run_both(
    sim: Simulation, joint: JointHardware, other: Callable[[JointHandle], None], period: int, *, first: bool
) -> None:
    """Run both for `_STEPS`; the other plugin, due every `period` steps, acts before or after ros_control."""
    handle = joint.handle
    for step in range(_STEPS):
        if first and step % period == 0:
            other(handle)
        joint.read()
        joint.write(0.001)
        if not first and step % period == 0:
            other(handle)
        sim.step()


def _hardware(
    folder: Path, interface: Interface, command: float, gains: dict[str, float], limit: str = ""
) -> tuple[Simulation, JointHardware]:
    sim = load(folder, ARM.replace("</xyz>", f"</xyz><limit>{limit}</limit>", 1))
    pid = ToolboxPid(p=gains["p"], d=gains.get("d", 0.0)) if gains else None
    joint = JointHardware(sim["m"].joint("hinge"), interface, pid, lag_s=0.005)
    joint.read()
    joint.command = command
    return sim, joint


@pytest.mark.parametrize(("period", "first"), [(1, False), (20, True)])
@pytest.mark.parametrize(
    ("interface", "command", "gains", "other", "speed"),
    [
        (_EFFORT, 0.0, {}, _drive, 1.0),
        (_EFFORT, 0.3, {}, _drive, 1.0),
        (_EFFORT, 0.3, {}, _weak_drive, 1.5),  # 0.4 N·m up to 1 rad/s after 0.25 s, then 0.3 against the motor's 0.1
        (_EFFORT, 0.0, {}, _push, 1.0),
        (_EFFORT, 0.3, {}, _push, 2.5),
        (_EFFORT, -0.2, {}, _push, 0.0),
        (_VELOCITY, 0.0, {}, _push, 0.0),
        (_VELOCITY, -2.0, {}, _push, -2.0),
        (_VELOCITY, 0.0, {"p": 1.0}, _drive, 1.0),
        (_VELOCITY, 0.0, {"p": 1.0}, _push, 0.2),  # p v = 0.2 N·m
        (_VELOCITY, 3.0, {"p": 1.0}, _weak_drive, 2.9),  # p (3 − v) = 0.1 N·m of the motor
        (_POSITION, 0.0, {}, _push, 0.0),
        (_POSITION, 0.0, {}, _drive, 0.0),
        (_POSITION, 0.0, {"p": 1.0, "d": 0.1}, _drive, 1.0),
    ],
)
def test_efforts_add_up_and_a_position_overrides_all(
    tmp_path: Path,
    interface: Interface,
    command: float,
    gains: dict[str, float],
    other: Callable[[JointHandle], None],
    speed: float,
    period: int,
    first: bool,
) -> None:
    """v = Σ effort · t / I with 0.1 kg·m² after 0.5 s, whichever plugin acts first and however often."""
    sim, joint = _hardware(tmp_path, interface, command, gains)
    _run_both(sim, joint, other, period, first=first)

    assert joint.handle.velocity == pytest.approx(speed, abs=0.02)
    if interface == _POSITION and not gains:
        assert joint.handle.position == pytest.approx(0.0, abs=1e-6)


@pytest.mark.parametrize(("first", "period", "speed"), [(True, 1, 0.0), (False, 1, 1.0), (True, 20, 0.0)])
def test_the_later_of_two_speeds_counts(tmp_path: Path, first: bool, period: int, speed: float) -> None:
    """Gazebo has one motor a joint: ros_control, which writes at every step, overrides a drive plugin of 50 Hz."""
    sim, joint = _hardware(tmp_path, _VELOCITY, 0.0, {})
    _run_both(sim, joint, _drive, period, first=first)

    assert joint.handle.velocity == pytest.approx(speed, abs=1e-3)


def test_a_plugins_effort_beyond_the_motors_limit_accelerates(tmp_path: Path) -> None:
    """0.2 N·m of the plugin and 0.1 N·m of a wrench against a motor of 0.2 N·m."""
    sim, joint = _hardware(tmp_path, _VELOCITY, 0.0, {}, "<effort>0.2</effort>")
    sim["m"].link("arm").apply_wrench(Wrench(torque=(0.0, 0.0, 0.1)))
    _run_both(sim, joint, _push, 1, first=False)

    assert joint.handle.velocity == pytest.approx((0.2 + 0.1 - 0.2) / _INERTIA * 0.5, abs=0.01)


@pytest.mark.parametrize("command", [0.3, 3.0])
def test_each_effort_respects_the_joints_limits(tmp_path: Path, command: float) -> None:
    """ros_control adds at most 1 N·m to the plugin's effort; neither accelerates beyond 2 rad/s."""
    sim, joint = _hardware(tmp_path, _EFFORT, command, {}, "<effort>1</effort><velocity>2</velocity>")
    _run_both(sim, joint, _push, 1, first=True)
    assert joint.handle.velocity == pytest.approx(min(2.0, (min(command, 1.0) + 0.2) / _INERTIA * 0.5), abs=0.05)


def test_an_effort_with_a_motor_respects_the_velocity_limit(tmp_path: Path) -> None:
    sim, joint = _hardware(tmp_path, _EFFORT, 0.5, {}, "<velocity>2</velocity>")
    _run_both(sim, joint, _weak_drive, 1, first=True)

    assert joint.handle.velocity == pytest.approx(2.0, abs=0.02)


def test_a_wrench_on_the_link_adds_to_an_effort(tmp_path: Path) -> None:
    """Like that of gazebo_ros_force."""
    sim, joint = _hardware(tmp_path, _EFFORT, 0.3, {})
    sim["m"].link("arm").apply_wrench(Wrench(torque=(0.0, 0.0, 0.1)))
    _run_both(sim, joint, lambda _: None, 1, first=True)

    assert joint.handle.velocity == pytest.approx(0.4 / _INERTIA * 0.5, rel=1e-3)


def test_a_timed_effort_ends_and_that_of_ros_control_stays(tmp_path: Path) -> None:
    """Like that of apply_joint_effort."""
    sim, joint = _hardware(tmp_path, _EFFORT, 0.1, {})
    joint.handle.command_effort(0.2, duration_s=0.25)
    _run_both(sim, joint, lambda _: None, 1, first=True)

    assert joint.handle.velocity == pytest.approx((0.1 * 0.5 + 0.2 * 0.25) / _INERTIA, rel=1e-3)


@pytest.mark.parametrize("other", [_drive, _push])
def test_mixed_commands_continue_from_a_saved_state_to_the_bit(
    tmp_path: Path, other: Callable[[JointHandle], None]
) -> None:
    sim, joint = _hardware(tmp_path, _EFFORT, 0.3, {})
    _run_both(sim, joint, other, 20, first=False)
    saved = sim.save()

    def rest() -> tuple[float, float, object]:
        for _ in range(10):
            joint.write(0.001)
            sim.step()
        return joint.handle.position, joint.handle.velocity, joint.handle.commands

    after = rest()
    joint.handle.command_effort(7.0)
    sim.run(0.05)
    sim.restore(saved)
    assert rest() == after


def test_mixed_commands_are_not_doubled_when_a_model_is_spawned(tmp_path: Path) -> None:
    sim, joint = _hardware(tmp_path, _EFFORT, 0.1, {})
    joint.handle.command_effort(0.2)
    joint.write(0.001)
    commands = joint.handle.commands
    sim.spawn(replace(sim["m"].model, name="other"))
    joint.rebind()
    assert joint.handle.commands == commands
    assert joint.handle.effort == pytest.approx(0.3)
    _run_both(sim, joint, lambda _: None, 1, first=True)

    assert joint.handle.velocity == pytest.approx(0.3 / _INERTIA * 0.5, rel=1e-3)


_WHEEL = """<link name="{0}"><inertial><mass value="0.1"/><inertia ixx="5e-5" iyy="8e-5" izz="5e-5" ixy="0" ixz="0"
iyz="0"/></inertial><collision><origin rpy="1.5708 0 0"/><geometry><cylinder radius="0.04" length="0.03"/></geometry>
</collision></link><joint name="{0}_hinge" type="continuous"><parent link="base_link"/><child link="{0}"/>
<origin xyz="{1} {2} 0"/><axis xyz="0 1 0"/></joint><transmission name="{0}_t">
<type>transmission_interface/SimpleTransmission</type><joint name="{0}_hinge">
<hardwareInterface>hardware_interface/{3}</hardwareInterface></joint><actuator name="{0}_m"/></transmission>"""
_WHEEL_POSITIONS = {"fl": (0.06, 0.11), "fr": (0.06, -0.11), "rl": (-0.06, 0.11), "rr": (-0.06, -0.11)}
_SKID = """<plugin name="drive" filename="libgazebo_ros_skid_steer_drive.so"><leftFrontJoint>fl_hinge</leftFrontJoint>
<rightFrontJoint>fr_hinge</rightFrontJoint><leftRearJoint>rl_hinge</leftRearJoint><rightRearJoint>rr_hinge
</rightRearJoint><wheelSeparation>0.22</wheelSeparation><wheelDiameter>0.08</wheelDiameter></plugin>"""
_DIFF = """<plugin name="drive" filename="libgazebo_ros_diff_drive.so"><leftJoint>fl_hinge</leftJoint><rightJoint>
fr_hinge</rightJoint><wheelSeparation>0.22</wheelSeparation><wheelDiameter>0.08</wheelDiameter></plugin>"""
_PLANAR = '<plugin name="drive" filename="libgazebo_ros_planar_move.so"/>'
_CONTROL = '<plugin name="control" filename="libgazebo_ros_control.so"/>'


def _cart(interface: Interface, *plugins: str) -> str:
    wheels = "".join(_WHEEL.format(name, x, y, interface) for name, (x, y) in _WHEEL_POSITIONS.items())
    return f"""<robot name="cart"><link name="base_link"><inertial><mass value="2"/><inertia ixx="0.01" iyy="0.02"
izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial><collision><origin xyz="0 0 0.05"/><geometry><box size="0.2 0.16 0.06"/>
</geometry></collision></link>{wheels}{"".join(f"<gazebo>{plugin}</gazebo>" for plugin in plugins)}</robot>"""


@pytest.mark.parametrize(
    ("interface", "plugins", "distance"),
    [
        (_EFFORT, (_SKID, _CONTROL), 0.3),
        (_EFFORT, (_CONTROL, _DIFF), 0.3),
        (_EFFORT, (_CONTROL, _PLANAR), 0.3),
        (_VELOCITY, (_SKID, _CONTROL), 0.0),
        (_POSITION, (_CONTROL, _SKID), 0.0),
    ],
)
def test_wheels_without_a_controller_roll_only_with_effort_interfaces(
    gazebo: Gazebo, interface: Interface, plugins: tuple[str, ...], distance: float
) -> None:
    """The default hardware adds zero effort, but holds zero speed or a position."""
    text = _cart(interface, *plugins)
    gazebo.loop.run(gazebo.client.params.set("/robot_description", text))
    pose: dict[str, Any] = {"position": {"z": 0.041}}
    spawned = gazebo.call(
        "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="cart", model_xml=text, initial_pose=pose
    )
    assert spawned.success, spawned.status_message
    gazebo.call("unpause_physics")
    gazebo.loop.run(gazebo.client.wait_for_service("/cart/controller_manager/list_controllers", 60.0))
    gazebo.advertise("/cmd_vel", "geometry_msgs/Twist")({"linear": {"x": 0.3}})
    gazebo.until_s(gazebo.time_s + 0.5)
    start_s, start = gazebo.time_s, gazebo.state("cart").pose.position.x
    gazebo.until_s(start_s + 1.0)
    elapsed_s = gazebo.time_s - start_s

    moved = gazebo.state("cart").pose.position.x - start
    assert moved == pytest.approx(distance * elapsed_s, abs=0.03 * elapsed_s + 0.02)


_ROBOT = fixed_robot(
    driven("a", "continuous", _POSITION), driven("b", "continuous", _VELOCITY), driven("c", "continuous", _EFFORT)
).replace("</robotNamespace>", "</robotNamespace><eStopTopic>stop</eStopTopic>")
_CONTROLLERS: dict[str, Any] = {
    "a": {"type": "position_controllers/JointTrajectoryController", "joints": ["a"]},
    "b": {"type": "velocity_controllers/JointVelocityController", "joint": "b"},
    "c": {"type": "effort_controllers/JointEffortController", "joint": "c"},
}


@pytest.fixture
def robot(gazebo: Gazebo) -> Iterator[Robot]:
    running = Robot(gazebo, _ROBOT, _CONTROLLERS)
    running.spawn(*_CONTROLLERS)
    yield running
    running.close()


def test_an_emergency_stop_holds_positions_and_restarts_the_controllers_afterwards(robot: Robot) -> None:
    results = robot.gazebo.subscribe(
        "/r/a/follow_joint_trajectory/result", "control_msgs/FollowJointTrajectoryActionResult"
    )
    point = {"positions": [3.0], "time_from_start": {"sec": 10}}
    goal = {"goal": {"trajectory": {"joint_names": ["a"], "points": [point]}}}
    robot.gazebo.advertise("/r/a/follow_joint_trajectory/goal", "control_msgs/FollowJointTrajectoryActionGoal")(goal)
    robot.command("b", 1.0)
    robot.command("c", 0.01)
    until(lambda: all(robot.joint(name).rate[0] > 0.01 for name in "abc"))
    stop = robot.gazebo.advertise("/r/stop", "std_msgs/Bool")
    stop({"data": True})
    until(lambda: abs(robot.joint("a").rate[0]) < 1e-3 and abs(robot.joint("b").rate[0]) < 1e-3)
    positions = {name: robot.joint(name).position[0] for name in "ab"}
    coasting = robot.joint("c").rate[0]
    robot.gazebo.until_s(robot.gazebo.time_s + 0.5)
    assert {name: robot.joint(name).position[0] for name in "ab"} == pytest.approx(positions, abs=1e-3)
    assert robot.joint("c").rate[0] == pytest.approx(coasting, rel=1e-3)
    assert not results

    stop({"data": False})
    until(lambda: results)
    assert results[0].status.status == 2  # preempted, as the controller was restarted
    robot.gazebo.until_s(robot.gazebo.time_s + 0.3)
    assert robot.joint("a").position[0] == pytest.approx(positions["a"], abs=1e-3)
    assert abs(robot.joint("b").rate[0]) < 1e-3
