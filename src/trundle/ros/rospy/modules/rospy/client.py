"""Functions of programs: init_node, spin, parameters, waiting for messages."""

import logging
import os
import sys
import time
import warnings
from collections.abc import Callable, Sequence
from typing import Any

import genpy
import rosgraph.names

from . import core, graph, names, rostime, subscription
from .exceptions import ROSException, ROSInitException, ROSInterruptException
from .msproxy import MasterProxy

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16
"""Levels of rosgraph_msgs/Log."""
_POLL_S = 0.1
_MESSAGE_POLL_S = 0.01
_init_node_args: tuple[Any, ...] | None = None
_master_proxy: MasterProxy | None = None
_unspecified: Any = object()


def myargv(argv: Sequence[str] | None = None) -> list[str]:
    """Arguments without remappings."""
    arguments = sys.argv if argv is None else argv
    return [argument for argument in arguments if not rosgraph.names.is_legal_remap(argument)]


def load_command_line_node_params(argv: Sequence[str]) -> dict[str, Any]:
    """Private parameters of a command line: `_name:=value`, with the value as YAML.

    Raises:
        ROSInitException: a value is not YAML.
    """
    params: dict[str, Any] = {}
    for argument in argv:
        if not (argument.startswith("_") and argument[1:2] != "_" and rosgraph.names.is_legal_remap(argument)):
            continue
        name, _, value = (part.strip() for part in argument.partition(":="))
        if len(name) > 1 and value:
            import yaml

            try:
                params[name[1:]] = yaml.safe_load(value)
            except yaml.YAMLError as error:
                raise ROSInitException(f"invalid command-line parameters: {error}") from None
    return params


def on_shutdown(h: Callable[[], object]) -> None:
    """Register a function to be called before the node shuts down."""
    core.add_client_shutdown_hook(h)


def spin() -> None:
    """Wait until the node shuts down.

    Raises:
        ROSInitException: before `init_node`.
    """
    if not core.is_initialized():
        raise ROSInitException("client code must call rospy.init_node() first")
    core.logdebug("node[%s, %s] entering spin(), pid[%s]", core.get_caller_id(), core.get_node_uri(), os.getpid())
    try:
        while not core.is_shutdown():
            rostime.wallsleep(_POLL_S)
    except KeyboardInterrupt:
        core.logdebug("keyboard interrupt, shutting down")
        core.signal_shutdown("keyboard interrupt")


def init_node(
    name: str,
    argv: Sequence[str] | None = None,
    anonymous: bool = False,
    log_level: int | None = None,
    disable_rostime: bool = False,
    disable_rosout: bool = False,
    disable_signals: bool = False,
    xmlrpc_port: int = 0,
    tcpros_port: int = 0,
) -> None:
    """Start this process's node; returns once it is registered.

    Args:
        name: base name, which `__name:=` overrides.
        argv: command line with remappings; sys.argv by default.
        anonymous: append process ID and time to the name.
        log_level: level from which messages are shown and published, such as rospy.DEBUG.
        disable_rostime: do not use simulated time.
        disable_rosout: do not publish log messages on /rosout.
        disable_signals: leave SIGINT and SIGTERM alone; needed outside of the main thread.
        xmlrpc_port: port of the slave API; 0: any.
        tcpros_port: port of topics and services; 0: any.

    Raises:
        ROSInitException: interrupted, or the time cannot be initialized.
        ROSException: the node was already initialized with other arguments.
        ValueError: an invalid name.
    """
    global _init_node_args
    if argv is None:
        argv = sys.argv
    else:
        names.reload_mappings(argv)
    if not name:
        raise ValueError("name must not be empty")
    if rosgraph.names.SEP in name:
        raise ValueError("namespaces are not allowed in node names")
    node_args = (name, argv, anonymous, log_level, disable_rostime, disable_signals)
    if _init_node_args:
        if _init_node_args != node_args:
            raise ROSException(f"rospy.init_node() has already been called with different arguments: {_init_node_args}")
        return
    disable_signals = disable_signals or _is_interactive()
    _init_node_args = node_args
    if not disable_signals:
        core.register_signals()
    if not disable_rosout:
        _set_level(log_level)
    mappings = names.get_mappings()
    if "__name" in mappings:
        name, anonymous = mappings["__name"], False
    if anonymous:
        name = f"{name}_{os.getpid()}_{int(time.time() * 1000)}"
    if not rosgraph.names.is_legal_base_name(name):
        text = f"'{name}' is not a legal ROS base name. This may cause problems with other ROS tools."
        warnings.warn(text, stacklevel=2)
    full_name = rosgraph.names.resolve_name(name, core.get_caller_id())
    core.configure_logging(full_name)
    names.initialize_mappings(full_name)
    names._set_caller_id(full_name)
    _start(full_name, argv, (xmlrpc_port, tcpros_port))
    if not disable_rosout:
        from .impl import rosout

        rosout.init_rosout()
        rosout.load_rosout_handlers(log_level)
    _refuse_shutdown()
    if not disable_rostime:
        from .impl import simtime

        simtime.init_simtime()
    rostime.set_rostime_initialized(True)
    from .impl import loggers

    loggers.advertise()
    graph.wait_registered()
    _refuse_shutdown()
    core.logdebug("init_node, name[%s], pid[%s]", full_name, os.getpid())


def init_library_node(name: str, argv: Sequence[str] | None = None) -> None:
    """Start a node for a library, as MoveIt's C++ is one beside rospy's; the program's own `init_node` starts another.

    Args:
        name: base name, to which process ID and time are appended.
        argv: command line with remappings; sys.argv by default.
    """
    global _init_node_args
    arguments = sys.argv if argv is None else argv
    unnamed = [argument for argument in arguments if not argument.startswith("__name:=")]
    init_node(name, argv=unnamed, anonymous=True, disable_signals=True)
    names.reload_mappings(sys.argv)
    _init_node_args = None


def _start(name: str, argv: Sequence[str], ports: tuple[int, int]) -> None:
    """Start the node, and set its private parameters."""
    subscription.open_statistics = _open_statistics
    node = graph.start(name, rosgraph.get_master_uri() or "", ports)
    core.set_node_uri(node.uri)
    core.add_shutdown_hook(graph.stop)
    _refuse_shutdown()
    for param, value in load_command_line_node_params(argv).items():
        set_param(f"~{param}", value)
    core.set_initialized(True)


def _open_statistics(topic: str) -> subscription.Statistics | None:
    """Statistics of a topic; None unless /enable_statistics is true."""
    if not get_param("/enable_statistics", False):
        return None
    from .impl.statistics import SubscriberStatisticsLogger

    return SubscriberStatisticsLogger(topic, get_param)


def _refuse_shutdown() -> None:
    if core.is_shutdown():
        raise ROSInitException("init_node interrupted before it could complete")


def _is_interactive() -> bool:
    roslib: Any = sys.modules.get("roslib")
    return roslib is not None and roslib.is_interactive()


_LEVELS = {
    DEBUG: logging.DEBUG, INFO: logging.INFO, WARN: logging.WARNING, ERROR: logging.ERROR, FATAL: logging.CRITICAL,
}  # fmt: skip


def _set_level(level: int | None) -> None:
    if level is not None and level not in _LEVELS:
        raise KeyError(level)


def get_master(env: Any = None) -> MasterProxy:
    """Client of the master, which is also a dictionary of parameters."""
    del env
    global _master_proxy
    if _master_proxy is None:
        _master_proxy = MasterProxy(rosgraph.get_master_uri())
    return _master_proxy


def get_published_topics(namespace: str = "/") -> list[list[str]]:
    """Pairs (topic, type) of published topics.

    Raises:
        ROSException: the master refuses.
    """
    code, text, value = get_master().getPublishedTopics(namespace)
    if code != 1:
        raise ROSException(f"unable to get published topics: {text}")
    return value


def wait_for_message(topic: str, topic_type: Any, timeout: Any = None) -> Any:
    """Wait for one message of a topic.

    Args:
        topic: resolved and remapped.
        topic_type: class of the message.
        timeout: seconds or Duration, in wall time; None: no limit.

    Raises:
        ROSException: timeout.
        ROSInterruptException: shutdown.
    """
    from .topics import Subscriber

    if isinstance(timeout, genpy.Duration):
        timeout = timeout.to_sec()
    end = None if timeout is None else time.time() + timeout
    received: list[Any] = []
    subscriber = Subscriber(topic, topic_type, received.append)
    try:
        while not core.is_shutdown() and not received:
            rostime.wallsleep(_MESSAGE_POLL_S)
            if end is not None and time.time() >= end and not received:
                raise ROSException(f"timeout exceeded while waiting for message on topic {topic}")
    finally:
        subscriber.unregister()
    if core.is_shutdown():
        raise ROSInterruptException("rospy shutdown")
    return received[0]


def get_param(param_name: str, default: Any = _unspecified) -> Any:
    """Value of a parameter, or a namespace as a dictionary.

    Raises:
        KeyError: it is not set, and there is no default.
    """
    try:
        return get_master()[param_name]
    except KeyError:
        if default is _unspecified:
            raise
        return default


def get_param_cached(param_name: str, default: Any = _unspecified) -> Any:
    """Value of a parameter; later calls return the latest value that the master has sent.

    Raises:
        KeyError: it is not set, and there is no default.
    """
    try:
        return get_master().get_param_cached(param_name)
    except KeyError:
        if default is _unspecified:
            raise
        return default


def get_param_names() -> list[str]:
    """Names of all parameters.

    Raises:
        ROSException: the master refuses.
    """
    code, text, value = get_master().getParamNames()
    if code != 1:
        raise ROSException(f"Unable to retrieve parameter names: {text}")
    return value


def set_param(param_name: str, param_value: Any) -> None:
    """Set a parameter, or a namespace from a dictionary."""
    if not rosgraph.names.is_legal_name(param_name):
        text = f"'{param_name}' is not a legal ROS graph resource name. This may cause problems with other ROS tools"
        warnings.warn(text, stacklevel=2)
    get_master()[param_name] = param_value


def search_param(param_name: str) -> str | None:
    """Full name of the nearest parameter upwards from this node; None if there is none."""
    return get_master().search_param(param_name)


def delete_param(param_name: str) -> None:
    """Delete a parameter or a namespace.

    Raises:
        KeyError: it is not set.
    """
    del get_master()[param_name]


def has_param(param_name: str) -> bool:
    """True if a parameter or a namespace is set."""
    return param_name in get_master()
