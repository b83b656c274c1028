"""The page's own process: viser, fed through mailboxes, ended by the end of its input.

Run as `python -m trundle.viewer.page` by `Viewer.start` alone. Standard input carries what to serve and show,
standard output what people press; nothing else may write there.
"""

import contextlib
import logging
import os
import pickle
import queue
import signal
import socket
import sys
import threading
import time
from typing import BinaryIO

import numpy as np
import viser

from trundle.access import Access
from trundle.page_address import PageAddress

from .content import ViewerState
from .display import Display
from .framing import Extent
from .guard import guarded
from .joystick import JoystickServer
from .mailbox import Mailbox
from .panel import Panel
from .requests import Request
from .stage import Stage
from .wire import Refused, Served, Show

_DEFAULT_PORT = 8080
_PORTS_TRIED = 200
_PERIOD_S = 1 / 30
_DARK = 0.4
"""A background darker than this, as rviz's, gets a dark panel."""


class Page:
    """A server and the scene it shows now."""

    def __init__(self, server: viser.ViserServer, mouth: "Mouth", access: Access) -> None:
        self._server = server
        self._access = access
        self._joystick: JoystickServer | None = None
        self._mouth = mouth
        self._display: Display | None = None
        self._state: ViewerState | None = None
        self._dirty = threading.Event()
        self._told: tuple[str, ...] = ()
        self._framed: Extent | None = None
        self._fixed_by_owner = ""

    def show(self, show: Show) -> bool:
        """Draw another scene; the toggles stay as the person set them.

        False: its mailboxes are gone, as the owner has replaced it already; the newer scene is on its way.
        """
        server, scene = self._server, show.scene
        try:
            boxes = [Mailbox.open(address) for address in (show.state_box, *show.image_boxes, *show.figure_boxes)]
        except FileNotFoundError:
            return False
        self._state_box, *pictures = boxes
        self._image_boxes = pictures[: len(show.image_boxes)]
        self._figure_boxes = pictures[len(show.image_boxes) :]
        for box in boxes:
            box.unlink()  # nothing is left behind, however the two processes end
        fixed = scene.fixed_frame or scene.root_frame
        if self._display is None:
            self._display = Display(frames=scene.show_frames, path=scene.show_path, fixed_frame=fixed)
        elif fixed != self._fixed_by_owner:
            self._display.fixed_frame = fixed
        self._fixed_by_owner = fixed
        with server.atomic():
            server.gui.reset()
            server.scene.reset()
            server.scene.set_up_direction("+z")
            dark = sum(scene.scene.background[:3]) / 3 < _DARK
            server.gui.configure_theme(show_logo=False, show_share_button=False, dark_mode=dark)
            server.gui.main_panel.dock_right()
            self._stage = Stage(server, scene)
            self._panel = Panel(
                server,
                scene,
                self._display,
                send=self._mouth.say,
                redraw=self._dirty.set,
                aim=self._aim,
                joystick=self._joystick_frame,
            )
        self._state = None
        self.tick()
        return True

    def _joystick_frame(self) -> JoystickServer:
        """Serve the joystick's frame, once."""
        if self._joystick is None:
            self._joystick = JoystickServer(self._access, self._mouth.say)
        return self._joystick

    def tick(self) -> None:
        """Draw the newest state and images, if there are any."""
        assert self._display is not None
        watched = bool(self._server.get_clients())
        for index, box in enumerate(self._image_boxes):
            message = box.take() if watched else None  # two JPEGs a frame are not made for nobody
            if message is not None:
                height, width = np.frombuffer(message, dtype=np.int32, count=2)
                rgb = np.frombuffer(message, dtype=np.uint8, offset=8).reshape(int(height), int(width), 3)
                self._panel.image(index, rgb)
                self._stage.image(index, rgb)
        for index, box in enumerate(self._figure_boxes):
            drawing = box.take()
            if drawing is not None:
                self._panel.figure(index, drawing)
        message = self._state_box.take()
        if message is not None:
            state: ViewerState = pickle.loads(message)
            self._state = state
        elif not self._dirty.is_set() or self._state is None:
            if self._state is not None:
                self._panel.update(self._state, self._told)  # its texts lag behind the scene on purpose
            return
        self._dirty.clear()
        self._told = self._stage.update(self._state, self._display)
        self._panel.update(self._state, self._told)
        self._frame()

    def _frame(self) -> None:
        """Place the camera once there is something to see; from then on it belongs to the person."""
        extent = self._stage.extent
        if extent is None or extent is self._framed or (extent.is_guess and self._framed is not None):
            return
        extent.aim(self._server.initial_camera)
        if self._framed is None or self._framed.is_guess:
            for client in self._server.get_clients().values():
                extent.aim(client.camera)
        self._framed = extent

    def _aim(self, client: viser.ClientHandle, from_above: bool) -> None:
        if self._stage.extent is not None:
            self._stage.recenter()
            self._dirty.set()
            self._stage.extent.aim(client.camera, from_above=from_above)


class Mouth:
    """The pipe to the owner; viser's callbacks come from many threads."""

    def __init__(self, stream: BinaryIO) -> None:
        self._stream = stream
        self._lock = threading.Lock()

    def say(self, message: Served | Refused | Request) -> None:
        """Send one message."""
        with self._lock, contextlib.suppress(OSError):  # an owner that is gone is noticed where its pipe ends
            pickle.dump(message, self._stream, protocol=5)
            self._stream.flush()


def _free_port(serve: PageAddress) -> int | Refused:
    """Find the port to bind, by binding it for a moment: viser itself would try a thousand without a word."""
    asked = serve.port is not None
    ports = (serve.port,) if serve.port is not None else range(_DEFAULT_PORT, _DEFAULT_PORT + _PORTS_TRIED)
    try:
        family, _, _, _, (address, *_) = socket.getaddrinfo(serve.host, None, type=socket.SOCK_STREAM)[0]
    except OSError as error:
        return Refused(f"cannot serve the viewer at host '{serve.host}': {error.strerror or error}")
    for port in ports:
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            if os.name == "posix":
                probe.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            try:
                probe.bind((address, port))
            except OSError as error:
                if asked:
                    return Refused(
                        f"cannot serve the viewer at {serve.host}:{port}: {error.strerror}; "
                        "leave out the port to take the next free one, or give another"
                    )
                continue
            return int(probe.getsockname()[1])
    return Refused(f"no port from {ports[0]} to {ports[-1]} is free at {serve.host}; give one with --port")


def main() -> None:
    """Serve until standard input ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    logging.getLogger("websockets").setLevel(logging.CRITICAL)  # it answers nonsense from the net with tracebacks
    mouth = Mouth(os.fdopen(os.dup(1), "wb"))
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)  # viser prints banners
    serve, show = pickle.load(sys.stdin.buffer), pickle.load(sys.stdin.buffer)
    assert isinstance(serve, PageAddress)
    port = _free_port(serve)
    if isinstance(port, Refused):
        mouth.say(port)
        return
    access = Access(host=serve.host, port=port, allowed=serve.allowed)
    with guarded(access):
        server = viser.ViserServer(host=serve.host, port=port, verbose=False)
    if serve.port and server.get_port() != serve.port:  # somebody was faster: viser has moved on
        mouth.say(Refused(f"cannot serve the viewer at {serve.host}:{serve.port}: the port was just taken"))
        os._exit(0)
    reachable = "127.0.0.1" if serve.host in ("0.0.0.0", "") else serve.host
    page = Page(server, mouth, access)
    while not page.show(show):
        show = pickle.load(sys.stdin.buffer)
    mouth.say(Served(access.url(reachable, server.get_port())))
    shows: queue.SimpleQueue[Show] = queue.SimpleQueue()
    threading.Thread(target=_listen, args=(shows,), daemon=True).start()
    while True:
        started = time.monotonic()
        while not shows.empty():
            page.show(shows.get())
        page.tick()
        time.sleep(max(0.0, started + _PERIOD_S - time.monotonic()))


def _listen(shows: "queue.SimpleQueue[Show]") -> None:
    """Take new scenes until the owner closes the pipe or is gone, then end at once.

    Nothing here needs an orderly end: the system closes the sockets, and the mailboxes have no names any more.
    """
    try:
        while True:
            shows.put(pickle.load(sys.stdin.buffer))
    except (EOFError, OSError, pickle.UnpicklingError):
        os._exit(0)


if __name__ == "__main__":
    main()
