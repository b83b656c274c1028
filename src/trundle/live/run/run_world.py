"""`trundle run`: simulates one world, with its page, ROS interface and recording."""

import os
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, TrundleError, UsageError
from trundle.base.http.page_address import PageAddress
from trundle.base.signals import StopFlag, stop_flag
from trundle.gazebo.plugin_error import plugin_error
from trundle.page.network_warning import warn_of_network
from trundle.robots.load_input import report_workspace
from trundle.robots.packages import Packages
from trundle.sim.physics import SimulationUnstableError
from trundle.sim.realtime_pacer import RealtimePacer, shorten_gil_interval
from trundle.sim.simulation import Simulation, with_actors
from trundle.spatial import NS_PER_S

from .run_options import RunOptions
from .run_result import RunResult
from .running_world import RunningWorld

if TYPE_CHECKING:  # a run without a page starts without its modules
    from trundle.page.simulated_world.page import SimulationPage

    from .compared_recording import ComparedRecording

_MAX_RESETS = 10
"""Resets after which --on-instability reset exits."""
_PROGRESS_PERIOD_S = 5.0


def run(file: str, options: RunOptions, environment: Mapping[str, str] | None = None) -> RunResult:
    """Simulate a description.

    Args:
        file: path, folder with model.config, model://NAME, or package://NAME/FILE.
        options: run options.
        environment: environment variables; None: os.environ.

    Raises:
        TrundleError: an invalid file or request.
    """
    env = dict(os.environ if environment is None else environment)
    report = Diagnostics(strict=options.strict)
    show = Console(sys.stderr, report)
    if options.ros:
        from ..graph import master_notice

        if joined := master_notice(env):
            show.line(f"{joined}: another process started it")
    if options.headless and options.compare is not None:
        raise UsageError("--compare needs the page: leave --headless out, or record and use trundle compare")
    compared = None
    if options.compare is not None:
        from .compared_recording import ComparedRecording

        compared = ComparedRecording.read(options.compare, has_graph=options.ros)
    warn_of_network(options.host, show.line)
    report_workspace(file, Packages(env, start=Path.cwd()), show.line)
    world = RunningWorld(file, options, env, report, show)  # Ctrl-C still ends the process at once
    reference = None if compared is None else compared.reference(world.simulation)
    with stop_flag() as stop, ExitStack() as resources:
        resources.callback(world.close)
        world.start()
        page = None
        if not options.headless:
            page = resources.enter_context(_open_page(world, options, compared, show.line))
            if reference is not None:
                page.compare(reference)
        wall_s = _simulate(world, page, options, stop, show.line)
        show.findings()
        simulation = world.simulation
        return RunResult(
            world=with_actors(world.loaded.nested, report),
            snapshot=simulation.snapshot(),
            steps=simulation.simulated_steps,
            simulated_s=simulation.simulated_ns / NS_PER_S,
            wall_s=wall_s,
            images=world.live.image_count,
            report=report,
            interrupted=stop.is_set(),
            recording_failed=world.recorder is not None and world.recorder.has_failed,
        )


def _open_page(
    world: RunningWorld, options: RunOptions, compared: "ComparedRecording | None", say: Callable[[str], None]
) -> "SimulationPage":
    """Serve the page; with ROS it joins the graph, and can publish /cmd_vel."""
    from trundle.page import GraphAddress
    from trundle.page.shared_page import SharedPage
    from trundle.page.simulated_world.page import SimulationPage

    from ..state_logs import PageRecording

    ros = world.ros
    page = SimulationPage(
        SharedPage(
            say=say,
            at=PageAddress(host=options.host, port=options.port, allowed=options.allowed, view_only=options.view_only),
            graph=None if ros is None else GraphAddress(master_uri=ros.graph.master_uri, host=ros.graph.host),
            opens_browser=options.opens_browser,
            reference=None if compared is None else compared.bag,
            lesson=options.lesson,
        ),
        world.live,
        node=None if ros is None else ros.node,
        recorder=PageRecording(world.simulation, say),
    )

    def reload() -> None:
        page.end_recording()
        world.reload()
        node = None if world.ros is None else world.ros.node
        page.show(world.live, node=node, recorder=PageRecording(world.simulation, say))
        say(f"{world.simulation.world.name} is loaded again")

    page.on_reload = reload
    return page


def _simulate(
    world: RunningWorld,
    page: "SimulationPage | None",
    options: RunOptions,
    stop: StopFlag,
    say: Callable[[str], None],
) -> float:
    """Step until the end of --duration, a failed recording or Ctrl-C; return the wall time taken [s].

    Raises:
        SimulationUnstableError: the physics is unstable, and --on-instability is exit.
        TrundleError: a user's plugin raised an exception.
    """
    end_ns = None if options.duration_s is None else round(options.duration_s * NS_PER_S)
    pacer = RealtimePacer(options.speed)
    shorten_gil_interval()
    paused = options.paused
    resets = 0

    def warn(text: str) -> None:
        say(text)
        if page is not None:
            page.warn(text)

    progress = RunProgress(say, end_ns=end_ns) if page is None and sys.stderr.isatty() else None
    started = time.monotonic()
    while not stop.is_set() and (end_ns is None or world.simulation.time_ns < end_ns):
        try:
            if page is not None:
                paused = page.handle_requests(pacer, paused=paused)
                page.update(pacer, paused=paused)
            if paused:
                world.simulation.inputs.run_calls()
                stop.wait(0.02)
                pacer.restart()
                continue
            target_ns = pacer.next_target(world.simulation.time_ns)
            world.live.advance(target_ns if end_ns is None else min(target_ns, end_ns))
        except SimulationUnstableError as error:
            resets += 1
            paused = _recover(world.simulation, options, error, resets, warn)
            pacer.restart()
            continue
        except TrundleError:
            raise
        except Exception as error:  # a plugin may raise anything
            if (failure := plugin_error(error)) is None:
                raise
            raise failure from None
        if progress is not None:
            progress.update(world.simulation.time_ns)
        if world.ros is not None:
            world.ros.tick(wait=pacer.speed is None)
        if world.recorder is not None and world.recorder.has_failed:
            break
    return time.monotonic() - started


def _recover(
    simulation: Simulation, options: RunOptions, error: SimulationUnstableError, resets: int, say: Callable[[str], None]
) -> bool:
    """React to unstable physics by --on-instability; return True if the simulation is paused now."""
    match options.on_instability or ("exit" if options.headless else "pause"):
        case "pause":
            say(f"{error}; the simulation is paused at its last stable state, at {simulation.time_ns / NS_PER_S:.3f} s")
            return True
        case "reset" if resets <= _MAX_RESETS:
            say(f"{error}; the simulation is reset")
            simulation.reset()
            return False
        case _:
            raise error


class RunProgress:
    """Prints a line every few seconds in a run without a page."""

    def __init__(
        self, say: Callable[[str], None], *, end_ns: int | None, now: Callable[[], float] = time.monotonic
    ) -> None:
        """Start counting; `end_ns` is the end of the run in simulation time [ns], if it has one."""
        self._say, self._end_ns, self._now = say, end_ns, now
        self._last: tuple[float, int] | None = None
        """Wall time [s] and simulation time [ns] of the last line."""

    def update(self, time_ns: int) -> None:
        """Print the simulation time [ns] and the speed since the last line, if one is due."""
        wall = self._now()
        if self._last is None or time_ns < self._last[1]:
            self._last = (wall, time_ns)
        elapsed = wall - self._last[0]
        if elapsed < _PROGRESS_PERIOD_S:
            return
        of = "" if self._end_ns is None else f" of {self._end_ns / NS_PER_S:g}"
        speed = (time_ns - self._last[1]) / NS_PER_S / elapsed
        self._say(f"{time_ns / NS_PER_S:.1f}{of} s simulated, {speed:.3g} times real time; Ctrl-C ends it")
        self._last = (wall, time_ns)
