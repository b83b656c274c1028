"""Node of this process: a node of `trundle.ros` that sends and receives bytes; message classes serialize."""

import logging
import os
import threading
from collections.abc import Callable, Coroutine
from concurrent.futures import CancelledError
from queue import SimpleQueue
from typing import TYPE_CHECKING, Any, TypeVar, cast

from trundle.ros.log import LEVELS
from trundle.ros.messages.raw_message import ServiceType
from trundle.ros.node.clock import WallClock
from trundle.ros.node.graph_node import Node
from trundle.ros.node.loop import GraphLoop
from trundle.ros.node.node_log import NodeLog

from . import core
from .exceptions import ROSException

if TYPE_CHECKING:
    from trundle.ros.messages.message_library import Messages

_T = TypeVar("_T")
_STOP_S = 4.0
_IDLE_THREADS = 8
_LEVELS = {"debug": logging.DEBUG, "info": logging.INFO, "warn": logging.WARNING, "error": logging.ERROR}

loop: GraphLoop | None = None
node: Node | None = None
_starters: list[Callable[[Node], object]] = []
"""Start endpoints that were created before the node."""
_lock = threading.RLock()


class ByteMessages:
    """Message store of the node: messages are bytes."""

    def __init__(self) -> None:
        self.services: dict[str, ServiceType] = {}

    def service(self, type_name: str) -> ServiceType:
        """Look up a service type that was added."""
        return self.services[type_name]

    def deserialize(self, data: bytes | memoryview, type_name: str) -> bytes:
        """Return the bytes."""
        del type_name
        return data if isinstance(data, bytes) else bytes(data)

    def serialize(self, message: bytes) -> bytes:
        """Return the bytes."""
        return message


class _Log(NodeLog):
    """Log of the node's internals, in its file."""

    def _write(self, level: str, text: str) -> None:
        logging.getLogger("rospy.internal").log(_LEVELS.get(level, logging.CRITICAL), "%s", text)
        if text.startswith("unable to register"):  # the master refuses the name
            core.logfatal("%s", text)
        if "keeps trying" in text and LEVELS[level] >= LEVELS["warn"]:
            master = os.environ.get("ROS_MASTER_URI", "http://localhost:11311")
            core.logerr(
                f"Unable to register with master node [{master}]: master may not be running yet. Will keep trying."
            )


class _Workers:
    """Threads that run requests of services, reused while idle."""

    def __init__(self) -> None:
        self._work: SimpleQueue[Callable[[], object]] = SimpleQueue()
        self._idle = 0
        self._lock = threading.Lock()

    def run_soon(self, work: Callable[[], object]) -> None:
        """Run a function on a thread that runs nothing else meanwhile."""
        with self._lock:
            is_free = self._idle > 0
            self._idle -= is_free
        if is_free:
            self._work.put(work)
        else:
            threading.Thread(target=self._run, args=(work,), name="rospy-service", daemon=True).start()

    def _run(self, work: Callable[[], object]) -> None:
        while True:
            work()
            with self._lock:
                if self._idle >= _IDLE_THREADS:
                    return
                self._idle += 1
            work = self._work.get()


_workers = _Workers()


def start(name: str, master_uri: str, ports: tuple[int, int]) -> Node:
    """Create the node, and all endpoints that wait for it; returns once it is registered.

    A library's node that was there before goes on with its endpoints; new ones are of the new node.

    Args:
        name: global name.
        master_uri: URI of the master.
        ports: ports of the slave API and of TCPROS; 0: any.
    """
    global loop, node
    if loop is None:
        loop = GraphLoop(messages=cast("Messages", ByteMessages()))
        loop.start()
    clock = WallClock()
    with _lock:
        started = Node(
            name,
            loop=loop,
            master_uri=master_uri,
            deliver=_workers.run_soon,
            rosout=False,
            ports=ports,
            log=_Log(name, lambda: clock),
        )
        started.on_shutdown(_shutdown_requested)
        node = started
        starters, _starters[:] = _starters[:], []
        for starter in starters:
            starter(started)
    wait_registered()
    return started


def when_started(starter: Callable[[Node], object]) -> None:
    """Call a function with the node: now, or once it is created."""
    with _lock:
        if node is None:
            _starters.append(starter)
            return
        starter(node)
    wait_registered()


def forget_starter(starter: Callable[[Node], object]) -> None:
    """Do not call the function."""
    with _lock:
        if starter in _starters:
            _starters.remove(starter)


def wait_registered() -> None:
    """Wait until all endpoints of the node are registered, or shutdown."""
    assert node is not None
    run(node.wait_registered)


def run(coroutine: Callable[[], Coroutine[Any, Any, _T]]) -> _T | None:
    """Run a coroutine on the loop until it ends, or shutdown (None)."""
    assert loop is not None
    if core.is_shutdown():
        return None
    try:
        return loop.run(coroutine())
    except CancelledError:  # cancelled by the shutdown
        return None


def stop(reason: str) -> None:
    """Leave the graph, in a thread: a signal may have interrupted a thread that holds a lock."""
    del reason
    if loop is not None:
        stopping = threading.Thread(target=loop.stop, daemon=True)
        stopping.start()
        stopping.join(_STOP_S)


def _shutdown_requested(reason: str) -> None:
    print(f"shutdown request: {reason}")
    text = f"external shutdown request: {reason}"
    threading.Thread(target=core.signal_shutdown, args=(text,), daemon=True).start()


def byte_messages() -> ByteMessages:
    """Message store of the node.

    Raises:
        ROSException: there is no node yet.
    """
    if loop is None:
        raise ROSException("ROS node has not been initialized yet. Please call init_node() first")
    return cast(ByteMessages, loop.messages)
