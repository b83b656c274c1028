"""The page's server as its owner sees it: start it, feed it, poll the requests."""

import contextlib
import os
import queue
import shutil
import subprocess
import sys
import threading
from collections import deque
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Self, TypeVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.base.http.page_address import PageAddress
from trundle.base.waiting import PERIOD_S, WaitNotice

from .driving.stop import DriveStop
from .errors import PageError
from .link_file import write_link_file
from .mailbox import Mailbox, Piece
from .requests.answers import DONE, Answer
from .requests.request import GraphAction, Request
from .session import Session
from .wire import (
    AddFile,
    BagFile,
    Driven,
    GraphAddress,
    OpenMailbox,
    Plotted,
    Refused,
    Respond,
    Served,
    SetNotice,
    SetSession,
    SetWorld,
    Start,
    TerminalInput,
    ToServer,
    Uploaded,
    Watched,
    encode_json,
    frame,
    from_server_decoder,
    read_frame,
)  # fmt: skip
from .world.streams import (
    ARRAY_HEADER,
    CONTACTS,
    IMAGE_HEADER,
    JOINTS,
    LINES,
    PERFORMANCE,
    POSES,
    RANGES,
    SERIES,
    SERIES_HEADER,
    STATE,
    TERMINAL_HEADER,
    ClockState,
    Line,
    SeriesHead,
    line_pieces,
)

if TYPE_CHECKING:
    from trundle.ros import Node

    from .world.manifest import Manifest
    from .world.profile import Profile

_STOP_TIMEOUT_S = 1.5
_MAX_REQUESTS = 1000
_MIN_BOX_BYTES = 4096
_Item = TypeVar("_Item")


class PageServer:
    """A browser page served by a process of its own.

    One thread owns it. Nothing here waits for the page: a browser that is slow, or gone, costs the owner nothing.
    """

    def __init__(self, process: "subprocess.Popen[bytes]", stop: DriveStop | None) -> None:
        self._process = process
        self._stop = stop
        self._outgoing: queue.SimpleQueue[Start | ToServer | None] = queue.SimpleQueue()
        self._replies: queue.SimpleQueue[Served | Refused | None] = queue.SimpleQueue()
        self._requests: dict[bool, deque[Request]] = {kind: deque(maxlen=_MAX_REQUESTS) for kind in (False, True)}
        """By whether they are to nodes of the graph."""
        self._terminal_inputs: deque[TerminalInput] = deque(maxlen=_MAX_REQUESTS)
        self._watched: frozenset[str] = frozenset()
        self._boxes: dict[str, Mailbox] = {}
        self._plotted: tuple[str, ...] = ()
        self._uploads: Path | None = None
        self._generation = 0
        self._addresses = Served(url="", foxglove_url="", view_url="")
        self._link_file: Path | None = None
        self._threads = [
            threading.Thread(target=run, name="trundle-page", daemon=True) for run in (self._receive, self._send_all)
        ]
        for thread in self._threads:
            thread.start()

    @classmethod
    def start(
        cls,
        session: Session,
        *,
        at: PageAddress | None = None,
        graph: GraphAddress | None = None,
        node: "Node | None" = None,
        bag: BagFile | None = None,
        source: Path | None = None,
    ) -> Self:
        """Start the server and return once it answers.

        Args:
            session: what the page is for.
            at: address to bind; by default loopback, port 8080 or the next free one.
            graph: the ROS graph to join; None: the page shows what its owner puts here, alone.
            source: world, model or launch file that the page is about; clients may fetch meshes and textures around it
                and on the package paths. None: the working directory.
            bag: a bag to play; None: the page shows what its owner puts here, or the graph.
            node: node of this process that publishes a zero velocity if the server dies while a robot is driven.

        Raises:
            UsageError: the host or the port asked for cannot be bound.
            PageError: the server's process did not start.
        """
        at = at or PageAddress()
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "trundle.page.server"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # Ctrl-C reaches every process of the terminal's group; the server ends when its input does.
            start_new_session=True,
        )
        server = cls(process, None if node is None else DriveStop(node))
        start = Start(
            host=at.host,
            port=at.port,
            reserved_ports=at.reserved_ports,
            hosts=at.allowed.hosts,
            origins=at.allowed.origins,
            session=session,
            graph=graph,
            bag=bag,
            source=os.fsencode((source or Path.cwd()).absolute()),
        )
        server._outgoing.put(start)
        try:
            server._addresses = server._await_served()
            server._link_file = write_link_file(server._addresses, os.environ)
        except BaseException:
            server.close()
            raise
        return server

    @property
    def url(self) -> str:
        """Link to the page, with the token that opens it: `http://127.0.0.1:8080/?token=…`."""
        return self._addresses.url

    @property
    def foxglove_url(self) -> str:
        """Address for Foxglove and Lichtblick, with the token: `ws://127.0.0.1:8080/?token=…`."""
        return self._addresses.foxglove_url

    @property
    def view_url(self) -> str:
        """Link to a page that may look and change nothing: `http://127.0.0.1:8080/?token=…`."""
        return self._addresses.view_url

    @property
    def alive(self) -> bool:
        """True while the server's process runs; afterwards everything put here is dropped."""
        return self._process.poll() is None

    @property
    def process_id(self) -> int:
        """Number of the server's process."""
        return self._process.pid

    @property
    def generation(self) -> int:
        """Generation of the last world shown; 0 before the first."""
        return self._generation

    def is_watched(self, stream: str) -> bool:
        """True if some client looks at a stream: one of `trundle.page.world.streams`, or a camera's topic.

        Streams that are not watched need not be put.
        """
        return stream in self._watched

    @property
    def plotted(self) -> tuple[str, ...]:
        """Values of the simulation that some client plots, as `PlotSeries` names them."""
        return self._plotted

    @property
    def uploads(self) -> Path | None:
        """Folder of the models that people have uploaded, each a folder, until `close`; None: there are none."""
        return self._uploads

    def requests(self, *, of_graph: bool | None = None) -> list[Request]:
        """Return the requests since the last call, oldest first; each is to be answered by `respond`.

        Two threads may share the page: one takes the requests to nodes of the graph, the other one the rest.

        Args:
            of_graph: True: requests to nodes of the graph alone; False: all others; None: all.
        """
        taken = [
            request
            for kind, waiting in self._requests.items()
            if of_graph in (None, kind)
            for request in _drain(waiting)
        ]
        return taken if of_graph is not None else sorted(taken, key=lambda request: request.id)

    def terminal_inputs(self) -> list[TerminalInput]:
        """Return the keys and sizes for terminals since the last call, oldest first."""
        return _drain(self._terminal_inputs)

    def respond(self, request_id: int, error: str | None = None, answer: Answer = DONE) -> None:
        """Answer a request; `error` is a sentence that says why it was not done."""
        self._send(Respond(request_id, error, answer=encode_json(answer)))

    def respond_picture(self, request_id: int, picture: bytes) -> None:
        """Answer `RenderView` or `RenderModel` with a picture, or a GLB."""
        self._send(Respond(request_id, picture=picture))

    def set_session(self, session: Session) -> None:
        """Replace the session: the robot's name came, or a panel was asked for."""
        self._send(SetSession(session))

    def set_notice(self, notice_id: str, text: str | None) -> None:
        """Show a warning, a sentence, until it is replaced; None: it does not hold any more."""
        self._send(SetNotice(notice_id, text))

    def set_node(self, node: "Node | None") -> None:
        """Have another node publish the stop of a driven robot; see `start`."""
        if self._stop is not None:
            self._stop.end()
        self._stop = None if node is None else DriveStop(node)

    def set_world(self, manifest: "Manifest", files: Mapping[str, bytes]) -> None:
        """Replace the manifest of the simulated world.

        Args:
            manifest: its generation goes with the poses and joints put afterwards.
            files: URL as in the manifest → content of the files that the manifest did not name before. Files that it
                no longer names are forgotten.
        """
        for url, content in files.items():
            self._send(AddFile(url, content))
        self._generation = manifest.generation
        self._send(SetWorld.of(manifest))

    def put_state(self, state: ClockState) -> None:
        """Show the clock's newest state."""
        self._put(STATE, [msgspec.json.encode(state)])

    def put_poses(self, time_ns: int, poses: NDArray[np.float64]) -> None:
        """Show the newest poses (bodies, 7): x y z [m], qw qx qy qz, in the world frame, a row per body."""
        self._put_rows(POSES, time_ns, poses)

    def put_joints(self, time_ns: int, joints: NDArray[np.float64]) -> None:
        """Show the newest joints (joints, 3): position [rad or m], velocity, effort; rows as the manifest's `index`."""
        self._put_rows(JOINTS, time_ns, joints)

    def put_series(self, first: int, head: SeriesHead, rows: NDArray[np.float64]) -> None:
        """Show the newest rows of plotted values; those that a client has already are sent again.

        Args:
            first: number of the first row, which counts all that were put.
            head: of the columns.
            rows: (rows, 1 + series): time [s] and values, NaN where there is none.
        """
        text = msgspec.json.encode(head)
        self._put(
            SERIES, [SERIES_HEADER.pack(first, len(text)), text, np.ascontiguousarray(rows).reshape(-1).view(np.uint8)]
        )

    def put_performance(self, profile: "Profile") -> None:
        """Show where the wall time of the last second went."""
        self._put(PERFORMANCE, [msgspec.json.encode(profile)])

    def put_lines(self, time_ns: int, lines: Iterable[Line]) -> None:
        """Show these lines and no others."""
        self._put(LINES, line_pieces(time_ns, tuple(lines)))

    def put_contacts(self, time_ns: int, contacts: NDArray[np.float64]) -> None:
        """Show the contacts (contacts, 9): both bodies, position [m], force of first on second [N], depth [m]."""
        self._put_rows(CONTACTS, time_ns, contacts)

    def put_ranges(self, time_ns: int, lines: Iterable[Line]) -> None:
        """Show what range sensors measure, and nothing of those before."""
        self._put(RANGES, line_pieces(time_ns, tuple(lines)))

    def put_terminal(self, stream: str, first: int, size: tuple[int, int], output: bytes) -> None:
        """Show the end of a terminal's output, which begins with byte `first` of all, at a size (columns, rows)."""
        self._put(stream, [TERMINAL_HEADER.pack(first, *size), output])

    def put_image(self, topic: str, time_ns: int, rgb: NDArray[np.uint8]) -> None:
        """Show a camera's newest picture (height, width, 3) on its topic of the manifest; for runs without ROS."""
        assert rgb.ndim == 3, "a picture is (height, width, 3)"
        assert rgb.shape[2] == 3, "a picture is (height, width, 3)"
        self._put(topic, [IMAGE_HEADER.pack(time_ns, *rgb.shape), np.ascontiguousarray(rgb).reshape(-1)])

    def close(self) -> None:
        """End the server; the port is free and the process gone when this returns. May be called twice."""
        self._outgoing.put(None)
        try:
            self._process.wait(_STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        for thread in self._threads:
            thread.join()
        boxes, self._boxes = self._boxes, {}  # first: two threads may close
        for box in boxes.values():
            box.unlink()
        if self._link_file is not None:
            with contextlib.suppress(OSError):
                self._link_file.unlink(missing_ok=True)
                self._link_file.parent.rmdir()  # if no other page runs
        if self._uploads is not None:  # the server removes it, unless it was killed
            shutil.rmtree(self._uploads.parent, ignore_errors=True)

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def _put_rows(self, stream: str, time_ns: int, rows: NDArray[np.float64]) -> None:
        header = ARRAY_HEADER.pack(time_ns, self._generation, len(rows))
        self._put(stream, [header, np.ascontiguousarray(rows, dtype=np.float64).reshape(-1).view(np.uint8)])

    def _put(self, stream: str, pieces: Sequence[Piece]) -> None:
        """Put a message into the stream's mailbox, a larger one if it does not fit."""
        size = sum(map(len, pieces))
        box = self._boxes.get(stream)
        if box is None or size > box.capacity_bytes:
            if box is not None:
                box.unlink()
            box = self._boxes[stream] = Mailbox.create(max(_MIN_BOX_BYTES, size + size // 4))
            box.put(pieces)
            self._send(OpenMailbox(stream, box.address))
            return
        box.put(pieces)

    def _send(self, message: ToServer) -> None:
        self._outgoing.put(message)

    def _send_all(self) -> None:
        """Write messages until the end; in a thread of its own, as a pipe blocks when it is full."""
        assert self._process.stdin is not None
        with contextlib.suppress(OSError), self._process.stdin as pipe:
            while (message := self._outgoing.get()) is not None:
                pipe.write(frame(message))
                pipe.flush()

    def _receive(self) -> None:
        """Receive what the server says until it ends."""
        assert self._process.stdout is not None
        with contextlib.suppress(EOFError, OSError, msgspec.DecodeError), self._process.stdout as pipe:
            while True:
                match from_server_decoder.decode(read_frame(pipe)):
                    case Request() as request:
                        self._requests[isinstance(request.action, GraphAction)].append(request)
                    case Watched(streams):
                        self._watched = streams
                    case Plotted(series):
                        self._plotted = series
                    case Uploaded(folder):
                        self._uploads = Path(folder)
                    case TerminalInput() as typed:
                        self._terminal_inputs.append(typed)
                    case Driven(topics):
                        if self._stop is not None:
                            self._stop.follow(topics)
                    case reply:
                        self._replies.put(reply)
        self._watched, self._plotted = frozenset(), ()
        if self._stop is not None:
            self._stop.end()
        self._replies.put(None)

    def _await_served(self) -> Served:
        notice = WaitNotice("the page's server to start")
        while True:
            try:
                reply = self._replies.get(timeout=PERIOD_S)
                break
            except queue.Empty:
                notice.poll()
        if isinstance(reply, Served):
            return reply
        if isinstance(reply, Refused):
            raise UsageError(reply.reason)
        raise PageError(f"the page's server ended at once with exit code {self._process.wait()}")


def _drain(waiting: deque[_Item]) -> list[_Item]:
    """Remove and return what another thread appended, oldest first."""
    taken: list[_Item] = []
    with contextlib.suppress(IndexError):
        while True:
            taken.append(waiting.popleft())
    return taken
