"""One launch: its graph, parameters, recording, page, simulation and nodes."""

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Self

from trundle.base.console import Console, say
from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.garbage import no_garbage
from trundle.base.http.page_address import PageAddress
from trundle.base.supervisor import Event, ProcessTree, StopTimeouts
from trundle.gazebo.nodes import WORLDS, Executable, NodeHost, Simulator, find_node
from trundle.robots.launch import LaunchNode, LaunchPlan
from trundle.robots.names import anonymous_name
from trundle.ros import DISTROS, Node, Recorder, RecorderOptions, StepRecorder, follow_time
from trundle.spatial import NS_PER_S

from ..graph import Graph
from ..lockstep import Lockstep
from . import printing
from .clock_publisher import ClockPublisher
from .loaded_launch import LoadedLaunch
from .logs import LaunchLog, log_folder
from .nodes import NodeStarter
from .options import LaunchOptions
from .pages import await_url, opens_page, reserved_ports
from .params import set_params
from .running_nodes import Listener, RunningNodes, launched_table
from .terminals import NodeTerminals

if TYPE_CHECKING:
    from trundle.page import PageServer
    from trundle.page.graph_page import GraphPage
    from trundle.page.shared_page import SharedPage

    from ..gazebo.world import GazeboWorld
    from ..gazebo.world_setup import WorldSetup


class LaunchSession:
    """A graph with the launch's parameters, and its nodes once started."""

    def __init__(
        self,
        loaded: LoadedLaunch,
        options: LaunchOptions,
        *,
        ports: Sequence[int] = (),
        rosout: bool = True,
        listener: Listener = lambda _event, _text: None,
        setup: "WorldSetup | None" = None,
        read_again: Callable[[], LoadedLaunch] | None = None,
    ) -> None:
        """Join or start a graph, and set the parameters.

        Args:
            loaded: the launch as read.
            options: launch options.
            ports: see `Graph.open`.
            rosout: see `Graph.open`.
            listener: called with each node's events, on the graph's thread.
            setup: changes the simulated world; None: no changes.
            read_again: reads the launch again, for `reload`, on the simulation's thread; None: not supported.
        """
        self._read_again = read_again
        self._reloaded: LoadedLaunch | None = None
        """Launch as reread on request of the page."""
        self._setup = setup
        self._gazebo: GazeboWorld | None = None
        self._loaded = loaded
        self._options = options
        self._listener = listener
        self._resources = ExitStack()
        self._running: RunningNodes | None = None
        self.recording_failed = False
        self._lockstep: Lockstep | None = None
        self._page: SharedPage | None = None
        self._display: GraphPage | None = None
        try:
            with no_garbage():
                self._open(ports, rosout=rosout)
        except BaseException:
            self._resources.close()
            raise

    def _open(self, ports: Sequence[int], *, rosout: bool) -> None:
        loaded, options, show = self._loaded, self._options, self._loaded.show
        graph = self.graph = self._resources.enter_context(
            Graph.open(
                loaded.env, host=options.host, ports=ports, rosout=rosout, log_folder=partial(log_folder, loaded.env)
            )
        )
        show.note(graph.summary)
        # Launches that join a master are many: of one name, each would shut down the one before, and stop its clock.
        caller = "/roslaunch" if graph.core is not None else f"/{anonymous_name('roslaunch')}"
        launcher = self._launcher = Node(
            caller, loop=graph.loop, master_uri=graph.master_uri, host=graph.host, rosout=False
        )
        logs = log_folder(loaded.env, str(graph.loop.run(launcher.params.get("/run_id", ""))))
        self._log = LaunchLog(logs)
        self._resources.callback(self._log.close)
        show.log_to(self._log.write)
        if options.distro is not None:
            profile = DISTROS[options.distro]
            for name, value in (("/rosdistro", profile.distro), ("/rosversion", profile.version)):
                graph.loop.run(launcher.params.set(name, f"{value}\n"))
        if options.summary and not options.core_only:
            core = {name: str(graph.loop.run(launcher.params.get(name, ""))).strip() for name in _CORE_PARAMS}
            values = {**core, **{param.name: param.value for param in loaded.params}}
            self._say(printing.summary(loaded.plan, values))
        graph.loop.run(set_params(launcher, loaded.plan, loaded.params))
        programs = self._programs()
        may_wait = options.speed is None or options.in_step
        publishes_clock = may_wait and not programs and self._may_publish_clock(launcher)
        in_step = publishes_clock or (may_wait and _has_world(loaded.plan))
        if publishes_clock or (in_step and not graph.loop.run(launcher.params.has("/use_sim_time"))):
            graph.loop.run(launcher.params.set("/use_sim_time", True))
        self.clock = graph.loop.run(follow_time(launcher))
        recorder = None if options.record is None else self._record(options.record, in_step, programs)
        if in_step:
            end_ns = None if options.duration_s is None else round(options.duration_s * NS_PER_S)
            settle = None if self._setup is None else self._setup.settle
            self._lockstep = Lockstep(graph.loop, end_ns=end_ns, recorder=recorder, say=show.line, settle=settle)
            if publishes_clock:
                show.note("no simulation publishes /clock: it is published here, as fast as the nodes can follow")
                self._resources.callback(ClockPublisher(launcher, self._lockstep).close)
        page = self._page = None if options.headless else self._shared_page()
        if page is not None:
            from trundle.page.graph_page import GraphPage

            self._display = GraphPage(page, loaded.report)
        display = self._display
        self._terminals = NodeTerminals(None if display is None else display.terminals, reads_keys=options.reads_keys)
        self._resources.callback(self._terminals.close)
        self._tree = self._resources.enter_context(ProcessTree(terminate_s=options.terminate_s))
        self.starter = self._make_starter(logs)

    def _make_starter(self, logs: Path) -> NodeStarter:
        loaded, options = self._loaded, self._options
        self._logs = logs
        simulator = self._simulator(logs) if _simulates(loaded.plan) else None
        return NodeStarter(
            graph=self.graph,
            packages=loaded.packages,
            env=loaded.env,
            report=loaded.report,
            host=NodeHost(display=self._display, simulator=simulator),
            terminals=self._terminals,
            tree=self._tree,
            log_folder=logs,
            output=options.output,
            all_required=options.all_required,
        )

    def _shared_page(self) -> "SharedPage":
        from trundle.page import GraphAddress  # a launch without a page does not import it
        from trundle.page.shared_page import SharedPage

        graph, options, loaded = self.graph, self._options, self._loaded
        page = SharedPage(
            say=loaded.show.line,
            at=PageAddress(
                host=options.host,
                port=options.view_port,
                reserved_ports=reserved_ports(loaded.plan),
                allowed=options.allowed,
                view_only=options.view_only,
            ),
            graph=GraphAddress(master_uri=graph.master_uri, host=graph.host),
            source=next(iter(loaded.plan.files), None),
            opens_browser=options.opens_browser,
            lesson=options.lesson,
        )
        self._resources.callback(page.close)
        return page

    def _record(self, file: Path, in_step: bool, programs: Sequence[str]) -> StepRecorder | None:
        """Record every topic into a bag; return the recorder if it writes in lockstep with the nodes."""
        graph = self.graph
        if in_step and not programs:
            steps = StepRecorder(
                graph.loop,
                file,
                on_failure=self._report_recording_failure,
                from_ns=round(self._options.record_from_s * NS_PER_S),
                without_types=self._options.record_without,
            )
            self._resources.callback(steps.close)
            self._loaded.show.line(
                f"{file} will be the same whenever this is run; /rosout and other programs are left out"
            )
            return steps
        if self._options.speed is None:
            reason = (
                f"{', '.join(programs)} run as programs of their own"
                if programs
                else "another program publishes /clock"
            )
            self._loaded.show.line(f"{file} will differ from run to run: {reason}")
        node = Node("/record", loop=graph.loop, master_uri=graph.master_uri, host=graph.host)
        self._resources.callback(lambda: graph.loop.run(node.shutdown()))
        graph.loop.run(follow_time(node))
        options = RecorderOptions(
            all_topics=True, path=file, without_types=self._options.record_without, without_copies=True
        )
        recorder = Recorder(node, options, log=node.log.debug, on_failure=self._report_recording_failure)
        recorder.start()
        self._resources.callback(recorder.stop)
        return None

    def _report_recording_failure(self, reason: str) -> None:
        self.recording_failed = True
        self._loaded.show.line(reason)

    def _may_publish_clock(self, launcher: Node) -> bool:
        """True if nothing else publishes /clock: no simulation, no other program of a joined graph, no bag to play."""
        graph = self.graph
        if _has_world(self._loaded.plan) or graph.core is None:
            return False
        return graph.loop.run(launcher.params.get("/use_sim_time", False)) is not True

    def _programs(self) -> list[str]:
        """Names of the nodes that run as processes."""
        loaded, find = self._loaded, self._loaded.packages.find_package
        return [
            n.name
            for n in loaded.plan.nodes
            if isinstance(find_node(n.package, n.type, find, env=loaded.env), Executable)
        ]

    @property
    def has_master(self) -> bool:
        """True if this launch started the master; like roslaunch, it then outlives its last node."""
        return self.graph.core is not None

    @property
    def is_over(self) -> bool:
        """True if a launch in lockstep has reached and recorded its --duration, or its setup ended it."""
        return self._lockstep is not None and self._lockstep.over.is_set()

    def rewind(self) -> None:
        """Resume after the end of a launch in lockstep whose world was reset."""
        if self._lockstep is not None:
            self._lockstep.rewind()

    @property
    def nodes(self) -> Sequence[LaunchNode]:
        """Nodes of the launch."""
        return self._loaded.plan.nodes

    @property
    def is_paused(self) -> bool:
        """True if its world is paused."""
        return self._gazebo is not None and self._gazebo.paused

    @property
    def is_busy(self) -> bool:
        """True while this process has work that can go on without ROS time advancing."""
        return self.graph.loop.work.is_busy

    @property
    def stop_reason(self) -> str | None:
        """Reason why the world had to stop; None: it runs."""
        return None if self._gazebo is None else self._gazebo.stop_reason

    @property
    def is_lockstep(self) -> bool:
        """True if time waits for the nodes at each step."""
        return self._lockstep is not None

    def _simulator(self, logs: Path) -> Simulator:
        from ..gazebo.world import GazeboWorld  # a launch without Gazebo does not import the physics

        options, loaded = self._options, self._loaded
        gazebo = GazeboWorld(
            graph=self.graph,
            start=loaded.start,
            env=loaded.env,
            report=loaded.report,
            folder=logs / "spawned",
            say=loaded.show.line,
            page=self._page,
            speed=options.speed,
            renderer=options.renderer,
            timeline_mb=options.timeline_mb,
            reload=None if self._read_again is None else self._request_reload,
            steps=self._lockstep,
            setup=self._setup,
        )
        self._gazebo = gazebo
        self._resources.callback(gazebo.close)
        return gazebo

    def show_world(self) -> "PageServer":
        """Serve the page and show the world there once it is open, as gzclient does; return the page's server.

        Raises:
            UsageError: the requested port is in use.
        """
        assert self._page is not None, "the launch is headless"
        assert self._gazebo is not None, "the launch has no world"
        server = self._page.acquire(self._launcher, shows_world=True)
        window = self.graph.loop.spawn(self._gazebo.show(self._launcher))
        self._resources.callback(window.cancel)
        return server

    def start(
        self, nodes: Sequence[LaunchNode], *, is_ending: Callable[[], bool] = lambda: False, begins: bool = True
    ) -> RunningNodes:
        """Start nodes, until `is_ending`, and print their table.

        Args:
            nodes: nodes of the launch.
            is_ending: polled; True cancels the start.
            begins: False: time stays zero until `begin`, in lockstep.
        """
        loop, options = self.graph.loop, self._options
        timeouts = StopTimeouts(interrupt_s=options.interrupt_s, terminate_s=options.terminate_s)
        running = self._running = RunningNodes(
            self.starter, nodes, timeouts=timeouts, quiet=options.quiet, listener=self._on_event
        )
        steps = self._lockstep
        loop.run(running.start(is_ending, None if steps is None else steps.wait_started))
        if begins:
            self.begin()
        if self._display is not None and self._display.terminals:
            self._resources.callback(loop.spawn(self._show_terminals(self._display)).cancel)
        self._loaded.show.findings()
        if running.launched and not options.quiet:
            page = self._page if opens_page(running.launched) else None
            url = None if page is None else await_url(page, lambda: is_ending() or running.is_over)
            self._say(launched_table(running.launched, url))
        return running

    def _request_reload(self) -> None:
        """Read the launch again; `reload` then starts it.

        Raises:
            TrundleError: it cannot be read; the running launch continues.
        """
        if self._options.record is not None:
            raise UsageError("the bag of this launch holds one run: start it without --record to load others")
        assert self._read_again is not None
        self._reloaded = self._read_again()

    @property
    def show(self) -> Console:
        """Console that prints the findings of the launch's files."""
        return self._loaded.show

    @property
    def is_reload_due(self) -> bool:
        """True if the page has requested to load the launch again."""
        return self._reloaded is not None

    def reload(self, *, is_ending: Callable[[], bool]) -> RunningNodes:
        """Stop all nodes, and start those of the reread launch on the same graph and page."""
        loaded, self._reloaded = self._reloaded, None
        assert loaded is not None
        assert self._running is not None
        assert self._page is not None, "the page has requested it"
        self._page.acquire(self._launcher)  # keeps the page open while its windows close
        loop = self.graph.loop
        loop.run(self._running.stop())
        self._loaded = loaded
        loaded.show.log_to(self._log.write)
        if self._display is not None:
            self._display.report = loaded.report
        loop.run(set_params(self._launcher, loaded.plan, loaded.params))
        if self._lockstep is not None:
            self._lockstep.hold()
        self.starter = self._make_starter(self._logs)
        return self.start(loaded.plan.nodes, is_ending=is_ending)

    async def _show_terminals(self, display: "GraphPage") -> None:
        """Serve the page, even if no node opens a window on it."""
        try:
            await display.serve(self._launcher)
        except TrundleError as error:
            self._loaded.show.line(f"the terminals of nodes cannot be shown: {error}")

    def begin(self) -> None:
        """Let time advance, in lockstep."""
        if self._lockstep is not None:
            self._lockstep.start()

    def _say(self, text: str) -> None:
        say(text)
        self._log.write(text)

    def _on_event(self, event: Event, text: str) -> None:
        self._log.write(text)
        self._listener(event, text)

    def close(self) -> None:
        """Stop the nodes, the last one first, then everything else."""
        try:
            if self._running is not None:
                self.graph.loop.run(self._running.stop())
        finally:
            self._resources.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


_CORE_PARAMS = ("/rosdistro", "/rosversion")
"""Core parameters that roslaunch's summary shows."""


def _simulates(plan: LaunchPlan) -> bool:
    return any(node.package == "gazebo_ros" for node in plan.nodes)


def _has_world(plan: LaunchPlan) -> bool:
    """True if a node runs Gazebo's world, which publishes /clock; a spawner alone does not."""
    return any((node.package, node.type) in WORLDS for node in plan.nodes)
