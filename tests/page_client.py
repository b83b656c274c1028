"""A client of the page's protocol for tests, over `websockets`."""

import itertools
import json
import struct
import time
from collections.abc import Callable
from types import TracebackType
from typing import Any, Self
from urllib.parse import urlsplit

from websockets.sync.client import ClientConnection, connect
from websockets.typing import Subprotocol

PATIENCE_S = 60.0


def socket_url(url: str) -> str:
    """Return the WebSocket address of a page's URL, with its token."""
    parts = urlsplit(url)
    return f"ws://{parts.netloc}/" + (f"?{parts.query}" if parts.query else "")


def page_url(url: str, path: str) -> str:
    """Return the address of a path of a page, with its token."""
    parts = urlsplit(url)
    joint = "" if not parts.query else "&" if "?" in path else "?"
    return f"{parts.scheme}://{parts.netloc}/{path.lstrip('/')}{joint}{parts.query}"


class ProtocolClient:
    """Blocking client that stores all messages."""

    def __init__(self, url: str, *, protocol: str = "trundle.v1", **options: Any) -> None:
        self.socket: ClientConnection = connect(
            socket_url(url),
            subprotocols=[Subprotocol(protocol)],
            compression=None,
            **{"max_size": None, "max_queue": None, "close_timeout": 1.0, "ping_interval": None} | options,
        )
        self.channels: dict[str, dict[str, Any]] = {}
        """Topic → offer."""
        self.services: dict[str, dict[str, Any]] = {}
        self.statuses: list[dict[str, Any]] = []
        self.jsons: list[dict[str, Any]] = []
        """All text messages."""
        self.messages: list[tuple[str, int, bytes]] = []
        """Topic, time and payload of all messages of channels; the topic is empty for unknown subscriptions."""
        self.binaries: list[bytes] = []
        """Other binary messages, except for the time."""
        self.times: list[int] = []
        self._subscribed: dict[int, str] = {}
        self._parts: dict[int, bytes] = {}
        self._numbers = itertools.count(100)

    def send(self, op: str, **fields: Any) -> None:
        self.socket.send(json.dumps({"op": op, **fields}))

    def subscribe(self, topic: str) -> int:
        """Subscribe once the topic is offered."""
        self.until(lambda: topic in self.channels)
        number = next(self._numbers)
        self._subscribed[number] = topic
        self.send("subscribe", subscriptions=[{"id": number, "channelId": self.channels[topic]["id"]}])
        return number

    def unsubscribe(self, number: int) -> None:
        self.send("unsubscribe", subscriptionIds=[number])

    def read(self, timeout_s: float) -> bool:
        """Read one message; return False after a timeout."""
        try:
            data = self.socket.recv(timeout=timeout_s)
        except TimeoutError:
            return False
        self._receive(data)
        return True

    def _join(self, part: bytes) -> None:
        """Join the parts of a message."""
        flow, is_last, is_text = struct.unpack_from("<IBB", part, 1)
        self._parts[flow] = self._parts.get(flow, b"") + part[7:]
        if is_last:
            whole = self._parts.pop(flow)
            self._receive(whole.decode() if is_text else whole)

    def _receive(self, data: str | bytes) -> None:
        if isinstance(data, str):
            self._read_json(json.loads(data))
        elif data[0] in (1, 0x81):
            number, stamp = struct.unpack_from("<IQ", data, 1)
            payload = data[13 if data[0] == 1 else 21 :]
            self.messages.append((self._subscribed.get(number, ""), stamp, payload))
        elif data[0] == 0x82:
            self.send("trundle/echo", mark=struct.unpack_from("<I", data, 1)[0])
        elif data[0] == 0x80:
            self._join(data)
        elif data[0] == 2:
            self.times.append(struct.unpack_from("<Q", data, 1)[0])
        else:
            self.binaries.append(data)

    def until(self, condition: Callable[[], object]) -> None:
        """Read until a condition is true."""
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, "waited in vain"
            self.read(0.05)

    def payloads(self, topic: str) -> list[bytes]:
        return [payload for name, _, payload in self.messages if name == topic]

    def last(self, op: str) -> dict[str, Any]:
        """Wait for a text message of a kind; return the last one."""
        self.until(lambda: any(message["op"] == op for message in self.jsons))
        return next(message for message in reversed(self.jsons) if message["op"] == op)

    def settle(self, seconds: float = 0.3) -> None:
        """Read all messages for some time."""
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0:
            self.read(left)

    def _read_json(self, message: dict[str, Any]) -> None:
        self.jsons.append(message)
        match message["op"]:
            case "advertise":
                self.channels |= {channel["topic"]: channel for channel in message["channels"]}
            case "unadvertise":
                gone = set(message["channelIds"])
                self.channels = {name: offer for name, offer in self.channels.items() if offer["id"] not in gone}
            case "advertiseServices":
                self.services |= {service["name"]: service for service in message["services"]}
            case "unadvertiseServices":
                gone = set(message["serviceIds"])
                self.services = {name: offer for name, offer in self.services.items() if offer["id"] not in gone}
            case "status":
                self.statuses.append(message)
            case _:
                pass

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: type[BaseException] | BaseException | TracebackType | None) -> None:
        self.socket.close()
