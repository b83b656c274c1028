"""tf broadcasters, and a listener that fills a buffer. Quaternions are xyzw in messages only."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from ..messages.raw_message import Message
from ..node.clock import SimClock, to_nsec
from ..node.graph_node import Node
from .tf_buffer import TransformBuffer
from .transform_history import Transform

if TYPE_CHECKING:
    from ..message_types import tf2_msgs

_TYPE = "tf2_msgs/TFMessage"
_QUEUE = 100
"""Queue size of tf2_ros."""


class TransformBroadcaster:
    """Publishes transforms on /tf."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publisher = node.advertise("/tf", _TYPE, queue_size=_QUEUE)

    @property
    def has_subscribers(self) -> bool:
        """True if /tf has subscribers; otherwise transforms need not be computed."""
        return self._publisher.has_subscribers

    def send_transform(self, *transforms: Transform) -> None:
        """Publish transforms in one message; thread-safe."""
        if self.has_subscribers:
            self._publisher.publish(transform_message(self._node, transforms))


class StaticTransformBroadcaster:
    """Publishes static transforms on /tf_static, latched."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._publisher = node.advertise("/tf_static", _TYPE, latch=True, queue_size=_QUEUE)
        self._sent: dict[str, Transform] = {}

    def send_transform(self, *transforms: Transform) -> None:
        """Publish transforms together with all earlier ones; a new transform replaces its child's earlier one."""
        self._sent.update({transform.child: transform for transform in transforms})
        self._publisher.publish(transform_message(self._node, tuple(self._sent.values())))


class TransformListener:
    """Fills a buffer from /tf and /tf_static."""

    def __init__(
        self, node: Node, buffer: TransformBuffer | None = None, *, on_change: Callable[[], None] | None = None
    ) -> None:
        """Subscribe.

        Args:
            node: node that subscribes; the buffer is used on its loop only.
            buffer: buffer to fill, a new one by default; cleared when simulated time jumps back.
            on_change: called on the loop after each message.
        """
        self.buffer = buffer or TransformBuffer()
        self._on_change = on_change
        node.subscribe("/tf", _TYPE, lambda m: self._on_message(m, static=False), queue_size=_QUEUE, on_loop=True)
        node.subscribe("/tf_static", _TYPE, lambda m: self._on_message(m, static=True), queue_size=_QUEUE, on_loop=True)
        if isinstance(node.clock, SimClock):
            node.clock.on_jump(self.buffer.clear)

    def _on_message(self, message: "tf2_msgs.TFMessage", *, static: bool) -> None:
        for transform in read_transforms(message):
            self.buffer.set_transform(transform, static=static)
        if self._on_change is not None:
            self._on_change()


def transform_message(node: Node, transforms: tuple[Transform, ...]) -> Message:
    """Convert transforms to a tf2_msgs/TFMessage."""
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


def read_transforms(message: "tf2_msgs.TFMessage") -> list[Transform]:
    """Convert a tf2_msgs/TFMessage to transforms."""
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
