"""A joystick in the browser: two sticks and buttons to move by hand, or a real pad that is plugged in there.

viser knows neither; a small page of our own, in a frame of the panel, reads both and sends what changed to a server of
its own. That one hears only pages whose address holds the page's token.
"""

import json
import math
import socket
import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any, cast

from trundle.access import Access, PageRequest

from .requests import MoveJoystick

_LONGEST_BODY = 4000
_IDLE_S = 60.0
_STICKS, _BUTTONS = 4, 17
"""Of the Gamepad API's standard mapping."""
_ON = 0.5
_ANY = ("", "0.0.0.0")
"""Hosts that mean every address of this machine."""


def joystick_of(sticks: Sequence[float], buttons: Sequence[float]) -> MoveJoystick:
    """Put a standard gamepad into the order in which Linux, and so `joy`, has the usual one.

    Args:
        sticks: left x, left y, right x, right y; right and back are positive.
        buttons: A B X Y, shoulders, triggers, back, start, sticks, up down left right, guide; 0 to 1.
    """
    left_x, left_y, right_x, right_y = (-value for value in sticks)
    pressed = [int(value > _ON) for value in buttons]
    up, down, left, right = pressed[12:16]
    axes = (left_x, left_y, 1 - 2 * buttons[6], right_x, right_y, 1 - 2 * buttons[7], left - right, up - down)
    order = (0, 1, 2, 3, 4, 5, 8, 9, 16, 10, 11)
    return MoveJoystick(tuple(float(value) for value in axes), tuple(pressed[index] for index in order))


class JoystickServer:
    """Serves the frame's page, and takes what it sends."""

    def __init__(self, access: Access, send: Callable[[MoveJoystick], None]) -> None:
        """Serve at any free port, by the page's rules, and by its token alone."""
        rules, page = replace(access, needs_token=True), files("trundle.viewer").joinpath("joystick.html").read_bytes()

        class Handler(_Handler):
            access, page_bytes, taken = rules, page, staticmethod(send)

        self._server = ThreadingHTTPServer((access.host, 0), Handler)
        self._server.daemon_threads = True
        port = int(self._server.server_address[1])
        everywhere = access.host in _ANY
        self.url = rules.url("127.0.0.1" if everywhere else access.host, port)
        self.url_elsewhere = rules.url(_outward_address(), port) if everywhere else None
        """For other machines, where the first one is for this one only."""
        threading.Thread(target=self._server.serve_forever, name="trundle-joystick", daemon=True).start()

    def close(self) -> None:
        """Serve no more."""
        self._server.shutdown()
        self._server.server_close()


def _outward_address() -> str:
    """This machine's address as others see it; no packet is sent to find it."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("192.0.2.1", 9))  # reserved for documentation: nobody has it
            return str(probe.getsockname()[0])
        except OSError:
            return socket.gethostname()


class _Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    timeout = _IDLE_S
    access: Access
    page_bytes: bytes
    taken: Callable[[MoveJoystick], None]

    def do_GET(self) -> None:
        """Hand the page out."""
        if self._is_refused("/"):
            return
        self._answer(200, self.page_bytes)

    def do_POST(self) -> None:
        """Take where the joystick is."""
        size = self.headers.get("Content-Length", "")
        if not size.isdigit() or int(size) > _LONGEST_BODY:
            self.close_connection = True
            self._answer(413)
            return
        body = self.rfile.read(int(size))
        if self._is_refused("/move"):
            return
        moved = _read(body)
        if moved is not None:
            self.taken(moved)
        self._answer(400 if moved is None else 204)

    def _is_refused(self, path: str) -> bool:
        """Answer what is not for this path, or not by the rules."""
        fields = self.headers
        asked = PageRequest(
            target=self.path, host=fields["Host"], origin=fields["Origin"], cookie=fields["Cookie"] or ""
        )
        if (why := self.access.refusal(asked)) is not None:
            self._answer(403, why.encode())
        elif self.path.partition("?")[0] != path:
            self._answer(404)
        else:
            return False
        return True

    def _answer(self, code: int, body: bytes = b"") -> None:
        self.send_response(code)
        self.send_header("Content-Type", "text/html; charset=utf-8")
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Cache-Control", "no-store")
        self.send_header("Referrer-Policy", "no-referrer")
        self.end_headers()
        self.wfile.write(body)

    def log_message(self, format: str, *args: Any) -> None:
        """Say nothing."""


def _read(body: bytes) -> MoveJoystick | None:
    """What the page sends; None: something else."""
    try:
        lists = json.loads(body)
        sticks, buttons = (_numbers(lists[name], count) for name, count in (("sticks", _STICKS), ("buttons", _BUTTONS)))
    except (ValueError, TypeError, KeyError, RecursionError):
        return None
    return joystick_of(sticks, buttons)


def _numbers(value: object, count: int) -> list[float]:
    """So many numbers from −1 to 1.

    Raises:
        ValueError: they are not.
        TypeError: they are no numbers.
    """
    numbers = [float(number) for number in cast("list[Any]", value)]
    if len(numbers) != count or not all(math.fabs(number) <= 1.0 for number in numbers):
        raise ValueError(numbers)
    return numbers
