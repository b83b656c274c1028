"""Robots behind ros_control: transmissions, a controller_manager, its spawner and its controllers."""

import asyncio
from collections.abc import Iterator
from concurrent.futures import Future
from typing import Any

import pytest
from tests.bringup.conftest import PATIENCE_S, Gazebo, until

from trundle.nodes import Host
from trundle.nodes.controller_manager import ControllerManagerTool, Spawner
from trundle.ros import Message, Node

_MOVES = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'


def _joint(name: str, kind: str, interface: str, *, axis: str = "1 0 0", limit: str = "") -> str:
    return f"""<link name="{name}_link">{_MOVES}</link>
<joint name="{name}" type="{kind}"><parent link="base"/><child link="{name}_link"/><axis xyz="{axis}"/>{limit}</joint>
<transmission name="{name}_t"><type>transmission_interface/SimpleTransmission</type>
<joint name="{name}"><hardwareInterface>hardware_interface/{interface}</hardwareInterface></joint>
<actuator name="{name}_m"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>"""


_LIMIT = '<limit lower="-2" upper="2" effort="100" velocity="3"/>'
ROBOT = f"""<robot name="r"><link name="world"/><link name="base">{_MOVES}</link>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 5"/></joint>
{_joint("lift", "prismatic", "EffortJointInterface", axis="0 0 1", limit=_LIMIT)}
{_joint("turn", "revolute", "PositionJointInterface", limit=_LIMIT)}
{_joint("spin", "continuous", "VelocityJointInterface")}
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/r</robotNamespace></plugin></gazebo>
</robot>"""
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
    "all": {"type": "position_controllers/JointGroupPositionController", "joints": ["turn"]},
}
MANAGER = "/r/controller_manager"
PACKAGE = "controller_manager_msgs"


class Robot:
    """A robot in a running world, and its controller_manager."""

    def __init__(self, gazebo: Gazebo) -> None:
        self.gazebo = gazebo
        self._spawners: list[tuple[Future[int], Node]] = []
        for name, value in CONTROLLERS.items():
            gazebo.loop.run(gazebo.client.set_param(f"/r/{name}", value))
        gazebo.loop.run(gazebo.client.set_param("/r/robot_description", ROBOT))
        answer = gazebo.call(
            "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="r", model_xml=ROBOT, robot_namespace="/r"
        )
        assert answer.success, answer.status_message
        gazebo.call("unpause_physics")

    def spawn(self, *words: str) -> None:
        """Start controllers as a launch file does, and wait until they run."""
        name, uri = f"/r/spawner{len(self._spawners)}", self.gazebo.client.master_uri
        node = Node(name, loop=self.gazebo.loop, master_uri=uri)
        self._spawners.append((self.gazebo.loop.spawn(Spawner(node, list(words), Host()).run()), node))
        names = {word for word in words if not word.startswith("--")}
        wanted = "initialized" if "--stopped" in words else "running"
        until(lambda: names <= {c.name for c in self.list() if c.state == wanted})

    def list(self) -> list[Message]:
        """What is loaded."""
        wait = self.gazebo.client.wait_for_service(f"{MANAGER}/list_controllers", PATIENCE_S)
        self.gazebo.loop.run(wait, timeout_s=PATIENCE_S)
        return list(self.ask("list_controllers", "ListControllers").controller)

    def ask(self, service: str, kind: str, **fields: Any) -> Message:
        """Call a service of the manager's."""
        call = self.gazebo.client.call_service(f"{MANAGER}/{service}", f"{PACKAGE}/{kind}", fields)
        return self.gazebo.loop.run(call, timeout_s=PATIENCE_S)

    def command(self, controller: str, value: float) -> None:
        """Give a controller its command."""
        self.gazebo.speak(f"/r/{controller}/command", "std_msgs/Float64")({"data": value})

    def joint(self, name: str) -> Message:
        """Where a joint is."""
        return self.gazebo.call("get_joint_properties", "gazebo_msgs/GetJointProperties", joint_name=f"r::{name}")

    def stop_spawner(self, number: int) -> int:
        """End one as `rosnode kill` does; its exit code."""
        future, node = self._spawners[number]
        self.gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)
        return future.result(PATIENCE_S)

    def close(self) -> None:
        """End what was started."""
        for future, node in self._spawners:
            future.cancel()
            self.gazebo.loop.run(node.shutdown(), timeout_s=PATIENCE_S)


@pytest.fixture
def robot(gazebo: Gazebo) -> Iterator[Robot]:
    running = Robot(gazebo)
    yield running
    running.close()


def test_commands_move_joints_through_their_interfaces(robot: Robot) -> None:
    robot.spawn("states", "turn", "spin", "lift")
    robot.command("turn", 1.25)
    robot.command("spin", -2.0)
    robot.command("lift", 0.5)

    until(lambda: robot.joint("turn").position[0] == pytest.approx(1.25, abs=2e-3))
    until(lambda: robot.joint("spin").rate[0] == pytest.approx(-2.0, abs=1e-2))
    until(lambda: robot.joint("lift").position[0] == pytest.approx(0.5, abs=1e-2))  # the integral carries the weight
    robot.command("turn", 9.0)
    until(lambda: robot.joint("turn").position[0] == pytest.approx(2.0, abs=5e-3))  # its stop


def test_joint_states_are_published_in_the_order_of_names(robot: Robot) -> None:
    robot.spawn("states")
    heard = robot.gazebo.hear("/r/joint_states", "sensor_msgs/JointState")
    until(lambda: len(heard) > 3)

    assert list(heard[0].name) == ["lift", "spin", "turn"]
    stamps = [message.header.stamp.sec + message.header.stamp.nanosec * 1e-9 for message in heard[:3]]
    assert stamps[1] - stamps[0] == pytest.approx(0.01, abs=1e-9)


def test_an_effort_falls_back_when_its_controller_stops(robot: Robot) -> None:
    """1 kg is carried by its weight, and falls without."""
    robot.spawn("push")
    robot.command("push", 9.8 + 1.0)
    until(lambda: robot.joint("lift").position[0] > 0.05)
    assert robot.ask("switch_controller", "SwitchController", stop_controllers=["push"], strictness=2).ok
    until(lambda: robot.joint("lift").position[0] == pytest.approx(-2.0, abs=1e-2))


def test_the_manager_lists_refuses_and_unloads(robot: Robot) -> None:
    robot.spawn("--stopped", "turn")
    robot.spawn("all")
    (first, second) = robot.list()
    assert (first.name, first.state, first.type) == ("turn", "initialized", CONTROLLERS["turn"]["type"])
    claim = second.claimed_resources[0]
    assert (claim.hardware_interface, list(claim.resources)) == ("hardware_interface::PositionJointInterface", ["turn"])

    def switch(start: list[str], stop: list[str], strictness: int = 2) -> bool:
        fields = {"start_controllers": start, "stop_controllers": stop, "strictness": strictness}
        return robot.ask("switch_controller", "SwitchController", **fields).ok

    assert not switch(["turn"], [])  # both would command one joint
    assert not switch(["nobody"], [])
    assert switch(["nobody"], [], 1)
    assert not robot.ask("unload_controller", "UnloadController", name="all").ok  # it runs
    assert switch(["turn"], ["all"])
    assert robot.ask("unload_controller", "UnloadController", name="all").ok
    assert [(c.name, c.state) for c in robot.list()] == [("turn", "running")]
    for name in ("turn", "nobody", "odd"):
        assert not robot.ask("load_controller", "LoadController", name=name).ok
    types = robot.ask("list_controller_types", "ListControllerTypes").types
    assert "diff_drive_controller/DiffDriveController" in types


def test_a_spawner_that_is_killed_takes_its_controllers_away(robot: Robot) -> None:
    robot.spawn("turn")
    assert robot.stop_spawner(0) == 0
    until(lambda: robot.list() == [])


def test_the_command_line_tool(robot: Robot, capsys: pytest.CaptureFixture[str]) -> None:
    def tool(words: str) -> int:
        gazebo = robot.gazebo
        node = Node("/r/tool", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

        async def run() -> int:
            try:
                return await ControllerManagerTool(node, words.split(), Host()).run()
            finally:
                await node.shutdown()

        return gazebo.loop.run(run(), timeout_s=PATIENCE_S)

    assert tool("spawn spin") == 0
    assert tool("list") == 0
    out = capsys.readouterr().out
    assert "Spawned 'spin' successfully\n'spin' - 'velocity_controllers/JointVelocityController' ( running )" in out
    assert tool("kill spin") == 0
    assert tool("start spin") == 1
    assert tool("fly spin") == 1
    assert "invalid choice: 'fly'" in capsys.readouterr().err


def test_a_reset_holds_joints_where_they_came(robot: Robot) -> None:
    robot.spawn("turn")
    robot.command("turn", 1.0)
    until(lambda: robot.joint("turn").position[0] == pytest.approx(1.0, abs=1e-2))
    robot.gazebo.call("reset_simulation")
    time_s = robot.gazebo.time_s
    robot.gazebo.until_s(time_s + 0.3)
    assert robot.joint("turn").position[0] == pytest.approx(0.0, abs=1e-2)


def test_without_a_description_it_waits_and_says_so(gazebo: Gazebo, capfd: pytest.CaptureFixture[str]) -> None:
    spawned = gazebo.call(
        "spawn_urdf_model", "gazebo_msgs/SpawnModel", model_name="r", model_xml=ROBOT, robot_namespace="/r"
    )
    assert spawned.success
    said: list[str] = []
    until(lambda: said.append(capfd.readouterr().err) or "waiting for model URDF" in "".join(said))
    gazebo.loop.run(gazebo.client.set_param("/robot_description", ROBOT))
    wait = gazebo.client.wait_for_service(f"{MANAGER}/list_controllers", PATIENCE_S)
    gazebo.loop.run(wait, timeout_s=PATIENCE_S)


def test_a_spawner_without_a_manager_gives_up(gazebo: Gazebo, capfd: pytest.CaptureFixture[str]) -> None:
    node = Node("/spawner", loop=gazebo.loop, master_uri=gazebo.client.master_uri)

    async def run() -> int:
        return await asyncio.create_task(Spawner(node, ["--timeout", "0.2", "a"], Host()).run())

    assert gazebo.loop.run(run(), timeout_s=PATIENCE_S) == 1
    assert "Controller Spawner: " in capfd.readouterr().err
    gazebo.loop.run(node.shutdown())
