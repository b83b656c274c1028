"""HTTP and WebSocket on one port; every request passes `Access` first."""

import logging
import socket
from collections.abc import Awaitable, Callable, Generator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import msgspec
from aiohttp import MultipartReader, WSMessage, WSMsgType, web
from aiohttp.http_exceptions import HttpProcessingError

from trundle.base.diagnostics import UsageError
from trundle.base.http.access import Access
from trundle.base.http.guard import Guard

from ..clients.connection import Connection
from ..clients.outbox import CLOSE, PONG, Outbox
from ..clients.protocol import SUBPROTOCOLS, TRUNDLE
from ..owner import PictureError
from ..requests.request import RenderView
from ..requests.world import RenderModel
from ..uploads.upload_folder import UploadedModels
from ..view_only import REFUSAL
from .client_files import MISSING, ClientFiles, content_type, is_immutable
from .content_policy import response_fields
from .places import MAX_CONTROLLING, Places

_MAX_MESSAGE_BYTES = 16 * 1024 * 1024
"""Longest message of a client."""
_MAX_LOOKERS_PICTURES = 2
"""Pictures at once for clients that may only look."""
_FAREWELL_S = 1.0
_log = logging.getLogger(__name__)
_TEXT = "text/plain"
_KEPT = "private, max-age=31536000, immutable"
"""For files whose name holds a hash of their content."""


class Page(Protocol):
    """Content of the page."""

    def session_json(self, is_view_only: bool) -> bytes:
        """Return what `/session.json` says."""
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
        """Receive a model and return the names of what can be inserted now; raises UsageError."""
        ...

    def join(self, outbox: Outbox, *, speaks_trundle: bool, is_view_only: bool) -> Connection:
        """Add a client."""
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
        self._places = Places()
        self._lookers_pictures = 0
        self._guard = Guard(access, is_page=True)

    async def start(self, listening: socket.socket) -> None:
        """Serve connections of a listening socket."""
        logging.getLogger("aiohttp").setLevel(logging.CRITICAL)  # it answers nonsense from the net with tracebacks
        app = web.Application(middlewares=[self._answer])
        app.router.add_get("/session.json", self._session)
        app.router.add_get("/world/{name:.*}", self._world_file)
        app.router.add_get("/camera.png", self._camera)
        app.router.add_get("/model.png", self._model_picture)
        app.router.add_get("/model.glb", self._model_shape)
        app.router.add_post("/models", self._upload)
        app.router.add_get("/{path:.*}", self._root)
        runner = web.AppRunner(app, access_log=None, handle_signals=False)
        await runner.setup()
        await web.SockSite(runner, listening).start()

    @web.middleware
    async def _answer(
        self, request: web.Request, handler: Callable[[web.Request], Awaitable[web.StreamResponse]]
    ) -> web.StreamResponse:
        """Refuse what the guard refuses, and add the header fields of the others."""
        if (refused := await self._guard.refuse(request)) is not None:
            return refused
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
        return _fresh(web.Response(body=session, content_type="application/json"))

    async def _world_file(self, request: web.Request) -> web.StreamResponse:
        file = self._page.world_files().get(request.path) or self._page.world_files().get(request.path[1:])
        if file is None:
            raise web.HTTPNotFound(reason="no such file in this world")
        response = web.Response(body=file, content_type=content_type(Path(request.path)))
        response.headers["Cache-Control"] = _KEPT
        return response

    async def _camera(self, request: web.Request) -> web.StreamResponse:
        try:
            view = msgspec.convert(dict(request.query), RenderView, strict=False)
            with self._picture_place(request):
                picture = await self._page.render(view)
        except msgspec.ValidationError as error:
            raise web.HTTPBadRequest(reason=f"not a view: {error}") from None
        except PictureError as error:
            raise web.HTTPServiceUnavailable(reason=" ".join(str(error).split())) from None
        return web.Response(body=picture, content_type="image/png", headers={"Cache-Control": "no-store"})

    @contextmanager
    def _picture_place(self, request: web.Request) -> Generator[None]:
        """Take a place among the pictures that are drawn.

        Raises:
            PictureError: those that clients who may only look can have are taken.
        """
        count = int(self._is_view_only(request))
        if self._lookers_pictures + count > _MAX_LOOKERS_PICTURES:
            raise PictureError(f"{_MAX_LOOKERS_PICTURES} pictures are being drawn already")
        self._lookers_pictures += count
        try:
            yield
        finally:
            self._lookers_pictures -= count

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
        if self._is_view_only(request):
            return web.Response(status=403, text=f"{REFUSAL}\n", content_type=_TEXT)
        try:
            if request.content_type != "multipart/form-data":
                raise UsageError("send the files of a model as a form")
            names = await self._page.upload(await request.multipart())
        except (UsageError, ValueError, HttpProcessingError, web.RequestPayloadError) as error:
            return web.Response(status=400, text=f"{' '.join(str(error).split())}\n", content_type=_TEXT)
        return web.json_response(body=msgspec.json.encode(UploadedModels(models=tuple(names))))

    async def _root(self, request: web.Request) -> web.StreamResponse:
        path = request.match_info["path"]
        if not path and request.headers.get("Upgrade", "").lower() == "websocket":
            return await self._web_socket(request)
        file = self._files.find(path)
        if file is None and not path:
            return _fresh(web.Response(text=MISSING, content_type="text/html"))
        if file is None:
            raise web.HTTPNotFound(reason="no such file")
        response = web.FileResponse(file, headers={"Content-Type": content_type(file)})
        response.headers["Cache-Control"] = _KEPT if is_immutable(path) else "no-cache"
        return response

    async def _web_socket(self, request: web.Request) -> web.StreamResponse:
        """Serve one client of the protocol."""
        offered = [name.strip() for name in request.headers.get("Sec-WebSocket-Protocol", "").split(",")]
        if not any(name in SUBPROTOCOLS for name in offered):
            raise web.HTTPBadRequest(reason=f"this page speaks {', '.join(SUBPROTOCOLS)}")
        is_view_only = self._is_view_only(request)
        if not self._places.has_room(is_view_only=is_view_only):
            raise web.HTTPServiceUnavailable(reason=f"{MAX_CONTROLLING} clients are served already")
        web_socket = web.WebSocketResponse(
            protocols=SUBPROTOCOLS, compress=False, autoping=False, autoclose=False, max_msg_size=_MAX_MESSAGE_BYTES,
            decode_text=False,
        )  # fmt: skip
        await web_socket.prepare(request)
        transport = request.transport
        if transport is None:
            return web_socket
        own: socket.socket = transport.get_extra_info("socket").dup()
        client = self._page.join(
            Outbox(own, broken=lambda _: transport.abort(), dropped=lambda stream: client.count_drop(stream)),
            speaks_trundle=web_socket.ws_protocol == TRUNDLE,
            is_view_only=is_view_only,
        )
        try:
            with self._places.taken(transport.abort, is_view_only=is_view_only):
                while await self._receive(client, await web_socket.receive()):
                    pass
        except Exception:
            _log.exception("a client could not be served")
        finally:
            self._page.leave(client)  # first: a robot that it drove is stopped now
            await client.outbox.drain(_FAREWELL_S)
            client.outbox.close()
            transport.abort()  # aiohttp then writes no closing frame of its own
        return web_socket

    async def _receive(self, client: Connection, message: WSMessage) -> bool:
        """Handle a message; False: the connection ends."""
        match message.type:
            case WSMsgType.TEXT | WSMsgType.BINARY:
                data = message.data if isinstance(message.data, bytes) else bytes(message.data)
                self._page.receive(client, data, is_text=message.type is WSMsgType.TEXT)
            case WSMsgType.PING:
                client.outbox.send(PONG, (bytes(message.data),))
            case WSMsgType.PONG:
                pass
            case WSMsgType.CLOSE:
                client.outbox.send(CLOSE, ((message.data or 1000).to_bytes(2, "big"),))
                return False
            case _:
                return False
        return True


def _fresh(response: web.Response) -> web.Response:
    """Have browsers ask again each time."""
    response.headers["Cache-Control"] = "no-cache"
    return response
