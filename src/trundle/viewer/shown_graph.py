"""What the page shows of a graph, as far as it is known by now."""

import asyncio
import contextlib
import math
import time
from collections.abc import Sequence
from dataclasses import replace

from trundle.diagnostics import Diagnostics, TrundleError
from trundle.packages import Packages
from trundle.render import Scene
from trundle.robot import read_robot
from trundle.ros import MasterUnreachableError, Message, Node, Publisher, TransformListener
from trundle.xmlnode import parse_xml

from .content import OptionGroup
from .graph_figures import GraphFigures
from .graph_options import GraphOptions
from .graph_view import FrameTree
from .picture import rgb_of
from .requests import SetOption
from .robot_scene import robot_scene
from .rviz import RvizConfig, choose_fixed_frame
from .viewer import Viewer

_LOOK_AGAIN_S = 1.0
"""How often a robot description is asked for that was not there."""
_DRIVE_PERIOD_S = 0.1
"""Controllers stop a robot whose commands cease: 10 Hz, as the tutorials' `rostopic pub -r 10`."""
_EMPTY = Scene(bodies=(), shapes=())


class ShownGraph:
    """What the page shows of the graph, as far as it is known by now."""

    def __init__(self, node: Node, config: RvizConfig, fixed_frame: str | None) -> None:
        self.node = node
        self.config = config
        self.fixed_frame = fixed_frame
        self.robot = _EMPTY
        self.collisions: Scene | None = None
        self.title = "Trundle"
        self.buffer = TransformListener(node).buffer
        self.images = _images(config)
        self._heard = 0
        """Images that are listened to."""
        self._figures = GraphFigures(node)
        self._options: GraphOptions | None = None
        self._watching: asyncio.Task[None] | None = None
        self.groups: tuple[OptionGroup, ...] = ()
        self.tree = self._tree()
        self._look_due = 0.0
        self._found = False
        self._robot_is_new = False
        self._cmd_vel: Publisher | None = None
        self._command = (0.0, 0.0)
        self._drive_due = math.inf

    def follow(self, config: RvizConfig, fixed_frame: str | None) -> None:
        """Show by another configuration from now on."""
        self.config, self.fixed_frame = config, fixed_frame
        self.images += tuple(topic for topic in _images(config) if topic not in self.images)
        self._found, self._look_due = False, 0.0

    def listen(self, viewer: Viewer, more: Sequence[str]) -> bool:
        """Hand the images of the configured topics, and of others, to the page; return whether there are new ones."""
        added = tuple(topic for topic in more if topic not in self.images)
        self.images += added
        new, self._heard = self.images[self._heard :], len(self.images)
        for topic in new:
            index = self.images.index(topic)
            self.node.subscribe(
                topic,
                "sensor_msgs/Image",
                lambda message, index=index: _pass_on(viewer, index, message),
                queue_size=1,
                on_loop=True,
            )
        return bool(added)

    @property
    def figures(self) -> tuple[str, ...]:
        """Titles of what is drawn beside the scene."""
        return self._figures.titles

    def draw(self, viewer: Viewer, *, graph: bool, fields: list[str]) -> bool:
        """Hand newest drawings to the page, and begin others that are asked for; return whether there are such."""
        before = self.figures
        self._figures.want(graph=graph, fields=fields)
        if self.figures != before:
            return True
        for index, title in enumerate(before):
            drawing = self._figures.drawings.pop(title, None)
            if drawing is not None and not viewer.figure(index, drawing):
                self.node.log.warn(f"the drawing {title!r} is too large for the page; trundle graph -o FILE writes it")
        return False

    def watch_options(self) -> None:
        """Look for nodes with options."""
        if self._options is None:
            self._options = GraphOptions(self.node)
            self._watching = asyncio.create_task(self._options.watch())

    def set_option(self, request: SetOption) -> None:
        """Change an option of a node."""
        if self._options is not None:
            self.node.loop.spawn(self._options.set(request))

    def close(self) -> None:
        """End what goes on beside."""
        self._figures.close()
        if self._watching is not None:
            self._watching.cancel()

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
            name = await self.node.params.search(source) or source
            text = await self.node.params.get(name, None)
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
            self.node.log.error(f"URDF failed Model parse: {error}")  # rviz's own words
            return
        self.title = robot.name
        self._robot_is_new = True

    def drive(self, linear: float, angular: float, *, on: str) -> None:
        """Publish a velocity on a topic now, and again until another comes."""
        if self._cmd_vel is not None and self._cmd_vel.topic != on:
            self._cmd_vel.unregister()
            self._cmd_vel = None
        if self._cmd_vel is None:
            self._cmd_vel = self.node.advertise(on, "geometry_msgs/Twist", queue_size=1)
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
        groups = () if self._options is None else self._options.groups
        changed = self._robot_is_new or groups != self.groups
        self._robot_is_new, self.groups = False, groups
        return changed

    def _tree(self) -> FrameTree:
        fixed = self.fixed_frame or choose_fixed_frame(self.config, self.buffer.frames())
        return FrameTree.of(self.buffer, fixed.removeprefix("/"))


def _images(config: RvizConfig) -> tuple[str, ...]:
    return tuple(display.source for display in config.enabled("Image") if display.source)


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
