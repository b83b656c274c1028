"""Minimal HTTP for XML-RPC: one POST, one response, Content-Length required."""

import re
from typing import NamedTuple
from urllib.parse import urlsplit

from ..errors import WireError

MAX_HEAD_BYTES = 64 * 1024
MAX_BODY_BYTES = 64 * 1024 * 1024
"""Parameter trees with several robot descriptions take a few MB, far below this limit."""

XML = "text/xml"
_NODE_FETCH = ("node", "undici")
"""User agents of Node's `fetch`, which sends Sec-Fetch-Mode `cors` as browsers do."""
_MAX_PORT = 65535
_ADDRESS = re.compile(r"(?:http|rosrpc)://(?P<host>\[[^]/@]+\]|:?:?[^][/@?#:][^][/@?#]*):(?P<port>\d{1,5})(?:[/?#]|$)")


class Head(NamedTuple):
    """Start line and header fields of a request or response."""

    start: tuple[str, str, str]
    fields: dict[str, str]
    """Keys in lower case."""

    @property
    def keeps_alive(self) -> bool:
        """True if the connection stays open after this exchange."""
        connection = self.fields.get("connection", "").lower()
        if "HTTP/1.0" in self.start:
            return connection == "keep-alive"
        return connection != "close"

    @property
    def body_bytes(self) -> int | None:
        """Content-Length; None if absent.

        Raises:
            WireError: the length is not a number, or exceeds `MAX_BODY_BYTES`.
        """
        text = self.fields.get("content-length")
        if text is None:
            return None
        if not text.isdecimal():
            raise WireError(f"not a content length: {text[:40]!r}")
        if len(text) > 12 or int(text) > MAX_BODY_BYTES:
            raise WireError(f"a body of {text[:20]} bytes is larger than the {MAX_BODY_BYTES} accepted")
        return int(text)


def parse_head(data: bytes) -> Head:
    """Parse start line and fields, including the empty line.

    Raises:
        WireError: the data is not HTTP.
    """
    lines = data.decode("latin-1").split("\r\n")
    start = lines[0].split(" ", 2)
    if len(start) < 2 or not any(part.startswith("HTTP/1.") for part in start):
        raise WireError("not an HTTP/1 message")
    fields: dict[str, str] = {}
    for line in lines[1:]:
        name, colon, value = line.partition(":")
        if colon:
            fields[name.strip().lower()] = value.strip()
    return Head(start=(start[0], start[1], start[2] if len(start) > 2 else ""), fields=fields)


def browser_refusal(head: Head) -> str | None:
    """Return the reason to refuse a request that a web page may have sent; None for a program's request.

    A page can reach loopback. It cannot send text/xml to another origin without a preflight request, its POST carries
    an Origin, and current browsers add Sec-Fetch-Site. Programs: rospy, roscpp, rosnodejs, goroslib, rosjava and
    @foxglove/ros1 send text/xml; roslibrust and rosrust send no type. `Host` is not checked: clients connect by
    aliases.
    """
    fields = head.fields
    agent, origin = fields.get("user-agent", ""), fields.get("origin")
    is_electron = "Electron/" in agent and origin in (None, "file://")  # Foxglove's and Lichtblick's desktop programs
    browser_fields = (
        [] if is_electron else [name for name in fields if name == "origin" or name.startswith("sec-fetch-")]
    )
    if browser_fields and not (browser_fields == ["sec-fetch-mode"] and agent in _NODE_FETCH):
        sender = f"a page of {origin[:100]!r}" if origin else "a web page"
        return f"{sender} sent it, and web pages may not call ROS nodes"
    kind = fields.get("content-type", XML).partition(";")[0].strip().lower()
    if kind != XML or (is_electron and "content-type" not in fields):
        return f"an XML-RPC call has the Content-Type {XML}, not {fields.get('content-type', 'none')[:100]!r}"
    return None


def request(uri: str, body: bytes) -> bytes:
    """Format a POST; the connection closes after the response."""
    parts = urlsplit(uri)
    head = (
        f"POST {parts.path or '/'} HTTP/1.1\r\nHost: {parts.netloc}\r\nUser-Agent: trundle\r\n"
        f"Content-Type: {XML}\r\nContent-Length: {len(body)}\r\nConnection: close\r\n\r\n"
    )
    return head.encode("latin-1", "replace") + body


def answer(status: str, body: bytes, *, keep_alive: bool, kind: str = XML) -> bytes:
    """Format a response, such as `answer("200 OK", …)`."""
    head = (
        f"HTTP/1.1 {status}\r\nServer: trundle\r\nContent-Type: {kind}\r\nContent-length: {len(body)}\r\n"
        f"Connection: {'keep-alive' if keep_alive else 'close'}\r\n\r\n"
    )
    return head.encode("latin-1") + body


def host_and_port(uri: str) -> tuple[str, int]:
    """Split `http://host:port/` or `rosrpc://host:port`; rospy writes IPv6 addresses without brackets.

    Raises:
        WireError: host or port is missing or malformed.
    """
    address = _ADDRESS.match(uri)
    if address is None:
        raise WireError(f"not a node's address: {uri[:200]!r}; it reads like http://localhost:11311/")
    return checked_address(address["host"].strip("[]").lower(), int(address["port"]))


def checked_address(host: str, port: int) -> tuple[str, int]:
    """Check and return a peer's address; for an invalid one, sockets may raise other exceptions than OSError.

    Raises:
        WireError: no host has such a name, or the port is out of range.
    """
    try:
        host.encode("idna")
        is_valid = 0 <= port <= _MAX_PORT
    except UnicodeError:
        is_valid = False
    if not is_valid:
        raise WireError(f"not a node's address: host {host[:200]!r}, port {str(port)[:40]}")
    return host, port


def uri_host(uri: str) -> str:
    """Host of a node's address; empty if malformed."""
    try:
        return host_and_port(uri)[0]
    except WireError:
        return ""
