"""Page of a running simulation: its start and end, and the requests of its users."""

import os
import time
from collections.abc import Callable
from pathlib import Path
from typing import Self

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.page import (
    POSES,
    BeginDraft,
    Compare,
    DraftAction,
    InsertAction,
    ModelAction,
    Play,
    Reload,
    RenderModel,
    RenderView,
    Request,
    Reset,
    RunTo,
    SaveReplay,
    SaveWorld,
    Seek,
    SetReferenceOffset,
    Step,
    StopComparing,
)
from trundle.robots.model import World
from trundle.ros import Node
from trundle.ros.bridge import WORLD_FRAME
from trundle.sim.realtime_pacer import RealtimePacer
from trundle.sim.simulation import Simulation

from ..shared_page import SharedPage
from ..shown_world import ShownWorld
from .code_consent import CodeConsent
from .controls import Recorder, SimulationControls, reason_of
from .current_world import current_world
from .drafting import NO_DRAFT, Drafting
from .insertion import Insertion
from .manifest import find_robot
from .model_edits import ModelEdits
from .model_pictures import ModelPictures
from .performance import PerformanceStream
from .pictures import WorldPictures
from .pose_history import ReplaySaver
from .reference import Reference, read_recording
from .world_saver import WorldSaver
from .world_streams import WorldStreams

_WARNING = "simulation"


class SimulationPage:
    """Page of one simulation; belongs to the simulation's thread and never waits for a browser."""

    def __init__(
        self,
        page: SharedPage,
        world: ShownWorld,
        *,
        node: Node | None = None,
        recorder: Recorder | None = None,
        wall_ns: Callable[[], int] = time.monotonic_ns,
    ) -> None:
        """Serve the page and show a world on it.

        Args:
            page: page that other windows of the graph may share.
            world: running world.
            node: stops a driven robot if the page's server dies.
            recorder: records the run; None: the run cannot be recorded.
            wall_ns: the wall clock [ns].

        Raises:
            UsageError: the port is taken.
        """
        self.on_reload: Callable[[], None] | None = None
        """Reloads the world and calls `show`; None: the world cannot be reloaded."""
        self._page = page
        self._wall_ns = wall_ns
        self._warning: str | None = None
        source = Path(world.simulation.world.at.file)
        if page.session.rviz is None and page.session.fixed_frame is None:
            page.change(fixed_frame=WORLD_FRAME)
        self._set_titles(world.simulation)
        self._server = page.acquire(node, shows_world=True, source=source if source.exists() else None)
        root = Path.cwd()
        packages, environment = world.packages, world.environment
        self._replays = ReplaySaver(self._server.respond)
        self._saver = WorldSaver(self._server.respond, packages, root)
        self._model_pictures = ModelPictures(self._server.respond_picture, packages)
        self._streams = WorldStreams(
            self._server, has_graph=page.has_graph, offered_file=self._saver.offered_file, wall_ns=wall_ns
        )
        self._consent = CodeConsent(environment)
        self._draft = NO_DRAFT
        self._drafting = Drafting(self._server.respond, packages, environment, root, self._consent)
        self._pictures = WorldPictures(self._server.respond_picture)
        self._performance = PerformanceStream(self._server)
        self._set_world(world, node, recorder)

    @property
    def is_watched(self) -> bool:
        """True while a browser draws the world."""
        return self._server.is_watched(POSES)

    def show(self, world: ShownWorld, *, node: Node | None, recorder: Recorder | None) -> None:
        """Replace the shown world; arguments as in the constructor."""
        self._set_titles(world.simulation)
        self._server.set_node(node)
        self._set_world(world, node, recorder)

    def _set_world(self, world: ShownWorld, node: Node | None, recorder: Recorder | None) -> None:
        self._world = world
        self._simulation = world.simulation
        self._controls = SimulationControls(world, recorder, wall_ns=self._wall_ns)
        self._insertion = Insertion(world, self._consent)
        self._model_edits = ModelEdits(world)
        self._streams.show(world, recorder)
        self._performance.show(world.simulation, node)

    def _set_titles(self, simulation: Simulation) -> None:
        title, robot = page_names(simulation.world)
        self._page.change(kind="simulation", title=title, robot=robot)

    def warn(self, text: str | None) -> None:
        """Show a warning until a user plays, steps, resets or reloads; None: remove it."""
        if text != self._warning:
            self._warning = text
            self._server.set_notice(_WARNING, text)

    def end_recording(self) -> None:
        """End the recording that a user of the page started."""
        if self._controls.recorder is not None:
            self._controls.recorder.set(False)

    def update(self, pacer: RealtimePacer, *, paused: bool, at_once: bool = False) -> None:
        """Send the watched streams that are due: poses and lines at 30 Hz, joints and the clock at 10 Hz."""
        self._streams.update(pacer, paused=paused, at_once=at_once)
        self._page.show_findings(self._simulation.report)
        self._performance.end_page(paused=paused)

    def handle_requests(self, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Handle the requests since the last call; return True if the simulation is paused afterwards."""
        self._performance.begin_page()
        requests = self._page.requests(of_world=True)
        if self._server.uploads is not None:
            self._world.packages.add_models(self._server.uploads)
        for request in requests:
            if isinstance(request.action, RenderView):
                self._draw(request.id, request.action)
                continue
            if isinstance(request.action, RenderModel):
                self._model_pictures.draw(request.id, request.action)
                continue
            if isinstance(request.action, Play | Step | RunTo | Reset | Reload):
                self.warn(None)
            try:
                paused = self._handle(request, pacer, paused=paused)
            except TrundleError as error:
                self._server.respond(request.id, reason_of(error))
        self._show_draft()
        if self._saver.poll_newest():
            self._streams.show_offered_file()
        self._controls.let_go_after_timeout()
        if self._controls.step(pacer) or requests:
            self.update(pacer, paused=paused, at_once=True)
        return paused

    def _handle(self, request: Request, pacer: RealtimePacer, *, paused: bool) -> bool:
        """Handle one request; return True if the simulation is paused afterwards."""
        if isinstance(request.action, SaveWorld):
            world = current_world(self._simulation)
            self._saver.save(request.id, request.action, world, self._simulation.seed)
            return paused
        if isinstance(request.action, SaveReplay):
            world, title = self._simulation.world, self._page.session.title
            self._replays.save(request.id, request.action, lambda: self._streams.history.motion(world, title))
            return paused
        if isinstance(request.action, InsertAction):
            self._server.respond(request.id, answer=self._insertion.handle(request.action))
            pacer.restart()
            return paused
        if isinstance(request.action, DraftAction):
            self._drafting.handle(request.id, request.action, self._simulation)
            return paused or isinstance(request.action, BeginDraft)
        if isinstance(request.action, Play | Step | RunTo) and self._drafting.is_open:
            raise UsageError("the simulation is paused while a model is edited: finish or leave it first")
        if isinstance(request.action, Compare | SetReferenceOffset | StopComparing):
            self._compare(request.action)
        elif isinstance(request.action, ModelAction):
            self._model_edits.handle(request.action)
            pacer.restart()
        elif isinstance(request.action, Reload) and self.on_reload is not None:
            self.on_reload()
            pacer.restart()
        else:
            paused = self._controls.handle(request.action, pacer, paused=paused)
            if isinstance(request.action, Seek):
                self._streams.comparison.follow()
        self._server.respond(request.id)
        return paused

    def compare(self, reference: Reference) -> None:
        """Compare the world with a recording of it."""
        self._streams.comparison.open(reference)
        self._streams.show_comparison()

    def _compare(self, action: Compare | SetReferenceOffset | StopComparing) -> None:
        match action:
            case Compare(file, title):
                try:
                    log = read_recording(Path(os.fsdecode(file)), title)
                except OSError as error:
                    raise UsageError(f"{title} cannot be read: {error.strerror}") from None
                self.compare(Reference(log, title, self._simulation, start=0.0))
                return
            case SetReferenceOffset():
                self._streams.comparison.set_offset(action)
            case StopComparing():
                self._streams.comparison.stop()
        self._streams.show_comparison()

    def _show_draft(self) -> None:
        """Show the draft's edits since the last call."""
        for draft in self._drafting.poll(self._world, self._model_edits):
            self._draft = draft
            self._streams.show_draft(draft)

    def _draw(self, request_id: int, view: RenderView) -> None:
        """Draw a picture of the robot, the model being edited or the origin."""
        simulation = self._simulation
        states = {name: simulation.animation_state(name) for name in simulation.actors}
        self._pictures.draw(request_id, view, simulation.world, simulation.snapshot().poses, states, self._draft)

    def close(self) -> None:
        """Close the page."""
        self._streams.close()
        self._performance.close()
        self._pictures.close()
        self._saver.close()
        self._replays.close()
        self._drafting.close()
        self._model_pictures.close()
        self._page.release(shows_world=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def page_names(world: World) -> tuple[str, str | None]:
    """Return the page's title and the robot's name; a world called `default` has its file's or its robot's name."""
    robot = find_robot(world)
    name = None if robot is None else robot.name
    file = Path(world.at.file)
    if world.name != "default":
        return world.name, name
    return file.stem if file.suffix == ".world" else name or world.name, name
