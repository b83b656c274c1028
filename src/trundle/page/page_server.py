"""Interface of the owner to the page's server: start it, send it data, poll the requests."""

import contextlib
import os
import queue
import secrets
import shutil
from collections import deque
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Self, TypeVar

import msgspec
import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.base.http.page_address import PageAddress
from trundle.base.waiting import PERIOD_S, WaitNotice, print_line

from .driving.stop import DriveStop
from .errors import PageError
from .link_file import write_link_file
from .mailbox import Mailbox, Piece
from .requests.answers import DONE, Answer
from .requests.request import GraphAction, Request
from .server_process import ServerProcess
from .session import Session
from .wire import (
    AddFile,
    BagFile,
    BagReferenceFile,
    Driven,
    FromServer,
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
)  # fmt: skip
from .world.streams import (
    ARRAY_HEADER,
    CONTACTS,
    DIFFERENCES,
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
    from .world.reference import Differences

_MAX_REQUESTS = 1000
_MIN_MAILBOX_BYTES = 4096
_Item = TypeVar("_Item")


class PageServer:
    """A browser page served by its own process.

    One thread owns it. Only `start` and `close` wait for the server; no method waits for a browser.
    """

    def __init__(self, start: Start, node: "Node | None", say: Callable[[str], None]) -> None:
        self._stop = None if node is None else DriveStop(node)
        self._requests: dict[bool, deque[Request]] = {kind: deque(maxlen=_MAX_REQUESTS) for kind in (False, True)}
        """Requests to the simulation or recording (False) and to nodes of the graph (True)."""
        self._terminal_inputs: deque[TerminalInput] = deque(maxlen=_MAX_REQUESTS)
        self._watched: frozenset[str] = frozenset()
        self._mailboxes: dict[str, Mailbox] = {}
        self._plotted: tuple[str, ...] = ()
        self._uploads: Path | None = None
        self._generation = 0
        self._addresses = Served(url="", foxglove_url="", view_url="")
        self._link_file: Path | None = None
        self._process = ServerProcess(start, receive=self._receive, on_end=self._ended, say=say)

    @classmethod
    def start(
        cls,
        session: Session,
        *,
        at: PageAddress | None = None,
        graph: GraphAddress | None = None,
        node: "Node | None" = None,
        bag: BagFile | None = None,
        reference: BagReferenceFile | None = None,
        source: Path | None = None,
        say: Callable[[str], None] = print_line,
    ) -> Self:
        """Start the server and wait until it answers; if it ends, it is started again with the same links.

        Args:
            session: title, panels and topics of the page.
            at: address to bind; by default loopback, port 8080 or the next free one.
            graph: ROS graph to join; None: the page shows only its owner's data.
            source: world, model or launch file of the page; clients may fetch meshes and textures around it and on the
                package paths. None: the working directory.
            reference: bag to compare the page's topics with.
            bag: bag to play; None: the page shows its owner's data or the graph.
            node: node of this process that publishes a zero velocity if the server dies while a robot is driven.
            say: prints a line when the server has ended.

        Raises:
            UsageError: the requested host or port cannot be bound.
            PageError: the server's process did not start.
        """
        at = at or PageAddress()
        start = Start(
            host=at.host,
            port=at.port,
            reserved_ports=at.reserved_ports,
            hosts=at.allowed.hosts,
            origins=at.allowed.origins,
            token=secrets.token_urlsafe(16),
            view_token=secrets.token_urlsafe(16),
            session=session,
            graph=graph,
            bag=bag,
            reference=reference,
            source=os.fsencode((source or Path.cwd()).absolute()),
        )
        server = cls(start, node, say)
        try:
            server._addresses = server._await_served()
            server._link_file = write_link_file(server._addresses, os.environ)
        except BaseException:
            server.close()
            raise
        return server

    @property
    def url(self) -> str:
        """Link to the page, with its token: `http://127.0.0.1:8080/?token=…`."""
        return self._addresses.url

    @property
    def foxglove_url(self) -> str:
        """Address for Foxglove and Lichtblick, with the token: `ws://127.0.0.1:8080/?token=…`."""
        return self._addresses.foxglove_url

    @property
    def view_url(self) -> str:
        """View-only link to the page: `http://127.0.0.1:8080/?token=…`."""
        return self._addresses.view_url

    @property
    def alive(self) -> bool:
        """True while the server runs or is being started again; after that, all data is dropped."""
        return self._process.alive

    @property
    def process_id(self) -> int:
        """Id of the server's process."""
        return self._process.id

    @property
    def generation(self) -> int:
        """Generation of the latest world; 0 before the first."""
        return self._generation

    def is_watched(self, stream: str) -> bool:
        """True if a client watches a stream: one of `trundle.page.world.streams`, or a camera's topic.

        Other streams need not be put.
        """
        return stream in self._watched

    @property
    def plotted(self) -> tuple[str, ...]:
        """Names, as in `PlotSeries`, of the values of the simulation that clients plot."""
        return self._plotted

    @property
    def uploads(self) -> Path | None:
        """Folder of the uploaded models, each a folder, until `close`; None: there are none."""
        return self._uploads

    def requests(self, *, of_graph: bool | None = None) -> list[Request]:
        """Return the requests since the last call, oldest first; answer each by `respond`.

        Two threads may share the page, one for the requests to nodes of the graph, the other for the rest.

        Args:
            of_graph: True: only requests to nodes of the graph; False: all others; None: all.
        """
        requests = [
            request
            for kind, pending in self._requests.items()
            if of_graph in (None, kind)
            for request in _drain(pending)
        ]
        return requests if of_graph is not None else sorted(requests, key=lambda request: request.id)

    def terminal_inputs(self) -> list[TerminalInput]:
        """Return the input and sizes for terminals since the last call, oldest first."""
        return _drain(self._terminal_inputs)

    def respond(self, request_id: int, error: str | None = None, answer: Answer = DONE) -> None:
        """Answer a request; `error` is the reason for a failure."""
        self._send(Respond(request_id, error, answer=encode_json(answer)))

    def respond_picture(self, request_id: int, picture: bytes | str) -> None:
        """Answer `RenderView` or `RenderModel` with a picture, a GLB, or the error as text."""
        if isinstance(picture, str):
            self.respond(request_id, picture)
        else:
            self._send(Respond(request_id, picture=picture))

    def set_session(self, session: Session) -> None:
        """Replace the session."""
        self._send(SetSession(session))

    def set_notice(self, notice_id: str, text: str | None) -> None:
        """Show a warning until it is replaced; None: remove it."""
        self._send(SetNotice(notice_id, text))

    def set_node(self, node: "Node | None") -> None:
        """Replace the node that stops a driven robot; see `start`."""
        if self._stop is not None:
            self._stop.end()
        self._stop = None if node is None else DriveStop(node)

    def set_world(self, manifest: "Manifest", files: Mapping[str, bytes]) -> None:
        """Replace the manifest of the simulated world.

        Args:
            manifest: manifest, whose generation the following poses and joints get.
            files: URL as in the manifest → content of files that are new in the manifest. Files that it no longer
                names are removed.
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
        """Show the newest rows of plotted values; they may overlap with earlier ones.

        Args:
            first: number of the first row, counted from the first row ever put.
            head: names and units of the columns.
            rows: (rows, 1 + series): time [s] and values, NaN for missing ones.
        """
        text = msgspec.json.encode(head)
        self._put(
            SERIES, [SERIES_HEADER.pack(first, len(text)), text, np.ascontiguousarray(rows).reshape(-1).view(np.uint8)]
        )

    def put_performance(self, profile: "Profile") -> None:
        """Show how the wall time of the last second was spent."""
        self._put(PERFORMANCE, [msgspec.json.encode(profile)])

    def put_differences(self, differences: "Differences") -> None:
        """Show the differences from the recording that the world is compared with."""
        self._put(DIFFERENCES, [msgspec.json.encode(differences)])

    def put_lines(self, time_ns: int, lines: Iterable[Line]) -> None:
        """Replace the lines."""
        self._put(LINES, line_pieces(time_ns, tuple(lines)))

    def put_contacts(self, time_ns: int, contacts: NDArray[np.float64]) -> None:
        """Show the contacts (contacts, 9): both bodies, position [m], force of first on second [N], depth [m]."""
        self._put_rows(CONTACTS, time_ns, contacts)

    def put_ranges(self, time_ns: int, lines: Iterable[Line]) -> None:
        """Replace the lines of range sensors."""
        self._put(RANGES, line_pieces(time_ns, tuple(lines)))

    def put_terminal(self, stream: str, first: int, size: tuple[int, int], output: bytes) -> None:
        """Show the end of a terminal's output, from byte number `first`, at a size (columns, rows)."""
        self._put(stream, [TERMINAL_HEADER.pack(first, *size), output])

    def put_image(self, topic: str, time_ns: int, rgb: NDArray[np.uint8]) -> None:
        """Show a camera's newest picture (height, width, 3) on its topic in the manifest; for runs without ROS."""
        assert rgb.ndim == 3, "a picture is (height, width, 3)"
        assert rgb.shape[2] == 3, "a picture is (height, width, 3)"
        self._put(topic, [IMAGE_HEADER.pack(time_ns, *rgb.shape), np.ascontiguousarray(rgb).reshape(-1)])

    def close(self) -> None:
        """End the server and wait until its process has ended and the port is free. May be called twice."""
        self._process.close()
        mailboxes, self._mailboxes = self._mailboxes, {}  # first, since two threads may close
        for mailbox in mailboxes.values():
            mailbox.unlink()
        if self._link_file is not None:
            with contextlib.suppress(OSError):
                self._link_file.unlink(missing_ok=True)
                self._link_file.parent.rmdir()  # fails while other pages run
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
        """Put a message into the stream's mailbox; one that is too small is replaced."""
        size = sum(map(len, pieces))
        mailbox = self._mailboxes.get(stream)
        if mailbox is None or size > mailbox.capacity_bytes:
            if mailbox is not None:
                mailbox.unlink()
            mailbox = self._mailboxes[stream] = Mailbox.create(max(_MIN_MAILBOX_BYTES, size + size // 4))
            mailbox.put(pieces)
            self._send(OpenMailbox(stream, mailbox.address))
            return
        mailbox.put(pieces)

    def _send(self, message: ToServer) -> None:
        self._process.send(message)

    def _receive(self, message: FromServer) -> None:
        """Handle a message of the server, in its process' thread."""
        match message:
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
            case _:  # replies to the start
                pass

    def _ended(self) -> None:
        """Stop driven robots, after the server has ended; its clients are gone."""
        self._watched, self._plotted = frozenset(), ()
        if self._stop is not None:
            self._stop = self._stop.replace()

    def _await_served(self) -> Served:
        notice = WaitNotice("the page's server to start")
        while True:
            try:
                reply = self._process.replies.get(timeout=PERIOD_S)
                break
            except queue.Empty:
                notice.poll()
        if isinstance(reply, Served):
            return reply
        if isinstance(reply, Refused):
            raise UsageError(reply.reason)
        raise PageError("the page's server ended at each start; what it printed says why")


def _drain(pending: deque[_Item]) -> list[_Item]:
    """Remove and return the items that another thread appended, oldest first."""
    items: list[_Item] = []
    with contextlib.suppress(IndexError):
        while True:
            items.append(pending.popleft())
    return items
