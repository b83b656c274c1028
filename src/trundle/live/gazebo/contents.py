"""World behind /gazebo, into which models are spawned from texts."""

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import DescriptionError, Diagnostics, UsageError
from trundle.base.xmlnode import parse_xml
from trundle.robots.description import load
from trundle.robots.model import Model, World
from trundle.robots.packages import Packages
from trundle.robots.robot import Robot
from trundle.ros import Node, StaticTransformBroadcaster
from trundle.ros.bridge import ClockTopic
from trundle.sim.physics import BackgroundCutting
from trundle.sim.renderers import RendererName
from trundle.sim.simulation import Simulation
from trundle.spatial import Pose

from ..graph import Graph
from ..live_world import LiveWorld
from ..model_interfaces import ModelInterfaces
from ..simulation_clock import SimulationClock
from ..state_logs import WorldRecorder
from .world_setup import WorldSetup

_URDF = re.compile(r"<robot[\s>]")


class GazeboContents:
    """Live world of one gzserver, its state logs and its plugins' nodes; used on the simulation's thread only."""

    def __init__(
        self,
        world: World,
        node: Node,
        *,
        graph: Graph,
        packages: Packages,
        env: Mapping[str, str],
        folder: Path,
        report: Diagnostics,
        renderer: RendererName,
        clock_hz: float | None,
        post: Callable[[Callable[[], object]], None],
        say: Callable[[str], None],
        setup: WorldSetup | None,
        is_lockstep: bool,
    ) -> None:
        """Compile the world; `load` starts its sensors and plugins.

        Args:
            world: the world's description.
            node: gzserver's node.
            graph: ROS graph that the plugins' nodes join.
            packages: resolves URIs of spawned models.
            env: environment variables that locate plugins.
            folder: folder for the text of each spawned model.
            report: collects findings of spawned models and physics.
            renderer: draws the cameras' images.
            clock_hz: rate of /clock [Hz]; None: the default.
            post: calls a function on this thread.
            say: prints which plugins are loaded, and the paths of logs.
            setup: sets the seed, changes the world and spawned models; None: no changes.
            is_lockstep: True: cut hollow meshes before time advances, so that runs repeat; False: in the background.
        """
        self._node, self._graph, self._post = node, graph, post
        self._folder, self._report, self._say = folder, report, say
        self._cutting = (
            None if is_lockstep else BackgroundCutting(say, lambda count: post(lambda: self._use_cuts(count)))
        )
        seed = 0 if setup is None else setup.seed
        simulation = Simulation(world, report, seed=seed, cutting=self._cutting)
        self.clock = SimulationClock(graph.loop, simulation)
        """Time of the plugins' nodes."""
        self._setup = setup
        if setup is not None:
            setup.start(simulation, node)
        ClockTopic(node, rate_hz=clock_hz).attach(simulation)
        self.live = LiveWorld(simulation, packages=packages, environment=env, say=say, renderer=renderer)
        self._recorder: WorldRecorder | None = None

    def load(self, record: Path | None, server_plugins: Sequence[str]) -> None:
        """Start state logs in a folder (None: without), sensors and plugins, those of the server first."""
        live, simulation = self.live, self.live.simulation
        if record is not None:
            self._recorder = WorldRecorder(simulation, record / "state.log", self._say)
            simulation.add_hook(self._recorder, period_ns=self._recorder.period_ns)
        live.start_sensors()
        broadcaster = StaticTransformBroadcaster(self._node)
        live.join_graph(ModelInterfaces(self._node, broadcaster, simulation, self._make_node))
        live.load_plugins(server_plugins)

    def _make_node(self, name: str) -> Node:
        graph, simulation = self._graph, self.live.simulation
        node = Node(
            name,
            loop=graph.loop,
            master_uri=graph.master_uri,
            clock=self.clock,
            deliver=lambda callback: self._post(lambda: simulation.inputs.call(callback)),
            remappings=self._node.remappings,  # of all nodes of the process, as in roscpp
            host=graph.host,
        )
        node.profile = self._node.profile
        return node

    def spawn(self, xml: str, *, name: str, world_from_model: Pose, namespace: str) -> None:
        """Add a model with its sensors and plugins."""
        if any(model.name == name for model in self.live.simulation.models):
            raise UsageError(f"Failure - model name {name} already exist.")
        model, robot = _read_spawned(
            xml, name=name, namespace=namespace, folder=self._folder, packages=self.live.packages, report=self._report
        )
        pose = world_from_model @ model.world_from_model
        model = replace(model, name=name, world_from_model=pose)
        self.live.spawn(model if self._setup is None else self._setup.model(model), robot)

    def _use_cuts(self, count: int) -> None:
        """Replace the provisional hulls of hollow meshes by their convex pieces."""
        self.live.simulation.recompile()
        if count:
            self._say(f"{count} hollow meshes are cut, and collide as their convex pieces from now on")

    def close_logs(self) -> None:
        """Complete the state logs."""
        if self._recorder is not None:
            self._recorder.close()
            self._recorder = None

    def close_plugins(self) -> None:
        """Shut down the plugins' nodes without waiting, and cut no more meshes; from any thread."""
        if self._cutting is not None:
            self._cutting.close()
        self.live.close()


def _read_spawned(
    xml: str, *, name: str, namespace: str, folder: Path, packages: Packages, report: Diagnostics
) -> tuple[Model, Robot | None]:
    """Read the only model of an SDF or URDF text; for URDF, return its own tree, too.

    Args:
        xml: SDF or URDF; written to a file, so that messages can name its lines.
        name: the model's name in the world.
        namespace: robotNamespace for plugins without one, as in gazebo_ros; empty: leave them.
        folder: folder of that file.
        packages: resolves URIs.
        report: collects all findings.

    Raises:
        TrundleError: no model, or several.
    """
    if not xml.strip():
        raise UsageError(f"model {name!r}: its text is empty")
    suffix = "urdf" if _URDF.search(xml) else "sdf"
    file = folder / f"{re.sub(r'[^A-Za-z0-9_.-]', '_', name)}.{suffix}"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(_in_namespace(xml, namespace) if namespace else xml, encoding="utf-8")
    loaded = load(str(file), report, packages=packages)
    models = loaded.world.models
    if len(models) != 1:
        raise UsageError(f"model {name!r}: the text describes {len(models)} models; one is needed")
    return models[0], loaded.robot


def _in_namespace(xml: str, namespace: str) -> str:
    """Write <robotNamespace> into every plugin that has none."""
    try:
        root = parse_xml(xml, name="", report=Diagnostics())
    except DescriptionError:
        return xml  # the reader reports it with its line
    pending = [root]
    while pending:
        node = pending.pop()
        if node.tag != "plugin":
            pending += node.children
        elif node.find("robotNamespace") is None:
            node.write("robotNamespace", namespace)
    return root.xml()
