"""Page of a running simulation: feeds it what is watched, and handles its requests."""

import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Self

import numpy as np
from msgspec import UNSET, UnsetType
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.bridge import WORLD_FRAME
from trundle.diagnostics import TrundleError
from trundle.page import (
    JOINTS,
    LINES,
    POSES,
    ClockState,
    GraphAddress,
    PageServer,
    Play,
    Recording,
    Reload,
    RenderView,
    Reset,
    Session,
    Step,
    TimelineSpan,
)
from trundle.page_address import PageAddress
from trundle.ros import Node
from trundle.sensors import CameraReading, CameraSensor, InstrumentSensor
from trundle.simulation import Simulation, Snapshot
from trundle.timeline import Timeline

from ..ray_overlay import RayOverlay
from ..realtime_pacer import RealtimePacer
from .actor_bones import ActorBones
from .body_numbers import BodyNumbers
from .controls import Recorder, SimulationControls, reason_of
from .lines import plugin_lines
from .manifest import camera_topic, single_axes, world_manifest
from .missing_meshes import missing_meshes
from .pictures import WorldPictures
from .titles import page_names
from .world_builder import WorldBuilder

_WARNING, _MESHES = "simulation", "meshes"
"""Notices of the page."""
_FRAME_NS = 33_000_000
"""Period of poses and lines, in wall time [ns]."""
_SLOW_NS = 3 * _FRAME_NS
"""Period of joints and the clock [ns]."""


class SimulationPage:
    """Page of one simulation; belongs to the simulation's thread, and never waits for a browser."""

    def __init__(
        self,
        server: PageServer,
        simulation: Simulation,
        sensors: Sequence[CameraSensor | InstrumentSensor],
        *,
        has_graph: bool,
        recorder: Recorder | None = None,
        timeline: Timeline | None = None,
        wall_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        """Show a simulation.

        Args:
            server: the page's.
            simulation: the running one.
            sensors: those that measure; cameras and rays are drawn.
            has_graph: True if the page's server gets pictures from the ROS graph.
            recorder: records the run; None: it cannot be recorded.
            timeline: of the run; None: it cannot go back.
            wall_ns: the wall clock [ns].
        """
        self.on_reload: Callable[[], None] | None = None
        """Loads the world again, and calls `show`; None: it cannot be."""
        self._server = server
        self._session: Session | None = None
        self._warning: str | None = None
        self._missing: str | None = None
        self._has_graph = has_graph
        self._wall_ns = wall_ns
        self._rays = RayOverlay(lambda: server.is_watched(LINES))
        self._bodies = BodyNumbers()
        self._builder = WorldBuilder()
        self._pictures = WorldPictures(server.respond_picture)
        self._generation = 0
        self._cameras: set[CameraSensor] = set()
        """Cameras whose pictures go to the page from here."""
        self._frame_due_ns = self._slow_due_ns = 0
        self._state: ClockState | None = None
        self._set_simulation(simulation, sensors, recorder, timeline)

    @classmethod
    def open(
        cls,
        simulation: Simulation,
        sensors: Sequence[CameraSensor | InstrumentSensor],
        at: PageAddress,
        *,
        graph: GraphAddress | None = None,
        node: Node | None = None,
        drive_topic: str | None = None,
        recorder: Recorder | None = None,
        timeline: Timeline | None = None,
    ) -> Self:
        """Serve the page.

        Args:
            simulation: the running one.
            sensors: those that measure.
            at: address to bind.
            graph: ROS graph that the page joins; None: without ROS.
            node: publishes the stop of a robot that is driven when the page's server dies.
            drive_topic: velocity commands of the page; None: driving is not offered.
            recorder: records the run; None: it cannot be recorded.
            timeline: of the run; None: it cannot go back.

        Raises:
            UsageError: the port is taken.
        """
        title, robot = page_names(simulation.world)
        session = Session(
            title=title,
            kind="simulation",
            robot=robot,
            fixed_frame=WORLD_FRAME,
            drive_topic=drive_topic,
        )
        source = Path(simulation.world.at.file)
        server = PageServer.start(session, at=at, graph=graph, node=node, source=source if source.exists() else None)
        page = cls(server, simulation, sensors, has_graph=graph is not None, recorder=recorder, timeline=timeline)
        page._session = session
        return page

    @property
    def url(self) -> str:
        """URL of the page."""
        return self._server.url

    @property
    def foxglove_url(self) -> str:
        """Address for Foxglove and Lichtblick, with the token."""
        return self._server.foxglove_url

    def set_sensors(self, sensors: Sequence[CameraSensor | InstrumentSensor]) -> None:
        """Set the sensors that measure after models came or went."""
        self._sensors = sensors
        self._is_changed = True

    def show(
        self,
        simulation: Simulation,
        sensors: Sequence[CameraSensor | InstrumentSensor],
        *,
        node: Node | None,
        recorder: Recorder | None,
        timeline: Timeline | None = None,
    ) -> None:
        """Show another simulation in place of the one before; arguments are those of `open`."""
        self._server.set_node(node)
        self._set_simulation(simulation, sensors, recorder, timeline)
        if self._session is not None:
            title, robot = page_names(simulation.world)
            self._session = replace(self._session, title=title, robot=robot)
            self._server.set_session(self._session)

    def _set_simulation(
        self,
        simulation: Simulation,
        sensors: Sequence[CameraSensor | InstrumentSensor],
        recorder: Recorder | None,
        timeline: Timeline | None,
    ) -> None:
        self._simulation = simulation
        self._sensors = sensors
        self._controls = SimulationControls(simulation, recorder, timeline)
        self._show_world()
        simulation.on_change(self._mark_changed)

    def warn(self, text: str | None) -> None:
        """Show a sentence until a person plays, steps, resets or reloads; None: end it."""
        if text != self._warning:
            self._warning = text
            self._server.set_notice(_WARNING, text)

    def _set_missing(self, meshes: str | None) -> None:
        if meshes != self._missing:
            self._missing = meshes
            self._server.set_notice(_MESHES, meshes)

    def end_recording(self) -> None:
        """End the recording that a person at the page has begun."""
        if self._controls.recorder is not None:
            self._controls.recorder.set(False)

    def _mark_changed(self) -> None:
        self._is_changed = True

    def _show_world(self) -> None:
        """Show the world again after models came, went or changed; its files are made meanwhile."""
        self._is_changed = False
        simulation, sensors = self._simulation, self._sensors
        simulation.lines_are_shown = True
        self._bones = ActorBones(simulation.world)
        bodies = (*simulation.engine.compiled.link_names, *self._bones.names)
        self._bodies.update(bodies)
        self._axes = single_axes(simulation)
        self._generation += 1
        manifest = world_manifest(simulation, sensors, self._bodies) | {"generation": self._generation}
        self._builder.build(simulation.world, manifest, {name: self._bodies[name] for name in bodies})
        self._set_missing(missing_meshes(simulation.world))
        self._rays.set_sensors(sensors)
        if not self._has_graph:
            self._listen([sensor for sensor in sensors if isinstance(sensor, CameraSensor)])

    def _listen(self, cameras: list[CameraSensor]) -> None:
        for camera in cameras:
            if camera not in self._cameras:
                topic = camera_topic(camera)
                camera.listen(partial(self._put_image, topic), enabled=partial(self._server.is_watched, topic))
        self._cameras = set(cameras)

    def _put_image(self, topic: str, reading: CameraReading) -> None:
        self._server.put_image(topic, reading.time_ns, reading.rgb)

    def update(self, pacer: RealtimePacer, *, paused: bool, at_once: bool = False) -> None:
        """Send the page what is due: poses and lines at 30 Hz, joints and the clock at 10 Hz, if they are watched."""
        now = self._wall_ns()
        if now < self._frame_due_ns and not at_once:
            return
        self._frame_due_ns = now + _FRAME_NS
        if self._is_changed:
            self._show_world()
        self._publish_world()
        snapshot = self._simulation.snapshot()
        server, time_ns = self._server, snapshot.time_ns
        if server.is_watched(POSES):
            poses = self._bones.with_bones(snapshot.poses, self._simulation.animation_state)
            server.put_poses(time_ns, self._bodies.rows(poses))
        if server.is_watched(LINES):
            server.put_lines(time_ns, [*plugin_lines(self._simulation), *self._rays.lines(snapshot)])
        if now < self._slow_due_ns and not at_once:
            return
        self._slow_due_ns = now + _SLOW_NS
        if server.is_watched(JOINTS):
            server.put_joints(time_ns, self._joint_rows(snapshot))
        self._put_state(time_ns, pacer, paused=paused)

    def _joint_rows(self, snapshot: Snapshot) -> NDArray[np.float64]:
        columns = (snapshot.joint_positions, snapshot.joint_velocities, snapshot.joint_efforts)
        return np.stack([column[self._axes] for column in columns], axis=-1)

    def _put_state(self, time_ns: int, pacer: RealtimePacer, *, paused: bool) -> None:
        recorder = self._controls.recorder
        since_ns = None if recorder is None else recorder.since_ns
        state = ClockState(
            time_ns=time_ns,
            paused=paused,
            real_time_factor=None if paused else pacer.real_time_factor,
            speed=pacer.speed,
            timeline=self._span(),
            recording=UNSET if recorder is None else None if since_ns is None else Recording(since_ns),
        )
        if state != self._state:
            self._state = state
            self._server.put_state(state)

    def _span(self) -> TimelineSpan | UnsetType:
        timeline = self._controls.timeline
        return UNSET if timeline is None else TimelineSpan(timeline.start_ns, timeline.end_ns)

    def _publish_world(self) -> None:
        while (built := self._builder.poll()) is not None:
            self._simulation.report.extend(built.report.findings)
            self._server.set_world(built.manifest, built.files)

    def handle_requests(self, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Handle the requests since the last call; return True if the simulation is paused now."""
        requests = self._server.requests()
        for request in requests:
            if isinstance(request.action, RenderView):
                self._draw(request.id, request.action)
                continue
            if isinstance(request.action, Play | Step | Reset | Reload):
                self.warn(None)
            try:
                if isinstance(request.action, Reload) and self.on_reload is not None:
                    self.on_reload()
                    pacer.restart()
                else:
                    paused = self._controls.handle(request.action, pacer, paused=paused)
            except TrundleError as error:
                self._server.respond(request.id, reason_of(error))
            else:
                self._server.respond(request.id)
        if self._controls.step(pacer) or requests:
            self.update(pacer, paused=paused, at_once=True)
        return paused

    def _draw(self, request_id: int, view: RenderView) -> None:
        """Draw a picture around the robot, or the origin."""
        simulation = self._simulation
        states = {name: simulation.animation_state(name) for name in simulation.actors}
        self._pictures.draw(request_id, view, simulation.world, simulation.snapshot().poses, states)

    def close(self) -> None:
        """Close the page."""
        self._builder.close()
        self._pictures.close()
        self._server.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()
