"""Connection of a subscription to a publisher of another process."""

import asyncio
import contextlib
import threading
from collections.abc import Mapping, Sequence
from functools import partial
from typing import Any, Protocol

from .. import _message_codec
from ..errors import MessageError, WireError
from ..messages.codec import Codec
from ..messages.raw_message import ANY_TYPE
from ..transport.headers import check_md5
from ..transport.shared_ring import SharedRingReader
from ..transport.tcpros import FrameProtocol, SocketSelector


class MessageReceiver(Protocol):
    """Subscription that owns a connection."""

    selector: SocketSelector
    """Selector that reads the connection."""

    @property
    def type(self) -> str:
        """Message type."""
        ...

    @property
    def md5sum(self) -> str:
        """md5 sum of the type."""
        ...

    @property
    def is_raw(self) -> bool:
        """True if it receives serialized messages."""
        ...

    def receive_batch(self, messages: Sequence[Any], header: Mapping[str, str], /) -> None:
        """Receive messages of another process, serialized if it is raw, with their publisher's header."""
        ...

    def copy(self, view: memoryview, /) -> Any:
        """Copy a serialized message that will be overwritten, for `receive_data`."""
        ...

    def receive_data(self, data: bytes | memoryview, header: Mapping[str, str]) -> None:
        """Receive a serialized message with its publisher's connection header."""
        ...


class SubscriberLink(FrameProtocol):
    """Connection that requests a topic and forwards its messages; read by the subscription's selector, in its thread.

    Runs on the loop until the handshake is done.
    """

    def __init__(self, subscription: MessageReceiver, request: dict[str, str], codec: Codec | None) -> None:
        super().__init__()
        self._loop = asyncio.get_running_loop()
        self._loop_thread = threading.get_ident()
        self.ended: asyncio.Future[str] = self._loop.create_future()
        self._subscription = subscription
        self._request = request
        self._receive = _message_codec.receive if codec is None else codec.receive
        self._shared_ring: SharedRingReader | None = None

    def connected(self) -> None:
        self.send_header(self._request)

    def header_received(self, header: dict[str, str]) -> None:
        if "error" in header:
            raise WireError(header["error"])
        if not check_md5(self._subscription.md5sum, header.get("md5sum", "*")) and header.get("md5sum") != ANY_TYPE:
            raise WireError(f"it carries {header.get('type', 'another type')}, not {self._subscription.type}")
        if header.get("tcp_nodelay") == "1":
            self.set_nodelay()

    def buffer_updated(self, nbytes: int) -> None:
        super().buffer_updated(nbytes)
        if self.header is not None:  # after the messages that came with it
            self.read_through(self._subscription.selector)

    def frame_received(self, data: bytes | memoryview) -> None:
        try:
            self._subscription.receive_data(data, self.header or {})
        except MessageError as error:
            raise WireError(str(error)) from None

    def note_received(self, note: bytes, /) -> bytes | None:
        if self._shared_ring is None:
            assert self.transport is not None
            with contextlib.suppress(OSError):  # the ring cannot be mapped: keep using the socket
                self._shared_ring = SharedRingReader(self.transport.get_extra_info("socket"), note)
                self.out.send([(self._shared_ring.mapped_note(),)], None)
            return None
        content, answer = self._shared_ring.read(note, self._subscription.copy)
        if answer is not None:
            self.out.send([(answer,)], None)
        self.bytes_received += len(content)
        return content

    def _readable(self) -> None:
        """Read; whole messages are received and deserialized in one step."""
        assert self._socket is not None
        try:
            messages, count, others = self.frames.receive(self._socket.recv_into, self._receive)
        except OSError as error:
            self._cannot_read(error)
            return
        if not count:
            self.close("the peer closed the connection")
            return
        if messages:
            self._subscription.receive_batch(messages, self.header or {})
        self._received(count, others)

    def close(self, reason: str = "closed") -> None:
        if threading.get_ident() == self._loop_thread:
            super().close(reason)
            return
        self._stop_reading()
        with contextlib.suppress(RuntimeError):  # the loop has ended
            self._loop.call_soon_threadsafe(partial(super().close, reason))

    def closed(self, reason: str, /) -> None:
        if self._shared_ring is not None:
            self._shared_ring.close()
        if not self.ended.done():
            self.ended.set_result(reason)
