"""Calls to the parent: the roslaunch on another machine that started this child."""

import contextlib
import socket
import threading
from queue import Full, Queue
from typing import Self

from trundle.base.diagnostics import UsageError
from trundle.ros import MasterProxy, RosError, host_and_port

_ANSWER_S = 10.0
"""Timeout of a call [s]; roslaunch's timeout for the registration of its children."""
_MAX_QUEUED = 1000
_CLOSING_S = 2.0
_INFO, _ERROR = 2, 8
"""Levels of rosgraph_msgs/Log."""


class ParentLaunch:
    """Queue of calls to the parent, which a thread sends in order. Also a context manager."""

    def __init__(self, name: str, uri: str, run_id: str) -> None:
        """Prepare.

        Args:
            name: this child's name.
            uri: URI of the parent's XML-RPC server.
            run_id: run_id of the master, which may start after this child.
        """
        self.uri = uri
        self.run_id = run_id
        self._name = name
        self._queue: Queue[tuple[str, str, object] | None] = Queue(_MAX_QUEUED)
        self._thread = threading.Thread(target=self._send, name="call for the parent", daemon=True)

    def register(self, uri: str, bind: str) -> None:
        """Register this child's address with the parent.

        Args:
            uri: URI of this child's XML-RPC server.
            bind: address to which the server is bound.

        Raises:
            UsageError: it does not answer, refuses the name, or is on another machine while `bind` is loopback.
        """
        try:
            with socket.create_connection(host_and_port(self.uri), timeout=_ANSWER_S) as link:
                is_elsewhere = link.getsockname()[0] != link.getpeername()[0]
            if is_elsewhere and bind.startswith(("127.", "::1", "localhost")):
                raise UsageError(
                    f"the roslaunch at {self.uri} cannot reach {uri}; let its env-loader add --host 0.0.0.0"
                )
            self._call(self._name, "register", uri)
        except (OSError, ValueError, RosError) as error:
            raise UsageError(f"no roslaunch at {self.uri} that takes {self._name!r} as its child: {error}") from None

    def log(self, text: str, *, error: bool = False) -> None:
        """Send a line for the parent to print."""
        self._put((self._name, text, _ERROR if error else _INFO))

    def process_died(self, process: str, code: int) -> None:
        """Report that a process has ended by itself."""
        self._put((process, "", code))

    def _put(self, call: tuple[str, str, object] | None) -> None:
        with contextlib.suppress(Full):  # the parent has not answered for a thousand calls
            self._queue.put_nowait(call)

    def _send(self) -> None:
        while (call := self._queue.get()) is not None:
            name, text, number = call
            try:
                if text:
                    self._call(name, "log", number, text)
                else:
                    self._call(name, "process_died", number)
            except RosError:
                continue  # it has ended, or refuses the call; the nodes run on until its shutdown call

    def _call(self, name: str, method: str, *arguments: object) -> None:
        """Call a method of the parent; as with the master's, its first argument is a name."""
        MasterProxy(self.uri, name, timeout_s=_ANSWER_S).call(method, *arguments)

    def __enter__(self) -> Self:
        self._thread.start()
        return self

    def __exit__(self, *_: object) -> None:
        self._put(None)
        self._thread.join(_CLOSING_S)
