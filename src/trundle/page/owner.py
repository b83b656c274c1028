"""The page's owner as the server sees it: requests to it, and messages about clients."""

import asyncio
from collections.abc import Callable

from msgspec import UNSET

from .clients.connection import Connection
from .clients.server_messages import Response
from .requests.request import ClientAction, PageAction, RenderView, Request
from .requests.world import RenderModel
from .wire import Driven, FromServer, Plotted, Respond, Watched

MAX_IN_FLIGHT = 64
"""Requests of one client that wait for the owner."""
_MAX_PICTURES = 4
_PICTURE_S = 10.0


class Owner:
    """Requests that wait for an answer, and what was said last; used on the loop only."""

    def __init__(self, send: Callable[[FromServer], None]) -> None:
        """Create; `send` writes a message to the owner."""
        self.send = send
        self._last_id = 0
        self._waiting: dict[int, tuple[Connection, int | str]] = {}
        self._pictures: dict[int, asyncio.Future[Respond]] = {}
        self._watched: frozenset[str] = frozenset()
        self._plotted: frozenset[str] = frozenset()

    def request(self, client: Connection, client_id: int | str, action: ClientAction) -> None:
        """Pass a client's request on."""
        if sum(waiting is client for waiting, _ in self._waiting.values()) >= MAX_IN_FLIGHT:
            respond(client, client_id, f"{MAX_IN_FLIGHT} requests wait already")
            return
        self._waiting[self._send(action)] = client, client_id

    async def render(self, view: RenderView | RenderModel) -> bytes:
        """Have the owner draw a picture, and return the PNG.

        Raises:
            PictureError: it cannot be drawn, or not in time; the text says why.
        """
        if len(self._pictures) >= _MAX_PICTURES:
            raise PictureError(f"{_MAX_PICTURES} pictures are being drawn already")
        number = self._send(view)
        future = self._pictures[number] = asyncio.get_running_loop().create_future()
        try:
            answer = await asyncio.wait_for(future, _PICTURE_S)
        except TimeoutError:
            raise PictureError(f"no picture came within {_PICTURE_S:.0f} s") from None
        finally:
            del self._pictures[number]
        if answer.picture is None:
            raise PictureError(answer.error or "there is no picture")
        return answer.picture

    def receive(self, answer: Respond) -> None:
        """Pass the owner's answer on to the client, if it is still there."""
        if (waiting := self._waiting.pop(answer.id, None)) is not None:
            respond(*waiting, answer.error, answer.answer)
        elif (picture := self._pictures.get(answer.id)) is not None and not picture.done():
            picture.set_result(answer)

    def forget(self, client: Connection) -> None:
        """Drop the requests of a client that has gone."""
        self._waiting = {number: waiting for number, waiting in self._waiting.items() if waiting[0] is not client}

    def _send(self, action: PageAction) -> int:
        """Send a request and return its id."""
        self._last_id += 1
        self.send(Request(self._last_id, action))
        return self._last_id

    def set_watched(self, streams: frozenset[str]) -> None:
        """Report which streams some client looks at."""
        if streams != self._watched:
            self._watched = streams
            self.send(Watched(streams))

    def set_plotted(self, series: frozenset[str]) -> None:
        """Report which values of the simulation some client plots."""
        if series != self._plotted:
            self._plotted = series
            self.send(Plotted(tuple(sorted(series))))

    def set_driven(self, topics: dict[str, str]) -> None:
        """Report which topics are driven, each with its type."""
        self.send(Driven(topics))


class PictureError(Exception):
    """A picture cannot be drawn; the text says why."""


def respond(client: Connection, client_id: int | str, error: str | None = None, answer: bytes = b"{}") -> None:
    """Answer a request of a client: `error` is a sentence, `answer` JSON."""
    client.send_response(Response(client_id, error is None, UNSET if error is None else error), answer)
