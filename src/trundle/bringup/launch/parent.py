"""The roslaunch that started us, on another machine: where it is, and what it is told."""

import contextlib
import socket
import threading
from queue import Full, Queue
from typing import Self

from trundle.diagnostics import UsageError
from trundle.ros import MasterProxy, RosError, host_and_port

_ANSWER_S = 10.0
"""How long it may take to answer; roslaunch gives its children as long to register."""
_MAX_NEWS = 1000
_CLOSING_S = 2.0
_INFO, _ERROR = 2, 8
"""Levels of rosgraph_msgs/Log."""


class ParentLaunch:
    """Told in order what happens here; while it does not listen, nothing is held up. Also a context manager."""

    def __init__(self, name: str, uri: str, run_id: str) -> None:
        """Prepare.

        Args:
            name: what it calls us.
            uri: where it listens.
            run_id: of the master, once there is one: children are started before it.
        """
        self.uri = uri
        self.run_id = run_id
        self._name = name
        self._news: Queue[tuple[str, str, object] | None] = Queue(_MAX_NEWS)
        self._thread = threading.Thread(target=self._send, name="news for the parent", daemon=True)

    def register(self, ours: str, bind: str) -> None:
        """Tell it where to reach us.

        Args:
            ours: our address as it may call it.
            bind: the address we listen at.

        Raises:
            UsageError: it does not answer, does not know us, or is on another machine while we listen on loopback.
        """
        try:
            with socket.create_connection(host_and_port(self.uri), timeout=_ANSWER_S) as link:
                is_elsewhere = link.getsockname()[0] != link.getpeername()[0]
            if is_elsewhere and bind.startswith(("127.", "::1", "localhost")):
                raise UsageError(
                    f"the roslaunch at {self.uri} cannot reach {ours}; let its env-loader add --host 0.0.0.0"
                )
            self._call(self._name, "register", ours)
        except (OSError, ValueError, RosError) as error:
            raise UsageError(f"no roslaunch at {self.uri} that takes {self._name!r} as its child: {error}") from None

    def log(self, text: str, *, error: bool = False) -> None:
        """Have it print a line."""
        self._put((self._name, text, _ERROR if error else _INFO))

    def process_died(self, process: str, code: int) -> None:
        """Tell it that a process has ended by itself."""
        self._put((process, "", code))

    def _put(self, news: tuple[str, str, object] | None) -> None:
        with contextlib.suppress(Full):  # it has not listened to a thousand
            self._news.put_nowait(news)

    def _send(self) -> None:
        while (news := self._news.get()) is not None:
            name, text, number = news
            try:
                if text:
                    self._call(name, "log", number, text)
                else:
                    self._call(name, "process_died", number)
            except RosError:
                continue  # it is gone, or does not care; our nodes run on until it says otherwise

    def _call(self, first: str, method: str, *rest: object) -> None:
        """Call it; each of its methods has a name as its first argument, as the master's have."""
        MasterProxy(self.uri, first, timeout_s=_ANSWER_S).call(method, *rest)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._put(None)
        self._thread.join(_CLOSING_S)
