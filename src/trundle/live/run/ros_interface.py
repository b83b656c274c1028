"""ROS interface of a simulation: its node, clock, frames, sensor topics and parameters on the graph."""

from collections.abc import Callable, Mapping
from typing import Self

from trundle.ros import GraphLoop, Node, StaticTransformBroadcaster
from trundle.ros.bridge import ClockTopic, FrameNames, JointStatesTopic, LinkTransforms

from ..graph import DEFAULT_PORT, Graph
from ..live_world import LiveWorld
from ..model_interfaces import ModelInterfaces
from ..simulation_clock import SimulationClock
from ..world_setup import LoadedWorld

NODE_NAME = "/trundle"


class RosInterface:
    """Node, topics and parameters of one world."""

    def __init__(self, graph: Graph, live: LiveWorld, loaded: LoadedWorld) -> None:
        """Advertise a world on a graph; its sensors must have started."""
        simulation = live.simulation
        self._graph = graph
        self._simulation = simulation
        self._nodes: list[Node] = []
        self.clock = SimulationClock(graph.loop, simulation)
        self.node = self.make_node(NODE_NAME)
        loop = graph.loop
        loop.run(self.node.wait_registered())
        loop.run(self.node.params.set("/use_sim_time", True))
        ClockTopic(self.node).attach(simulation)
        static_broadcaster = StaticTransformBroadcaster(self.node)
        frames = LinkTransforms(self.node, static_broadcaster, loaded.flat, simulation.snapshot())
        simulation.on_change(lambda: frames.set_world(simulation.world, simulation.snapshot()))
        simulation.add_hook(frames, period_ns=frames.period_ns, enabled=frames.enabled, name="/tf")
        names = FrameNames.from_world(loaded.flat, loaded.robot)
        live.join_graph(ModelInterfaces(self.node, static_broadcaster, simulation, self.make_node, frames=names))
        if loaded.urdf is not None:
            loop.run(self.node.params.set("/robot_description", loaded.urdf))
            states, robot = JointStatesTopic(self.node, simulation.models[0]), simulation.models[0].name
            simulation.on_change(
                lambda: states.set_model(next((model for model in simulation.models if model.name == robot), None))
            )
            simulation.add_hook(states, period_ns=states.period_ns, enabled=states.enabled, name="/joint_states")

    @classmethod
    def open(
        cls,
        live: LiveWorld,
        loaded: LoadedWorld,
        environment: Mapping[str, str],
        *,
        host: str,
        on_open: Callable[[GraphLoop], None] = lambda _loop: None,
    ) -> Self:
        """Join or start a graph, call `on_open` with its loop, and advertise the world."""
        graph = Graph.open(environment, host=host, ports=(DEFAULT_PORT, 0))
        try:
            on_open(graph.loop)
            return cls(graph, live, loaded)
        except BaseException:
            graph.close()
            raise

    @property
    def graph(self) -> Graph:
        """ROS graph of the simulation."""
        return self._graph

    def make_node(self, name: str) -> Node:
        """Make a node on simulation time; its callbacks run on the simulation's thread between two steps.

        Services answer while the simulation is paused, too.
        """
        simulation = self._simulation
        node = Node(
            name,
            loop=self._graph.loop,
            master_uri=self._graph.master_uri,
            clock=self.clock,
            deliver=simulation.inputs.post_callback,
            deliver_call=simulation.inputs.post_call,
            host=self._graph.host,
        )
        self._nodes.append(node)
        return node

    def settle(self) -> None:
        """Wait until this process's nodes are registered and connected, so that no message is lost."""
        self._graph.loop.wait_idle()

    def tick(self, *, wait: bool) -> None:
        """Set the nodes' clock at the end of a stride.

        Args:
            wait: True: wait until every published message has reached the nodes of this process, as flat-out runs do,
                so that delivery order does not depend on the machine's speed.
        """
        self.clock.set(self._simulation.time_ns)
        if wait:
            self._graph.loop.flush_deliveries()

    def replace_world(self, live: LiveWorld, loaded: LoadedWorld) -> Self:
        """Leave the graph, and return the interface of another world on it."""
        for node in self._nodes:
            self._graph.loop.run(node.shutdown())
        return type(self)(self._graph, live, loaded)

    def close(self) -> None:
        """Leave the graph; stop its master if it was started here."""
        self._graph.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
