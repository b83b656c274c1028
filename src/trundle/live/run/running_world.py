"""World of a run: its simulation with sensors, ROS interface, recording and plugins; it can be reloaded."""

from collections.abc import Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.files import is_stream
from trundle.base.garbage import no_garbage
from trundle.robots.packages import Packages
from trundle.sim.simulation import Simulation

from ..live_world import LiveWorld
from ..world_setup import LoadedWorld, load_world
from .run_options import RunOptions

if TYPE_CHECKING:  # a run without a graph or a recording starts without their modules
    from ..state_logs import WorldRecorder
    from .ros_interface import RosInterface


class RunningWorld:
    """World of a run, with its sensors, ROS interface and recording."""

    def __init__(
        self, file: str, options: RunOptions, environment: Mapping[str, str], report: Diagnostics, show: Console
    ) -> None:
        """Read and compile a description; `start` starts its sensors, ROS interface, recording and plugins.

        Args:
            file: see `run`.
            options: run options.
            environment: environment variables that locate packages, plugins and the ROS master.
            report: collects all findings.
            show: prints the findings.

        Raises:
            TrundleError: the file is invalid.
        """
        self._file = file
        self._options = options
        self._environment = environment
        self._report = report
        self._show = show
        self._resources = ExitStack()
        self.ros: RosInterface | None = None
        self.recorder: WorldRecorder | None = None
        self.loaded, self.live = self._read()

    def _read(self) -> tuple[LoadedWorld, LiveWorld]:
        options = self._options
        with no_garbage():
            packages = Packages(self._environment, start=Path.cwd())
            loaded = load_world(self._file, packages, self._report, seed=options.seed)
            live = LiveWorld(
                Simulation(loaded.flat, self._report, seed=options.seed),
                packages=packages,
                environment=self._environment,
                say=self._show.line,
                renderer=options.renderer,
                has_sensors=options.sensors,
            )
            live.on_parts = self._show.findings
            return loaded, live

    @property
    def simulation(self) -> Simulation:
        """The running simulation."""
        return self.live.simulation

    def start(self) -> None:
        """Start sensors, the ROS interface, recording and plugins.

        Raises:
            TrundleError: the graph cannot be joined, or the recording cannot be written.
        """
        self.live.start_sensors()
        self._show.findings()
        if self._options.ros:
            self._open_graph()
        if self._options.record is not None:
            self._record(self._options.record)
        self._load_plugins()

    def reload(self) -> None:
        """Read the file again, and simulate it from time zero.

        Raises:
            TrundleError: the file cannot be read; the running world continues.
        """
        if self.recorder is not None:
            raise UsageError("the recording of this run has one world: start it without --record to load others")
        if is_stream(self._file):
            raise UsageError("the world came through a pipe, which cannot be read again")
        self.loaded, self.live = self._read()
        self.live.start_sensors()
        if self.ros is not None:
            self.ros = self.ros.replace_world(self.live, self.loaded)
        self._load_plugins()

    def _open_graph(self) -> None:
        from .ros_interface import RosInterface

        self.ros = RosInterface.open(self.live, self.loaded, self._environment, host=self._options.host)
        self._resources.callback(lambda: self.ros is None or self.ros.close())
        if self.ros.graph.core is not None:
            self._show.line(self.ros.graph.summary)

    def _record(self, file: Path) -> None:
        from ..state_logs import WorldRecorder

        recorder = self.recorder = WorldRecorder(self.simulation, file, self._show.line)
        recorder.start(self.loaded.nested)
        self.simulation.add_hook(recorder, period_ns=recorder.period_ns)
        self._resources.callback(recorder.close)

    def _load_plugins(self) -> None:
        self.live.load_plugins()
        self._show.findings()
        if self._options.timeline_mb and not self._options.headless:
            self.live.keep_timeline(self._options.timeline_mb * 1_000_000)

    def close(self) -> None:
        """Stop everything that was started."""
        self._resources.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
