"""`trundle play`: shows a state log on a page, at any speed."""

import math
import os
import sys
import time
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from trundle.description import load_text
from trundle.diagnostics import DescriptionError, Diagnostics, Source
from trundle.model import flattened
from trundle.packages import Packages
from trundle.page_address import AllowedNames
from trundle.simulation import Simulation, StateLog, read_state_log
from trundle.viewer import Pause, Play, Reset, SetSpeed, Step, Viewer, ViewerState

from .console import Console
from .page_scene import build_page_scene, joint_indices
from .signals import StopFlag, stop_flag

_FRAME_S = 1 / 30


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayOptions:
    """Options of `trundle play`."""

    host: str = "127.0.0.1"
    port: int | None = None
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves beside its own."""
    speed: float = 1.0
    """Recorded seconds per second of wall time."""
    paused: bool = False


def play(file: Path, options: PlayOptions) -> int:
    """Show a state log until Ctrl-C; return the exit code.

    Raises:
        TrundleError: the file is not a state log, or its world cannot be read.
    """
    log = read_state_log(file)
    if len(log.times) == 0:
        raise DescriptionError(Source(str(file)), "nothing was recorded")
    report = Diagnostics()
    packages = Packages(dict(os.environ), start=Path.cwd())
    loaded = load_text(log.sdf, name=str(file), folder=file.parent, packages=packages, report=report)
    simulation = Simulation(flattened(loaded.world), report)
    if simulation.engine.compiled.link_names != log.links:
        raise DescriptionError(Source(str(file), 1), "the world in this log has other links than were recorded")
    layout = build_page_scene(simulation, [], drive=False)
    show = Console(sys.stderr, report)
    show.findings()
    with stop_flag() as stop, ExitStack() as open_things:
        viewer = Viewer.start(
            layout.scene, host=options.host, port=options.port, allowed=options.allowed, state=layout.first
        )
        open_things.callback(viewer.close)
        show.line(f"see it at {viewer.url}")
        _Player(log, viewer, joint_indices(simulation, layout.joints), options).run(stop)
    return 130


class _Player:
    def __init__(self, log: StateLog, viewer: Viewer, sliders: list[int], options: PlayOptions) -> None:
        self._log = log
        self._viewer = viewer
        self._sliders = sliders
        self._speed = options.speed
        self._paused = options.paused
        self._at_s = float(log.times[0])

    def run(self, stop: StopFlag) -> None:
        """Play in a loop until stopped."""
        then = time.monotonic()
        while not stop.wait(_FRAME_S):
            now = time.monotonic()
            self._handle_requests()
            if not self._paused:
                self._at_s += (now - then) * self._speed
                if self._at_s > self._log.times[-1]:
                    self._at_s = float(self._log.times[0])
            then = now
            self._show()

    def _handle_requests(self) -> None:
        for request in self._viewer.requests():
            match request:
                case Play():
                    self._paused = False
                case Pause():
                    self._paused = True
                case Reset():
                    self._at_s = float(self._log.times[0])
                case Step(count):
                    self._paused = True
                    row = min(self._row() + count, len(self._log.times) - 1)
                    self._at_s = float(self._log.times[row])
                case SetSpeed(factor):
                    self._speed = factor if math.isfinite(factor) else 100.0
                case _:
                    pass

    def _row(self) -> int:
        return max(0, int(np.searchsorted(self._log.times, self._at_s, side="right")) - 1)

    def _show(self) -> None:
        row = self._row()
        self._viewer.show(
            ViewerState(
                time_ns=round(self._log.times[row] * 1e9),
                body_poses=self._log.poses[row],
                joint_positions=self._log.positions[row][self._sliders],
                real_time_factor=None if self._paused else self._speed,
                paused=self._paused,
            )
        )
