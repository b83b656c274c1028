"""tf2_web_republisher: transforms for web pages, at requested rates and thresholds."""

import asyncio
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from trundle.ros import (
    ActionResult,
    ActionServer,
    Node,
    ServiceError,
    Transform,
    TransformBuffer,
    TransformError,
    TransformListener,
    to_nsec,
)

from .host import NodeHost

if TYPE_CHECKING:
    from trundle.ros.message_types import tf2_web_republisher

_MAX_RATE_HZ = 1000.0
_MAX_REQUESTS = 1000


@dataclass(slots=True)
class TransformPair:
    """A transform that a client watches."""

    source: str
    target: str
    sent: Transform | None = None
    is_broken: bool = False


@dataclass(slots=True, kw_only=True)
class TransformWatch:
    """Transforms that a client watches; a transform is due when it has changed enough."""

    pairs: list[TransformPair]
    angle: float
    """[rad]; 0: every transform is due."""
    distance: float
    """[m]; 0: every transform is due."""
    period_s: float
    log: list[str] = field(default_factory=list[str])

    def due(self, look_up: Callable[[str, str], Transform]) -> list[tuple[TransformPair, Transform]]:
        """Return the transforms that have moved by more than a threshold since they were last returned."""
        changed: list[tuple[TransformPair, Transform]] = []
        for pair in self.pairs:
            try:
                transform = look_up(pair.target, pair.source)
            except TransformError as error:
                if not pair.is_broken:
                    self.log.append(str(error))
                pair.is_broken = True
                continue
            pair.is_broken = False
            if pair.sent is None or self._has_moved(pair.sent, transform):
                pair.sent = transform
                changed.append((pair, transform))
        return changed

    def _has_moved(self, old: Transform, new: Transform) -> bool:
        if self.distance == 0.0 or self.angle == 0.0:
            return True
        dot = abs(sum(a * b for a, b in zip(old.rotation, new.rotation, strict=True)))
        angle = 2.0 * math.acos(min(dot, 1.0))
        return math.dist(old.translation, new.translation) > self.distance or angle > self.angle


class Tf2WebRepublisher:
    """The action `tf2_web_republisher` and the service `republish_tfs`."""

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node
        self._requests: set[asyncio.Task[None]] = set()
        self._count = 0

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        self._buffer = TransformListener(node, TransformBuffer()).buffer
        self._action = ActionServer(
            node, node.name, "tf2_web_republisher/TFSubscription", self._on_goal, concurrent=True
        )
        node.advertise_service("republish_tfs", "tf2_web_republisher/RepublishTFs", self._on_request)
        try:
            await node.closed.wait()
        finally:
            for task in self._requests:
                task.cancel()
        return 0

    async def _on_goal(
        self, goal: "tf2_web_republisher.TFSubscriptionGoal", accept: Callable[[], None]
    ) -> ActionResult:
        """Publish feedback until the goal is cancelled."""
        accept()
        watch = _watch(goal)
        while True:
            await self._node.clock.sleep(watch.period_s)
            transforms = self._transforms(watch)
            if transforms:
                self._action.publish_feedback({"transforms": transforms}, goal=goal)

    async def _on_request(self, request: "tf2_web_republisher.RepublishTFsRequest") -> dict[str, Any]:
        """Publish on a new topic, until it has had no subscribers for the timeout."""
        if len(self._requests) >= _MAX_REQUESTS:
            raise ServiceError(f"{_MAX_REQUESTS} requests are being served already")
        topic = self._node.resolve(f"~tf_repub_{self._count}")
        self._count += 1
        task = asyncio.create_task(self._republish(topic, _watch(request), to_nsec(request.timeout) / 1e9))
        self._requests.add(task)
        task.add_done_callback(self._requests.discard)
        self._node.log.info(f"Publishing requested TFs on topic {topic}")
        return {"topic_name": topic}

    async def _republish(self, topic: str, watch: TransformWatch, timeout_s: float) -> None:
        clock = self._node.clock
        publisher = self._node.advertise(topic, "tf2_web_republisher/TFArray", latch=True)
        subscribed_ns = clock.now_ns()
        while clock.now_ns() - subscribed_ns <= timeout_s * 1e9:
            await clock.sleep(watch.period_s)
            if publisher.has_subscribers:
                subscribed_ns = clock.now_ns()
            transforms = self._transforms(watch)
            if transforms:
                publisher.publish({"transforms": transforms})
        publisher.unregister()
        self._node.log.info(f"No subscribers on {topic} for {timeout_s:g} seconds. Unadvertising it.")

    def _transforms(self, watch: TransformWatch) -> list[dict[str, Any]]:
        """Return the messages of due transforms, with the current stamp."""
        now = self._node.clock.now_ns()
        messages = [_stamped(pair, transform, now) for pair, transform in watch.due(self._buffer.lookup_transform)]
        for text in watch.log:
            self._node.log.error(text)
        watch.log.clear()
        return messages


def _watch(
    request: "tf2_web_republisher.TFSubscriptionGoal | tf2_web_republisher.RepublishTFsRequest",
) -> TransformWatch:
    sources: Sequence[str] = request.source_frames
    rate = min(request.rate, _MAX_RATE_HZ) if request.rate > 0.0 else 1.0
    return TransformWatch(
        pairs=[TransformPair(source.removeprefix("/"), request.target_frame.removeprefix("/")) for source in sources],
        angle=request.angular_thres,
        distance=request.trans_thres,
        period_s=1.0 / rate,
    )


def _stamped(pair: TransformPair, transform: Transform, now_ns: int) -> dict[str, Any]:
    (x, y, z), (qw, qx, qy, qz) = transform.translation, transform.rotation
    return {
        "header": {"stamp": now_ns, "frame_id": pair.target},
        "child_frame_id": pair.source,
        "transform": {"translation": {"x": x, "y": y, "z": z}, "rotation": {"x": qx, "y": qy, "z": qz, "w": qw}},
    }
