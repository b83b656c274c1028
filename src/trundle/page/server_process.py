"""Process of the page's server: started, and started again with the same links when it ends."""

import contextlib
import queue
import subprocess
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import IO

import msgspec

from .requests.request import Request
from .shown_state import ShownState
from .wire import FromServer, Refused, Served, Start, ToServer, Uploaded, frame, from_server_decoder, read_frame

_STOP_TIMEOUT_S = 1.5
_MAX_ENDS, _WINDOW_S = 5, 60.0
"""Ends within a time after which the server is not started again."""
_PORT_RETRY_S = 1.0
_Outgoing = queue.SimpleQueue[Start | ToServer | None]


class ServerProcess:
    """Process of one page's server; thread-safe."""

    def __init__(
        self,
        start: Start,
        *,
        receive: Callable[[FromServer], None],
        on_end: Callable[[], None],
        say: Callable[[str], None],
    ) -> None:
        """Start it.

        Args:
            start: first message; its port, if it is None or 0, is the first server's from then on.
            receive: called with the messages of the server, in a thread.
            on_end: called after each end of a process, before the next one starts.
            say: prints a line.
        """
        self.replies: queue.SimpleQueue[Served | Refused | None] = queue.SimpleQueue()
        """The first server's reply; None: it has ended, and is not started again."""
        self._start = start
        self._receive, self._on_end, self._say = receive, on_end, say
        self._state = ShownState()
        self._lock = threading.Lock()
        self._closing = threading.Event()
        self._has_served = self._is_over = False
        self._process, self._outgoing = self._launch()
        self._thread = threading.Thread(target=self._supervise, name="trundle-page", daemon=True)
        self._thread.start()

    @property
    def alive(self) -> bool:
        """True while a process runs, or is being started again."""
        return not self._is_over

    @property
    def id(self) -> int:
        """Id of the current process."""
        return self._process.pid

    def send(self, message: ToServer) -> None:
        """Send a message; the shown state is sent again to a server that is started later."""
        with self._lock:
            self._state.record(message)
            self._outgoing.put(message)

    def close(self) -> None:
        """End the process and wait until the port is free; may be called twice."""
        with self._lock:
            self._closing.set()
            self._outgoing.put(None)
            process = self._process
        try:
            process.wait(_STOP_TIMEOUT_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        self._thread.join()

    def _launch(self) -> "tuple[subprocess.Popen[bytes], _Outgoing]":
        """Start a process, and the thread that sends it the first message and the shown state."""
        process = subprocess.Popen(
            [sys.executable, "-P", "-m", "trundle.page.server"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            # Ctrl-C signals every process of the terminal's group; the server ends at the end of its input.
            start_new_session=True,
        )
        assert process.stdin is not None
        outgoing: _Outgoing = queue.SimpleQueue()
        outgoing.put(self._start)
        for message in self._state.messages():
            outgoing.put(message)
        threading.Thread(target=_send_all, args=(process.stdin, outgoing), name="trundle-page", daemon=True).start()
        return process, outgoing

    def _supervise(self) -> None:
        """Receive messages, and start the server again whenever it ends, until it is closed or cannot start."""
        ends: deque[float] = deque(maxlen=_MAX_ENDS)
        while True:
            refusal = self._receive_all()
            code = self._process.wait()
            self._outgoing.put(None)
            self._on_end()
            ends.append(time.monotonic())
            is_final = refusal is not None and not self._has_served
            if is_final or (len(ends) == _MAX_ENDS and ends[-1] - ends[0] < _WINDOW_S):
                self._give_up(refusal, code)
                break
            if refusal is not None:
                self._closing.wait(_PORT_RETRY_S)
            with self._lock:
                if self._closing.is_set():
                    break
                self._process, self._outgoing = self._launch()
            if refusal is None:
                self._say(f"the page's server has ended with exit code {code}; it is started again, its links stay")
        self._is_over = True
        self.replies.put(None)

    def _give_up(self, refusal: str | None, code: int) -> None:
        if not self._has_served or self._closing.is_set():
            return
        reason = refusal or f"its server has ended {_MAX_ENDS} times, the last time with exit code {code}"
        self._say(f"the page is closed: {reason}. To see it again, end this with Ctrl-C and start it anew")

    def _receive_all(self) -> str | None:
        """Receive the messages of the current process; return the reason if it refused to start."""
        assert self._process.stdout is not None
        refusal: str | None = None
        with contextlib.suppress(EOFError, OSError, msgspec.DecodeError), self._process.stdout as pipe:
            while True:
                message = from_server_decoder.decode(read_frame(pipe))
                match message:
                    case Refused(reason):
                        refusal = reason
                        if not self._has_served:
                            self.replies.put(message)
                    case Served():
                        self._served(message)
                    case _:
                        self._follow(message)
                        self._receive(message)
        return refusal

    def _served(self, addresses: Served) -> None:
        if not self._has_served:
            self._has_served = True
            self._change_start(port=addresses.port)
            if self._start.graph is not None:  # so that the master replaces the old node's registrations
                self._change_start(graph=msgspec.structs.replace(self._start.graph, number=self._process.pid))
            self.replies.put(addresses)

    def _follow(self, message: FromServer) -> None:
        """Store the state of the server that the next one continues."""
        if isinstance(message, Request):
            self._change_start(last_request=message.id)
        elif isinstance(message, Uploaded):
            self._change_start(uploads=message.folder)

    def _change_start(self, **changes: object) -> None:
        self._start = msgspec.structs.replace(self._start, **changes)


def _send_all(pipe: IO[bytes], outgoing: _Outgoing) -> None:
    """Write messages until the end, in a thread, as a full pipe blocks."""
    with contextlib.suppress(OSError), pipe:
        while (message := outgoing.get()) is not None:
            pipe.write(frame(message))
            pipe.flush()
