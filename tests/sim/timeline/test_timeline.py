"""A simulation that was put back goes on as it did, to the byte."""

import os
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from tests.graphs import until

import trundle
from trundle.base.diagnostics import UsageError
from trundle.live.loaded_simulation import LoadedSimulation
from trundle.ros import GraphLoop, Node
from trundle.sim.sensors import RangeReading
from trundle.sim.simulation import Simulation
from trundle.sim.timeline import Timeline
from trundle.spatial import NS_PER_S, Pose

STATM = Path("/proc/self/statm")
ROBOT = """
<model name="robot{number}"><pose>0 {number} 0.1 0 0 0</pose>
  <link name="base">
    <inertial><mass>5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
    <collision name="body"><geometry><box><size>0.4 0.2 0.1</size></box></geometry></collision>
    <collision name="caster"><pose>0.15 0 -0.05 0 0 0</pose><geometry><sphere><radius>0.05</radius></sphere></geometry>
      <surface><friction><ode><mu>0</mu><mu2>0</mu2></ode></friction></surface></collision>
    <sensor name="laser" type="ray"><update_rate>10</update_rate><always_on>1</always_on>
      <ray><scan><horizontal><samples>60</samples><min_angle>-1.5</min_angle><max_angle>1.5</max_angle></horizontal></scan>
        <range><min>0.1</min><max>8</max></range><noise><type>gaussian</type><stddev>0.02</stddev></noise></ray>
      <plugin name="scan" filename="libgazebo_ros_laser.so"><topicName>/robot{number}/scan</topicName></plugin></sensor>
    <sensor name="imu" type="imu"><update_rate>50</update_rate><always_on>1</always_on>
      <imu><angular_velocity><x><noise type="gaussian"><stddev>0.01</stddev><bias_stddev>0.1</bias_stddev></noise></x>
      </angular_velocity></imu></sensor>
  </link>
  {wheels}
  <plugin name="drive" filename="libgazebo_ros_diff_drive.so"><robotNamespace>robot{number}</robotNamespace>
    <leftJoint>left</leftJoint><rightJoint>right</rightJoint><wheelSeparation>0.3</wheelSeparation>
    <wheelDiameter>0.2</wheelDiameter><wheelTorque>5</wheelTorque><updateRate>50</updateRate>
    <wheelAcceleration>1</wheelAcceleration></plugin>
  <plugin name="push" filename="push.py"/>
</model>
"""
WHEEL = """
  <link name="{side}_wheel"><pose>-0.1 {y} 0 -1.5708 0 0</pose>
    <inertial><mass>0.5</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
    <collision name="tread"><geometry>
      <cylinder><radius>0.1</radius><length>0.04</length></cylinder></geometry></collision>
  </link>
  <joint name="{side}" type="revolute"><parent>base</parent><child>{side}_wheel</child>
    <axis><xyz>0 0 1</xyz></axis></joint>
"""
PUSH = """
import random

class Push:
    '''Pushes the robot now and then; remembers in every way that Python offers.'''

    @classmethod
    def load(cls, sim, model, node, tag):
        return cls(model)

    def __init__(self, model):
        self.model = model
        self.random = random.Random(model.name)
        self.pushes = []
        self.last = {"time": 0.0}
        self.due = self.make_due()

    def make_due(self):
        left = 5

        def due():
            nonlocal left
            left = left - 1 if left else self.random.randrange(3, 9)
            return left == 0

        return due

    period = 0.02

    def before_step(self, sim):
        if self.due():
            force = self.random.uniform(-20.0, 20.0)
            self.pushes.append(force)
            self.last["time"] = sim.time_ns
            self.model.link("base").apply_force((0.0, force, 0.0), duration_s=0.01)
"""


def world(robots: int) -> str:
    """Robots side by side that drive over a floor."""
    wheels = "".join(WHEEL.format(side=side, y=y) for side, y in (("left", 0.17), ("right", -0.17)))
    models = "".join(ROBOT.format(number=number, wheels=wheels) for number in range(robots))
    floor = """<model name="floor"><static>1</static><link name="l"><collision name="c"><geometry>
        <plane><normal>0 0 1</normal></plane></geometry></collision></link></model>"""
    return f'<sdf version="1.6"><world name="w">{floor}{models}</world></sdf>'


@pytest.fixture
def simulation(tmp_path: Path) -> Iterator[LoadedSimulation]:
    (tmp_path / "push.py").write_text(PUSH, encoding="utf-8")
    (tmp_path / "robots.world").write_text(world(2), encoding="utf-8")
    with trundle.load(str(tmp_path / "robots.world"), plugins=True, ros=True) as simulation:
        yield simulation


class Driver:
    """Drives a robot by its topic, from another graph loop than the simulation's."""

    def __init__(self, simulation: LoadedSimulation, loop: GraphLoop, robot: str = "robot0") -> None:
        self._simulation = simulation
        self._node = Node(f"driver_of_{robot}", loop=loop, master_uri=simulation.ros_master_uri)
        self._topic = self._node.advertise(f"/{robot}/cmd_vel", "geometry_msgs/Twist")
        listener = simulation.make_node(f"/listener_of_{robot}")
        listener.subscribe(f"/{robot}/cmd_vel", "geometry_msgs/Twist", lambda _: None)
        until(lambda: self._topic.subscribers == 2)

    def drive(self, timeline: Timeline, linear: float, angular: float) -> None:
        """Publish, and simulate until robot and listener have it: what comes later would change a repeated run."""
        inputs, record = self._simulation.inputs, self._simulation.inputs.record
        arrived: list[object] = []

        def count(repeat: Callable[[], object]) -> None:
            arrived.append(repeat)
            assert record is not None
            record(repeat)

        inputs.record = count
        self._topic.publish({"linear": {"x": linear}, "angular": {"z": angular}})
        while len(arrived) < 2:
            timeline.advance(self._simulation.time_ns + self._simulation.step_ns)
        inputs.record = record


def state(simulation: Simulation) -> bytes:
    snapshot = simulation.snapshot()
    return b"".join(
        array.tobytes() for array in (snapshot.poses, snapshot.twists, snapshot.joint_positions, snapshot.joint_efforts)
    )


def readings(simulation: LoadedSimulation) -> tuple[object, ...]:
    """Readings with noise."""
    scan, imu = (simulation.sensor(f"robot1::base::{name}").read() for name in ("laser", "imu"))
    assert isinstance(scan, RangeReading)
    return scan.ranges.tobytes(), imu


def scans(simulation: LoadedSimulation, robots: int) -> bytes:
    """Ranges of the robots' lidars, with their noise."""
    read = [simulation.sensor(f"robot{number}::base::laser").read() for number in range(robots)]
    return b"".join(scan.ranges.tobytes() for scan in read if isinstance(scan, RangeReading))


def seconds(value: float) -> int:
    return round(value * NS_PER_S)


def test_a_run_after_a_seek_repeats_exactly(simulation: LoadedSimulation) -> None:
    timeline = Timeline(simulation, wall_ns=lambda: 0)
    with GraphLoop() as loop:
        driver = Driver(simulation, loop)
        timeline.advance(seconds(0.3))
        driver.drive(timeline, 0.5, 0.2)
        timeline.advance(seconds(10))
        timeline.do(lambda sim: sim["robot1"].joint("left").command_velocity(3.0))
        timeline.advance(seconds(10.7))
        moment_ns, moment = simulation.time_ns, state(simulation)
        timeline.advance(seconds(10.8))
        driver.drive(timeline, -0.3, 0.0)
        timeline.advance(seconds(12.0))
    end_ns, end, read = simulation.time_ns, state(simulation), readings(simulation)
    assert simulation["robot0"].pose.position[0] > 0.2

    for _ in range(2):
        timeline.seek(moment_ns)
        assert simulation.time_ns == moment_ns
        assert state(simulation) == moment
        timeline.advance(end_ns)
        assert state(simulation) == end
        assert readings(simulation) == read


@pytest.mark.slow
def test_ten_robots_seek_back_ten_seconds_and_continue_to_the_bit(tmp_path: Path) -> None:
    """Each drives and has a lidar; commands come by topic, as from the page's disc, and as the page's edits."""
    (tmp_path / "push.py").write_text(PUSH, encoding="utf-8")
    (tmp_path / "robots.world").write_text(world(10), encoding="utf-8")
    with trundle.load(str(tmp_path / "robots.world"), plugins=True, ros=True) as simulation, GraphLoop() as loop:
        timeline = Timeline(simulation, wall_ns=lambda: 0)
        drivers = [Driver(simulation, loop, f"robot{number}") for number in range(10)]
        for number, driver in enumerate(drivers):
            driver.drive(timeline, 0.1 * number, 0.05)
        timeline.advance(seconds(2))
        first: list[bytes] = []
        for tenth in range(21, 121):
            timeline.advance(seconds(tenth / 10))
            first.append(state(simulation) + scans(simulation, 10))
            if tenth % 9 == 0:
                drivers[tenth // 9 % 10].drive(timeline, -0.2, 0.4)
            if tenth == 55:
                timeline.advance(seconds(5.55))
                timeline.do(lambda sim: sim["robot3"].set_pose(Pose((0.5, 3.2, 0.1))))

        timeline.seek(seconds(2))
        second: list[bytes] = []
        for tenth in range(21, 121):
            timeline.advance(seconds(tenth / 10))
            second.append(state(simulation) + scans(simulation, 10))
        assert simulation["robot9"].pose.position[0] > 0.5
        assert [index for index, pair in enumerate(zip(first, second, strict=True)) if pair[0] != pair[1]] == []


def test_a_new_command_discards_the_recorded_future(simulation: LoadedSimulation) -> None:
    timeline = Timeline(simulation, wall_ns=lambda: 0)
    timeline.advance(seconds(2.5))
    end = state(simulation)
    timeline.seek(seconds(1.2))
    assert timeline.end_ns == seconds(2.5)
    timeline.do(lambda sim: sim["robot0"].set_pose(Pose((5.0, 0.0, 0.1))))
    assert timeline.end_ns == seconds(1.2)
    timeline.advance(seconds(2.5))
    assert state(simulation) != end
    assert simulation["robot0"].pose.position[0] > 3.0
    timeline.seek(seconds(1.0))
    assert simulation["robot0"].pose.position[0] < 3.0


def test_a_seek_restores_spawned_and_deleted_models(simulation: LoadedSimulation) -> None:
    timeline = Timeline(simulation, wall_ns=lambda: 0)
    timeline.advance(seconds(1.1))
    timeline.do(lambda sim: sim.delete("robot1"))
    timeline.advance(seconds(2.2))
    end = state(simulation)
    timeline.seek(seconds(0.5))
    assert [model.name for model in simulation.models] == ["floor", "robot0", "robot1"]
    timeline.advance(seconds(2.2))
    assert [model.name for model in simulation.models] == ["floor", "robot0"]
    assert state(simulation) == end


def test_the_oldest_states_are_dropped_at_the_memory_limit(simulation: LoadedSimulation) -> None:
    timeline = Timeline(simulation, limit_bytes=1, wall_ns=lambda: 0)
    timeline.advance(seconds(0.5))
    for second in range(1, 4):
        timeline.advance(seconds(second))
    assert timeline.start_ns == seconds(3)
    with pytest.raises(UsageError, match=r"0\.500 s is not part of the timeline, which is from 3\.000 to 3\.000 s"):
        timeline.seek(seconds(0.5))


@pytest.mark.skipif(not STATM.exists(), reason="this system does not say there how much memory a process has")
def test_the_timelines_memory_is_bounded(tmp_path: Path) -> None:
    world = tmp_path / "small.world"
    world.write_text("<sdf version='1.6'><world name='w'><model name='m'><link name='l'/></model></world></sdf>")
    simulation = trundle.load(world)
    timeline = Timeline(simulation, limit_bytes=20_000_000, wall_ns=lambda: 0)
    sizes: list[int] = []
    for second in range(1, 301):
        timeline.advance(seconds(second))
        sizes.append(int(STATM.read_text().split()[1]) * os.sysconf("SC_PAGESIZE"))
    assert sizes[-1] - sizes[0] < 40_000_000
    assert timeline.end_ns - timeline.start_ns > seconds(20)


def test_a_reset_of_time_starts_a_new_timeline(simulation: LoadedSimulation) -> None:
    timeline = Timeline(simulation, wall_ns=lambda: 0)
    timeline.advance(seconds(2))
    simulation.reset()
    timeline.advance(seconds(0.5))
    assert (timeline.start_ns, timeline.end_ns) == (seconds(0.5), seconds(0.5))
    timeline.advance(seconds(2))
    poses = simulation.snapshot().poses
    timeline.seek(seconds(1))
    timeline.advance(seconds(2))
    assert np.array_equal(simulation.snapshot().poses, poses)
