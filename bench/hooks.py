"""Controllers with the engine: an arm under ros_control at every step, an arm with efforts from Python, and a lidar at
100 Hz on a robot at rest.

The peer is a plain loop of `mj_step` on the same compiled model. Times are of all threads of this process.
"""

import copy
import statistics
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Future
from pathlib import Path
from typing import Any

import mujoco

import trundle
from bench.table import Row
from trundle.gazebo.model_plugins import load_plugins
from trundle.ros import Core, GraphLoop, Node
from trundle.sim.sensors import mount_sensors
from trundle.sim.simulation import Simulation

_PAIRS = 5
_PATIENCE_S = 30.0
_JOINTS = [f"j{i}" for i in range(7)]
_GAINS = {"p": 300.0, "i": 10.0, "d": 10.0, "i_clamp": 50.0}
_CONTROLLERS: dict[str, Any] = {
    "joint_state_controller": {"type": "joint_state_controller/JointStateController", "publish_rate": 50},
    "arm": {
        "type": "effort_controllers/JointTrajectoryController",
        "joints": _JOINTS,
        "gains": dict.fromkeys(_JOINTS, _GAINS),
    },
}
_STATES = {
    "/joint_states": "sensor_msgs/JointState",
    "/arm/state": "control_msgs/JointTrajectoryControllerState",
}
_LINK = """<link name="{name}"><inertial><origin xyz="0 0 0.15"/><mass value="2"/>
<inertia ixx="0.02" iyy="0.02" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>"""
_JOINT = """<joint name="j{i}" type="revolute"><parent link="l{i}"/><child link="l{next}"/><origin xyz="0 0 0.3"/>
<axis xyz="{axis}"/><limit lower="-2.9" upper="2.9" effort="200" velocity="3"/><dynamics damping="0.5"/></joint>
<transmission name="t{i}"><type>transmission_interface/SimpleTransmission</type><joint name="j{i}">
<hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface></joint>
<actuator name="m{i}"/></transmission>"""
_LIDAR = """<sensor name="scan" type="ray"><pose>0 0 0.5 0 0 0</pose><always_on>1</always_on>
<update_rate>100</update_rate><ray><scan><horizontal><samples>360</samples><min_angle>-3.1</min_angle>
<max_angle>3.1</max_angle></horizontal></scan><range><min>0.1</min><max>10</max></range>
<noise><type>gaussian</type><stddev>0.01</stddev></noise></ray></sensor>"""
_BOX = """<collision name="c"><geometry><box><size>{}</size></box></geometry></collision>"""


def run() -> list[Row]:
    """Alternate simulation and loop, so that a varying machine speed affects both equally."""
    rows = _rows("robot at rest with a 360-ray lidar at 100 Hz (Gazebo 11: 13.6)", _robot_with_lidar(), 10.0)
    with tempfile.TemporaryDirectory() as folder, GraphLoop() as loop:
        sim, client = _controlled_arm(Path(folder), loop)
        rows += _rows("arm of 7 joints under ros_control", sim, 4.0)
        for topic, kind in _STATES.items():
            client.subscribe(topic, kind, lambda _: None)
        time.sleep(0.5)
        rows += _rows("the same with a subscriber to its states at 50 Hz", sim, 4.0)
    sim = _commanded_arm()
    rows += _rows("arm of 7 joints with efforts of a hook at every step", sim, 1.0)
    return [*rows, _command_cost(sim)]


def _rows(name: str, sim: Simulation, duration_s: float) -> list[Row]:
    model, data = copy.copy(sim.engine.compiled.model), sim.engine.save().data
    steps = round(duration_s * 1e9 / sim.step_ns)
    pairs = [
        (
            _rate(lambda: sim.step(steps), duration_s),
            _rate(lambda: mujoco.mj_step(model, data, nstep=steps), duration_s),
        )
        for _ in range(_PAIRS)
    ]
    ratio = statistics.median(simulation / loop for simulation, loop in pairs)
    return [Row(name, statistics.median(simulation for simulation, _ in pairs), "× real", "mj_step on the same", ratio)]


def _rate(work: Callable[[], None], duration_s: float) -> float:
    """Return simulated seconds per CPU second."""
    start = time.process_time()
    work()
    return duration_s / (time.process_time() - start)


def _robot_with_lidar() -> Simulation:
    inertia = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
    robot = f'<link name="l"><inertial><mass>5</mass>{inertia}</inertial>{_BOX.format("0.4 0.3 0.2")}{_LIDAR}</link>'
    wall = f'<static>1</static><pose>3 0 0.5 0 0 0</pose><link name="l">{_BOX.format("0.2 6 1")}</link>'
    models = f'<model name="wall">{wall}</model><model name="robot"><pose>0 0 0.1 0 0 0</pose>{robot}</model>'
    ground = "<include><uri>model://ground_plane</uri></include>"
    sim = _load("robot.world", f'<sdf version="1.6"><world name="w">{ground}{models}</world></sdf>')
    for sensor in mount_sensors(sim):
        sensor.listen(lambda _: None)
        sensor.start(sim)
    sim.run(2.0)
    return sim


class _Efforts:
    """Hook that commands a different effort of each joint at every step."""

    def __init__(self, sim: Simulation) -> None:
        self._joints = [sim["r"].joint(name) for name in _JOINTS]
        self._count = 0

    def before_step(self, _: Simulation) -> None:
        self._count += 1
        effort = 0.1 + 0.001 * (self._count % 7)
        for joint in self._joints:
            joint.command_effort(effort)


def _commanded_arm() -> Simulation:
    sim = _load("arm.urdf", _arm(""))
    sim.add_hook(_Efforts(sim))
    sim.step(1000)
    return sim


def _command_cost(sim: Simulation) -> Row:
    hook, count = _Efforts(sim), 2_000
    costs: list[float] = []
    for _ in range(4 * _PAIRS):
        start = time.process_time()
        for _ in range(count):
            hook.before_step(sim)
        costs.append((time.process_time() - start) / (count * len(_JOINTS)))
    return Row("JointHandle.command_effort", 1e6 * statistics.median(costs), "µs", "", None)


def _arm(extra: str) -> str:
    links = "".join(_LINK.format(name=f"l{i}") for i in range(len(_JOINTS) + 1))
    joints = "".join(_JOINT.format(i=i, next=i + 1, axis="0 1 0" if i % 2 else "0 0 1") for i in range(len(_JOINTS)))
    weld = '<link name="world"/><joint name="w" type="fixed"><parent link="world"/><child link="l0"/></joint>'
    return f'<robot name="r">{weld}{links}{joints}{extra}</robot>'


def _controlled_arm(folder: Path, loop: GraphLoop) -> tuple[Simulation, Node]:
    """Return an arm that follows a trajectory, set up like by a launch file, and a client node."""
    plugin = '<plugin name="c" filename="libgazebo_ros_control.so"><robotNamespace>/</robotNamespace></plugin>'
    urdf = _arm(f"<gazebo>{plugin}</gazebo>")
    core = Core(loop, port=0)
    loop.run(core.start(), _PATIENCE_S)
    loop.run(core.wait_ready(), _PATIENCE_S)
    sim = _load("arm.urdf", urdf, folder)
    node = Node("/gazebo", loop=loop, master_uri=core.uri, deliver=sim.inputs.post_callback, rosout=False)
    for name, value in {"robot_description": urdf, **_CONTROLLERS}.items():
        loop.run(node.params.set(f"/{name}", value), _PATIENCE_S)
    load_plugins(sim, lambda _: node, {}, log=lambda _: None)
    client = Node("/client", loop=loop, master_uri=core.uri, rosout=False)

    def call(service: str, **fields: Any) -> None:
        name = f"/controller_manager/{service}_controller"
        kind = f"controller_manager_msgs/{service.title()}Controller"
        _step_until_done(sim, loop.spawn(client.wait_for_service(name, _PATIENCE_S)))
        assert _step_until_done(sim, loop.spawn(client.call_service(name, kind, fields))).ok, f"{name} failed"

    for name in _CONTROLLERS:
        call("load", name=name)
    call("switch", start_controllers=list(_CONTROLLERS), stop_controllers=[], strictness=2)
    commands = client.advertise("/arm/command", "trajectory_msgs/JointTrajectory")
    while not commands.has_subscribers:
        time.sleep(0.01)
    goal = {"positions": [0.3] * 7, "velocities": [0.0] * 7, "time_from_start": {"secs": 60, "nsecs": 0}}
    commands.publish({"joint_names": _JOINTS, "points": [goal]})
    time.sleep(0.2)
    sim.step(1000)
    return sim, client


def _step_until_done(sim: Simulation, future: Future[Any]) -> Any:
    """Step until a call has its result."""
    while not future.done():
        sim.step(1)
        time.sleep(0.001)
    return future.result()


def _load(name: str, text: str, folder: Path | None = None) -> Simulation:
    with tempfile.TemporaryDirectory() as temporary:
        file = (folder or Path(temporary)) / name
        file.write_text(text)
        return trundle.load(str(file))
