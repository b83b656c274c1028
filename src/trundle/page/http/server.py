"""HTTP and WebSocket on one port; every request passes `Access` first."""

import logging
import socket
from collections.abc import Awaitable, Callable, Mapping
from contextlib import AbstractAsyncContextManager, nullcontext
from pathlib import Path
from typing import Protocol

import msgspec
from aiohttp import MultipartReader, WSMessage, WSMsgType, web
from aiohttp.http_exceptions import HttpProcessingError

from trundle.base.diagnostics import UsageError
from trundle.base.http.access import Access
from trundle.base.http.guard import Guard

from ..clients.connection import Connection
from ..clients.frames import CLOSE, PONG
from ..clients.outbox import Outbox, pong_number
from ..clients.protocol import SUBPROTOCOLS, TRUNDLE_DRIVE
from ..picture_slots import PictureError, PictureSlots
from ..requests.request import RenderView
from ..requests.world import RenderModel
from ..uploads.recording import UploadedRecording
from ..uploads.upload_folder import UploadedModels
from ..view_only import REFUSAL
from .client_files import MISSING, ClientFiles, content_type, is_immutable
from .client_slots import MAX_CONTROLLING, ClientSlots
from .content_policy import response_fields

_MAX_MESSAGE_BYTES = 16 * 1024 * 1024
"""Limit of a client's message."""
_MAX_VIEW_ONLY_PICTURES = 2
"""Limit of concurrent pictures for view-only clients."""
_MAX_WAITING_VIEW_ONLY = 30
_CLOSE_TIMEOUT_S = 1.0
_log = logging.getLogger(__name__)
_TEXT = "text/plain"
_IMMUTABLE = "private, max-age=31536000, immutable"
"""Cache-Control of files whose name contains a hash of their content."""


class Page(Protocol):
    """Content of the page."""

    def session_json(self, is_view_only: bool) -> bytes:
        """Return the content of `/session.json`."""
        ...

    def world_files(self) -> Mapping[str, bytes]:
        """Return the files of the simulated world by URL."""
        ...

    async def render(self, view: RenderView) -> bytes:
        """Return a picture of the scene as PNG; raises PictureError."""
        ...

    async def render_model(self, model: RenderModel) -> bytes:
        """Return a picture of a model as PNG, or its shape as GLB; raises PictureError."""
        ...

    async def upload(self, parts: MultipartReader) -> list[str]:
        """Receive a model and return the names of the models that can now be inserted; raises UsageError."""
        ...

    async def compare(self, parts: MultipartReader) -> str:
        """Receive a recording, compare the world with it, and return its title; raises UsageError."""
        ...

    def join(self, outbox: Outbox, *, protocol: str, is_view_only: bool) -> Connection:
        """Add a client that speaks a subprotocol."""
        ...

    def receive(self, client: Connection, message: bytes, *, is_text: bool) -> None:
        """Handle a message of a client."""
        ...

    def leave(self, client: Connection) -> None:
        """Remove a client."""
        ...


class HttpServer:
    """Server of one page."""

    def __init__(self, page: Page, access: Access, files: ClientFiles) -> None:
        self._page = page
        self._access = access
        self._files = files
        self._slots = ClientSlots()
        self._driving_slots = ClientSlots()
        """Slots of sockets that only drive: each page opens one besides its own."""
        self._view_only_pictures = PictureSlots(_MAX_VIEW_ONLY_PICTURES, max_waiting=_MAX_WAITING_VIEW_ONLY)
        self._guard = Guard(access, is_page=True)

    async def start(self, listening: socket.socket) -> None:
        """Serve connections of a listening socket."""
        logging.getLogger("aiohttp").setLevel(logging.CRITICAL)  # aiohttp would log tracebacks of malformed requests
        app = web.Application(middlewares=[self._answer])
        app.router.add_get("/session.json", self._session)
        app.router.add_get("/world/{name:.*}", self._world_file)
        app.router.add_get("/camera.png", self._camera)
        app.router.add_get("/model.png", self._model_picture)
        app.router.add_get("/model.glb", self._model_shape)
        app.router.add_post("/models", self._upload)
        app.router.add_post("/reference", self._compare)
        app.router.add_get("/{path:.*}", self._root)
        runner = web.AppRunner(app, access_log=None, handle_signals=False)
        await runner.setup()
        await web.SockSite(runner, listening).start()

    @web.middleware
    async def _answer(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        """Refuse requests that the guard rejects, and add header fields to the other responses."""
        if (refusal := await self._guard.refuse(request)) is not None:
            return refusal
        try:
            response = await handler(request)
        except web.HTTPException as error:
            response = web.Response(status=error.status, text=f"{error.reason}\n", content_type=_TEXT)
        if not response.prepared:
            response.headers.update(response_fields(self._access, self._guard.read(request), path=request.path))
        return response

    def _is_view_only(self, request: web.Request) -> bool:
        return self._access.is_view_only(self._guard.read(request))

    async def _session(self, request: web.Request) -> web.StreamResponse:
        session = self._page.session_json(self._is_view_only(request))
        return _uncached(web.Response(body=session, content_type="application/json"))

    async def _world_file(self, request: web.Request) -> web.StreamResponse:
        file = self._page.world_files().get(request.path) or self._page.world_files().get(request.path[1:])
        if file is None:
            raise web.HTTPNotFound(reason="no such file in this world")
        response = web.Response(body=file, content_type=content_type(Path(request.path)))
        response.headers["Cache-Control"] = _IMMUTABLE
        return response

    async def _camera(self, request: web.Request) -> web.StreamResponse:
        try:
            view = msgspec.convert(dict(request.query), RenderView, strict=False)
            async with self._picture_slot(request):
                picture = await self._page.render(view)
        except msgspec.ValidationError as error:
            raise web.HTTPBadRequest(reason=f"not a view: {error}") from None
        except PictureError as error:
            raise web.HTTPServiceUnavailable(reason=" ".join(str(error).split())) from None
        return web.Response(body=picture, content_type="image/png", headers={"Cache-Control": "no-store"})

    def _picture_slot(self, request: web.Request) -> AbstractAsyncContextManager[None]:
        """Occupy one of the few slots that view-only clients have, so that they do not delay the others."""
        return self._view_only_pictures.slot() if self._is_view_only(request) else nullcontext()

    async def _model_picture(self, request: web.Request) -> web.StreamResponse:
        return await self._render_model(request, "picture", "image/png")

    async def _model_shape(self, request: web.Request) -> web.StreamResponse:
        return await self._render_model(request, "shape", "model/gltf-binary")

    async def _render_model(self, request: web.Request, kind: str, media_type: str) -> web.StreamResponse:
        if self._is_view_only(request):
            raise web.HTTPForbidden(reason=REFUSAL)
        try:
            model = msgspec.convert({**request.query, "kind": kind}, RenderModel)
            drawn = await self._page.render_model(model)
        except msgspec.ValidationError as error:
            raise web.HTTPBadRequest(reason=f"not a model: {error}") from None
        except PictureError as error:
            raise web.HTTPNotFound(reason=" ".join(str(error).split())) from None
        headers = {"Cache-Control": "private, max-age=60"}
        return web.Response(body=drawn, content_type=media_type, headers=headers)

    async def _upload(self, request: web.Request) -> web.StreamResponse:
        async def receive(parts: MultipartReader) -> msgspec.Struct:
            return UploadedModels(models=tuple(await self._page.upload(parts)))

        return await self._receive_form(request, receive)

    async def _compare(self, request: web.Request) -> web.StreamResponse:
        async def receive(parts: MultipartReader) -> msgspec.Struct:
            return UploadedRecording(title=await self._page.compare(parts))

        return await self._receive_form(request, receive)

    async def _receive_form(
        self, request: web.Request, receive: Callable[[MultipartReader], Awaitable[msgspec.Struct]]
    ) -> web.StreamResponse:
        """Receive files from a client with full access; answer with JSON, or with the reason for a refusal."""
        if self._is_view_only(request):
            return web.Response(status=403, text=f"{REFUSAL}\n", content_type=_TEXT)
        try:
            if request.content_type != "multipart/form-data":
                raise UsageError("send files as multipart/form-data")
            answer = await receive(await request.multipart())
        except (UsageError, ValueError, HttpProcessingError, web.RequestPayloadError) as error:
            return web.Response(status=400, text=f"{' '.join(str(error).split())}\n", content_type=_TEXT)
        return web.json_response(body=msgspec.json.encode(answer))

    async def _root(self, request: web.Request) -> web.StreamResponse:
        path = request.match_info["path"]
        if not path and request.headers.get("Upgrade", "").lower() == "websocket":
            return await self._web_socket(request)
        file = self._files.find(path)
        if file is None and not path:
            return _uncached(web.Response(text=MISSING, content_type="text/html"))
        if file is None:
            raise web.HTTPNotFound(reason="no such file")
        response = web.FileResponse(file, headers={"Content-Type": content_type(file)})
        response.headers["Cache-Control"] = _IMMUTABLE if is_immutable(path) else "no-cache"
        return response

    async def _web_socket(self, request: web.Request) -> web.StreamResponse:
        """Serve one client of the protocol."""
        offered = [name.strip() for name in request.headers.get("Sec-WebSocket-Protocol", "").split(",")]
        protocol = next((name for name in offered if name in SUBPROTOCOLS), None)
        if protocol is None:
            raise web.HTTPBadRequest(reason=f"use a subprotocol of: {', '.join(SUBPROTOCOLS)}")
        is_view_only = self._is_view_only(request)
        slots = self._driving_slots if protocol == TRUNDLE_DRIVE else self._slots
        if not slots.has_room(is_view_only=is_view_only):
            raise web.HTTPServiceUnavailable(reason=f"{MAX_CONTROLLING} clients are connected already")
        web_socket = web.WebSocketResponse(
            protocols=(protocol,), compress=False, autoping=False, autoclose=False, max_msg_size=_MAX_MESSAGE_BYTES,
            decode_text=False,
        )  # fmt: skip
        await web_socket.prepare(request)
        transport = request.transport
        if transport is None:
            return web_socket
        duplicate: socket.socket = transport.get_extra_info("socket").dup()
        client = self._page.join(
            Outbox(duplicate, broken=lambda _: transport.abort(), dropped=lambda stream: client.count_drop(stream)),
            protocol=protocol,
            is_view_only=is_view_only,
        )
        try:
            with slots.occupied(transport.abort, is_view_only=is_view_only):
                while await self._receive(client, await web_socket.receive()):
                    pass
        except Exception:
            _log.exception("a client could not be served")
        finally:
            self._page.leave(client)  # first, since this stops a robot that the client drove
            await client.outbox.drain(_CLOSE_TIMEOUT_S)
            client.outbox.close()
            transport.abort()  # otherwise aiohttp would write its own closing frame
        return web_socket

    async def _receive(self, client: Connection, message: WSMessage) -> bool:
        """Handle a message; return False at the end of the connection."""
        match message.type:
            case WSMsgType.TEXT | WSMsgType.BINARY:
                data = message.data if isinstance(message.data, bytes) else bytes(message.data)
                self._page.receive(client, data, is_text=message.type is WSMsgType.TEXT)
            case WSMsgType.PING:
                client.outbox.send(PONG, (bytes(message.data),))
            case WSMsgType.PONG:
                client.outbox.echo(pong_number(message.data))
            case WSMsgType.CLOSE:
                client.outbox.send(CLOSE, ((message.data or 1000).to_bytes(2, "big"),))
                return False
            case _:
                return False
        return True


def _uncached(response: web.Response) -> web.Response:
    """Make browsers revalidate a response each time."""
    response.headers["Cache-Control"] = "no-cache"
    return response
