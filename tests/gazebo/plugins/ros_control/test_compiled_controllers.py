"""Controllers, robots and simulated hardware of ros_control in C++, compiled by catkin_make."""

import math
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, free_port, running_graph, until

from trundle.base.diagnostics import UsageError
from trundle.ros import GraphLoop, Message, Node
from trundle.ros.sdk import find_toolchain

pytestmark = pytest.mark.slow
_SOURCE = Path(__file__).parents[3] / "data/ros_control/src"
_MANAGER = "controller_manager_msgs"
_INERTIAL = '<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>'
_ARM = f"""<robot name="arm"><link name="world"/><link name="base">{_INERTIAL}</link><link name="arm">{_INERTIAL}</link>
<joint name="fix" type="fixed"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 0 1"/>
<limit effort="100" velocity="20"/></joint>
<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
<joint name="shoulder"><hardwareInterface>hardware_interface/VelocityJointInterface</hardwareInterface></joint>
<actuator name="m"/></transmission>
<gazebo><plugin name="control" filename="libgazebo_ros_control.so"><robotNamespace>/r</robotNamespace>
<robotSimType>{{kind}}</robotSimType></plugin></gazebo></robot>
"""
_LAUNCH = """<launch>
<include file="$(find gazebo_ros)/launch/empty_world.launch"><arg name="gui" value="false"/></include>
<param name="robot_description" textfile="$(dirname)/arm.urdf"/>
<rosparam>
r:
  gear: 2.0
  joint_state_controller: {type: joint_state_controller/JointStateController, publish_rate: 100}
  sway: {type: arm_control/SwayController, joint: shoulder, frequency: 0.5}
</rosparam>
<node name="urdf_spawner" pkg="gazebo_ros" type="spawn_model" args="-urdf -model arm -param robot_description"/>
<node name="controller_spawner" pkg="controller_manager" type="spawner" ns="/r" args="joint_state_controller sway"/>
</launch>
"""


@pytest.fixture(scope="module")
def workspace(tmp_path_factory: pytest.TempPathFactory) -> Path:
    try:
        find_toolchain(os.environ)
    except UsageError as error:
        pytest.skip(str(error))
    base = tmp_path_factory.mktemp("ws")
    shutil.copytree(_SOURCE, base / "src")
    done = subprocess.run(
        [sys.executable, "-m", "trundle", "--as", "catkin_make"],
        cwd=base,
        env={**os.environ, "PWD": str(base)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return base


class Client:
    """Client of a graph that another process serves."""

    def __init__(self, loop: GraphLoop, uri: str, namespace: str) -> None:
        self._loop, self._namespace = loop, namespace
        self.node = Node("/client", loop=loop, master_uri=uri)
        self._publishers: dict[str, Any] = {}

    def call(self, service: str, kind: str, **fields: object) -> Message:
        name = f"{self._namespace}/controller_manager/{service}"
        self._loop.run(self.node.wait_for_service(name, PATIENCE_S), PATIENCE_S)
        return self._loop.run(self.node.call_service(name, f"{_MANAGER}/{kind}", fields), PATIENCE_S)

    def switch(self, **names: list[str]) -> Message:
        return self.call("switch_controller", "SwitchController", strictness=2, **names)

    def states(self) -> dict[str, str]:
        return {c.name: c.state for c in self.call("list_controllers", "ListControllers").controller}

    def messages(self, topic: str, kind: str) -> list[Message]:
        received: list[Message] = []
        self.node.subscribe(f"{self._namespace}/{topic}", kind, received.append)
        return received

    def sway(self, amplitude: float) -> None:
        topic = f"{self._namespace}/sway/command"
        if topic not in self._publishers:
            self._publishers[topic] = self.node.advertise(topic, "std_msgs/Float64", latch=True)
        self._publishers[topic].publish({"data": amplitude})


@contextmanager
def launched(folder: Path, workspace: Path, kind: str) -> Iterator[tuple[Client, "subprocess.Popen[str]"]]:
    uri = f"http://127.0.0.1:{free_port()}"
    (folder / "arm.urdf").write_text(_ARM.format(kind=kind))
    (folder / "arm.launch").write_text(_LAUNCH)
    variables = {"ROS_MASTER_URI": uri, "ROS_PACKAGE_PATH": str(workspace / "src"), "PYTHONUNBUFFERED": "1"}
    process = subprocess.Popen(
        [sys.executable, "-m", "trundle", "launch", "arm.launch"],
        cwd=folder,
        env={**os.environ, **variables, "CMAKE_PREFIX_PATH": str(workspace / "devel")},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    try:
        with GraphLoop() as loop:
            client = Client(loop, uri, "/r")
            until(lambda: set(_states_or_none(client).values()) == {"running"})
            yield client, process
            loop.run(client.node.shutdown(), PATIENCE_S)
    finally:
        process.kill()
        process.communicate()


def _states_or_none(client: Client) -> dict[str, str]:
    try:
        return client.states()
    except Exception:  # the launch has not started its manager
        return {}


def test_a_controller_runs_at_every_step_beside_trundles(workspace: Path, tmp_path: Path) -> None:
    """Its speed is cos(pi·t); joint_state_controller is Trundle's. An exception stops it alone; a crash names it."""
    with launched(tmp_path, workspace, "gazebo_ros_control/DefaultRobotHWSim") as (client, process):
        sways = client.messages("sway/state", "std_msgs/Float64MultiArray")
        states = client.messages("joint_states", "sensor_msgs/JointState")
        claims = {c.name: c.claimed_resources for c in client.call("list_controllers", "ListControllers").controller}
        assert claims["sway"][0].hardware_interface == "hardware_interface::VelocityJointInterface"
        assert list(claims["sway"][0].resources) == ["shoulder"]
        client.sway(1.0)
        until(lambda: any(abs(s.velocity[0]) > 0.9 for s in states))

        def is_followed() -> bool:
            updates, time, period, _, velocity, command = sways[-1].data
            assert period == pytest.approx(0.001)
            assert updates == pytest.approx(time / 0.001, abs=2)
            assert command == pytest.approx(math.cos(math.pi * time), abs=1e-6)
            return velocity == pytest.approx(command, abs=0.02)

        until(lambda: sways and is_followed())
        client.sway(-1.0)
        until(lambda: abs(states[-1].velocity[0]) < 0.01)
        assert client.states() == {"joint_state_controller": "running", "sway": "running"}
        client.sway(1.0)
        assert client.switch(start_controllers=["sway"], stop_controllers=["sway"]).ok
        until(lambda: abs(states[-1].velocity[0]) > 0.5)
        client.sway(1e7)
        output, _ = process.communicate(timeout=PATIENCE_S)

    assert f"controller /r/sway: {workspace}/devel/lib/libarm_controllers.so, in C++" in output
    assert "controller 'sway': the amplitude is negative; it is not updated again until it is restarted" in output
    assert "trundle: error: plugin 'sway' crashed in its C++ code (SIGSEGV)" in output
    assert "in arm_control::SwayController::update(ros::Time const&, ros::Duration const&)" in output
    assert process.returncode < 0


def test_the_hardware_of_a_package_drives_the_joints(workspace: Path, tmp_path: Path) -> None:
    """A RobotHWSim with a gear of 2, whose joints both Trundle's controller and one in C++ use."""
    with launched(tmp_path, workspace, "arm_control/ArmHardwareSim") as (client, _):
        sways = client.messages("sway/state", "std_msgs/Float64MultiArray")
        states = client.messages("joint_states", "sensor_msgs/JointState")
        client.sway(1.0)
        until(lambda: any(abs(s.velocity[0]) > 1.9 for s in states))
        until(lambda: sways[-1].data[4] == pytest.approx(2.0 * sways[-1].data[5], abs=0.02))


def test_a_robots_own_program_runs_a_controller_manager(workspace: Path) -> None:
    """A main() with a ControllerManager and a loop: load, start, stop and unload by services."""
    with running_graph() as graph:
        client = Client(graph.loop, graph.core.uri, "")
        parameters = {"type": "arm_control/SwayController", "joint": "shoulder", "frequency": 0.1}
        graph.loop.run(client.node.params.set("/sway", parameters))
        variables = {"ROS_MASTER_URI": graph.core.uri, "ROS_PACKAGE_PATH": str(workspace / "src")}
        with program(workspace, "arm_node", variables):
            assert "arm_control/SwayController" in client.call("list_controller_types", "ListControllerTypes").types
            assert client.call("load_controller", "LoadController", name="sway").ok
            assert not client.call("load_controller", "LoadController", name="sway").ok
            sways = client.messages("sway/state", "std_msgs/Float64MultiArray")
            client.sway(1.0)
            assert client.states() == {"sway": "initialized"}
            assert client.switch(start_controllers=["sway"]).ok
            until(lambda: sways and sways[-1].data[4] > 0.5)
            assert not client.call("unload_controller", "UnloadController", name="sway").ok
            assert client.switch(stop_controllers=["sway"]).ok
            assert client.states() == {"sway": "stopped"}
            assert client.call("unload_controller", "UnloadController", name="sway").ok
            assert client.states() == {}


@contextmanager
def program(workspace: Path, name: str, variables: dict[str, str]) -> Iterator[None]:
    process = subprocess.Popen([str(workspace / "devel/lib/arm_control" / name)], env={**os.environ, **variables})
    try:
        yield
    finally:
        process.kill()
        process.wait()


def test_limits_transmissions_and_interfaces(workspace: Path) -> None:
    command = [str(workspace / "devel/lib/arm_control/checks")]

    done = subprocess.run(command, capture_output=True, text=True, check=False, timeout=PATIENCE_S)

    assert done.stdout.endswith("\n0 checks failed\n") or done.stdout == "0 checks failed\n", done.stdout + done.stderr
