"""Page as a window of the ROS graph: rviz, rqt's programs, sliders and joysticks."""

import asyncio
import os
import time
from collections.abc import Callable, Sequence
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import DescriptionError, Diagnostics, Source, TrundleError, UsageError
from trundle.base.files import read_file
from trundle.base.http.access import without_query
from trundle.gazebo.nodes import Slider
from trundle.page import (
    JointSlider,
    MoveJoystick,
    MoveSlider,
    PageAction,
    PageServer,
    RenderView,
    RvizFile,
    SaveRviz,
    Session,
)
from trundle.ros import Node

from .shared_page import CMD_VEL, SharedPage
from .terminals import PageTerminals

_PERIOD_S = 1 / 50
_AT_REST = MoveJoystick(axes=(0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0), buttons=(0,) * 11)
"""Axes of the page's joystick at rest: triggers are at 1."""
_JOYSTICK_LEASE_S = 1.0
_MAX_CONFIG_BYTES = 4_000_000

MoveJoint = Callable[[str, float], None]
MoveAxes = Callable[[Sequence[float], Sequence[int]], None]


class GraphPage:
    """Collects the panels, plots and files of the graph's windows, and handles the requests to them.

    Call all methods but the properties and `close` on the graph's loop.
    """

    def __init__(self, page: SharedPage, report: Diagnostics | None = None) -> None:
        """Create it; `show` serves the page.

        Args:
            page: page, which a simulation may share.
            report: warnings about the files of the launch, which the page shows.
        """
        self._page = page
        self.report = report
        """Warnings that the page shows."""
        self._config: Path | None = None
        self._owner: Node | None = None
        self._move_slider: MoveJoint | None = None
        self._joysticks: list[MoveAxes] = []
        self._joystick_end_s: float | None = None
        """Monotonic time at which the joysticks return to rest [s]; None: they are at rest."""
        self.terminals = PageTerminals(page)

    @property
    def url(self) -> str | None:
        """URL of the page; None before it is served."""
        return self._page.url

    @property
    def is_over(self) -> bool:
        """True if the page was closed, or could not be served."""
        return self._page.is_over

    @property
    def _session(self) -> Session:
        return self._page.session

    def offer_sliders(self, sliders: Sequence[Slider], move: MoveJoint) -> None:
        """Show joint sliders; `move` is called with a joint's name and position [rad or m], on the graph's loop."""
        self._move_slider = move
        shown = (
            JointSlider(name=slider.name, lower=slider.lower, upper=slider.upper, position=slider.position)
            for slider in sliders
        )
        self._page.change(sliders=tuple(shown), panels=_with(self._session.panels, "joint_state_publisher_gui"))

    def offer_joystick(self, move: MoveAxes) -> None:
        """Show a joystick; `move` is called with axes and buttons as in sensor_msgs/Joy, on the graph's loop."""
        self._joysticks.append(move)
        self._page.change(joystick=True, panels=_with(self._session.panels, "joy"))

    def drive_on(self, topic: str) -> None:
        """Drive with this velocity topic; the first call wins."""
        if self._session.drive_topic in (None, CMD_VEL):
            self._page.change(drive_topic=topic)

    def show_image(self, topic: str) -> None:
        """Show an image topic in addition to those of an rviz configuration."""
        self._page.change(images=_with(self._session.images, topic))

    def open_panel(self, program: str) -> None:
        """Open the panel that replaces a program: `rqt_graph`."""
        self._page.change(panels=_with(self._session.panels, program))

    def plot(self, fields: Sequence[str]) -> None:
        """Plot message fields `/topic/field/…` over time."""
        self._page.change(plots=_with(self._session.plots, *fields), panels=_with(self._session.panels, "rqt_plot"))

    async def show(self, node: Node, *, config: str | None = None, fixed_frame: str | None = None) -> int:
        """Show the page until its server ends or the call is cancelled; return an exit code.

        Args:
            node: node of the window. The first one serves the page; later ones add their panels.
            config: path of an .rviz file, which need not exist.
            fixed_frame: overrides the fixed frame in `config`.

        Raises:
            DescriptionError: the configuration cannot be read.
            UsageError: the requested port is in use.
        """
        if config is not None and os.path.exists(config):
            self._config = Path(config)
            self._page.change(rviz=read_rviz_file(self._config), fixed_frame=None)  # the file's fixed frame counts
        if config is not None or self._owner is None:
            self._page.change(namespace=node.name.rpartition("/")[0] or "/", remappings=dict(node.remappings))
        if fixed_frame is not None:
            self._page.change(fixed_frame=fixed_frame)
        if self._owner is not None:
            url = without_query(self.url or "") or "an address that it will print"
            node.log.info(f"{self._owner.name} serves the page at {url}")
        else:
            self._owner = node
        try:
            await self.serve(node)
        finally:
            if self._owner is node:
                self._owner = None
        return 0

    async def serve(self, node: Node) -> None:
        """Serve the page until its server ends or the call is cancelled.

        Args:
            node: stops a driven robot if the server dies.

        Raises:
            UsageError: the requested port is in use.
        """
        server = await asyncio.to_thread(self._page.acquire, node)
        try:
            while server.alive and not node.closed.is_set():
                self._handle_requests(server)
                if self._joystick_end_s is not None and time.monotonic() > self._joystick_end_s:
                    self._move_joysticks(_AT_REST)
                self.terminals.update(server)
                if self.report is not None:
                    self._page.show_findings(self.report)
                await asyncio.sleep(_PERIOD_S)
        finally:
            if self._joystick_end_s is not None:
                self._move_joysticks(_AT_REST)
            self._page.release()

    def close(self) -> None:
        """Close the page; callable twice and on any thread."""
        self._page.close()

    def _handle_requests(self, server: PageServer) -> None:
        for request in self._page.requests(of_world=False):
            error = None
            try:
                self._handle(request.action)
            except TrundleError as fault:
                error = str(fault)
            server.respond(request.id, error)

    def _handle(self, action: PageAction) -> None:
        match action:
            case MoveSlider(joint, position) if self._move_slider is not None:
                if joint not in {slider.name for slider in self._session.sliders}:
                    raise UsageError(f"no slider for joint '{joint}'")
                self._move_slider(joint, position)
            case MoveJoystick() if self._joysticks:
                self._move_joysticks(action)
            case SaveRviz(text) if self._config is not None:
                write_atomically(self._config, text)
                self._page.change(rviz=read_rviz_file(self._config))
            case RenderView():
                raise UsageError("only browsers with WebGL can draw a ROS graph")
            case _:
                raise UsageError(
                    "this page shows a ROS graph: it has no simulation, recording or file for this request"
                )

    def _move_joysticks(self, to: MoveJoystick) -> None:
        self._joystick_end_s = None if to == _AT_REST else time.monotonic() + _JOYSTICK_LEASE_S
        for move in self._joysticks:
            move(to.axes, to.buttons)


def _with(names: tuple[str, ...], *more: str) -> tuple[str, ...]:
    return (*names, *(name for name in dict.fromkeys(more) if name not in names))


def read_rviz_file(path: Path) -> RvizFile:
    """Read an rviz configuration, which the client parses.

    Raises:
        DescriptionError: the file cannot be read.
    """
    try:
        text = read_file(path, max_bytes=_MAX_CONFIG_BYTES).decode("utf-8", "replace")
    except OSError as error:
        raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}") from None
    return RvizFile(name=path.name, text=text, writable=os.access(path, os.W_OK))
