"""What `roscore` starts: the master with its parameters, and the node that gathers what all others log."""

import asyncio
import uuid
from collections.abc import Callable
from pathlib import Path

from ..distro import NOETIC, Distro
from ..master.master import Master
from ..master.parameters import ParameterTree
from ..messages.messages import Message
from ..node.loop import GraphLoop
from ..node.node import Node
from ..node.publisher import Publisher
from .logs import CoreLogs


class Core:
    """A master and /rosout, on one loop."""

    def __init__(
        self,
        loop: GraphLoop,
        *,
        port: int = 11311,
        host: str | None = None,
        run_id: str | None = None,
        rosout: bool = True,
        profile: Distro = NOETIC,
        on_shutdown: Callable[[str], None] | None = None,
        log_folder: Callable[[str], Path | None] | None = None,
    ) -> None:
        """Prepare; `start` listens.

        Args:
            loop: where it runs.
            port: 0 takes any free one.
            host: address to listen at; loopback by default.
            run_id: names this run; new by default.
            rosout: whether to gather logs.
            profile: which distribution it says it is.
            on_shutdown: called, on the loop and with the reason, when a client asks the master to stop.
            log_folder: makes the folder for master.log and rosout.log from the run_id; no logs by default.
        """
        self._loop = loop
        self._port = port
        self._host = host
        self._run_id = run_id or str(uuid.uuid1())
        self._wants_rosout = rosout
        self._profile = profile
        self._master = Master(on_shutdown=on_shutdown)
        self._log_folder = log_folder
        self._logs: CoreLogs | None = None
        self._rosout: Node | None = None
        self._gathered: Publisher | None = None
        self._is_stopping = False
        loop.work.add_source(lambda: self._master.is_busy)

    @property
    def uri(self) -> str:
        """Address of the master."""
        return self._master.uri

    @property
    def port(self) -> int:
        """Where the master listens."""
        return self._master.port

    @property
    def run_id(self) -> str:
        """Names this run."""
        return self._run_id

    @property
    def parameters(self) -> ParameterTree:
        """The parameters as they are; to set one, `set_param` also tells the nodes that follow it."""
        return self._master.parameters

    def set_param(self, name: str, value: object) -> None:
        """Set a parameter by its global name, on the loop."""
        self._master.set_param(name, value)

    async def start(self) -> None:
        """Listen.

        Raises:
            PortTakenError: another program listens there.
            TrundleError: as `log_folder` does.
        """
        await self._master.start(self._port, self._host)
        folder = None if self._log_folder is None else self._log_folder(self._run_id)
        if folder is not None:
            self._logs = CoreLogs(folder, self.parameters)
            self._logs.log_master(f"Master initialized: port[{self.port}], uri[{self.uri}]")
            self._master.on_call = self._logs.log_call
        profile = self._profile
        for name, value in (("run_id", self._run_id), ("rosdistro", profile.distro), ("rosversion", profile.version)):
            # roslaunch writes both with a newline at the end, as `rosversion -d > file` does; clients strip it.
            self._master.set_param(f"/{name}", value if name == "run_id" else f"{value}\n")
        if self._wants_rosout:
            self._start_rosout()

    def _start_rosout(self) -> None:
        node = self._rosout = Node("rosout", loop=self._loop, master_uri=self.uri, host=self._host)
        self._gathered = node.advertise("/rosout_agg", "rosgraph_msgs/Log", queue_size=100)
        node.subscribe("/rosout", "rosgraph_msgs/Log", self._on_log, queue_size=100)

        def respawn(_reason: str) -> None:
            self._loop.spawn(self._respawn_rosout(node))

        node.on_shutdown(respawn)

    async def _respawn_rosout(self, killed: Node) -> None:
        """Start it again after `rosnode kill`, as roscore does."""
        await killed.closed.wait()
        if not self._is_stopping:
            self._start_rosout()

    def _on_log(self, message: Message) -> None:
        if self._gathered is not None:
            self._gathered.publish(message)
        if self._logs is not None:
            self._logs.log_message(message)

    async def wait_ready(self) -> None:
        """Wait until /rosout is there too."""
        if self._rosout is not None:
            await self._rosout.wait_registered()

    async def stop(self) -> None:
        """End /rosout, then the master."""
        self._is_stopping = True
        if self._rosout is not None:
            await self._rosout.shutdown()
        await self._master.stop()
        if self._logs is not None:
            await asyncio.to_thread(self._logs.close)
