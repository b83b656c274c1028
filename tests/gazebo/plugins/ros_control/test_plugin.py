"""Robots behind ros_control: transmissions, a controller_manager, its spawner and its controllers."""

import asyncio
from collections.abc import Iterator
from typing import Any

import pytest
from tests.gazebo.plugins.ros_control.controlled import MANAGER, Robot, driven, fixed_robot
from tests.gazebo_server import PATIENCE_S, Gazebo, until

from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.controller_manager import ControllerManagerTool, Spawner
from trundle.ros import Node

_LIMIT = '<limit lower="-2" upper="2" effort="100" velocity="3"/>'
ROBOT = fixed_robot(
    driven("lift", "prismatic", "EffortJointInterface", axis="0 0 1", limit=_LIMIT),
    driven("turn", "revolute", "PositionJointInterface", limit=_LIMIT),
    driven("spin", "continuous", "VelocityJointInterface"),
)
CONTROLLERS: dict[str, Any] = {
    "states": {"type": "joint_state_controller/JointStateController", "publish_rate": 100},
    "turn": {"type": "position_controllers/JointPositionController", "joint": "turn"},
    "spin": {"type": "velocity_controllers/JointVelocityController", "joint": "spin"},
    "lift": {
        "type": "effort_controllers/JointPositionController",
        "joint": "lift",
        "pid": {"p": 400.0, "i": 200.0, "i_clamp": 50.0, "d": 40.0},
    },
    "push": {"type": "effort_controllers/JointEffortController", "joint": "lift"},
    "odd": {"type": "no/Such"},
    "imu": {"type": "imu_sensor_controller/ImuSensorController", "publish_rate": 50},
    "wrist": {"type": "force_torque_sensor_controller/ForceTorqueSensorController", "publish_rate": 50},
    "all": {"type": "position_controllers/JointGroupPositionController", "joints": ["turn"]},
}


@pytest.fixture
def robot(gazebo: Gazebo) -> Iterator[Robot]:
    running = Robot(gazebo, ROBOT, CONTROLLERS)
    yield running
    running.close()


def test_commands_move_joints_through_their_interfaces(robot: Robot) -> None:
    robot.spawn("states", "turn", "spin", "lift")
    robot.command("turn", 1.25)
    robot.command("spin", -2.0)
    robot.command("lift", 0.5)

    until(lambda: robot.joint("turn").position[0] == pytest.approx(1.25, abs=2e-3))
    until(lambda: robot.joint("spin").rate[0] == pytest.approx(-2.0, abs=1e-2))
    until(
        lambda: robot.joint("lift").position[0] == pytest.approx(0.5, abs=1e-2)
    )  # the integral term carries the weight
    robot.command("turn", 9.0)
    until(lambda: robot.joint("turn").position[0] == pytest.approx(2.0, abs=5e-3))  # its stop


def test_each_joint_of_a_differential_is_driven_in_place_of_a_robots_own_hardware(gazebo: Gazebo) -> None:
    tilt, roll = (driven(name, "revolute", "PositionJointInterface", limit=_LIMIT) for name in ("tilt", "roll"))
    split = '<actuator name="tilt_m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>'
    roll_links, roll_transmission = roll.split("<transmission", 1)
    wrist = tilt.removesuffix(split) + roll_transmission.split("</type>", 1)[1]
    own = "<robotSimType>wrist/WristHardware</robotSimType></plugin>"
    urdf = fixed_robot(roll_links, wrist).replace("</plugin>", own)
    kind = "position_controllers/JointPositionController"
    robot = Robot(gazebo, urdf, {name: {"type": kind, "joint": name} for name in ("tilt", "roll")})

    robot.spawn("tilt", "roll")
    robot.command("tilt", 0.5)
    robot.command("roll", -0.25)

    until(lambda: robot.joint("tilt").position[0] == pytest.approx(0.5, abs=2e-3))
    until(lambda: robot.joint("roll").position[0] == pytest.approx(-0.25, abs=2e-3))
    robot.close()


def test_joint_states_are_published_in_the_order_of_names(robot: Robot) -> None:
    robot.spawn("states")
    messages = robot.gazebo.subscribe("/r/joint_states", "sensor_msgs/JointState")
    until(lambda: len(messages) > 3)

    assert list(messages[0].name) == ["lift", "spin", "turn"]
    stamps = [message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 for message in messages[:3]]
    assert stamps[1] - stamps[0] == pytest.approx(0.01, abs=1e-9)


def test_an_effort_ends_when_its_controller_stops(robot: Robot) -> None:
    """An effort equal to the weight holds 1 kg; without it, the mass falls."""
    robot.spawn("push")
    robot.command("push", 9.8 + 1.0)
    until(lambda: robot.joint("lift").position[0] > 0.05)
    assert robot.call("switch_controller", "SwitchController", stop_controllers=["push"], strictness=2).ok
    until(lambda: robot.joint("lift").position[0] == pytest.approx(-2.0, abs=1e-2))


def test_the_controller_manager_lists_switches_and_unloads(robot: Robot) -> None:
    robot.spawn("--stopped", "turn")
    robot.spawn("all")
    (first, second) = robot.list()
    assert (first.name, first.state, first.type) == ("turn", "initialized", CONTROLLERS["turn"]["type"])
    claim = second.claimed_resources[0]
    assert (claim.hardware_interface, list(claim.resources)) == ("hardware_interface::PositionJointInterface", ["turn"])

    def switch(start: list[str], stop: list[str], strictness: int = 2) -> bool:
        fields = {"start_controllers": start, "stop_controllers": stop, "strictness": strictness}
        return robot.call("switch_controller", "SwitchController", **fields).ok

    assert not switch(["turn"], [])  # both would command one joint
    assert not switch(["nobody"], [])
    assert switch(["nobody"], [], 1)
    assert not robot.call("unload_controller", "UnloadController", name="all").ok  # it runs
    assert switch(["turn"], ["all"])
    assert robot.call("unload_controller", "UnloadController", name="all").ok
    assert [(c.name, c.state) for c in robot.list()] == [("turn", "running")]
    for name in ("turn", "nobody", "odd"):
        assert not robot.call("load_controller", "LoadController", name=name).ok
    types = robot.call("list_controller_types", "ListControllerTypes").types
    assert "diff_drive_controller/DiffDriveController" in types


def test_a_killed_spawner_unloads_its_controllers(robot: Robot) -> None:
    robot.spawn("turn")
    assert robot.stop_spawner(0) == 0
    until(lambda: robot.list() == [])


def test_the_command_line_tool(robot: Robot, capsys: pytest.CaptureFixture[str]) -> None:
    def run_tool(arguments: str) -> int:
        gazebo = robot.gazebo
        node = Node("/r/tool", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

        async def run() -> int:
            try:
                return await ControllerManagerTool(node, arguments.split(), NodeHost()).run()
            finally:
                await node.shutdown()

        return gazebo.loop.run(run(), timeout_s=PATIENCE_S)

    assert run_tool("spawn spin") == 0
    assert run_tool("list") == 0
    out = capsys.readouterr().out
    assert "Spawned 'spin' successfully\n'spin' - 'velocity_controllers/JointVelocityController' ( running )" in out
    assert run_tool("kill spin") == 0
    assert run_tool("start spin") == 1
    assert run_tool("fly spin") == 1
    assert "invalid choice: 'fly'" in capsys.readouterr().err


def test_a_reset_holds_joints_at_their_initial_positions(robot: Robot) -> None:
    robot.spawn("turn")
    robot.command("turn", 1.0)
    until(lambda: robot.joint("turn").position[0] == pytest.approx(1.0, abs=1e-2))
    robot.gazebo.call("reset_simulation")
    time_s = robot.gazebo.time_s
    robot.gazebo.until_s(time_s + 0.3)
    assert robot.joint("turn").position[0] == pytest.approx(0.0, abs=1e-2)


def test_a_missing_robot_description_is_logged_and_awaited(gazebo: Gazebo, capfd: pytest.CaptureFixture[str]) -> None:
    spawned = gazebo.call(
        "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="r", model_xml=ROBOT, robot_namespace="/r"
    )
    assert spawned.success
    output: list[str] = []
    until(lambda: output.append(capfd.readouterr().err) or "waiting for model URDF" in "".join(output))
    gazebo.loop.run(gazebo.client.params.set("/robot_description", ROBOT))
    wait = gazebo.client.wait_for_service(f"{MANAGER}/list_controllers", PATIENCE_S)
    gazebo.loop.run(wait, timeout_s=PATIENCE_S)


def test_a_spawner_without_a_manager_gives_up(gazebo: Gazebo, capfd: pytest.CaptureFixture[str]) -> None:
    node = Node("/spawner", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

    async def run() -> int:
        return await asyncio.create_task(Spawner(node, ["--timeout", "0.2", "a"], NodeHost()).run())

    assert gazebo.loop.run(run(), timeout_s=PATIENCE_S) == 1
    assert "Controller Spawner: " in capfd.readouterr().err
    gazebo.loop.run(node.shutdown())


@pytest.mark.parametrize(("name", "interface"), [("imu", "ImuSensor"), ("wrist", "ForceTorqueSensor")])
def test_a_sensor_controller_does_not_load_without_its_hardware_interface(
    robot: Robot, name: str, interface: str
) -> None:
    robot.list()
    log = robot.gazebo.subscribe("/rosout_agg", "rosgraph_msgs/Log")
    assert not robot.call("load_controller", "LoadController", name=name).ok
    error = f"/r/{name} requires a hardware interface of type 'hardware_interface::{interface}Interface'"
    until(lambda: any(error in str(line.msg) for line in log))
