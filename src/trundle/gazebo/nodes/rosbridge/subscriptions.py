"""A client's subscriptions: throttled, queued and encoded by its settings."""

import asyncio
import time
from collections import deque
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from typing import Any

import msgspec

from trundle.ros import Message, MessageError, Node, RawMessage, Subscription as RosSubscription

from .cbor import cbor_values, dump_cbor
from .json_values import JsonEncoder
from .png import encode_png
from .topic_types import resolve_type

_ANY = "*"
_MAX_QUEUE = 10_000
_COMPRESSIONS = ("cbor-raw", "cbor", "png")
"""Encodings by precedence: all of a client's subscriptions to a topic use the first one that any of them requests, as
in rosbridge_library."""

Send = Callable[[str | bytes], bool]


@dataclass(frozen=True, slots=True, kw_only=True)
class Settings:
    """Options of one `subscribe`."""

    throttle_ms: float = 0.0
    queue_length: int = 0
    compression: str = "none"


class Subscription:
    """One topic of one client."""

    def __init__(
        self,
        node: Node,
        topic: str,
        encoder: JsonEncoder,
        send: Send,
        wait_idle: Callable[[], Awaitable[object]],
        kind: str,
    ) -> None:
        """Prepare; `subscribe` subscribes.

        Args:
            node: node that subscribes.
            topic: topic in the client's request.
            encoder: encoder of messages.
            send: queues a message for the client; False: the client is too slow.
            wait_idle: coroutine function that waits until the client is not busy.
            kind: message type.
        """
        self._node = node
        self._topic = topic
        self._encoder = encoder
        self._send = send
        self._wait_idle = wait_idle
        self.kind = kind
        self._settings: dict[object, Settings] = {}
        self._subscription: RosSubscription | None = None
        self._subscribed_kind = ""
        self._queue: deque[Message] = deque(maxlen=1)
        self._filled = asyncio.Event()
        self._send_task: asyncio.Task[None] | None = None
        self._sent_s = 0.0
        self._throttle_s = 0.0
        self._queue_length = 0
        self._compression = "none"
        self._has_warned = False

    @property
    def is_empty(self) -> bool:
        """True after the last `unsubscribe`."""
        return not self._settings

    def subscribe(self, key: object, settings: Settings) -> None:
        """Add settings under an id; the minimum of all settings counts."""
        self._settings[key] = settings
        self._update()

    def unsubscribe(self, key: object) -> None:
        """Remove the settings of an id; None: all."""
        if key is None:
            self._settings.clear()
        self._settings.pop(key, None)
        if self._settings:
            self._update()
        else:
            self.close()

    def close(self) -> None:
        """Unsubscribe."""
        if self._subscription is not None:
            self._subscription.unregister()
            self._subscription = None
        if self._send_task is not None:
            self._send_task.cancel()
            self._send_task = None

    def _update(self) -> None:
        settings = self._settings.values()
        self._throttle_s = max(min(item.throttle_ms for item in settings), 0.0) / 1e3
        self._queue_length = max(min(min(item.queue_length for item in settings), _MAX_QUEUE), 0)
        requested = {item.compression for item in settings}
        self._compression = next((item for item in _COMPRESSIONS if item in requested), "none")
        self._queue = deque(self._queue, maxlen=max(self._queue_length, 1))
        if self._queue_length and self._send_task is None:
            self._send_task = asyncio.get_running_loop().create_task(self._send_queued())
        is_raw = self._compression == "cbor-raw" or not self._node.messages.has(self.kind)
        kind = _ANY if is_raw else self.kind
        if kind != self._subscribed_kind:
            if self._subscription is not None:
                self._subscription.unregister()
            self._subscribed_kind = kind
            self._subscription = self._node.subscribe(self._topic, kind, self._receive, on_loop=True)

    def _receive(self, message: Message) -> None:
        if self._queue_length:
            self._queue.append(message)
            self._filled.set()
        elif self._remaining_s() <= 0.0:
            self._deliver(message)

    def _remaining_s(self) -> float:
        return self._sent_s + self._throttle_s - time.monotonic()

    async def _send_queued(self) -> None:
        """Send queued messages as the throttle and the client allow."""
        while True:
            self._filled.clear()
            await self._filled.wait()
            while self._queue:
                await asyncio.sleep(max(self._remaining_s(), 0.0))
                await self._wait_idle()
                if self._queue:
                    self._deliver(self._queue.popleft())

    def _deliver(self, message: Message) -> None:
        self._sent_s = time.monotonic()
        try:
            encoded = self._encode(message)
        except MessageError as error:
            self._warn(f"{self._topic}: {error}")
            return
        if not self._send(encoded):
            self._warn(f"{self._topic}: a client is too slow; messages to it are dropped")

    def _warn(self, text: str) -> None:
        if not self._has_warned:
            self._has_warned = True
            self._node.log.warn(text)

    def _encode(self, message: Message) -> str | bytes:
        head = {"op": "publish", "topic": self._topic}
        if self._compression == "cbor-raw":
            now = self._node.clock.now_ns()
            raw = {"secs": now // 10**9, "nsecs": now % 10**9, "bytes": bytes(message.data)}
            return dump_cbor({**head, "msg": raw})
        kind, messages = self.kind, self._node.messages
        if isinstance(message, RawMessage):
            messages.add_definition(message.type, message.definition)
            kind, message = message.type, messages.deserialize(message.data, message.type)
        if self._compression == "cbor":
            return dump_cbor({**head, "msg": cbor_values(messages, message, kind)})
        text = dump_json({**head, "msg": self._encoder.values(message, kind)})
        return dump_json({"op": "png", "data": encode_png(text)}) if self._compression == "png" else text


async def make_subscription(
    node: Node,
    topic: str,
    requested_type: str | None,
    *,
    encoder: JsonEncoder,
    send: Send,
    wait_idle: Callable[[], Awaitable[object]],
    is_raw: bool,
) -> Subscription:
    """Return a subscription with the requested or the established type.

    Raises:
        RosbridgeError: the type is unknown, or the topic has another.
        RosError: no such type, or no master.
    """
    kind = _ANY if is_raw and requested_type is None else await resolve_type(node, topic, requested_type)
    if requested_type is not None:
        node.messages.md5(kind)
    return Subscription(node, topic, encoder, send, wait_idle, kind)


def dump_json(value: object) -> str:
    """Encode as JSON; invalid Unicode is replaced."""
    try:
        return msgspec.json.encode(value).decode()
    except UnicodeEncodeError:
        return msgspec.json.encode(_replace_surrogates(value)).decode()


def _replace_surrogates(value: Any) -> Any:
    """Replace lone surrogates, which represent bytes that are not UTF-8."""
    if isinstance(value, str):
        return value.encode("utf-8", "replace").decode()
    if isinstance(value, dict):
        return {_replace_surrogates(key): _replace_surrogates(item) for key, item in value.items()}
    return [_replace_surrogates(item) for item in value] if isinstance(value, list) else value
