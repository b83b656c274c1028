"""Send queue of one WebSocket: bounded in time for streams, whose newest messages replace older ones.

Streams share a slow connection by their bytes (start-time fair queueing, Goyal et al. 1996), so that images and clouds
are thinned before transforms. Frames are written to the socket from buffers that all clients share: asyncio's
transport would copy them, which costs more than sending them for point clouds of many megabytes.
"""

import asyncio
import contextlib
import math
import socket
from collections.abc import Callable, Hashable, Sequence
from itertools import islice

from .frames import PING, Buffer, frame_header
from .pace import Pace
from .send_flow import KEPT, Flow, Keys, Message, Reduction
from .thinning import Thin

MAX_STREAM_BYTES = 4 * 1024 * 1024
"""Limit of queued bytes in streams; the newest message of each stream stays, however long."""
MAX_BYTES = 256 * 1024 * 1024
"""Limit of all queued bytes; a client that leaves more unread is disconnected."""
_MAX_BATCH = 256
"""Messages per call of sendmsg, which accepts at most IOV_MAX (1024) pieces."""
_MAX_TRANSFER_S = 0.25
"""Transfer time above which a message blocks the others for too long; images and clouds are thinned to it."""
_MAX_BLOCKING_S = 1.0
"""Transfer time above which a message is not sent while the client waits for other streams."""
_PAUSES = 19
"""Pause after a message that blocked the others, as a multiple of its transfer time."""
_PART_S = 0.03
"""Transfer time of a part of a message [s]."""
_MIN_PART_BYTES = 2048
_UNSENT_BYTES = 256 * 1024
"""Unsent bytes in the kernel, which nothing can overtake or replace."""


def ping(number: int) -> Sequence[Buffer]:
    """Return the frame of a mark that every client echoes: RFC 6455, 5.5.2."""
    payload = number.to_bytes(8, "big")
    return frame_header(PING, len(payload)), payload


def pong_number(payload: Buffer) -> int:
    """Return the number of the mark that a pong echoes; of any other pong, a number that no mark has."""
    return int.from_bytes(payload, "big") if len(payload) == 8 else 0


class Outbox:
    """Queue of messages to one client; used on the loop only."""

    def __init__(
        self, sock: socket.socket, *, broken: Callable[[str], None], dropped: Callable[[Hashable], None]
    ) -> None:
        """Create it; call on the loop.

        Args:
            sock: connected, non-blocking socket; closed here.
            broken: called with the reason when the client disconnects or leaves too much unread.
            dropped: called with the stream of each dropped message.
        """
        self._socket = sock
        self._loop = asyncio.get_running_loop()
        self._broken = broken
        self._dropped = dropped
        self.mark_frame: Callable[[int], Sequence[Buffer]] = ping
        """Returns the frame of a mark."""
        self.splits = False
        """True if the client joins the parts of long messages."""
        self.is_shared = False
        """True if the client waits for several streams, of which none must block the others."""
        self.reduced: Callable[[Hashable, Reduction, float], None] = _ignore
        """Called when a stream's messages begin to be reduced, with the stream and a message's transfer time [s]."""
        self._pace = Pace()
        self._flows: dict[Hashable, Flow] = {}
        self._queued: dict[Hashable, Flow] = {}
        """Flows with messages."""
        self._rest: list[Buffer] = []
        """Unsent rest of the current batch."""
        self._served = 0.0
        """Start tag of the message sent last."""
        self._count = 0
        self._waiting_bytes = self._droppable_bytes = 0
        self._blocking: tuple[float, int] | None = None
        """Message in transfer that blocks the others: time of sending, and number of its first byte."""
        self._blocking_due_s = -math.inf
        """Time before which no other message may block."""
        self._is_watching = self._is_closed = self._is_due = False
        self._timer: asyncio.TimerHandle | None = None
        self._drained: asyncio.Event = asyncio.Event()
        _limit_unsent(sock)

    @property
    def waiting_bytes(self) -> int:
        """Size of all queued messages [bytes]."""
        return self._waiting_bytes

    def send(
        self,
        first_byte: int,
        pieces: Sequence[Buffer],
        stream: Hashable = None,
        keys: Keys = KEPT,
        thin: Thin | None = None,
    ) -> None:
        """Send or queue a message.

        Args:
            first_byte: frame's first byte.
            pieces: buffers of the payload, which must not change afterwards.
            stream: messages of a stream stay in order.
            keys: returns the parts of a state that the message holds. Once the stream has newer messages with all of
                them, it is dropped if the client is slow. `KEPT`: it is never dropped.
            thin: returns a smaller version of the last of two pieces.
        """
        if self._is_closed:
            return
        self._count += 1
        message = Message(self._count, first_byte, pieces, keys, self._loop.time(), thin)
        flow = self._flows.get(stream)
        if flow is None:
            flow = self._flows[stream] = Flow(stream, len(self._flows))
        if not flow.messages:
            self._queued[stream] = flow
            flow.start = max(self._served, flow.finish)
        flow.messages.append(message)
        self._waiting_bytes += message.size
        if keys is not KEPT:
            flow.droppable_bytes += message.size
            self._droppable_bytes += message.size
        if self._droppable_bytes > MAX_STREAM_BYTES or self._waiting_bytes > MAX_BYTES:
            self._write_soon()
            self._drop_oldest()
        elif not self._is_due:
            self._is_due = True
            self._loop.call_soon(self._write_soon)
        if self._waiting_bytes > MAX_BYTES:
            self._fail(f"the client has left {self._waiting_bytes} bytes unread")

    def has_waiting(self, stream: Hashable) -> bool:
        """True if messages of a stream are queued."""
        return stream in self._queued

    def echo(self, number: int) -> None:
        """Receive the client's echo of a mark."""
        now_s = self._loop.time()
        self._pace.echo(number, now_s)
        if self._blocking is not None and self._pace.arrived >= self._blocking[1]:
            self._blocking_due_s = now_s + _PAUSES * (now_s - self._blocking[0])
            self._blocking = None
        self._write_soon()

    def beat(self) -> None:
        """Send a mark even without other data, so that the client can measure its lag."""
        if not (self._is_closed or self._rest or self._queued or self._pace.awaits_echo):
            self._rest += self.mark_frame(self._pace.mark_now(self._loop.time()))
            self._write_soon()

    def forget(self, stream: Hashable) -> None:
        """Remove a stream's queued messages, except for one of which parts were sent."""
        if stream in self._flows:
            self._flows[stream].reduction = None
        flow = self._queued.get(stream)
        if flow is None:
            return
        for message in flow.remove_unsent():
            self._account_removed(flow, message)
        if not flow.messages:
            del self._queued[stream]

    async def drain(self, timeout_s: float) -> None:
        """Wait until everything is sent, or until the timeout."""
        if not self._queued and not self._rest:
            return
        self._drained.clear()
        with contextlib.suppress(TimeoutError):
            await asyncio.wait_for(self._drained.wait(), timeout_s)

    def close(self) -> None:
        """Close the socket and drop all messages."""
        if not self._is_closed:
            self._is_closed = True
            self._watch(False)
            if self._timer is not None:
                self._timer.cancel()
            self._socket.close()
            self._queued.clear()
            self._flows.clear()
            self._rest.clear()
            self._drained.set()

    # -- dropping

    def _drop_oldest(self) -> None:
        """Drop the oldest messages of the stream with the most bytes, until the rest fits."""
        while self._droppable_bytes > MAX_STREAM_BYTES:
            droppable = [flow for flow in self._queued.values() if flow.has_older]
            if not droppable:
                return
            flow = max(droppable, key=lambda flow: flow.droppable_bytes)
            self._drop(flow, flow.drop_oldest())

    def _drop(self, flow: Flow, messages: Sequence[Message]) -> None:
        for message in messages:
            self._account_removed(flow, message)
            self._dropped(flow.stream)

    def _account_removed(self, flow: Flow, message: Message) -> None:
        self._waiting_bytes -= message.size
        if message.keys is not KEPT:
            flow.droppable_bytes -= message.size
            self._droppable_bytes -= message.size

    # -- writing

    def _write_soon(self) -> None:
        """Write the messages of this round of the loop, unless the socket's buffer is full."""
        self._is_due = False
        if not self._is_watching and not self._is_closed:
            self._write()

    def _write(self) -> None:
        """Write as much as the kernel and the pace accept; the socket or a timer continues with the rest."""
        try:
            while pieces := self._next():
                self._rest = _after(pieces, send_pieces(self._socket, pieces))
        except BlockingIOError:
            pass
        except OSError as error:
            self._fail(str(error))
            return
        self._watch(bool(self._rest))
        if not self._rest and not self._queued:
            self._drained.set()

    def _next(self) -> list[Buffer]:
        """Return the pieces to write next; none: until the timer or an echo."""
        if not self._rest and self._queued:
            now_s = self._loop.time()
            wait_s = self._pace.wait_s(now_s)
            if wait_s == 0.0:
                wait_s = self._take_batch(now_s)
            if not self._rest and wait_s > 0.0:
                self._continue_in(min(wait_s, 1.0))
            mark = self._pace.mark(now_s, is_limited=bool(self._queued))
            if mark is not None:
                self._rest += self.mark_frame(mark)
        return self._rest

    def _continue_in(self, delay_s: float) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = self._loop.call_later(delay_s, self._write_soon)

    def _take_batch(self, now_s: float) -> float:
        """Move messages to `_rest`; return the time after which to try again if there are none."""
        budget = min(self._pace.budget(now_s), MAX_STREAM_BYTES)
        is_behind = self._waiting_bytes > budget
        if not is_behind:
            flows = [flow for flow in self._queued.values() for _ in flow.messages]
            if len(self._queued) > 1:
                numbers = [message.number for flow in self._queued.values() for message in flow.messages]
                flows = [flow for _, flow in sorted(zip(numbers, flows, strict=True), key=lambda pair: pair[0])]
            for flow in islice(flows, _MAX_BATCH):
                self._take(flow, None)
            return 0.0
        size = 0
        while self._queued and size < budget and len(self._rest) < 2 * _MAX_BATCH:
            flow = min(self._queued.values(), key=lambda flow: flow.start)
            self._drop(flow, flow.drop_late(now_s))
            if not self.splits and (flow := self._quick_flow(now_s)) is None:
                return 0.0 if self._rest else _PART_S
            size += self._take(flow, self._part_bytes if self.splits else None)
        return 0.0

    @property
    def _part_bytes(self) -> int:
        return int(min(max(self._pace.rate * _PART_S, _MIN_PART_BYTES), MAX_BYTES))

    def _quick_flow(self, now_s: float) -> Flow | None:
        """Return the next flow; a flow whose message blocks the others comes only after a long pause, or never."""
        for flow in sorted(self._queued.values(), key=lambda flow: flow.start):
            message = flow.messages[0]
            transfer_s = self._pace.transfer_s(message.size)
            if message.keys is KEPT or not self.is_shared or transfer_s <= _MAX_TRANSFER_S:
                return flow
            if self._shrink(flow, message, int(message.size * _MAX_TRANSFER_S / transfer_s)):
                self._reduce(flow, Reduction.THINNED, transfer_s)
                return flow
            if transfer_s > _MAX_BLOCKING_S:
                self._reduce(flow, Reduction.HELD, transfer_s)
            elif self._blocking is None and now_s >= self._blocking_due_s:
                self._blocking = now_s, self._pace.sent + 1
                return flow
        return None

    def _shrink(self, flow: Flow, message: Message, max_bytes: int) -> bool:
        """Replace a message by a smaller version; False: there is none."""
        before = message.size
        if not message.shrink(max_bytes):
            return False
        self._waiting_bytes += message.size - before
        flow.droppable_bytes += message.size - before
        self._droppable_bytes += message.size - before
        return True

    def _reduce(self, flow: Flow, reduction: Reduction, transfer_s: float) -> None:
        if flow.reduction is not reduction:
            flow.reduction = reduction
            self._loop.call_soon(self.reduced, flow.stream, reduction, transfer_s)  # later: it sends a message

    def _take(self, flow: Flow, part_bytes: int | None) -> int:
        """Move a flow's oldest message to `_rest`, or its next part; return the number of bytes."""
        message = flow.messages[0]
        self._served = flow.start
        pieces, is_whole = message.part(MAX_BYTES if part_bytes is None else part_bytes, flow.number)
        size = sum(map(len, pieces))
        self._rest += pieces
        self._pace.add(size)
        flow.finish = flow.start + size
        flow.start = flow.finish
        if is_whole:
            flow.messages.popleft()
            self._account_removed(flow, message)
            if not flow.messages:
                del self._queued[flow.stream]
        return size

    def _watch(self, on: bool) -> None:
        """Start or stop writing whenever the socket has room."""
        if on != self._is_watching:
            self._is_watching = on
            if on:
                self._loop.add_writer(self._socket.fileno(), self._write)
            else:
                self._loop.remove_writer(self._socket.fileno())

    def _fail(self, reason: str) -> None:
        if not self._is_closed:
            self.close()
            self._loop.call_soon(self._broken, reason)  # later: the caller may be iterating over all clients


def _ignore(stream: Hashable, reduction: Reduction, transfer_s: float) -> None:
    """Report nothing."""


def _limit_unsent(sock: socket.socket) -> None:
    """Limit the number of unsent bytes in the kernel."""
    option = getattr(socket, "TCP_NOTSENT_LOWAT", None)
    with contextlib.suppress(OSError):  # not TCP
        if option is not None:
            sock.setsockopt(socket.IPPROTO_TCP, option, _UNSENT_BYTES)
        else:
            sock.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _UNSENT_BYTES)


def send_pieces(sock: socket.socket, pieces: Sequence[Buffer]) -> int:
    """Send as many bytes of the buffers as the kernel accepts; return their number.

    Raises:
        BlockingIOError: the kernel accepts none.
    """
    if hasattr(sock, "sendmsg"):
        return sock.sendmsg(list(islice(pieces, 1024)))
    return sock.send(pieces[0])  # Windows


def _after(pieces: list[Buffer], count: int) -> list[Buffer]:
    """Return the buffers without their first `count` bytes."""
    for i, piece in enumerate(pieces):
        if count < len(piece):
            return [memoryview(piece)[count:], *pieces[i + 1 :]]
        count -= len(piece)
    return []
