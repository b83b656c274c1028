"""Interface of the server to the page's owner: requests, and messages about clients."""

import asyncio
from collections.abc import Callable

from msgspec import UNSET

from .clients.connection import Connection
from .clients.server_messages import Response
from .picture_slots import PictureError, PictureSlots
from .requests.request import ClientAction, Compare, PageAction, RenderView, Request, StopComparing
from .requests.world import RenderModel
from .wire import Driven, FromServer, Plotted, Respond, Watched

MAX_IN_FLIGHT = 64
"""Limit of a client's pending requests."""
_MAX_PICTURES = 4
_MAX_WAITING_PICTURES = 60
_PICTURE_TIMEOUT_S = 60.0
_COMPARE_TIMEOUT_S = 60.0


class Owner:
    """Pending requests to the owner, and the state sent last; used on the loop only."""

    def __init__(self, send: Callable[[FromServer], None], *, last_request: int = 0) -> None:
        """Create it.

        Args:
            send: writes a message to the owner.
            last_request: id of the last request of an earlier server, which the owner may still answer.
        """
        self.send = send
        self._last_id = last_request
        self._pending: dict[int, tuple[Connection, int | str]] = {}
        self._asked: dict[int, asyncio.Future[Respond]] = {}
        self._picture_slots = PictureSlots(_MAX_PICTURES, max_waiting=_MAX_WAITING_PICTURES)
        self._watched: frozenset[str] = frozenset()
        self._plotted: frozenset[str] = frozenset()

    def request(self, client: Connection, client_id: int | str, action: ClientAction) -> None:
        """Forward a client's request."""
        if sum(pending is client for pending, _ in self._pending.values()) >= MAX_IN_FLIGHT:
            respond(client, client_id, f"{MAX_IN_FLIGHT} requests are pending")
            return
        self._pending[self._send(action)] = client, client_id

    async def render(self, view: RenderView | RenderModel) -> bytes:
        """Request a picture from the owner; return the PNG.

        Raises:
            PictureError: the picture cannot be drawn, or not in time.
        """
        try:
            async with self._picture_slots.slot():
                answer = await self._ask(view, _PICTURE_TIMEOUT_S)
        except TimeoutError:
            raise PictureError(f"no picture within {_PICTURE_TIMEOUT_S:.0f} s") from None
        if answer.picture is None:
            raise PictureError(answer.error or "the picture cannot be drawn")
        return answer.picture

    async def compare(self, action: Compare | StopComparing) -> str | None:
        """Compare the world with a state log, or stop it; return the reason if it cannot be compared."""
        try:
            return (await self._ask(action, _COMPARE_TIMEOUT_S)).error
        except TimeoutError:
            return f"the simulation did not read the recording within {_COMPARE_TIMEOUT_S:.0f} s"

    async def _ask(self, action: PageAction, timeout_s: float) -> Respond:
        """Send a request and wait for its answer; raises TimeoutError."""
        number = self._send(action)
        future = self._asked[number] = asyncio.get_running_loop().create_future()
        try:
            return await asyncio.wait_for(future, timeout_s)
        finally:
            del self._asked[number]

    def receive(self, answer: Respond) -> None:
        """Forward the owner's answer to the client, if it is still connected."""
        if (request := self._pending.pop(answer.id, None)) is not None:
            respond(*request, answer.error, answer.answer)
        elif (asked := self._asked.get(answer.id)) is not None and not asked.done():
            asked.set_result(answer)

    def forget(self, client: Connection) -> None:
        """Remove the requests of a client that has disconnected."""
        self._pending = {number: request for number, request in self._pending.items() if request[0] is not client}

    def _send(self, action: PageAction) -> int:
        """Send a request and return its id."""
        self._last_id += 1
        self.send(Request(self._last_id, action))
        return self._last_id

    def set_watched(self, streams: frozenset[str]) -> None:
        """Report the streams that any client watches."""
        if streams != self._watched:
            self._watched = streams
            self.send(Watched(streams))

    def set_plotted(self, series: frozenset[str]) -> None:
        """Report the values of the simulation that any client plots."""
        if series != self._plotted:
            self._plotted = series
            self.send(Plotted(tuple(sorted(series))))

    def set_driven(self, topics: dict[str, str]) -> None:
        """Report the topics that clients drive with, and their types."""
        self.send(Driven(topics))


def respond(client: Connection, client_id: int | str, error: str | None = None, answer: bytes = b"{}") -> None:
    """Answer a client's request; `answer` is JSON."""
    client.send_response(Response(client_id, error is None, UNSET if error is None else error), answer)
