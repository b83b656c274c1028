"""`trundle run`: simulates one world, with its page, ROS interface and recording."""

import os
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

from trundle.diagnostics import Diagnostics, TrundleError
from trundle.garbage import no_garbage
from trundle.packages import Packages
from trundle.page_address import AllowedNames, PageAddress
from trundle.physics import SimulationUnstableError
from trundle.sensors import mount_cameras, mount_sensors
from trundle.simulation import Simulation, with_actors
from trundle.spatial import NS_PER_S

from ..console import Console
from ..load_input import report_workspace
from ..network_warning import warn_of_network
from ..plugin_error import plugin_error
from ..plugins import load_plugins, load_world_plugins
from ..realtime_pacer import RealtimePacer, shorten_gil_interval
from ..renderers import RENDERERS, RendererName
from ..signals import StopFlag, stop_flag
from ..world_setup import load_world
from .run_result import RunResult

if TYPE_CHECKING:  # a run without a page or a graph starts without their modules
    from ..page import SimulationPage
    from ..state_logs import RunRecorder
    from .ros_interface import RosInterface

OnInstability: TypeAlias = Literal["pause", "reset", "exit"]
_MAX_RESETS = 10
"""Resets after which --on-instability reset exits."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunOptions:
    """Options of `trundle run`, with its defaults."""

    headless: bool = False
    host: str = "127.0.0.1"
    port: int | None = None
    """Port of the page; None: 8080 or the next free one."""
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves beside its own."""
    duration_s: float | None = None
    """Simulation time [s]; None: until interrupted."""
    speed: float | None = 1.0
    """Simulated seconds per second of wall time; None: flat out."""
    paused: bool = False
    seed: int = 0
    ros: bool = True
    sensors: bool = True
    renderer: RendererName = "cpu"
    """Renderer of cameras: Trundle's own, or OpenGL over EGL."""
    strict: bool = False
    record: Path | None = None
    """State log to write."""
    on_instability: OnInstability | None = None
    """Reaction to unstable physics; None: pause if there is a page, else exit."""


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
    packages = Packages(env, start=Path.cwd())
    report_workspace(file, packages, show.line)
    with no_garbage():
        stage = load_world(file, packages, report, seed=options.seed)
        simulation = Simulation(
            stage.world, report, seed=options.seed
        )  # nothing is open yet: Ctrl-C ends the process at once
    with stop_flag() as stop, ExitStack() as open_things:
        cameras = mount_cameras(simulation, RENDERERS[options.renderer])
        sensors = mount_sensors(simulation)
        if not options.sensors:
            cameras.clear()
            sensors.clear()
        for sensor in (*cameras, *sensors):
            sensor.start(simulation)
        show.findings()
        ros = None
        if options.ros:
            from .ros_interface import RosInterface

            ros = open_things.enter_context(
                RosInterface.open(simulation, stage, cameras, sensors, env, host=options.host)
            )
            if ros.graph.core is not None:
                show.line(ros.graph.summary)
        recorder = None
        if options.record is not None:
            from ..state_logs import RunRecorder, start_state_log

            log = start_state_log(options.record, simulation, stage.written, report)
            recorder = RunRecorder(log, show.line)
            simulation.add_hook(recorder, period_ns=recorder.period_ns)
            open_things.callback(recorder.close)
        make_node = None if ros is None else ros.make_node
        load_plugins(simulation, make_node, env, say=show.line)
        load_world_plugins(simulation, make_node, env, say=show.line)
        show.findings()
        page = None
        if not options.headless:
            from ..page import SimulationPage

            shown = (*cameras, *sensors)
            at = PageAddress(host=options.host, port=options.port, allowed=options.allowed)
            page = open_things.enter_context(SimulationPage.open(simulation, shown, ros, at))
            show.line(f"see it at {page.url}")
        wall_s = _simulate(simulation, ros, page, options, stop, show.line, recorder=recorder)
        show.findings()
        return RunResult(
            world=with_actors(stage.written, report),
            snapshot=simulation.snapshot(),
            steps=simulation.simulated_steps,
            simulated_s=simulation.simulated_ns / NS_PER_S,
            wall_s=wall_s,
            images=sum(camera.image_count for camera in cameras),
            report=report,
            interrupted=stop.is_set(),
            recording_broke_off=recorder is not None and recorder.has_failed,
        )


def _simulate(
    simulation: Simulation,
    ros: "RosInterface | None",
    page: "SimulationPage | None",
    options: RunOptions,
    stop: StopFlag,
    say: Callable[[str], None],
    *,
    recorder: "RunRecorder | None",
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
    started = time.monotonic()
    while not stop.is_set() and (end_ns is None or simulation.time_ns < end_ns):
        try:
            if page is not None:
                paused = page.handle_requests(pacer, paused=paused)
                page.update(pacer, paused=paused)
            if paused:
                stop.wait(0.02)
                pacer.restart()
                continue
            target_ns = pacer.next_target(simulation.time_ns)
            simulation.advance(target_ns if end_ns is None else min(target_ns, end_ns))
        except SimulationUnstableError as error:
            resets += 1
            paused = _recover(simulation, options, error, resets, say)
            pacer.restart()
            continue
        except TrundleError:
            raise
        except Exception as error:  # a plugin's code may raise anything
            if (theirs := plugin_error(error)) is None:
                raise
            raise theirs from None
        if ros is not None:
            ros.tick(wait=pacer.speed is None)
        if recorder is not None and recorder.has_failed:
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
