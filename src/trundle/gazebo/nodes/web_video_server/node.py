"""web_video_server: streams and snapshots of image topics over HTTP."""

import asyncio
from collections.abc import Mapping
from html import escape
from typing import Literal
from urllib.parse import quote, urlencode

from trundle.base.diagnostics import TrundleError, UsageError
from trundle.base.http.web_server import Reply, WebServer
from trundle.robots.parameters import RosParameters
from trundle.ros import Message, Node

from ..host import NodeHost
from ..web_access import read_web_address
from .pictures import Encoding, PictureError, encode_picture
from .streams import MULTIPART, NewestMessage, stream, timestamp

_PORT = 8080
_IMAGE, _COMPRESSED, _CAMERA_INFO = "sensor_msgs/Image", "sensor_msgs/CompressedImage", "sensor_msgs/CameraInfo"
_TYPES = ("mjpeg", "png", "ros_compressed")
_SNAPSHOT_S = 10.0
_NO_CACHE = {
    "Server": "web_video_server",
    "Cache-Control": "no-cache, no-store, must-revalidate, pre-check=0, post-check=0, max-age=0",
    "Pragma": "no-cache",
}
_HTML = "text/html; charset=utf-8"


class _BadRequestError(Exception):
    """Request that cannot be answered: status and text."""

    def __init__(self, status: int, text: str) -> None:
        super().__init__(text)
        self.status = status


class WebVideoServer:
    """Server of image topics: `/`, `/stream`, `/stream_viewer` and `/snapshot`, as MJPEG, PNG or as compressed.

    Parameters: port (8080), address, publish_rate, default_stream_type, and allowed_origins, allowed_hosts and token,
    which restrict the clients.
    """

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        del arguments, host
        self._node = node

    async def run(self) -> int:
        """Serve until cancelled."""
        node = self._node
        settings = RosParameters(await node.params.get("~", {}), node.name)
        try:
            address = read_web_address(settings, port=_PORT)
            rate = settings.number("publish_rate", -1.0)
            self._default_type = settings.text("default_stream_type", "mjpeg")
        except UsageError as error:
            node.log.fatal(str(error))
            return 1
        self._repeat_s = 1.0 / rate if rate > 0.0 else None
        try:
            socket_ = address.listen()
        except OSError as error:
            address_text = f"{address.host}:{address.port}"
            node.log.fatal(f"{address_text}: {error.strerror or error}; set {node.name}/port to another")
            return 1
        port = int(socket_.getsockname()[1])
        pages = {"/": self._list, "/stream": self._stream, "/stream_viewer": self._view, "/snapshot": self._snapshot}
        server = WebServer(address.access("web_video_server", port), pages)
        await server.start(socket_)
        try:
            await node.params.set("~actual_port", port)
            node.log.info(f"Waiting For connections on {address.url('http', port)}")
            if address.warning is not None:
                node.log.warn(address.warning)
            await node.closed.wait()
        finally:
            await server.close()
        return 0

    async def _list(self, query: Mapping[str, str]) -> Reply:
        """List the image topics, grouped by camera."""
        token = {"token": query["token"]} if "token" in query else {}
        types = await self._topic_types()
        images = sorted(topic for topic, kind in types.items() if kind == _IMAGE)
        infos = [topic for topic, kind in types.items() if kind == _CAMERA_INFO and topic.endswith("/camera_info")]
        groups: list[str] = []
        for base in sorted(topic.removesuffix("camera_info") for topic in infos):
            topics = [topic for topic in images if topic.startswith(base)]
            images = [topic for topic in images if topic not in topics]
            links = "".join(_links(topic, topic.removeprefix(base), token) for topic in topics)
            groups.append(f"<li>{escape(base)}<ul>{links}</ul></li>")
        other_links = "".join(_links(topic, topic, token) for topic in images)
        return _page(
            "ROS Image Topic List",
            f"<h1>Available ROS Image Topics:</h1><ul>{''.join(groups)}</ul><ul>{other_links}</ul>",
        )

    async def _view(self, query: Mapping[str, str]) -> Reply:
        """Show a stream in a page."""
        topic = query.get("topic", "")
        return _page(topic, f'<h1>{escape(topic)}</h1><img src="/stream?{escape(urlencode(query))}">')

    async def _stream(self, query: Mapping[str, str]) -> Reply:
        try:
            kind = query.get("type", self._default_type)
            if kind not in _TYPES:
                raise _BadRequestError(404, f"no streams of type {kind[:50]!r}; types: {', '.join(_TYPES)}")
            types = await self._topic_types()
            topic = self._image_topic(query, types)
            is_compressed = kind == "ros_compressed" and types.get(f"{topic}/compressed") == _COMPRESSED
            if is_compressed:
                parts = stream(self._node, f"{topic}/compressed", _COMPRESSED, _compressed, repeat_s=self._repeat_s)
                return Reply(content_type=MULTIPART, parts=parts, fields=_NO_CACHE)
            if kind == "ros_compressed":
                self._node.log.warn(f"Could not find compressed image topic for {topic}, falling back to mjpeg")
            self._check_type(topic, types)
            encoding = _encoding(query, "png" if kind == "png" else "jpeg")
        except _BadRequestError as error:
            return _refusal(error)
        content_type = f"image/{encoding.format}"
        parts = stream(
            self._node,
            topic,
            _IMAGE,
            lambda message: (content_type, encode_picture(message, encoding)),
            repeat_s=self._repeat_s,
        )
        return Reply(content_type=MULTIPART, parts=parts, fields=_NO_CACHE)

    async def _snapshot(self, query: Mapping[str, str]) -> Reply:
        try:
            types = await self._topic_types()
            topic = self._image_topic(query, types)
            self._check_type(topic, types)
            encoding = _encoding(query, "jpeg")
        except _BadRequestError as error:
            return _refusal(error)
        newest = NewestMessage(self._node, topic, _IMAGE)
        try:
            message = await newest.get(_SNAPSHOT_S)
            data = await asyncio.to_thread(encode_picture, message, encoding)
        except TimeoutError:
            return _refusal(_BadRequestError(504, f"no image on {topic} within {_SNAPSHOT_S:g} s"))
        except PictureError as error:
            return _refusal(_BadRequestError(415, f"{topic}: {error}"))
        finally:
            newest.close()
        return Reply(content_type="image/jpeg", body=data, fields={**_NO_CACHE, "X-Timestamp": timestamp(message)})

    async def _topic_types(self) -> dict[str, str]:
        try:
            return dict(await self._node.master.call("getTopicTypes"))
        except TrundleError as error:
            self._node.log.warn(str(error))
            return {}

    def _image_topic(self, query: Mapping[str, str], types: Mapping[str, str]) -> str:
        """Return the topic of a request, which may lack the leading slash."""
        requested = query.get("topic", "")
        topic = requested if requested.startswith("/") else f"/{requested}"
        if topic not in types and f"{topic}/compressed" not in types:
            images = ", ".join(sorted(name for name, kind in types.items() if kind == _IMAGE)) or "none"
            raise _BadRequestError(404, f"no topic {requested[:200]!r}; image topics: {images}")
        return topic

    def _check_type(self, topic: str, types: Mapping[str, str]) -> None:
        kind = types.get(topic)
        if kind != _IMAGE:
            raise _BadRequestError(415, f"{topic} is of type {kind}, not {_IMAGE}")


def _encoding(query: Mapping[str, str], file_format: Literal["jpeg", "png"]) -> Encoding:
    """Read a query.

    Raises:
        _BadRequestError: a value is not a number.
    """
    numbers: dict[str, int | None] = {}
    for name in ("width", "height", "quality"):
        try:
            numbers[name] = int(query[name]) if name in query else None
        except ValueError:
            raise _BadRequestError(400, f"{name}: {query[name][:50]!r} is not a number") from None
    width, height, quality = (numbers[name] for name in ("width", "height", "quality"))
    return Encoding(
        format=file_format,
        quality=quality if quality is not None else (3 if file_format == "png" else 95),
        width=width if width and width > 0 else None,
        height=height if height and height > 0 else None,
        rotates="invert" in query,
    )


def _compressed(message: Message) -> tuple[str, bytes]:
    """Return the content type and data of a compressed image."""
    name = str(message.format)
    for part, content_type in (("jpeg", "image/jpeg"), ("jpg", "image/jpeg"), ("png", "image/png")):
        if part in name:
            return content_type, bytes(message.data)
    raise PictureError(f"Unknown ROS compressed image format: {name[:50]!r}")


def _links(topic: str, title: str, token: Mapping[str, str]) -> str:
    query = escape("topic=" + quote(topic) + (f"&{urlencode(token)}" if token else ""))
    return (
        f'<li><a href="/stream_viewer?{query}">{escape(title)}</a> (<a href="/stream?{query}">Stream</a>) '
        f'(<a href="/snapshot?{query}">Snapshot</a>)</li>'
    )


def _page(title: str, body: str) -> Reply:
    text = f"<!DOCTYPE html><html><head><title>{escape(title)}</title></head><body>{body}</body></html>"
    fields = {**_NO_CACHE, "Content-Security-Policy": "default-src 'none'; img-src 'self'; frame-ancestors 'self'"}
    return Reply(content_type=_HTML, body=text.encode(), fields=fields)


def _refusal(error: _BadRequestError) -> Reply:
    return Reply(status=error.status, body=f"{error}\n".encode("utf-8", "replace"))
