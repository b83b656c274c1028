"""Graphical tools: image_view and rqt; the page replaces all of them."""

from typing import TYPE_CHECKING

from trundle.base.diagnostics import TrundleError
from trundle.ros import Node

from .host import Display, NodeHost
from .private_parameters import private_parameters

if TYPE_CHECKING:
    from trundle.ros.message_types import sensor_msgs


class Window:
    """Any rqt program: opens the page, if there is one."""

    panel = ""
    """Program whose panel is opened; empty: no panel."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        self._node = node
        self._arguments = arguments
        self._display = host.display

    async def run(self) -> int:
        """Show until the page is closed."""
        if self._display is not None:
            self._prepare(self._display)
            return await self._display.show(self._node, config=None, fixed_frame=None)
        await self._node.closed.wait()
        return 0

    def _prepare(self, display: Display) -> None:
        """Request the window's content from the page."""
        if self.panel:
            display.open_panel(self.panel)


class ImageView(Window):
    """image_view/image_view: images of `image`; logs their size and encoding once."""

    panel = "rqt_image_view"

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        super().__init__(node, arguments, host)
        self._is_logged = False

    async def run(self) -> int:
        """Show until the page is closed."""
        images = self._node.subscribe("image", "sensor_msgs/Image", self._on_image, queue_size=1)
        self._node.log.info(f"listening to {images.topic}")
        return await super().run()

    def _prepare(self, display: Display) -> None:
        super()._prepare(display)
        display.show_image(self._node.resolve("image"))

    def _on_image(self, image: "sensor_msgs.Image") -> None:
        if not self._is_logged:
            self._node.log.info(f"images of {image.width} × {image.height} pixels, {image.encoding}")
        self._is_logged = True


class RqtImageView(Window):
    """rqt_image_view: images of the given topic."""

    panel = "rqt_image_view"

    def _prepare(self, display: Display) -> None:
        super()._prepare(display)
        for word in self._arguments:
            if not word.startswith("-"):
                display.show_image(self._node.resolve(word))


class RqtRobotSteering(Window):
    """rqt_robot_steering: the page's pad publishes on ~default_topic."""

    panel = "rqt_robot_steering"

    async def run(self) -> int:
        """Show until the page is closed."""
        node = self._node
        try:
            self._topic = (await private_parameters(node)).text("default_topic", "/cmd_vel")
        except TrundleError as error:
            node.log.error(str(error))
            return 1
        return await super().run()

    def _prepare(self, display: Display) -> None:
        super()._prepare(display)
        display.drive_on(self._node.resolve(self._topic))


class RqtPlot(Window):
    """rqt_plot: plots the given fields, `/topic/field:field`, separated by spaces or commas."""

    def _prepare(self, display: Display) -> None:
        fields = [
            field for argument in self._arguments if not argument.startswith("-") for field in argument.split(",")
        ]
        display.plot([self._node.resolve(field) for field in fields if field])


class PanelWindow:
    """A program whose window is one panel of the page; callable like a node class."""

    def __init__(self, program: str, summary: str) -> None:
        self._program = program
        self.__doc__ = f"{program}: {summary}."

    def __call__(self, node: Node, arguments: list[str], host: NodeHost) -> Window:
        """Return a window that opens the panel."""
        window = Window(node, arguments, host)
        window.panel = self._program
        return window


RqtBag = PanelWindow("rqt_bag", "the timeline")
RqtConsole = PanelWindow("rqt_console", "the log")
RqtGraph = PanelWindow("rqt_graph", "nodes and topics")
RqtPublisher = PanelWindow("rqt_publisher", "publishes messages that a person types")
RqtReconfigure = PanelWindow("rqt_reconfigure", "the options of all nodes")
RqtRobotMonitor = PanelWindow("rqt_robot_monitor", "diagnostics")
RqtServiceCaller = PanelWindow("rqt_service_caller", "calls services")
RqtTfTree = PanelWindow("rqt_tf_tree", "frames and their parents")
RqtTopic = PanelWindow("rqt_topic", "topics with rate, bandwidth and messages")
