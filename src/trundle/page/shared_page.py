"""Page that all windows of one graph share: rviz, rqt's and Gazebo's."""

import threading
from collections.abc import Callable
from pathlib import Path

from msgspec.structs import replace

from trundle.base.diagnostics import Diagnostics, UsageError
from trundle.base.http.page_address import PageAddress
from trundle.page import BagReferenceFile, GraphAddress, PageServer, Request, Session
from trundle.ros import Node

from .browser import announce_page

_MAX_FINDINGS = 60
"""Limit of warnings about files on the page."""
CMD_VEL = "/cmd_vel"
"""Default topic of velocity commands."""


class SharedPage:
    """The page's server, started by the first window and ended by the last, and the session that all windows share.

    Thread-safe.
    """

    def __init__(
        self,
        *,
        say: Callable[[str], None],
        at: PageAddress | None = None,
        graph: GraphAddress | None = None,
        source: Path | None = None,
        server: PageServer | None = None,
        opens_browser: bool = True,
        reference: BagReferenceFile | None = None,
        lesson: str | None = None,
    ) -> None:
        """Create it; `acquire` serves the page.

        Args:
            say: prints the page's URLs.
            at: address of the page.
            graph: ROS graph that the page joins; None: without ROS.
            source: file of the page, from whose folder packages are searched; None: the working folder.
            server: running server; None: it is started on first use.
            opens_browser: False: print the URLs only.
            reference: bag to compare the graph's topics with.
            lesson: lesson that is open at the start, as `Session.lesson`.
        """
        self._say = say
        self._at = at or PageAddress()
        self._graph = graph
        self._source = source
        self._server = server
        self._opens_browser = opens_browser
        self._reference = reference
        drive_topic = None if graph is None else CMD_VEL
        self._session = Session(title="ROS", kind="graph", drive_topic=drive_topic, lesson=lesson)
        self._users = {False: 0, True: 0}
        """Numbers of windows that show the graph (False) and a simulated world (True)."""
        self._findings: tuple[Diagnostics, int] | None = None
        """Report whose findings are shown, and their number."""
        self._notices = 0
        self._is_over = False
        self._starting = threading.Lock()
        self._lock = threading.Lock()

    @property
    def url(self) -> str | None:
        """URL of the page; None before it is served."""
        server = self._server
        return None if server is None else server.url

    @property
    def is_over(self) -> bool:
        """True if the page was closed, or could not be served."""
        return self._is_over

    @property
    def has_graph(self) -> bool:
        """True if the page joins a ROS graph."""
        return self._graph is not None

    @property
    def session(self) -> Session:
        """Current session."""
        return self._session

    def change(self, **changes: object) -> None:
        """Change fields of the session."""
        with self._lock:
            self._session = replace(self._session, **changes)
            if self._server is not None:
                self._server.set_session(self._session)

    def acquire(self, node: Node | None, *, shows_world: bool = False, source: Path | None = None) -> PageServer:
        """Return the server, after starting it if none runs; call `release` once for each call.

        Args:
            node: stops a driven robot if the server dies.
            shows_world: True for a window with a simulated world.
            source: file of the page, if the constructor got none.

        Raises:
            UsageError: the requested port is in use, or the page was closed meanwhile.
        """
        with self._starting:
            server = self._server
            if server is None:
                self._is_over = False
                try:
                    server = self._start(node, self._source or source)
                except BaseException:
                    self._is_over = True
                    raise
            self._users[shows_world] += 1
            return server

    def _start(self, node: Node | None, source: Path | None) -> PageServer:
        started = self._session
        server = PageServer.start(
            started, at=self._at, graph=self._graph, reference=self._reference, node=node, source=source, say=self._say
        )
        with self._lock:
            if self._is_over:
                server.close()
                raise UsageError("the page was closed while it was being opened")
            self._server, self._findings, self._notices = server, None, 0
            if self._session is not started:
                server.set_session(self._session)
        announce_page(server, self._at, self._say, opens_browser=self._opens_browser)
        self._say(f"Foxglove connects to {server.foxglove_url}")
        return server

    def show_findings(self, report: Diagnostics) -> None:
        """Show the warnings about files, `file:line: text`; call it whenever there may be new ones."""
        with self._lock:
            server, shown = self._server, (report, len(report.findings))
            if server is None or shown == self._findings:
                return
            self._findings = shown
            texts = _warnings(report)
            for number in range(max(len(texts), self._notices)):
                server.set_notice(f"file/{number}", texts[number] if number < len(texts) else None)
            self._notices = len(texts)

    def requests(self, *, of_world: bool) -> list[Request]:
        """Return new requests to the windows of one kind, and to the other kind, too, while it has no window."""
        server = self._server
        if server is None:
            return []
        return server.requests(of_graph=not of_world if self._users[not of_world] else None)

    def release(self, *, shows_world: bool = False) -> None:
        """End a window's use of the page; the last one closes it."""
        with self._starting:
            self._users[shows_world] -= 1
            is_last = not any(self._users.values())
        if is_last:
            self.close()

    def close(self) -> None:
        """Close the page even if windows use it; may be called twice."""
        with self._lock:
            self._is_over = True
            server, self._server = self._server, None
        if server is not None:
            server.close()


def _warnings(report: Diagnostics) -> list[str]:
    """Return warnings and errors up to the limit, the worst first; one about several lines of a file counts once."""
    findings = Diagnostics()
    findings.extend(finding for finding in report.findings if finding.severity != "info")
    texts = [text.replace(": warning: ", ": ", 1) for text in findings.worst_first()]
    rest = len(texts) - _MAX_FINDINGS
    return texts if rest <= 0 else [*texts[:_MAX_FINDINGS], f"{rest} more in the terminal"]
