"""The page of a graph: what rviz shows of it, kept up to date from topics, with a pad that drives."""

import asyncio
import contextlib
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

from trundle.diagnostics import Diagnostics, TrundleError
from trundle.packages import Packages
from trundle.render import Scene
from trundle.robot import read_robot
from trundle.ros import MasterUnreachableError, Message, Node, Publisher, TransformListener
from trundle.xmlnode import parse_xml

from .content import JointSlider, ViewerScene
from .graph_view import FrameTree, graph_scene, graph_state
from .picture import rgb_of
from .requests import Drive, SetFixedFrame, SetJoint
from .robot_scene import robot_scene
from .rviz import RvizConfig, choose_fixed_frame, read_rviz_config
from .viewer import Viewer

_PERIOD_S = 1 / 30
_LOOK_AGAIN_S = 1.0
"""How often a robot description is asked for that was not there."""
_DRIVE_PERIOD_S = 0.1
"""Controllers stop a robot whose commands cease: 10 Hz, as the tutorials' `rostopic pub -r 10`."""
_EMPTY = Scene(bodies=(), shapes=())


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
    ) -> None:
        """`say` takes what people must see whatever becomes of a node's log: where the page is."""
        self._say = say
        self._packages = packages
        self._report = report
        self._host = host
        self._port = port
        self._viewer: Viewer | None = None
        self._sliders: tuple[JointSlider, ...] = ()
        self._move: Callable[[str, float], None] | None = None
        self._stale = True

    @property
    def url(self) -> str | None:
        """Where the page is; None before it is served."""
        return None if self._viewer is None else self._viewer.url

    def offer_sliders(self, sliders: Sequence[OfferedSlider], move: Callable[[str, float], None]) -> None:
        """Let people move joints; `move` takes a joint's name and position, on the graph's loop."""
        self._sliders = tuple(JointSlider(s.name, s.lower, s.upper, s.position) for s in sliders)
        self._move = move
        self._stale = True

    async def show(self, node: Node, *, config: str | None = None, fixed_frame: str | None = None) -> int:
        """Serve the page until its process is gone or this is cancelled; a coroutine of the graph's loop.

        Args:
            node: whose name, remappings and clock are used.
            config: an .rviz file; None or a missing one means the usual displays.
            fixed_frame: overrides the file's.

        Raises:
            DescriptionError: the configuration is none.
            UsageError: the port asked for is taken.
        """
        if self._viewer is not None:
            node.log_info(f"the page is already open at {self._viewer.url}")
            await node.closed.wait()
            return 0
        read = read_rviz_config(None if config is None else Path(config), self._report)
        shown = _Shown(node, read, fixed_frame)
        try:
            first = self._layout(shown)
            self._viewer = await asyncio.to_thread(Viewer.start, first, host=self._host, port=self._port)
            self._say(f"see it at {self._viewer.url}")
            await self._feed(self._viewer, shown)
        finally:
            self.close()
        return 0

    def close(self) -> None:
        """Take the page down; may be called twice."""
        if self._viewer is not None:
            self._viewer.close()
            self._viewer = None

    def _layout(self, shown: "_Shown") -> ViewerScene:
        self._stale = False
        return graph_scene(
            shown.tree,
            shown.robot,
            shown.config,
            title=shown.title,
            collisions=shown.collisions,
            sliders=self._sliders,
            images=shown.images,
        )

    async def _feed(self, viewer: Viewer, shown: "_Shown") -> None:
        shown.listen(viewer)
        while viewer.alive:
            await shown.look_for_robot(self._packages, self._report)
            if shown.look_at_frames() or self._stale:
                viewer.replace(self._layout(shown))
            viewer.show(graph_state(shown.tree, shown.buffer, shown.robot, time_ns=shown.node.clock.now_ns()))
            for request in viewer.requests():
                match request:
                    case SetJoint(name, position) if self._move is not None:
                        self._move(name, position)
                    case SetFixedFrame(name):
                        shown.fixed_frame = name
                    case Drive(linear, angular):
                        shown.drive(linear, angular)
                    case _:
                        pass
            shown.keep_driving()
            await asyncio.sleep(_PERIOD_S)


class _Shown:
    """What the page shows of the graph, as far as it is known by now."""

    def __init__(self, node: Node, config: RvizConfig, fixed_frame: str | None) -> None:
        self.node = node
        self.config = config
        self.fixed_frame = fixed_frame
        self.robot = _EMPTY
        self.collisions: Scene | None = None
        self.title = "Trundle"
        self.buffer = TransformListener(node).buffer
        self.images = tuple(display.source for display in config.enabled("Image") if display.source)
        self.tree = self._tree()
        self._look_due = 0.0
        self._found = False
        self._robot_is_new = False
        self._cmd_vel: Publisher | None = None
        self._command = (0.0, 0.0)
        self._drive_due = math.inf

    def listen(self, viewer: Viewer) -> None:
        """Hand the images of the configured topics to the page."""
        for index, topic in enumerate(self.images):
            self.node.subscribe(
                topic,
                "sensor_msgs/Image",
                lambda message, index=index: _pass_on(viewer, index, message),
                queue_size=1,
                on_loop=True,
            )

    def look_at_frames(self) -> bool:
        """See which frames there are; return whether the page must be laid out anew."""
        before, self.tree = self.tree, self._tree()
        if self.fixed_frame is not None:  # chosen at the page, which draws in it already
            before = replace(before, fixed_frame=self.tree.fixed_frame)
        return self.tree != before or self._changed()

    async def look_for_robot(self, packages: Packages, report: Diagnostics) -> None:
        """Read the robot's description, once there is one."""
        now = time.monotonic()
        if self._found or now < self._look_due:
            return
        self._look_due = now + _LOOK_AGAIN_S
        source = next((d.source for d in self.config.enabled("RobotModel") if d.source), "robot_description")
        try:
            name = await self.node.search_param(source) or source
            text = await self.node.get_param(name, None)
        except MasterUnreachableError:
            return  # it may come back; what is known is shown meanwhile
        if not isinstance(text, str):
            return
        self._found = True
        try:
            robot = read_robot(parse_xml(text, name=self.node.resolve(name)), report)
            # Meshes take their time; topics go on meanwhile.
            self.robot = await asyncio.to_thread(robot_scene, robot, packages, report)
            self.collisions = await asyncio.to_thread(robot_scene, robot, packages, report, collisions=True)
        except TrundleError as error:
            self.node.log_error(f"URDF failed Model parse: {error}")  # rviz's own words
            return
        self.title = robot.name
        self._robot_is_new = True

    def drive(self, linear: float, angular: float) -> None:
        """Publish a velocity now, and again until another comes."""
        if self._cmd_vel is None:
            self._cmd_vel = self.node.advertise("/cmd_vel", "geometry_msgs/Twist", queue_size=1)
        self._command = (linear, angular)
        self._drive_due = 0.0
        self.keep_driving()

    def keep_driving(self) -> None:
        """Repeat a velocity that is not zero, ten times a second."""
        now = time.monotonic()
        if self._cmd_vel is None or now < self._drive_due:
            return
        linear, angular = self._command
        self._cmd_vel.publish({"linear": {"x": linear}, "angular": {"z": angular}})
        self._drive_due = now + _DRIVE_PERIOD_S if linear or angular else math.inf

    def _changed(self) -> bool:
        changed, self._robot_is_new = self._robot_is_new, False
        return changed

    def _tree(self) -> FrameTree:
        fixed = self.fixed_frame or choose_fixed_frame(self.config, self.buffer.frames())
        return FrameTree.of(self.buffer, fixed.removeprefix("/"))


def _pass_on(viewer: Viewer, index: int, message: Message) -> None:
    rgb = rgb_of(
        message.data,
        encoding=message.encoding,
        height=message.height,
        width=message.width,
        step=message.step,
        big_endian=bool(message.is_bigendian),
    )
    if rgb is not None:
        with contextlib.suppress(IndexError):  # the page was laid out anew with fewer images
            viewer.image(index, rgb)
