"""World behind /gazebo on a graph of its own, for tests."""

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import pytest
from tests.graphs import PATIENCE_S, running_graph, until

from trundle.base.diagnostics import Diagnostics
from trundle.gazebo.nodes import NodeHost
from trundle.gazebo.nodes.gazebo import GazeboServer
from trundle.live.gazebo.world import GazeboWorld
from trundle.live.graph import Graph
from trundle.ros import DISTROS, GraphLoop, Message, Node


class Gazebo:
    """GazeboServer, and a client node."""

    def __init__(self, loop: GraphLoop, uri: str, folder: Path) -> None:
        self.loop, self.folder = loop, folder
        self.lines: list[str] = []
        self.report = Diagnostics()
        self.world = GazeboWorld(
            graph=Graph(loop, uri, None, "127.0.0.1"),
            start=folder,
            env={"HOME": str(folder)},
            report=self.report,
            folder=folder,
            say=self.lines.append,
            page=None,
        )
        self.host = NodeHost(simulator=self.world)
        self.client = Node("/client", loop=loop, master_uri=uri)

    def start(self, distro: str = "noetic", world: str = "", remappings: Mapping[str, str] | None = None) -> None:
        """Start the server, with an empty world or that of an SDF text, and remappings of its names."""
        words = ["-u", "-e", "ode"]
        if world:
            (self.folder / "w.world").write_text(world)
            words.append(str(self.folder / "w.world"))
        self.server = Node("/gazebo", loop=self.loop, master_uri=self.client.master_uri, remappings=remappings)
        self.server.profile = DISTROS[distro]
        self.loop.spawn(GazeboServer(self.server, words, self.host).run())
        wait = self.client.wait_for_service("/gazebo/unpause_physics", PATIENCE_S)
        self.loop.run(wait, timeout_s=PATIENCE_S)
        self.loop.run(self.server.wait_registered())

    def call(self, name: str, kind: str = "std_srvs/Empty", **fields: Any) -> Message:
        """Call a service of the server."""
        return self.loop.run(self.client.call_service(f"/gazebo/{name}", kind, fields), timeout_s=PATIENCE_S)

    def spawn(self, xml: str, name: str, *, x: float = 0.0, **fields: Any) -> Message:
        """Spawn a model from its text."""
        pose = {"position": {"x": x}}
        return self.call(
            "spawn_sdf_model", "gazebo_msgs/SpawnModel", model_name=name, model_xml=xml, initial_pose=pose, **fields
        )

    def state(self, name: str, relative_to: str = "") -> Message:
        """State of a model."""
        kind = "gazebo_msgs/GetModelState"
        return self.call("get_model_state", kind, model_name=name, relative_entity_name=relative_to)

    @property
    def time_s(self) -> float:
        """Simulation time [s]."""
        return self.call("get_world_properties", "gazebo_msgs/GetWorldProperties").sim_time

    def until_s(self, seconds: float) -> None:
        """Wait until a simulation time [s]."""
        until(lambda: self.time_s >= seconds)

    def subscribe(self, topic: str, kind: str) -> list[Message]:
        """Collect a topic's messages from now on; return once a publisher is connected."""
        messages: list[Message] = []
        subscription = self.client.subscribe(topic, kind, messages.append, queue_size=None)
        until(lambda: subscription.publishers)
        return messages

    def advertise(self, topic: str, kind: str) -> Callable[[dict[str, Any]], None]:
        """Return a function that publishes on a topic, once a subscriber is connected."""
        publisher = self.client.advertise(topic, kind, queue_size=None)
        until(lambda: publisher.has_subscribers)
        return publisher.publish


@pytest.fixture
def bare_gazebo(tmp_path: Path) -> Iterator[Gazebo]:
    """Server not yet started, so that parameters can be set before."""
    with running_graph() as running:
        gazebo = Gazebo(running.loop, running.core.uri, tmp_path)
        yield gazebo
        gazebo.world.close()


@pytest.fixture
def gazebo(bare_gazebo: Gazebo) -> Gazebo:
    bare_gazebo.start()
    return bare_gazebo
