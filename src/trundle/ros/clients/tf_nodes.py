"""tf on a node: broadcasters, and a listener that fills a buffer. Quaternions are xyzw on the wire only."""

from typing import Any

from ..messages.messages import Message
from ..node.clock import SimClock, to_nsec
from ..node.node import Node
from .tf_buffer import Transform, TransformBuffer

_TYPE = "tf2_msgs/TFMessage"
_QUEUE = 100
"""As tf2_ros."""


class TransformBroadcaster:
    """Sends transforms on /tf."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publisher = node.advertise("/tf", _TYPE, queue_size=_QUEUE)

    @property
    def has_subscribers(self) -> bool:
        """Whether anybody listens: if not, there is no need to make transforms."""
        return self._publisher.has_subscribers

    def send_transform(self, *transforms: Transform) -> None:
        """Send transforms in one message, from any thread."""
        if self.has_subscribers:
            self._publisher.publish(transform_message(self._node, transforms))


class StaticTransformBroadcaster:
    """Sends transforms that never change on /tf_static; newcomers get all of them."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publisher = node.advertise("/tf_static", _TYPE, latch=True, queue_size=_QUEUE)
        self._sent: dict[str, Transform] = {}

    def send_transform(self, *transforms: Transform) -> None:
        """Send transforms, with all that were sent before: a later one of the same child replaces it."""
        self._sent.update({transform.child: transform for transform in transforms})
        self._publisher.publish(transform_message(self._node, tuple(self._sent.values())))


class TransformListener:
    """Keeps a buffer up to date with /tf and /tf_static."""

    def __init__(self, node: Node, buffer: TransformBuffer | None = None) -> None:
        """Listen.

        Args:
            node: subscribes; the buffer is filled on its loop, where it should also be asked.
            buffer: to fill; a new one by default. Emptied of what moves when the node's simulated time goes back.
        """
        self.buffer = buffer or TransformBuffer()
        node.subscribe("/tf", _TYPE, lambda m: self._on_message(m, static=False), queue_size=_QUEUE, on_loop=True)
        node.subscribe("/tf_static", _TYPE, lambda m: self._on_message(m, static=True), queue_size=_QUEUE, on_loop=True)
        if isinstance(node.clock, SimClock):
            node.clock.on_jump(self.buffer.clear)

    def _on_message(self, message: Message, *, static: bool) -> None:
        for transform in read_transforms(message):
            self.buffer.set_transform(transform, static=static)


def transform_message(node: Node, transforms: tuple[Transform, ...]) -> Message:
    """Make a tf2_msgs/TFMessage."""
    items: list[dict[str, Any]] = []
    for transform in transforms:
        (x, y, z), (qw, qx, qy, qz) = transform.translation, transform.rotation
        items.append(
            {
                "header": {"stamp": transform.stamp_ns, "frame_id": transform.parent},
                "child_frame_id": transform.child,
                "transform": {
                    "translation": {"x": x, "y": y, "z": z},
                    "rotation": {"x": qx, "y": qy, "z": qz, "w": qw},
                },
            }
        )
    return node.new(_TYPE, {"transforms": items})


def read_transforms(message: Message) -> list[Transform]:
    """Read a tf2_msgs/TFMessage."""
    result: list[Transform] = []
    for item in message.transforms:
        t, q = item.transform.translation, item.transform.rotation
        result.append(
            Transform(
                parent=item.header.frame_id,
                child=item.child_frame_id,
                stamp_ns=to_nsec(item.header.stamp),
                translation=(t.x, t.y, t.z),
                rotation=(q.w, q.x, q.y, q.z),
            )
        )
    return result
