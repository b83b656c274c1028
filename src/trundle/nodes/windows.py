"""Programs that are windows on the graph: image_view, and those of rqt; the page stands in for all of them."""

from trundle.ros import Message, Node

from .host import Host


class ImageView:
    """image_view/image_view: listens to `image`, and says once what it sees; pictures are on the page."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments
        self._node = node
        self._display = host.display
        self._seen = False

    async def run(self) -> int:
        """Look until cancelled."""
        node = self._node
        images = node.subscribe("image", "sensor_msgs/Image", self._take, queue_size=1)
        where = "" if self._display is None else "; the page shows the images that an rviz configuration names"
        node.log_info(f"listening to {images.topic}{where}")
        await node.closed.wait()
        return 0

    def _take(self, image: Message) -> None:
        if not self._seen:
            self._node.log_info(f"images of {image.width} × {image.height} pixels, {image.encoding}")
        self._seen = True


class RqtWindow:
    """Any program of rqt: the launch's page, or nothing without one."""

    def __init__(self, node: Node, arguments: list[str], host: Host) -> None:
        del arguments
        self._node = node
        self._display = host.display

    async def run(self) -> int:
        """Show until the page is closed for good."""
        if self._display is not None:
            return await self._display.show(self._node, config=None, fixed_frame=None)
        await self._node.closed.wait()
        return 0
