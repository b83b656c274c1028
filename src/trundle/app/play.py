"""`trundle play`: shows a state log or a bag on a page, at any speed."""

import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.base.console import Console
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, TrundleError, UsageError
from trundle.base.http.page_address import AllowedNames, PageAddress
from trundle.base.signals import StopFlag, stop_flag
from trundle.page import (
    JOINTS,
    POSES,
    BagFile,
    Compare,
    PageAction,
    PageServer,
    Playback,
    RenderView,
    Session,
    SetReferenceOffset,
    StopComparing,
)
from trundle.page.actor_bones import ActorBones
from trundle.page.bag.compared_bag import compared_bag
from trundle.page.browser import announce_page
from trundle.page.simulated_world.body_numbers import BodyNumbers
from trundle.page.simulated_world.controls import reason_of
from trundle.page.simulated_world.log_series import LogSeries
from trundle.page.simulated_world.manifest import find_robot, single_axes, world_manifest
from trundle.page.simulated_world.pictures import WorldPictures
from trundle.page.simulated_world.reference import Reference, read_recording
from trundle.page.simulated_world.world_builder import BuiltWorld, WorldBuilder
from trundle.robots.model import AnimationState
from trundle.ros import is_bag, open_bag
from trundle.ros.bridge import WORLD_FRAME
from trundle.sim.comparison import Trajectory, ascending_rows
from trundle.sim.simulation import Simulation, StateLog
from trundle.spatial import NS_PER_S

from .recorded_run import open_recording

_FRAME_S = 1 / 30
_FRAMES_PER_COMPARISON = 3
_POLL_S = 0.5


@dataclass(frozen=True, slots=True, kw_only=True)
class PlayOptions:
    """Options of `trundle play`."""

    host: str = "127.0.0.1"
    port: int | None = None
    allowed: AllowedNames = AllowedNames()
    """Hosts and origins that the page serves besides its own."""
    view_only: bool = False
    """True: print a second link, which is view-only."""
    opens_browser: bool = True
    """True: open the page where there is a display; False: only print its URL."""
    speed: float = 1.0
    """Recorded seconds per second of wall time."""
    paused: bool = False
    compare: Path | None = None
    """Recording to compare with."""

    @property
    def address(self) -> PageAddress:
        """Address of the page."""
        return PageAddress(host=self.host, port=self.port, allowed=self.allowed, view_only=self.view_only)


def play(file: Path, options: PlayOptions) -> int:
    """Show a state log or bag until Ctrl-C; return the exit code.

    Raises:
        TrundleError: the file is neither, or its world cannot be read.
    """
    if is_bag(file):
        return play_bag(file, options)
    report = Diagnostics()
    log, simulation = open_recording(file, report)
    show = Console(sys.stderr, report)
    show.findings()
    if options.compare is not None and is_bag(options.compare):
        raise UsageError(f"{options.compare} is a bag, and a state log can only be compared with a state log")
    reference = None if options.compare is None else read_recording(options.compare, str(options.compare))
    robot = find_robot(simulation.world)
    session = Session(title=file.name, kind="log", robot=None if robot is None else robot.name, fixed_frame=WORLD_FRAME)
    with stop_flag() as stop, PageServer.start(session, at=options.address) as server:
        page = LogPage(server, log, simulation, options)
        if options.compare is not None and reference is not None:
            page.compare(reference, str(options.compare))
        announce_page(server, options.address, show.line, opens_browser=options.opens_browser)
        page.run(stop)
    return 130


def play_bag(file: Path, options: PlayOptions) -> int:
    """Show a bag until Ctrl-C; return the exit code.

    Raises:
        TrundleError: the file is damaged, or has no messages.
    """
    with open_bag(file) as bag:
        if not any(bag.counts):
            raise DescriptionError(Source(str(file)), "nothing was recorded")
    reference = None if options.compare is None else compared_bag(options.compare)
    if options.compare is not None and reference is None:
        raise UsageError(f"{options.compare} is no bag, and a bag can only be compared with a bag")
    playing = BagFile(path=os.fsencode(file.absolute()), speed=options.speed, paused=options.paused)
    session = Session(title=file.name, kind="bag")
    with stop_flag() as stop, PageServer.start(session, at=options.address, bag=playing, reference=reference) as server:
        say = Console(sys.stderr, Diagnostics()).line
        announce_page(server, options.address, say, opens_browser=options.opens_browser)
        while not stop.wait(_POLL_S) and server.alive:
            pass
    return 130


class LogPage:
    """Page of a state log."""

    def __init__(self, server: PageServer, log: StateLog, simulation: Simulation, options: PlayOptions) -> None:
        """Show a log.

        Args:
            server: page server.
            log: recorded states; where its time goes back, the later ones are shown.
            simulation: simulation of the log's world, which does not run.
            options: speed and pause.
        """
        rows = ascending_rows(log.times_s)
        if len(rows) < len(log.times_s):
            log = replace(log, times_s=log.times_s[rows], poses=log.poses[rows], positions=log.positions[rows])
        self._server = server
        self._log = log
        self._simulation = simulation
        self._pictures = WorldPictures(server.respond_picture)
        times_ns = np.rint(log.times_s * NS_PER_S).astype(np.int64)
        self._playback = Playback(times_ns, speed=options.speed, paused=options.paused)
        self._joints = _joint_columns(log, single_axes(simulation))
        self._series = LogSeries(server, log, simulation.world)
        self._bodies = BodyNumbers()
        self._bones = ActorBones(simulation.world)
        bodies = (*log.links, *self._bones.names)
        self._bodies.update(bodies)
        self._builder = WorldBuilder()
        self._built: BuiltWorld | None = None
        self._reference: Reference | None = None
        self._frames = 0
        manifest = replace(world_manifest(simulation, [], self._bodies), generation=1)
        self._builder.build(simulation.world, manifest, {name: self._bodies[name] for name in bodies})

    def run(self, stop: StopFlag) -> None:
        """Play until stopped."""
        previous = time.monotonic()
        while not stop.wait(_FRAME_S):
            now = time.monotonic()
            self.update(now - previous)
            previous = now
        self._builder.close()
        self._pictures.close()

    def update(self, wall_s: float) -> None:
        """Handle the requests, play for a duration [s] and show the state."""
        server, playback = self._server, self._playback
        for request in server.requests():
            if isinstance(request.action, RenderView):
                self._draw(request.id, request.action)
                continue
            try:
                self._handle(request.action)
            except TrundleError as error:
                server.respond(request.id, reason_of(error))
            else:
                server.respond(request.id)
        playback.advance(wall_s)
        while (world := self._builder.poll()) is not None:
            self._simulation.report.extend(world.report.findings)
            self._built = world
            self._show_world()
        sample = playback.sample
        if server.is_watched(POSES):
            poses = self._bones.with_bones(self._log.poses[sample], self._animation_state)
            server.put_poses(playback.time_ns, self._bodies.rows(poses))
        if server.is_watched(JOINTS):
            server.put_joints(playback.time_ns, self._joints[sample])
        self._series.put(sample, paused=playback.paused)
        self._frames += 1
        if self._reference is not None and self._frames % _FRAMES_PER_COMPARISON == 0:
            self._reference.put_differences(server, playback.time_ns / NS_PER_S)
        server.put_state(playback.state)

    def compare(self, recording: StateLog, title: str) -> None:
        """Compare the log with another.

        Raises:
            UsageError: it was recorded in another world.
        """
        start = float(self._log.times_s[0])
        reference = Reference(recording, title, self._simulation, start=start)
        compared = reference.comparison.reference
        reference.comparison.add_run(Trajectory.of_log(self._log).only(compared.models, compared.joints))
        self._reference = reference
        self._show_world()

    def _handle(self, action: PageAction) -> None:
        """Execute a request.

        Raises:
            TrundleError: it cannot be executed.
        """
        match action:
            case Compare(file, title):
                self.compare(read_recording(Path(os.fsdecode(file)), title), title)
            case SetReferenceOffset(offset) if self._reference is not None:
                self._reference.comparison.offset = offset
                self._show_world()
            case StopComparing():
                self._reference = None
                self._show_world()
            case _:
                self._playback.handle(action)

    def _show_world(self) -> None:
        if self._built is None:
            return
        manifest, files = self._built.manifest, self._built.files
        if self._reference is not None:
            manifest, files = self._reference.with_info(manifest), {**files, **self._reference.files}
        self._server.set_world(manifest, files)

    def _animation_state(self, actor: str) -> AnimationState:
        """State of an actor's script at the displayed time; a log does not record changes that plugins made to it."""
        player = self._simulation.actors.get(actor)
        return AnimationState() if player is None else player.animation_state(self._playback.time_ns)

    def _draw(self, request_id: int, view: RenderView) -> None:
        states = {name: self._animation_state(name) for name in self._simulation.actors}
        poses = self._log.poses[self._playback.sample]
        self._pictures.draw(request_id, view, self._simulation.world, poses, states)


def _joint_columns(log: StateLog, joints: NDArray[np.intp]) -> NDArray[np.float64]:
    """Return (samples, joints, 3): positions, their time derivative, and NaN for efforts, which are not recorded."""
    positions = log.positions[:, joints]
    columns = np.full((*positions.shape, 3), np.nan)
    columns[..., 0] = positions
    columns[..., 1] = 0.0
    if len(log.times_s) > 1:
        columns[1:, :, 1] = np.diff(positions, axis=0) / np.maximum(np.diff(log.times_s), 1e-9)[:, None]
    return columns
