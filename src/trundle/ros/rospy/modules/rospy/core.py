"""State of this process's node: initialization, shutdown, log functions."""

import atexit
import logging
import os
import signal
import threading
import traceback
import warnings
from collections.abc import Callable, Mapping
from types import FrameType
from typing import Any

from .exceptions import ROSException
from .impl.validators import Check, ParameterInvalid
from .log import (
    logdebug,
    logdebug_once,
    logdebug_throttle,
    logdebug_throttle_identical,
    logerr,
    logerr_once,
    logerr_throttle,
    logerr_throttle_identical,
    logerror,
    logfatal,
    logfatal_once,
    logfatal_throttle,
    logfatal_throttle_identical,
    loginfo,
    loginfo_once,
    loginfo_throttle,
    loginfo_throttle_identical,
    logout,
    logwarn,
    logwarn_once,
    logwarn_throttle,
    logwarn_throttle_identical,
    roslogging,
    rospydebug,
    rospyerr,
    rospyinfo,
    rospywarn,
)  # fmt: skip
from .names import get_caller_id, get_mappings, get_name, get_namespace, remap_name, resolve_name, valid_name

__all__ = [
    "ParameterInvalid", "add_client_shutdown_hook", "add_preshutdown_hook", "add_shutdown_hook",
    "configure_logging", "get_caller_id", "get_name", "get_namespace", "get_node_uri", "get_ros_root",
    "is_initialized", "is_shutdown", "is_shutdown_requested", "is_topic", "logdebug", "logdebug_once",
    "logdebug_throttle", "logdebug_throttle_identical", "logerr", "logerr_once", "logerr_throttle",
    "logerr_throttle_identical", "logerror", "logfatal", "logfatal_once", "logfatal_throttle",
    "logfatal_throttle_identical", "loginfo", "loginfo_once", "loginfo_throttle", "loginfo_throttle_identical",
    "logout", "logwarn", "logwarn_once", "logwarn_throttle", "logwarn_throttle_identical", "parse_rosrpc_uri",
    "register_signals", "remap_name", "resolve_name", "rospydebug", "rospyerr", "rospyinfo", "rospywarn",
    "set_initialized", "set_node_uri", "signal_shutdown", "xmlrpcapi",
]  # fmt: skip

ROSRPC = "rosrpc://"
MASTER_NAME = "master"
_JOIN_S = 5.0
_logger = logging.getLogger("rospy.core")
logging.getLogger("rospy").addHandler(logging.NullHandler())

_Hook = Callable[..., object]
_uri: str | None = None
_log_filename: str | None = None
_client_ready = False
_shutdown_flag = False
_in_shutdown = False
_shutdown_lock = threading.RLock()
_client_shutdown_hooks: list[_Hook] = []
_preshutdown_hooks: list[_Hook] = []
_shutdown_hooks: list[_Hook] = []
_shutdown_threads: list[threading.Thread] = []
_signal_chain: dict[int, Any] = {}


def parse_rosrpc_uri(uri: str) -> tuple[str, int]:
    """Host and port of a service's URI.

    Raises:
        ParameterInvalid: not such a URI.
    """
    if not uri.startswith(ROSRPC):
        raise ParameterInvalid(f"Invalid protocol for ROS service URL: {uri}")
    host, colon, port = uri.removeprefix(ROSRPC).partition("/")[0].rpartition(":")
    if not colon or not port.isdecimal():
        raise ParameterInvalid(f"ROS service URL is invalid: {uri}")
    return host, int(port)


def get_ros_root(required: bool = False, env: Mapping[str, str] | None = None) -> str | None:
    """ROS_ROOT.

    Raises:
        ROSException: it is required and not set.
    """
    warnings.warn("Call to deprecated function get_ros_root.", DeprecationWarning, stacklevel=2)
    root = (os.environ if env is None else env).get("ROS_ROOT")
    if required and not root:
        raise ROSException("ROS_ROOT is not set")
    return root


def get_node_uri() -> str | None:
    """URI of this node's slave API."""
    return _uri


def set_node_uri(uri: str | None) -> None:
    """Set this node's URI; see `get_node_uri`."""
    global _uri
    _uri = uri


def configure_logging(node_name: str, level: int = logging.INFO) -> None:
    """Log to the node's file, which `__log:=` overrides."""
    global _log_filename
    log_file = get_mappings().get("__log")
    name = os.path.abspath(log_file) if log_file else f"{node_name.replace('/', '_').removeprefix('_')}.log"
    _log_filename = roslogging.configure_logging("rospy", level, filename=name)


def is_initialized() -> bool:
    """True after `init_node`."""
    return _client_ready


def set_initialized(initialized: bool) -> None:
    """Set whether the node is initialized."""
    global _client_ready
    _client_ready = initialized


def is_shutdown() -> bool:
    """True once the node has shut down."""
    return _shutdown_flag


def is_shutdown_requested() -> bool:
    """True once shutdown has begun, while `on_shutdown` functions still run."""
    return _in_shutdown


def add_client_shutdown_hook(h: _Hook) -> None:
    """Register a function to be called before shutdown."""
    _add_hook(h, _client_shutdown_hooks)


def add_preshutdown_hook(h: _Hook) -> None:
    """Register a function to be called with the reason, just before shutdown."""
    _add_hook(h, _preshutdown_hooks, "already shutdown")


def add_shutdown_hook(h: _Hook) -> None:
    """Register a function to be called with the reason, during shutdown."""
    _add_hook(h, _shutdown_hooks, "already shutdown")


def _add_hook(hook: _Hook, hooks: list[_Hook], *reason: str) -> None:
    if not callable(hook):
        raise TypeError(f"shutdown hook [{hook}] must be a function or callable object: {type(hook)}")
    if _shutdown_flag:
        _logger.warning("add_shutdown_hook called after shutdown")
        hook(*reason)
        return
    with _shutdown_lock:
        hooks.append(hook)


def _add_shutdown_thread(thread: threading.Thread) -> None:  # pyright: ignore[reportUnusedFunction]
    """Register a thread to be joined at shutdown."""
    if not _shutdown_flag:
        with _shutdown_lock:
            _shutdown_threads[:] = [*(started for started in _shutdown_threads if started.is_alive()), thread]


def signal_shutdown(reason: str) -> None:
    """Shut the node down: call all hooks, then leave the graph."""
    global _shutdown_flag, _in_shutdown
    if _shutdown_flag or _in_shutdown:
        return
    with _shutdown_lock:
        if _shutdown_flag or _in_shutdown:
            return
        _in_shutdown = True
        _logger.info("signal_shutdown [%s]", reason)
        _run(_client_shutdown_hooks)
        _run(_preshutdown_hooks, reason)
        _shutdown_flag = True
        _wake_sleepers()
        _run(_shutdown_hooks, reason)
        threads, _shutdown_threads[:] = _shutdown_threads[:], []
    for thread in threads:
        if thread.is_alive() and thread is not threading.current_thread():
            thread.join(_JOIN_S)


def _run(hooks: list[_Hook], *arguments: str) -> None:
    for hook in hooks[:]:
        try:
            hook(*arguments)
        except BaseException:
            traceback.print_exc()
    hooks.clear()


def _wake_sleepers() -> None:
    from .rostime import get_rostime_cond

    changed = get_rostime_cond()
    if changed.acquire(blocking=False):  # a signal may have interrupted the thread that holds the lock
        changed.notify_all()
        changed.release()


def _ros_signal(sig: int, stackframe: FrameType | None) -> None:
    signal_shutdown(f"signal-{sig}")
    before = _signal_chain.get(sig)
    if callable(before):
        try:
            before(sig, stackframe)
        except KeyboardInterrupt:
            pass


def register_signals() -> None:
    """Shut down on SIGINT and SIGTERM; to be called from the main thread."""
    for number in (signal.SIGTERM, signal.SIGINT):
        _signal_chain[number] = signal.signal(number, _ros_signal)


def _ros_atexit() -> None:
    signal_shutdown("atexit")


atexit.register(_ros_atexit)


def is_topic(param_name: str) -> Check:
    """Check that a parameter is a topic's name, and resolve it."""
    resolved = valid_name(param_name)

    def check(value: Any, caller_id: str) -> str:
        name = resolved(value, caller_id)
        if value == "/":
            raise ParameterInvalid(f"ERROR: parameter [{param_name}] cannot be the global namespace")
        return name

    return check


def xmlrpcapi(uri: str | None, cache: bool = True) -> Any:
    """Client of a node's or the master's API; None for an invalid URI."""
    del cache
    from rosgraph.server_proxy import ServerProxy

    return ServerProxy(uri) if uri and "://" in uri and uri.partition("://")[2] else None
