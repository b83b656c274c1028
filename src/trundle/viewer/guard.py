"""The guard before viser's server: every request passes `Access` first, HTTP and WebSocket alike."""

from collections.abc import Callable, Generator
from contextlib import contextmanager
from http import HTTPStatus
from typing import Any

import websockets.asyncio.server as websockets_server
from websockets.asyncio.server import ServerConnection
from websockets.datastructures import Headers, MultipleValuesError
from websockets.http11 import Request, Response

from trundle.access import Access, PageRequest

from .errors import ViewerError

Process = Callable[[ServerConnection, Request], Response | None]


@contextmanager
def guarded(access: Access) -> Generator[None]:
    """Have the server that is started meanwhile ask `access`.

    viser offers no hook; it serves with `websockets`, whose `process_request` sees each request before anything else.

    Raises:
        ViewerError: the server was started in another way, so that nothing guards it.
    """
    serve, starts = websockets_server.serve, 0

    def serve_guarded(*arguments: Any, process_request: Process, **options: Any) -> Any:
        nonlocal starts
        starts += 1
        return serve(*arguments, process_request=_checked(access, process_request), **options)

    websockets_server.serve = serve_guarded  # pyright: ignore[reportAttributeAccessIssue]
    try:
        yield
    finally:
        websockets_server.serve = serve
    if not starts:
        raise ViewerError("this version of viser does not serve its page as trundle knows it; nothing would guard it")


def _checked(access: Access, process: Process) -> Process:
    def check(connection: ServerConnection, request: Request) -> Response | None:
        try:
            asked = PageRequest(
                target=request.path,
                host=request.headers.get("Host"),
                origin=request.headers.get("Origin"),
                cookie="; ".join(request.headers.get_all("Cookie")),
            )
        except MultipleValuesError:
            return _refused("a field that stands twice")
        why = access.refusal(asked)
        if why is not None:
            return _refused(why)
        response = process(connection, request)
        if response is not None:
            for name, value in access.answer_fields(asked).items():
                response.headers[name] = value
        return response

    return check


def _refused(why: str) -> Response:
    body = f"refused: {why}\n".encode()
    fields = Headers({"Content-Type": "text/plain; charset=utf-8", "Content-Length": str(len(body))})
    return Response(HTTPStatus.FORBIDDEN.value, HTTPStatus.FORBIDDEN.phrase, fields, body)
