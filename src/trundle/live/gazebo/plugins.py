"""Plugins of the world behind /gazebo, and their nodes, as models come and go."""

from collections.abc import Callable, Mapping

from trundle.gazebo.model_plugins import load_plugins, load_world_plugins
from trundle.ros import Clock, Deliver, Node
from trundle.sim.simulation import ModelHandle, Simulation

from ..graph import Graph
from ..model_nodes import ModelNodes


class GazeboPlugins:
    """Plugins of one simulation; each has a node of its own, which ends with its model."""

    def __init__(
        self,
        simulation: Simulation,
        server: Node,
        *,
        graph: Graph,
        env: Mapping[str, str],
        clock: Clock,
        deliver: Deliver,
        say: Callable[[str], None],
    ) -> None:
        """Prepare; `load` loads the plugins.

        Args:
            simulation: the plugins act on it.
            server: gzserver's node; the plugins' nodes get its distribution.
            graph: of their nodes.
            env: variables that locate plugins.
            clock: their nodes' time.
            deliver: runs their nodes' callbacks on the simulation's thread.
            say: prints which plugins are loaded.
        """
        self._simulation = simulation
        self._server = server
        self._graph = graph
        self._env = env
        self._clock = clock
        self._deliver = deliver
        self._say = say
        self._nodes = ModelNodes(graph.loop, self._node)

    def load(self) -> None:
        """Load the plugins of every model, then those of the world."""
        for model in self._simulation.models:
            self.load_model(model)
        load_world_plugins(self._simulation, self._nodes.maker(""), self._env, say=self._say)

    def load_model(self, model: ModelHandle) -> None:
        """Load the plugins of a model."""
        load_plugins(self._simulation, self._nodes.maker(model.name), self._env, say=self._say, models=[model])

    def unload(self, model: str) -> None:
        """Shut down the nodes of a deleted model."""
        self._nodes.shut_down(model)

    def close(self) -> None:
        """Shut down every node without waiting; from any thread."""
        self._nodes.close()

    def _node(self, name: str) -> Node:
        graph = self._graph
        node = Node(
            name,
            loop=graph.loop,
            master_uri=graph.master_uri,
            clock=self._clock,
            deliver=self._deliver,
            host=graph.host,
        )
        node.profile = self._server.profile
        return node
