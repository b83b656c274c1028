"""Streams of a simulated world to its page: the manifest, poses, lines, joints, the clock and camera pictures."""

import time
from collections.abc import Callable
from functools import partial

import numpy as np
from msgspec import UNSET
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.page import CONTACTS, JOINTS, LINES, POSES, RANGES, ClockState, PageServer, Recording, TimelineSpan
from trundle.robots.model import MeshFile, World
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.sensors import CameraReading, CameraSensor
from trundle.sim.simulation import Snapshot

from ..actor_bones import ActorBones
from ..ray_overlay import RayOverlay
from ..shown_world import ShownWorld
from ..world.manifest import Manifest
from .body_numbers import BodyNumbers
from .contact_rows import ContactRows
from .controls import Recorder
from .drafting import NO_DRAFT, ShownDraft
from .lines import plugin_lines
from .live_comparison import LiveComparison
from .manifest import camera_topic, single_axes, world_manifest
from .pose_history import PoseHistory
from .series_sampler import SeriesSampler
from .world_builder import BuiltWorld, WorldBuilder

_MESHES = "meshes"
"""Key of the page's notice about missing meshes."""
_MAX_MISSING_NAMES = 12
_FRAME_NS = 33_000_000
"""Period of poses and lines, in wall time [ns]."""
_SLOW_NS = 3 * _FRAME_NS
"""Period of joints and the clock [ns]."""


class WorldStreams:
    """Sends the watched streams to the page; belongs to the simulation's thread."""

    def __init__(
        self,
        server: PageServer,
        *,
        has_graph: bool,
        offered_file: Callable[[World], str | None],
        wall_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        """Create it; `show` sets the simulation.

        Args:
            server: page's server.
            has_graph: True if the page's server receives camera pictures from the ROS graph.
            offered_file: returns the path to offer for saving a world; None: the folder is not writable.
            wall_ns: the wall clock [ns].
        """
        self._server = server
        self._has_graph = has_graph
        self._offered_file = offered_file
        self._wall_ns = wall_ns
        self._rays = RayOverlay(lambda: server.is_watched(LINES))
        self._ranges = RayOverlay(lambda: server.is_watched(RANGES), of_all=True)
        self._series = SeriesSampler(server)
        self.history = PoseHistory()
        """Poses of the last minutes."""
        self.comparison = LiveComparison(server)
        self._bodies = BodyNumbers()
        self._builder = WorldBuilder()
        self._generation = server.generation
        self._cameras: set[CameraSensor] = set()
        """Cameras whose pictures are sent from here, not through the graph."""
        self._built: BuiltWorld | None = None
        """World that the page shows."""
        self._draft = NO_DRAFT
        self._frame_due_ns = self._slow_due_ns = 0
        self._state: ClockState | None = None
        self._missing: str | None = None
        self._shown_world: World | None = None
        """World of the latest manifest."""

    def show(self, world: ShownWorld, recorder: Recorder | None) -> None:
        """Show a world; arguments as in `SimulationPage`."""
        self._world = world
        self._simulation = world.simulation
        self._recorder = recorder
        self._show_world()

    def _show_world(self) -> None:
        """Show the world after models were added, removed or changed; a thread writes its files."""
        simulation = self._simulation
        self._shown_world = simulation.world
        present = {model.name for model in simulation.models}
        sensors = [sensor for sensor in self._world.sensors if sensor.model.name in present]
        simulation.lines_are_shown = True
        self._bones = ActorBones(simulation.world)
        bodies = (*simulation.engine.compiled.link_names, *self._bones.names)
        self._bodies.update(bodies)
        self._axes = single_axes(simulation)
        self._generation += 1
        manifest = replace(
            world_manifest(simulation, sensors, self._bodies),
            generation=self._generation,
            file=self._offered_file(simulation.world),
        )
        self._builder.build(simulation.world, manifest, {name: self._bodies[name] for name in bodies})
        self._set_missing(_missing_meshes(simulation.world))
        self._rays.set_sensors(sensors)
        self._ranges.set_sensors(sensors)
        self._contacts = ContactRows(simulation, self._bodies)
        self._series.show(simulation, sensors)
        self.history.clear()
        self.comparison.show(simulation)
        if not self._has_graph:
            self._listen([sensor for sensor in sensors if isinstance(sensor, CameraSensor)])

    def _set_missing(self, meshes: str | None) -> None:
        if meshes != self._missing:
            self._missing = meshes
            self._server.set_notice(_MESHES, meshes)

    def _listen(self, cameras: list[CameraSensor]) -> None:
        for camera in cameras:
            if camera not in self._cameras:
                topic = camera_topic(camera)
                camera.listen(partial(self._put_image, topic), enabled=partial(self._server.is_watched, topic))
        self._cameras = set(cameras)

    def _put_image(self, topic: str, reading: CameraReading) -> None:
        self._server.put_image(topic, reading.time_ns, reading.rgb)

    def update(self, pacer: RealtimePacer, *, paused: bool, at_once: bool = False) -> None:
        """Send the watched streams that are due: poses, lines and contacts at 30 Hz, joints and clock at 10 Hz."""
        self._series.sample(paused=paused)
        now = self._wall_ns()
        if now < self._frame_due_ns and not at_once:
            return
        self._frame_due_ns = now + _FRAME_NS
        if self._simulation.world is not self._shown_world:
            self._show_world()
        self._publish_world()
        self._series.put()
        snapshot = self._simulation.snapshot()
        server, time_ns = self._server, snapshot.time_ns
        poses = self._bones.with_bones(snapshot.poses, self._simulation.animation_state)
        self.history.add(time_ns, poses, paused=paused)
        if server.is_watched(POSES):
            server.put_poses(time_ns, self._bodies.rows(poses))
        if server.is_watched(LINES):
            server.put_lines(time_ns, [*plugin_lines(self._simulation), *self._rays.lines(snapshot)])
        if server.is_watched(RANGES):
            server.put_ranges(time_ns, self._ranges.lines(snapshot))
        if server.is_watched(CONTACTS):
            server.put_contacts(time_ns, self._contacts.read())
        if now < self._slow_due_ns and not at_once:
            return
        self._slow_due_ns = now + _SLOW_NS
        if server.is_watched(JOINTS):
            server.put_joints(time_ns, self._joint_rows(snapshot))
        self.comparison.put(snapshot)
        self._put_state(time_ns, pacer, paused=paused)

    def _publish_world(self) -> None:
        while (built := self._builder.poll()) is not None:
            self._simulation.report.extend(built.report.findings)
            self._built = built
            self._server.set_world(self._complete(built), {**built.files, **self.comparison.files})

    def show_draft(self, draft: ShownDraft) -> None:
        """Show the model that is being edited, next to the world."""
        self._draft = draft
        if self._built is not None:
            self._server.set_world(self._complete(self._built), draft.files)

    def show_offered_file(self) -> None:
        """Update the path to offer for saving the world."""
        if self._built is not None:
            manifest = replace(self._built.manifest, file=self._offered_file(self._simulation.world))
            self._built = replace(self._built, manifest=manifest)
            self._server.set_world(self._complete(self._built), {})

    def show_comparison(self) -> None:
        """Show the recording that the world is compared with, or that there is none."""
        if self._built is not None:
            self._server.set_world(self._complete(self._built), self.comparison.files)

    def _complete(self, built: BuiltWorld) -> Manifest:
        """Return a manifest with the draft, the recording and their files."""
        resources = (*built.manifest.resources, *self._draft.resources)
        return self.comparison.with_info(replace(built.manifest, draft=self._draft.info, resources=resources))

    def _joint_rows(self, snapshot: Snapshot) -> NDArray[np.float64]:
        columns = (snapshot.joint_positions, snapshot.joint_velocities, snapshot.joint_efforts)
        return np.stack([column[self._axes] for column in columns], axis=-1)

    def _put_state(self, time_ns: int, pacer: RealtimePacer, *, paused: bool) -> None:
        recorder, timeline = self._recorder, self._world.timeline
        since_ns = None if recorder is None else recorder.since_ns
        state = ClockState(
            time_ns=time_ns,
            paused=paused,
            real_time_factor=None if paused else pacer.real_time_factor,
            speed=pacer.speed,
            timeline=UNSET if timeline is None else TimelineSpan(timeline.start_ns, timeline.end_ns),
            recording=UNSET if recorder is None else None if since_ns is None else Recording(since_ns),
        )
        if state != self._state:
            self._state = state
            self._server.put_state(state)

    def close(self) -> None:
        """End the thread that writes files."""
        self._builder.close()


def _missing_meshes(world: World) -> str | None:
    """Return the number and names of missing meshes of visuals as text; None if all were found."""
    geometries = (visual.geometry for model in world.models for link in model.links for visual in link.visuals)
    meshes = (geometry for geometry in geometries if isinstance(geometry, MeshFile))
    missing = sorted({mesh.uri for mesh in meshes if mesh.path is None})
    if not missing:
        return None
    count = "1 mesh is missing" if len(missing) == 1 else f"{len(missing)} meshes are missing"
    more = f" and {len(missing) - _MAX_MISSING_NAMES} more" if len(missing) > _MAX_MISSING_NAMES else ""
    return f"{count}: {', '.join(missing[:_MAX_MISSING_NAMES])}{more}"
