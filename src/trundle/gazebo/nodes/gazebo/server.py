"""gazebo_ros/gzserver: a simulated world with /gazebo's services and topics."""

import asyncio
import re
from typing import NamedTuple

from trundle.base.diagnostics import TrundleError
from trundle.ros import Node

from ..host import NodeHost, Simulator
from .load_services import advertise_load_services
from .model_services import advertise_model_services
from .ode import OdeSettings
from .pause_services import advertise_pause_services
from .performance_metrics import MetricsTopic
from .property_getters import advertise_property_getters
from .property_setters import advertise_property_setters
from .reconfigure import advertise_options
from .state_services import advertise_state_services
from .state_topics import StateTopics

_EMPTY_WORLD = "worlds/empty.world"
_OPTIONS_WITH_VALUE = frozenset(
    {
        *("-e", "--physics", "-p", "--play", "-s", "--server-plugin", "-o", "--profile", "--seed", "--iters"),
        *("--record_path", "--record_period", "--record_filter", "--initial_sim_time", "--lockstep"),
    }
)
_PROVIDED_PLUGINS = re.compile(r"libgazebo_ros_(api_plugin|paths_plugin|init|factory|state)\.so$")
"""Server plugins whose functions this node provides."""
_UNSUPPORTED = {"-p": "playing a log", "--play": "playing a log"}


class _Arguments(NamedTuple):
    world: str
    paused: bool
    record: str | None
    """Folder of state logs, "" for the default; None: no logs."""
    server_plugins: list[str]


class GazeboServer:
    """Simulates a world and serves /gazebo; the window is gzclient's."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._node = node
        self._arguments = arguments
        self._simulator = host.simulator
        self._env = host.env

    async def run(self) -> int:
        """Simulate until cancelled."""
        node, simulator = self._node, self._simulator
        if simulator is None:
            node.log.fatal("simulation is not available here")
            return 1
        given = self._read_arguments()
        if not await node.params.has("/use_sim_time"):
            await node.params.set("/use_sim_time", True)
        try:
            await simulator.open(
                node,
                given.world,
                paused=given.paused,
                env=self._env,
                record=given.record,
                server_plugins=given.server_plugins,
            )
        except TrundleError as error:
            node.log.fatal(str(error))
            return 1
        try:
            await self._serve(simulator)
        finally:
            await asyncio.to_thread(simulator.close)
        return 0

    async def _serve(self, simulator: Simulator) -> None:
        node = self._node
        node.deliver = simulator.post
        topics, metrics = StateTopics(node, simulator), MetricsTopic(node, simulator)
        self._advertise(simulator)
        await node.wait_registered()  # all services exist before time begins
        simulator.begin()
        while not node.closed.is_set():
            if simulator.paused and not simulator.is_lockstep and topics.has_subscribers():
                simulator.post(topics.publish)
            if metrics.due():
                simulator.post(metrics.publish)
            if simulator.is_lockstep:
                await node.clock.sleep(topics.period_s)
            else:  # in wall time, since a paused world is also published
                await asyncio.sleep(topics.period_s)

    def _advertise(self, simulator: Simulator) -> None:
        for advertise in (
            advertise_model_services,
            advertise_state_services,
            advertise_load_services,
            advertise_pause_services,
        ):
            advertise(self._node, simulator)
        ode = OdeSettings()
        for advertise in (advertise_property_getters, advertise_property_setters, advertise_options):
            advertise(self._node, simulator, ode)

    def _read_arguments(self) -> _Arguments:
        """Return what the command line asks for; options without effect are logged."""
        world, paused, record = _EMPTY_WORLD, False, None
        plugins: list[str] = []
        arguments = iter(self._arguments)
        for argument in arguments:
            option, equals, value = argument.partition("=")
            if option in _OPTIONS_WITH_VALUE and not equals:
                value = next(arguments, "")
            if option in ("-u", "--pause"):
                paused = True
            elif option in ("-r", "--record"):
                record = record or ""
            elif option == "--record_path":
                record = value
            elif option in ("-s", "--server-plugin"):
                if not _PROVIDED_PLUGINS.search(value):
                    plugins.append(value)
            elif option in _UNSUPPORTED:
                self._node.log.warn(f"gzserver {argument} {value}: {_UNSUPPORTED[option]} is not supported")
            elif option in ("-e", "--physics") and value not in ("ode", ""):
                self._node.log.info(f"physics engine {value!r} is not available; using MuJoCo")
            elif not argument.startswith("-"):
                world = argument
        return _Arguments(world, paused, record, plugins)


class Gazebo(GazeboServer):
    """gazebo_ros/gazebo: server and window."""

    async def run(self) -> int:
        """Simulate and show until cancelled."""
        if self._simulator is None:
            return await super().run()
        window = self._node.loop.spawn(self._simulator.show(self._node))
        try:
            return await super().run()
        finally:
            window.cancel()
