"""Fixtures for tests of the whole path from an SDF file to ROS messages."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, running_graph, until

import trundle
from trundle.ros import StaticTransformBroadcaster, Transform
from trundle.ros.bridge import FrameNames, make_camera_topics, make_sensor_topics
from trundle.sim.render import NativeRenderer
from trundle.sim.sensors import mount_cameras, mount_sensors
from trundle.sim.simulation import Simulation


@pytest.fixture
def graph() -> Iterator[SimpleNamespace]:
    """Graph with a publishing and a subscribing node."""
    with running_graph() as running:
        node, listener = running.node("sim"), running.node("listener")
        yield SimpleNamespace(loop=running.loop, node=node, listener=listener)
        for running_node in (listener, node):
            running.loop.run(running_node.shutdown(), PATIENCE_S)


Receive = Callable[..., Any]
LoadWorld = Callable[..., Simulation]


@pytest.fixture
def load_world(tmp_path: Path) -> LoadWorld:
    """Return a function that loads the content of a <world> from a file."""

    def load_world(world: str, *, seed: int = 0, version: str = "1.6") -> Simulation:
        file = tmp_path / "w.sdf"
        file.write_text(f'<sdf version="{version}"><world name="w">{world}</world></sdf>')
        return trundle.load(str(file), seed=seed)

    return load_world


@pytest.fixture
def receive(graph: SimpleNamespace, load_world: LoadWorld) -> Receive:
    """Return a function that simulates a world and returns the first message on each topic, and the static frames."""

    def receive(
        world: str, topics: Mapping[str, str], *, seconds: float = 0.1, seed: int = 0, version: str = "1.6"
    ) -> tuple[dict[str, Any], set[str]]:
        sim = load_world(world, seed=seed, version=version)
        cameras = mount_cameras(sim, NativeRenderer)
        sensors = mount_sensors(sim)
        for sensor in (*cameras, *sensors):
            sensor.start(sim)
        static_broadcaster = StaticTransformBroadcaster(graph.node)
        make_camera_topics(graph.node, static_broadcaster, cameras, FrameNames.from_world(sim.world))
        make_sensor_topics(graph.node, static_broadcaster, sensors, FrameNames.from_world(sim.world))
        static_broadcaster.send_transform(Transform(parent="world", child="the last"))
        received: dict[str, Any] = {}
        frames: set[str] = set()
        graph.listener.subscribe(
            "/tf_static", "tf2_msgs/TFMessage", lambda m: frames.update(t.child_frame_id for t in m.transforms)
        )
        for topic, type_ in topics.items():
            graph.listener.subscribe(topic, type_, lambda message, topic=topic: received.setdefault(topic, message))
            until(lambda topic=topic, type_=type_: graph.node.advertise(topic, type_).has_subscribers)
        sim.run(seconds)
        until(lambda: received.keys() == topics.keys() and "the last" in frames)
        return received, frames

    return receive
