"""`trundle run`: simulates one world, with its page, ROS interface and recording."""

import os
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from trundle.base.console import Console
from trundle.base.diagnostics import Diagnostics, TrundleError
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
from .run_progress import RunProgress
from .run_result import RunResult
from .running_world import RunningWorld

if TYPE_CHECKING:  # a run without a page starts without its modules
    from trundle.page.simulated_world.page import SimulationPage

_MAX_RESETS = 10
"""Resets after which --on-instability reset exits."""


def run(file: str, options: RunOptions, environment: Mapping[str, str] | None = None) -> RunResult:
    """Simulate a description.

    Args:
        file: a path, a folder with model.config, model://NAME, or package://NAME/FILE.
        options: of the run.
        environment: None: os.environ.

    Raises:
        TrundleError: an invalid file or request.
    """
    env = dict(os.environ if environment is None else environment)
    report = Diagnostics(strict=options.strict)
    show = Console(sys.stderr, report)
    if options.ros:
        from ..graph import master_notice

        if joined := master_notice(env):
            show.line(f"{joined}: something else started it")
    warn_of_network(options.host, show.line)
    report_workspace(file, Packages(env, start=Path.cwd()), show.line)
    world = RunningWorld(file, options, env, report, show)  # nothing is open yet: Ctrl-C ends the process at once
    with stop_flag() as stop, ExitStack() as open_things:
        open_things.callback(world.close)
        world.start()
        page = None
        if not options.headless:
            page = open_things.enter_context(_open_page(world, options, show.line))
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
            recording_broke_off=world.recorder is not None and world.recorder.has_failed,
        )


def _open_page(world: RunningWorld, options: RunOptions, say: Callable[[str], None]) -> "SimulationPage":
    """Serve the page; with ROS it joins the graph, and drives what listens to /cmd_vel."""
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
        SimulationUnstableError: the physics is unstable, and the option is to exit.
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
        except Exception as error:  # a plugin's code may raise anything
            if (theirs := plugin_error(error)) is None:
                raise
            raise theirs from None
        if progress is not None:
            progress.update(world.simulation.time_ns)
        if world.ros is not None:
            world.ros.tick(wait=pacer.speed is None)
        if world.recorder is not None and world.recorder.has_failed:
            break
    return time.monotonic() - started


def _recover(
    simulation: Simulation, options: RunOptions, error: SimulationUnstableError, times: int, say: Callable[[str], None]
) -> bool:
    """React to unstable physics by --on-instability; return True if the simulation is paused now."""
    match options.on_instability or ("exit" if options.headless else "pause"):
        case "pause":
            say(f"{error}; the simulation is paused at its last stable state, at {simulation.time_ns / NS_PER_S:.3f} s")
            return True
        case "reset" if times <= _MAX_RESETS:
            say(f"{error}; the simulation is reset")
            simulation.reset()
            return False
        case _:
            raise error
