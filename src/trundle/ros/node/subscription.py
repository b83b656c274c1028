"""Subscription of a topic: a link to each publisher, maintained as publishers come and go."""

import asyncio
import contextlib
import inspect
from collections import deque
from collections.abc import Awaitable, Callable, Mapping, Sequence
from functools import partial
from typing import Any

from ..errors import MessageError, RosError, WireError
from ..messages.codec import Codec
from ..messages.raw_message import ANY_TYPE, Message, RawMessage
from ..transport.headers import check_md5
from ..transport.tcpros import FrameProtocol, SocketSelector
from ..transport.unix_sockets import UNIXROS, connect_unix, unix_address
from ..xmlrpc.http import checked_address
from ..xmlrpc.rpc_client import call
from ..xmlrpc.xmlrpc_text import FaultError
from .local_graph import LocalNode, LocalPublisher
from .node_context import NodeContext
from .subscriber_link import SubscriberLink

Callback = Callable[[Message], "Awaitable[None] | None"]
_RETRY_S = (0.1, 0.2, 0.5, 1.0, 2.0, 5.0)
"""Intervals between attempts to reach a registered publisher [s]."""
_CONNECT_S = 10.0


class Subscription:
    """Subscription of one node to a topic; created by `Node.subscribe`."""

    def __init__(
        self,
        node: NodeContext,
        topic: str,
        type_name: str,
        callback: Callback,
        *,
        queue_size: int | None,
        tcp_nodelay: bool,
        on_loop: bool,
        unregister: "Callable[[Subscription], None]",
    ) -> None:
        self.topic = topic
        self.type = type_name
        self.is_raw = type_name == ANY_TYPE
        """True if the callback receives serialized messages."""
        self.needs_every_message = queue_size != 1
        """True if the subscription needs every message; otherwise the newest suffices."""
        self.received = 0
        self.dropped = 0
        """Messages dropped because callbacks were too slow."""
        self._node = node
        self._messages = node.messages
        self._codec: Codec | None = None
        self._callback = callback
        self._unregister = unregister
        self._is_async = inspect.iscoroutinefunction(callback)
        self._tcp_nodelay = tcp_nodelay
        self._deliver = None if on_loop else node.deliver
        self._is_called_at_once = self._deliver is None and not self._is_async
        self._queue: deque[tuple[Message, bool]] = deque()
        """Queued messages, each with True if it came from outside the simulation of this process."""
        self._queue_size = queue_size
        self._worker: asyncio.Task[None] | None = None
        self._tasks: dict[str, asyncio.Task[None]] = {}
        """Publisher's URI → task that maintains its link."""
        self._links: dict[str, FrameProtocol | LocalPublisher] = {}
        self.selector: SocketSelector = node.loop.selector
        """Selector through which messages of other processes are read."""
        self._unreachable: set[str] = set()

    @property
    def publishers(self) -> int:
        """Number of connected publishers."""
        return len(self._links)

    @property
    def is_settled(self) -> bool:
        """True if each registered publisher is connected, or found unreachable."""
        return all(uri in self._links or uri in self._unreachable for uri in list(self._tasks))

    def unregister(self) -> None:
        """Stop subscribing; thread-safe."""
        self._unregister(self)

    # on the loop

    @property
    def md5sum(self) -> str:
        """md5 sum of the type; '*' for any."""
        return ANY_TYPE if self.is_raw else self._messages.md5(self.type)

    def follow(self, uris: list[str]) -> None:
        """Connect to exactly these publishers."""
        for uri in [uri for uri in self._tasks if uri not in uris]:
            self._tasks.pop(uri).cancel()
        self.add_publishers(uris)

    def add_publishers(self, uris: list[str]) -> None:
        """Connect to these publishers as well."""
        for uri in uris:
            if uri not in self._tasks:
                self._tasks[uri] = asyncio.get_running_loop().create_task(self._maintain_link(uri))

    def close(self) -> None:
        """Close all links."""
        self.follow([])
        if self._worker is not None:
            self._worker.cancel()
        self._queue.clear()

    def receive(self, message: Message, *, from_outside: bool) -> None:
        """Receive a message: call back, or queue it for the callback thread."""
        self.received += 1
        if self._is_called_at_once:
            try:
                self._callback(message)
            except Exception as error:
                self._log_failed_callback(error)
            return
        # `deliver` was called once per queued message; a message that replaces a dropped one needs no new call.
        replaced = self._queue_size is not None and len(self._queue) >= self._queue_size and self._drop_oldest()
        self._queue.append((message, from_outside))
        if self._is_async:
            if self._worker is None or self._worker.done():
                self._worker = asyncio.get_running_loop().create_task(self._call_in_turn())
        elif self._deliver is not None and not replaced:
            self._deliver(self._call_next)

    def receive_batch(self, messages: Sequence[Any], header: Mapping[str, str]) -> None:
        """Receive messages of another process, serialized if the subscription is raw, with the connection header."""
        for message in messages:
            if self.is_raw:
                self.receive_data(message, header)
            else:
                self.receive(message, from_outside=True)

    def copy(self, view: memoryview) -> Any:
        """Copy a serialized message that will be overwritten, for `receive_data`."""
        return bytes(view)

    def receive_bytes(self, data: bytes, publisher: LocalPublisher) -> None:
        """Receive a serialized message from a publisher of this process."""
        definition = publisher.definition if self.is_raw else ""
        try:
            header = {"type": publisher.type, "md5sum": publisher.md5sum, "callerid": publisher.caller}
            header |= {"message_definition": definition, "latching": str(int(publisher.latch))}
            self.receive_data(data, header, from_outside=publisher.is_outside)
        except MessageError as error:
            self._node.log.error(f"a message on {self.topic} is dropped: {error}")

    def connections(self) -> list[list[int | str | bool]]:
        """Links, as in getBusInfo."""
        result: list[list[Any]] = []
        for uri, link in self._links.items():
            remote = isinstance(link, FrameProtocol)
            kind, text = (link.kind, link.description) if remote else ("INTRAPROCESS", "")
            result.append([id(link) % 2**31, uri, "i", kind, self.topic, True, text])
        return result

    def statistics(self) -> list[object]:
        """Bytes and messages, as in getBusStats."""
        links = [link for link in self._links.values() if isinstance(link, FrameProtocol)]
        return [self.topic, [[id(link) % 2**31, link.bytes_received, -1, self.dropped, True] for link in links]]

    def receive_data(self, data: bytes | memoryview, header: Mapping[str, str], *, from_outside: bool = True) -> None:
        """Receive a serialized message with its publisher's connection header.

        Raises:
            MessageError: the bytes are not a message of this type.
        """
        if not self.is_raw:
            self.receive((self._codec or self._make_codec()).read(data), from_outside=from_outside)
            return
        self.receive(
            RawMessage(
                type=header.get("type", ANY_TYPE),
                md5sum=header.get("md5sum", ANY_TYPE),
                definition=header.get("message_definition", ""),
                data=data,
                caller=header.get("callerid", ""),
                latching=header.get("latching") == "1",
            ),
            from_outside=from_outside,
        )

    def _make_codec(self) -> Codec:
        self._codec = self._messages.codec(self.type)
        return self._codec

    # links

    async def _maintain_link(self, uri: str) -> None:
        """Maintain the link to one publisher while it is registered."""
        attempt = 0
        was_connected = False
        while True:
            local = self._node.loop.local.nodes.get(uri)
            try:
                if local is not None:
                    await self._connect_local(local, uri)
                else:
                    await self._connect(uri)
                attempt, was_connected = 0, True
            except (OSError, RosError, FaultError) as error:
                has_ended = was_connected and isinstance(error, ConnectionRefusedError)  # ended without unregistering
                if not has_ended:
                    self._warn_unreachable(uri, str(error) or type(error).__name__, attempt)
            await asyncio.sleep(_RETRY_S[min(attempt, len(_RETRY_S) - 1)])
            attempt += 1

    async def _connect_local(self, local: LocalNode, uri: str) -> None:
        """Receive message objects from a publisher of this process until cancelled."""
        publisher = local.find_publisher(self.topic)
        if publisher is None:
            raise RosError(f"{local.name} does not publish {self.topic}")
        if not check_md5(self.md5sum, publisher.md5sum):
            raise RosError(f"it carries {publisher.type}, not {self.type}")
        publisher.attach(self, self._node.name)
        self._links[uri] = publisher
        try:
            await local.closed.wait()
        finally:
            self._links.pop(uri, None)
            publisher.detach(self)

    async def _connect(self, uri: str) -> None:
        """Hold a TCPROS link until it breaks or the task is cancelled."""
        answer = await call(uri, "requestTopic", self._node.name, self.topic, [["TCPROS"], [UNIXROS]])
        match answer:
            case [1, _, ["TCPROS", str(host), int(port), *more]]:
                pass
            case _:
                raise WireError(f"it does not offer TCPROS: {str(answer)[:100]}")
        if not self.is_raw:  # not on the loop: compiling a type would delay everything else
            await asyncio.to_thread(self._make_codec)
        async with asyncio.timeout(_CONNECT_S):
            link = await self._open(*checked_address(host, port), unix_address(more))
        self._links[uri] = link
        try:
            reason = await link.ended
        finally:
            self._links.pop(uri, None)
            link.close("no longer subscribed")
        if link.header is None or "error" in link.header:
            raise WireError(reason)

    async def _open(self, host: str, port: int, socket_name: str | None) -> SubscriberLink:
        loop = asyncio.get_running_loop()
        link = SubscriberLink(self, self._request(), self._codec)
        if socket_name is not None:
            with contextlib.suppress(OSError):  # the socket is gone or not accessible
                await loop.create_unix_connection(lambda: link, sock=await connect_unix(loop, socket_name))
                return link
        await loop.create_connection(lambda: link, host, port)
        return link

    def _request(self) -> dict[str, str]:
        header = {
            "callerid": self._node.name,
            "topic": self.topic,
            "type": self.type,
            "md5sum": self.md5sum,
            "tcp_nodelay": "1" if self._tcp_nodelay else "0",
        }
        if not self.is_raw:
            header["message_definition"] = self._messages.definition(self.type)
        return header

    def _warn_unreachable(self, uri: str, reason: str, attempt: int) -> None:
        """Warn once about an unreachable publisher, but not about the usual failures while it starts or ends."""
        if attempt >= 2 and uri not in self._unreachable:
            self._unreachable.add(uri)
            self._node.log.warn(f"no messages on {self.topic} from {uri}: {reason}")

    # callbacks

    def _call(self, message: Message) -> None:
        try:
            self._callback(message)
        except Exception as error:
            self._log_failed_callback(error)

    def _log_failed_callback(self, error: Exception) -> None:
        self._node.log.exception(f"the callback of {self.topic} failed", error)

    def _drop_oldest(self) -> bool:
        try:
            self._queue.popleft()
        except IndexError:  # another thread has emptied the queue
            return False
        self.dropped += 1
        return True

    def _call_next(self) -> Callable[[], None] | None:
        """Run the callback for the next message; return its repetition if the message is from outside."""
        try:
            message, from_outside = self._queue.popleft()
        except IndexError:  # the message was dropped meanwhile
            return None
        self._call(message)
        return partial(self._call, message) if from_outside else None

    async def _call_in_turn(self) -> None:
        while self._queue:
            message, _ = self._queue.popleft()
            try:
                result = self._callback(message)
                if result is not None:
                    await result
            except Exception as error:
                self._log_failed_callback(error)
