"""Page of a ROS graph: one for a launch or `trundle view`, shared by all nodes with a window."""

import asyncio
import os
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec

from trundle.atomic_write import write_atomically
from trundle.diagnostics import DescriptionError, Source, TrundleError, UsageError
from trundle.files import read_file
from trundle.nodes import Slider
from trundle.page import (
    GraphAddress,
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
from trundle.page_address import PageAddress
from trundle.ros import Node

_CMD_VEL = "/cmd_vel"
_PERIOD_S = 1 / 50
_MAX_CONFIG_BYTES = 4_000_000

MoveJoint = Callable[[str, float], None]
MoveAxes = Callable[[Sequence[float], Sequence[int]], None]


class GraphPage:
    """Collects what windows ask for; the first one that is shown starts the server.

    All methods but the properties and `close` are called on the graph's loop.
    """

    def __init__(
        self, *, say: Callable[[str], None], at: PageAddress | None = None, source: Path | None = None
    ) -> None:
        """Prepare; `show` serves the page.

        Args:
            say: prints the page's URL.
            at: address of the page.
            source: launch file that the page belongs to; packages are found from there, else from the working folder.
        """
        self._source = source
        self._say = say
        self._at = at or PageAddress()
        self._session = Session(title="ROS", kind="graph", drive_topic=_CMD_VEL)
        self._config: Path | None = None
        self._server: PageServer | None = None
        self._owner: Node | None = None
        self._over = False
        self._move_slider: MoveJoint | None = None
        self._joysticks: list[MoveAxes] = []

    @property
    def url(self) -> str | None:
        """URL of the page; None before it is served."""
        return None if self._server is None else self._server.url

    @property
    def is_over(self) -> bool:
        """True if the page was closed, or could not be served."""
        return self._over

    def offer_sliders(self, sliders: Sequence[Slider], move: MoveJoint) -> None:
        """Show joint sliders; `move` is called with a joint's name and position [rad or m], on the graph's loop."""
        self._move_slider = move
        shown = (
            JointSlider(name=slider.name, lower=slider.lower, upper=slider.upper, position=slider.position)
            for slider in sliders
        )
        self._change(sliders=tuple(shown), panels=_with(self._session.panels, "joint_state_publisher_gui"))

    def offer_joystick(self, move: MoveAxes) -> None:
        """Show a joystick; `move` is called with axes and buttons as in sensor_msgs/Joy, on the graph's loop."""
        self._joysticks.append(move)
        self._change(joystick=True, panels=_with(self._session.panels, "joy"))

    def drive_on(self, topic: str) -> None:
        """Drive with this velocity topic; the first call wins."""
        if self._session.drive_topic in (None, _CMD_VEL):
            self._change(drive_topic=topic)

    def show_image(self, topic: str) -> None:
        """Show an image topic, besides those of an rviz configuration."""
        self._change(images=_with(self._session.images, topic))

    def open_panel(self, program: str) -> None:
        """Open the panel that takes the place of a program: `rqt_graph`."""
        self._change(panels=_with(self._session.panels, program))

    def plot(self, fields: Sequence[str]) -> None:
        """Plot message fields `/topic/field/…` over time."""
        self._change(plots=_with(self._session.plots, *fields), panels=_with(self._session.panels, "rqt_plot"))

    async def show(self, node: Node, *, config: str | None = None, fixed_frame: str | None = None) -> int:
        """Show until the page's server is gone or the call is cancelled; returns an exit code.

        Args:
            node: the node with the window. The first one serves the page; later ones add what they show.
            config: path of an .rviz file, which may not exist.
            fixed_frame: overrides that of `config`.

        Raises:
            DescriptionError: the configuration cannot be read.
            UsageError: the port asked for is taken.
        """
        if config is not None and os.path.exists(config):
            self._config = Path(config)
            self._change(rviz=read_rviz_file(self._config))
        if config is not None or self._owner is None:
            self._change(namespace=node.name.rpartition("/")[0] or "/", remappings=dict(node.remappings))
        if fixed_frame is not None:
            self._change(fixed_frame=fixed_frame)
        if self._owner is not None:
            node.log.info(f"the page is {self._owner.name}'s, at {self.url or 'an address that it will print'}")
            await node.closed.wait()
            return 0
        self._owner, self._over = node, False
        try:
            graph = GraphAddress(master_uri=node.master_uri)
            started = self._session
            self._server = server = await asyncio.to_thread(
                PageServer.start, started, at=self._at, graph=graph, node=node, source=self._source
            )
            if self._session is not started:
                server.set_session(self._session)
            self._say(f"see it at {server.url}")
            self._say(f"Foxglove connects to {server.foxglove_url}")
            while server.alive:
                self._handle_requests(server)
                await asyncio.sleep(_PERIOD_S)
        finally:
            self.close()
        return 0

    def close(self) -> None:
        """Close the page; may be called twice and on any thread."""
        self._over = True
        self._owner = None
        server, self._server = self._server, None
        if server is not None:
            server.close()

    def _change(self, **changes: object) -> None:
        self._session = msgspec.structs.replace(self._session, **changes)
        if self._server is not None:
            self._server.set_session(self._session)

    def _handle_requests(self, server: PageServer) -> None:
        for request in server.requests():
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
                    raise UsageError(f"no slider moves a joint '{joint}'")
                self._move_slider(joint, position)
            case MoveJoystick(axes, buttons) if self._joysticks:
                for move in self._joysticks:
                    move(axes, buttons)
            case SaveRviz(text) if self._config is not None:
                write_atomically(self._config, text)
                self._change(rviz=read_rviz_file(self._config))
            case RenderView():
                raise UsageError("a ROS graph is drawn by browsers with WebGL alone")
            case _:
                raise UsageError("this page shows a ROS graph; it has no simulation, recording or file of that kind")


def _with(names: tuple[str, ...], *more: str) -> tuple[str, ...]:
    return (*names, *(name for name in dict.fromkeys(more) if name not in names))


def read_rviz_file(path: Path) -> RvizFile:
    """Read a configuration of rviz; the client understands it.

    Raises:
        DescriptionError: it cannot be read.
    """
    try:
        text = read_file(path, max_bytes=_MAX_CONFIG_BYTES).decode("utf-8", "replace")
    except OSError as error:
        raise DescriptionError(Source(str(path)), f"cannot be read: {error.strerror}") from None
    return RvizFile(name=path.name, text=text, writable=os.access(path, os.W_OK))
