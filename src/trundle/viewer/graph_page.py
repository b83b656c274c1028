"""The page of a graph: what rviz shows of it, kept up to date from topics, with a pad that drives."""

import asyncio
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import Protocol

from trundle.diagnostics import Diagnostics
from trundle.packages import Packages
from trundle.page_address import NONE_ALLOWED, AllowedNames
from trundle.ros import Node

from .content import JointSlider, ViewerScene
from .graph_view import graph_scene, graph_state
from .requests import Drive, MoveJoystick, Request, SetFixedFrame, SetJoint, SetOption
from .rviz import read_rviz_config
from .shown_graph import ShownGraph
from .viewer import Viewer

_CMD_VEL = "/cmd_vel"
_PERIOD_S = 1 / 30


class OfferedSlider(Protocol):
    """A joint that a person may move; limits are finite [rad] or [m]."""

    @property
    def name(self) -> str: ...
    @property
    def lower(self) -> float: ...
    @property
    def upper(self) -> float: ...
    @property
    def position(self) -> float: ...


class GraphPage:
    """One page for a launch or for `trundle view`, however many rviz nodes ask for it."""

    def __init__(
        self,
        *,
        packages: Packages,
        report: Diagnostics,
        say: Callable[[str], None],
        host: str = "127.0.0.1",
        port: int | None = None,
        allowed: AllowedNames = NONE_ALLOWED,
    ) -> None:
        """`say` takes what people must see whatever becomes of a node's log: where the page is."""
        self._say = say
        self._packages = packages
        self._report = report
        self._host = host
        self._port = port
        self._allowed = allowed
        self._viewer: Viewer | None = None
        self._sliders: tuple[JointSlider, ...] = ()
        self._move: Callable[[str, float], None] | None = None
        self._pictures: list[str] = []
        self._drive_topic = ""
        self._wants_options = self._wants_graph = False
        self._fields: list[str] = []
        """To be plotted, and not handed on yet."""
        self._joysticks: list[Callable[[Sequence[float], Sequence[int]], None]] = []
        self._stale = True
        self._over = False
        self._shown: ShownGraph | None = None

    @property
    def url(self) -> str | None:
        """Where the page is; None before it is served."""
        return None if self._viewer is None else self._viewer.url

    @property
    def is_over(self) -> bool:
        """Whether it was served, or could not be, and is closed."""
        return self._over

    @property
    def _is_of_windows(self) -> bool:
        """Whether it was asked for what needs no frames: pictures, drawings, a joystick."""
        return bool(self._pictures or self._wants_graph or self._joysticks or (self._shown and self._shown.figures))

    def offer_sliders(self, sliders: Sequence[OfferedSlider], move: Callable[[str, float], None]) -> None:
        """Let people move joints; `move` takes a joint's name and position, on the graph's loop."""
        self._sliders = tuple(JointSlider(s.name, s.lower, s.upper, s.position) for s in sliders)
        self._move = move
        self._stale = True

    def drive_on(self, topic: str) -> None:
        """Have the pad publish there; the first topic that is asked for stays."""
        self._drive_topic = self._drive_topic or topic

    def show_image(self, topic: str) -> None:
        """Show the images of a topic, beside those of an rviz configuration."""
        if topic not in self._pictures:
            self._pictures.append(topic)

    def offer_options(self) -> None:
        """Let people change the options of every node that has some."""
        self._wants_options = True

    def show_graph(self) -> None:
        """Draw who publishes what to whom."""
        self._wants_graph = True

    def plot(self, fields: Sequence[str]) -> None:
        """Draw numbers over time, of `/topic/field/…`."""
        self._fields += fields

    def offer_joystick(self, move: Callable[[Sequence[float], Sequence[int]], None]) -> None:
        """Let people move a joystick; `move` takes its axes and buttons, on the graph's loop."""
        self._joysticks.append(move)
        self._stale = True

    async def show(self, node: Node, *, config: str | None = None, fixed_frame: str | None = None) -> int:
        """Serve the page until its process is gone or this is cancelled; a coroutine of the graph's loop.

        There is one page: it stays with the first node that shows it, and follows whatever configuration comes later.

        Args:
            node: whose name, remappings and clock are used.
            config: an .rviz file; None or a missing one means the usual displays.
            fixed_frame: overrides the file's.

        Raises:
            DescriptionError: the configuration is none.
            UsageError: the port asked for is taken.
        """
        if self._shown is not None:
            if config is not None:
                self._shown.follow(read_rviz_config(Path(config), self._report), fixed_frame)
                self._stale = True
            owner = self._shown.node.name
            node.log.info(f"the page is {owner}'s, at {self.url or 'an address that it will say'}")
            await node.closed.wait()
            return 0
        self._over = False
        with ExitStack() as open_things:
            open_things.callback(self.close)
            read = read_rviz_config(None if config is None else Path(config), self._report)
            self._shown = shown = ShownGraph(node, read, fixed_frame)
            open_things.callback(shown.close)
            first = self._layout(shown)
            self._viewer = await asyncio.to_thread(
                Viewer.start, first, host=self._host, port=self._port, allowed=self._allowed
            )
            self._say(f"see it at {self._viewer.url}")
            await self._feed(self._viewer, shown)
        return 0

    def close(self) -> None:
        """Take the page down; may be called twice."""
        self._shown = None
        self._over = True
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def _layout(self, shown: ShownGraph) -> ViewerScene:
        self._stale = False
        return graph_scene(
            shown.tree,
            shown.robot,
            shown.config,
            title=shown.title,
            collisions=shown.collisions,
            sliders=self._sliders,
            images=shown.images,
            figures=shown.figures,
            options=shown.groups,
            joystick=bool(self._joysticks),
        )

    async def _feed(self, viewer: Viewer, shown: ShownGraph) -> None:
        while viewer.alive:
            self._stale |= shown.listen(viewer, self._pictures)
            fields, self._fields = self._fields, []
            self._stale |= shown.draw(viewer, graph=self._wants_graph, fields=fields)
            if self._wants_options:
                shown.watch_options()
            await shown.look_for_robot(self._packages, self._report)
            if shown.look_at_frames() or self._stale:
                viewer.replace(self._layout(shown))
            now_ns = shown.node.clock.now_ns()
            viewer.show(
                graph_state(
                    shown.tree, shown.buffer, shown.robot, time_ns=now_ns, expects_frames=not self._is_of_windows
                )
            )
            for request in viewer.requests():
                self._obey(request, shown)
            shown.keep_driving()
            await asyncio.sleep(_PERIOD_S)

    def _obey(self, request: Request, shown: ShownGraph) -> None:
        match request:
            case SetJoint(name, position) if self._move is not None:
                self._move(name, position)
            case SetFixedFrame(name):
                shown.fixed_frame = name
            case Drive(linear, angular):
                shown.drive(linear, angular, on=self._drive_topic or _CMD_VEL)
            case SetOption() as option:
                shown.set_option(option)
            case MoveJoystick(axes, buttons):
                for move in self._joysticks:
                    move(axes, buttons)
            case _:
                pass
