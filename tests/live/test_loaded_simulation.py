"""`trundle.load` with plugins and with a ROS graph."""

import threading
from pathlib import Path

import pytest
from msgspec.structs import replace
from tests.graphs import until

import trundle
from trundle.base.diagnostics import UsageError
from trundle.live.graph import Graph
from trundle.robots.model import Sensor

WORLD = """<sdf version="1.6"><world name="w"><plugin name="blower" filename="libblower.so"/>
<model name="m"><link name="l"/><plugin name="pusher" filename="libpusher.so"/></model></world></sdf>"""
PUSHER = """
from trundle.gazebo.plugins import Plugin
from trundle.spatial import Wrench

class Pusher(Plugin):
    def __init__(self, model, node):
        self.model, self.speeds = model, []
        if node is not None:
            node.subscribe("/speed", "std_msgs/Float64", lambda message: self.speeds.append(message.data))

    @classmethod
    def load(cls, sim, model, node, tag):
        return cls(model, node)

    def before_step(self, sim):
        self.model.links[0].apply_wrench(Wrench(force=(2.0, 0.0, 9.8)))
        if self.speeds:
            self.model.links[0].set_twist(type(self.model.twist)((self.speeds.pop(), 0.0, 0.0)))
"""


@pytest.fixture
def world(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.delenv("ROS_MASTER_URI", raising=False)
    (tmp_path / "pusher.py").write_text(PUSHER)
    file = tmp_path / "w.world"
    file.write_text(WORLD)
    return file


def test_plugins_run_only_on_request(world: Path) -> None:
    """x = F t² / 2m of a push of 2 N on 1 kg."""
    still, pushed = trundle.load(world), trundle.load(world, plugins=True)
    for sim in (still, pushed):
        sim.run(1.0)

    assert still["m"].pose.position[0] == 0.0
    assert pushed["m"].pose.position[0] == pytest.approx(1.0, rel=0.01)
    assert any("'pusher' of m: " in str(finding) for finding in pushed.report.findings)
    assert [line for line in pushed.report.warnings if "libblower.so" in line]


def test_plugins_and_sensors_start_and_end_with_a_spawned_model(world: Path) -> None:
    """A plugin pushes the copy like the file's model, and its IMU has a topic until it is deleted."""
    with trundle.load(world, plugins=True, ros=True) as sim:
        imu = Sensor(name="turn", type="imu", at=sim.world.at, update_rate_hz=100.0)
        model = sim["m"].model
        copy = replace(model, name="copy", links=(replace(model.links[0], sensors=(imu,)),))
        sim.spawn(copy)
        node = sim.make_node("/me")

        def names() -> set[str]:
            published, subscribed, _ = node.loop.run(node.master.call("getSystemState"))
            return {name for _, names in (*published, *subscribed) for name in names}

        def imu_topics() -> list[str]:
            return [name for name, _ in node.loop.run(node.master.call("getPublishedTopics", "/")) if "turn" in name]

        sim.run(1.0)
        assert sim["copy"].pose.position[0] == pytest.approx(1.0, rel=0.01)
        assert sim.sensor_names == ("copy::l::turn",)
        assert "/copy/pusher" in names()
        until(imu_topics)
        sim.delete("copy")
        sim.run(0.1)
        until(lambda: "/copy/pusher" not in names() and not imu_topics())
        assert sim.sensor_names == ()


def test_own_ros_graph_carries_clock_and_commands(world: Path) -> None:
    with trundle.load(world, plugins=True, ros=True) as sim:
        times: list[float] = []
        node = sim.make_node("/me")
        node.subscribe(
            "/clock",
            "rosgraph_msgs/Clock",
            lambda message: times.append(message.clock.sec + message.clock.nanosec / 1e9),
        )
        speed = node.advertise("/speed", "std_msgs/Float64")
        sim.run(0.2)
        speed.publish({"data": 7.0})
        sim.run(0.2)
        assert sim["m"].twist.linear[0] > 7.0
        assert times[-1] == pytest.approx(0.4, abs=0.011)
        assert sim.ros_master_uri.startswith("http://")
    sim.run(0.1)
    assert sim.time_ns == 500_000_000
    with pytest.raises(UsageError, match="part of no ROS graph; load it with ros=True"):
        sim.make_node("/late")


def test_another_master_is_joined_by_its_uri(world: Path) -> None:
    with Graph.open({}, host="127.0.0.1", ports=(0,)) as graph, trundle.load(world, ros=graph.master_uri) as sim:
        assert sim.ros_master_uri == graph.master_uri
        assert graph.core is not None
        sim.run(0.1)


def test_an_unreachable_master_is_named_and_no_thread_is_left(world: Path) -> None:
    threads = threading.active_count()
    with pytest.raises(UsageError, match=r"no ROS master answers at http://192\.0\.2\.1:1 "):
        trundle.load(world, ros="http://192.0.2.1:1")
    assert threading.active_count() <= threads
