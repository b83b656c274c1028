"""ROS 1's Python client."""

from std_msgs.msg import Header

from .client import (
    DEBUG,
    ERROR,
    FATAL,
    INFO,
    WARN,
    delete_param,
    get_master,
    get_param,
    get_param_cached,
    get_param_names,
    get_published_topics,
    has_param,
    init_node,
    myargv,
    on_shutdown,
    search_param,
    set_param,
    spin,
    wait_for_message,
)  # fmt: skip
from .core import (
    get_node_uri,
    get_ros_root,
    is_shutdown,
    logdebug,
    logdebug_once,
    logdebug_throttle,
    logdebug_throttle_identical,
    logerr,
    logerr_once,
    logerr_throttle,
    logerr_throttle_identical,
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
    parse_rosrpc_uri,
    signal_shutdown,
)  # fmt: skip
from .exceptions import (
    ROSException,
    ROSInitException,
    ROSInternalException,
    ROSInterruptException,
    ROSSerializationException,
    ROSTimeMovedBackwardsException,
    TransportException,
    TransportInitError,
    TransportTerminated,
)  # fmt: skip
from .impl.tcpros_service import Service, ServiceProxy, wait_for_service
from .msg import AnyMsg
from .msproxy import MasterProxy
from .names import get_caller_id, get_name, get_namespace, remap_name, resolve_name
from .rostime import Duration, Time, get_rostime, get_time
from .service import ServiceException
from .timer import Rate, Timer, sleep
from .topics import Message, Publisher, SubscribeListener, Subscriber

__all__ = [
    "DEBUG", "ERROR", "FATAL", "INFO", "WARN", "AnyMsg", "Duration", "Header", "MasterProxy", "Message", "Publisher",
    "ROSException", "ROSInitException", "ROSInternalException", "ROSInterruptException", "ROSSerializationException",
    "ROSTimeMovedBackwardsException", "Rate", "Service", "ServiceException", "ServiceProxy", "SubscribeListener",
    "Subscriber", "Time", "Timer", "TransportException", "TransportInitError", "TransportTerminated", "delete_param",
    "get_caller_id", "get_master", "get_name", "get_namespace", "get_node_uri", "get_param", "get_param_cached",
    "get_param_names", "get_published_topics", "get_ros_root", "get_rostime", "get_time", "has_param", "init_node",
    "is_shutdown", "logdebug", "logdebug_once", "logdebug_throttle", "logdebug_throttle_identical", "logerr",
    "logerr_once", "logerr_throttle", "logerr_throttle_identical", "logfatal", "logfatal_once", "logfatal_throttle",
    "logfatal_throttle_identical", "loginfo", "loginfo_once", "loginfo_throttle", "loginfo_throttle_identical",
    "logout", "logwarn", "logwarn_once", "logwarn_throttle", "logwarn_throttle_identical", "myargv", "on_shutdown",
    "parse_rosrpc_uri", "remap_name", "resolve_name", "search_param", "set_param", "signal_shutdown", "sleep", "spin",
    "wait_for_message", "wait_for_service",
]  # fmt: skip
