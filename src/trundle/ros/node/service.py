"""Service provider and its client connections."""

import asyncio
import contextlib
import inspect
from collections.abc import Callable
from typing import Any, cast

from ..errors import MessageError, ServiceError, WireError
from ..messages.raw_message import Message, ServiceType
from ..transport.headers import check_md5, frame
from ..transport.tcpros import FrameProtocol
from .callback_dispatch import run_on_callback_thread
from .node_context import NodeContext

ServiceCallback = Callable[[Message], object]
"""Takes the request; returns the response, its fields as a dictionary, or an awaitable of either."""
_MAX_WAITING = 64
"""Maximum number of requests that a client may send ahead; no client library sends more than one."""


class Service:
    """Provider of one service of a node; created by `Node.advertise_service`."""

    def __init__(
        self,
        node: NodeContext,
        name: str,
        type_name: str,
        handler: ServiceCallback,
        *,
        unregister: "Callable[[Service], None]",
    ) -> None:
        self.name = name
        self.type = type_name
        self.kind: ServiceType = node.messages.service(type_name)
        self._node = node
        self._handler = handler
        self._unregister = unregister
        self._links: dict[FrameProtocol, asyncio.Queue[bytes | memoryview | None]] = {}
        self._tasks: set[asyncio.Task[None]] = set()

    def unregister(self) -> None:
        """Stop providing; thread-safe."""
        self._unregister(self)

    # on the loop

    def accept(self, link: FrameProtocol, header: dict[str, str]) -> None:
        """Accept a client's connection, or refuse it with ROS' reason."""
        md5sum = header.get("md5sum", "")
        if not check_md5(md5sum, self.kind.md5sum):
            peer = header.get("callerid", "unknown")
            link.refuse(f"request from [{peer}]: md5sums do not match: [{md5sum}] vs. [{self.kind.md5sum}]")
            return
        link.set_nodelay()
        link.send_header(
            {
                "callerid": self._node.name,
                "service": self.name,
                "type": self.type,
                "md5sum": self.kind.md5sum,
                "request_type": self.kind.request,
                "response_type": self.kind.response,
            }
        )
        if header.get("probe") == "1":
            link.close("the probe is answered")
            return
        requests: asyncio.Queue[bytes | memoryview | None] = asyncio.Queue(_MAX_WAITING)
        self._links[link] = requests
        persistent = header.get("persistent", "0").lower() in ("1", "true")
        task = asyncio.get_running_loop().create_task(self._answer_all(link, requests, persistent))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    def request(self, link: FrameProtocol, data: bytes | memoryview) -> None:
        """Queue a request."""
        try:
            self._links[link].put_nowait(data)
        except (KeyError, asyncio.QueueFull):
            raise WireError("more requests than are accepted at once") from None

    def release(self, link: FrameProtocol) -> None:
        """Remove a closed connection."""
        if (requests := self._links.pop(link, None)) is not None:
            with contextlib.suppress(asyncio.QueueFull):  # a task that handles a request checks the connection itself
                requests.put_nowait(None)

    def close(self) -> None:
        """Close all connections."""
        for task in list(self._tasks):
            task.cancel()
        for link in list(self._links):
            link.close("the service is no longer provided")

    async def _answer_all(
        self, link: FrameProtocol, requests: "asyncio.Queue[bytes | memoryview | None]", persistent: bool
    ) -> None:
        while link.transport is not None and (request := await requests.get()) is not None:
            answer = await self._answer(request)
            link.out.send([(answer,)], None)
            if not persistent:
                link.finish("answered")
                return

    async def _answer(self, data: bytes | memoryview) -> bytes:
        """Handle a request; returns the success byte, then the response or the error's text."""
        try:
            response = await self._handle(self._node.messages.deserialize(data, self.kind.request))
            if isinstance(response, dict) or response is None:
                response = self._node.new(self.kind.response, cast("dict[str, Any] | None", response))
            return b"\x01" + frame(self._node.messages.serialize(response))
        except (ServiceError, MessageError) as error:
            return b"\x00" + frame(f"service cannot process request: {error}".encode())
        except Exception as error:
            self._node.log.exception(f"the service {self.name} failed", error)
            return b"\x00" + frame(f"error processing request: {error}".encode())

    async def _handle(self, request: Message) -> Any:
        node = self._node
        if inspect.iscoroutinefunction(self._handler):
            return await self._handler(request)
        result = await run_on_callback_thread(node.deliver_call, node.loop, lambda: self._handler(request))
        return await result if inspect.isawaitable(result) else result
