"""Statistics for `tf tree` and `tf monitor`: broadcasters, rates and delays of transforms."""

from collections import deque
from dataclasses import dataclass, field

from trundle.ros import Clock, Node, RawMessage, to_nsec

_WINDOW = 1000
"""Window of the averages [messages]."""
_TYPE = "tf2_msgs/TFMessage"


@dataclass(slots=True)
class FrameStatistics:
    """Statistics of one frame."""

    child: str
    parent: str
    caller: str
    is_static: bool
    stamps: deque[float] = field(default_factory=lambda: deque[float](maxlen=_WINDOW))
    """Stamps of the transforms [s]."""
    delays: deque[float] = field(default_factory=lambda: deque[float](maxlen=_WINDOW))
    """Age of the transforms on arrival [s]."""

    @property
    def rate_hz(self) -> float | None:
        """Rate of the stamps; None before the second transform."""
        span = max(self.stamps) - min(self.stamps) if self.stamps else 0.0
        return (len(self.stamps) - 1) / span if span > 0 else None


@dataclass(slots=True)
class SenderStatistics:
    """Statistics of one broadcaster."""

    name: str
    arrivals: deque[float] = field(default_factory=lambda: deque[float](maxlen=_WINDOW))
    delays: deque[float] = field(default_factory=lambda: deque[float](maxlen=_WINDOW))


class TransformMonitor:
    """Collects statistics of /tf and /tf_static; read on the loop."""

    def __init__(self, node: Node, clock: Clock) -> None:
        self._node = node
        self._clock = clock
        self.frames: dict[str, FrameStatistics] = {}
        self.senders: dict[str, SenderStatistics] = {}
        self.other_parents: dict[str, set[tuple[str, str]]] = {}
        """Frame with alternating parents → (parent, broadcaster)."""
        for topic, is_static in (("/tf", False), ("/tf_static", True)):
            node.subscribe(
                topic, "*", lambda m, s=is_static: self._on_message(m, is_static=s), queue_size=None, on_loop=True
            )

    def _on_message(self, raw: RawMessage, *, is_static: bool) -> None:
        now_s = self._clock.now_ns() / 1e9
        sender = self.senders.setdefault(raw.caller, SenderStatistics(raw.caller))
        sender.arrivals.append(now_s)
        for item in self._node.messages.deserialize(raw.data, _TYPE).transforms:
            child, parent = item.child_frame_id.removeprefix("/"), item.header.frame_id.removeprefix("/")
            frame = self.frames.get(child)
            if frame is None or (frame.parent, frame.caller) != (parent, raw.caller):
                if frame is not None and frame.parent != parent:
                    self.other_parents.setdefault(child, set()).update(
                        {(frame.parent, frame.caller), (parent, raw.caller)}
                    )
                frame = self.frames[child] = FrameStatistics(child, parent, raw.caller, is_static)
            stamp_s = to_nsec(item.header.stamp) / 1e9
            frame.stamps.append(stamp_s)
            frame.delays.append(now_s - stamp_s)
            sender.delays.append(now_s - stamp_s)
