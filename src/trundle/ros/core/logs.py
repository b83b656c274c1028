"""roscore's log files: rosout.log with the messages of all nodes, master.log with registrations."""

import os
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from trundle.robots.names import resolve_name

from ..log import LEVELS
from ..log_file import LogFile
from ..master.parameters import ParameterTree
from ..xmlrpc.rpc_methods import Answer

if TYPE_CHECKING:
    from ..message_types import rosgraph_msgs

ROSOUT_BYTES, ROSOUT_BACKUPS = 100 * 1024 * 1024, 10
"""Limits of roscore's rosout node."""
PYTHON_LOG_BYTES, PYTHON_LOG_BACKUPS = 50_000_000, 4
"""Limits in ROS' python_logging.conf, for rosmaster and roslaunch."""
_OFF = ("", "0", "false", "off", "no")
_LEVEL_NAMES = {number: name.upper() for name, number in LEVELS.items()}
_BY_CALLER = {
    "setParam": ("+PARAM", 1),
    "deleteParam": ("-PARAM", 1),
    "subscribeParam": ("+CACHEDPARAM", 2),
    "unsubscribeParam": ("-CACHEDPARAM", 2),
}
"""Label in the log, and index of the key among the arguments."""
_WITH_ADDRESS = {
    "registerPublisher": "+PUB",
    "unregisterPublisher": "-PUB",
    "registerSubscriber": "+SUB",
    "unregisterSubscriber": "-SUB",
    "registerService": "+SERVICE",
    "unregisterService": "-SERVICE",
}


class CoreLogs:
    """Writes rosout.log and master.log of one run; never blocks."""

    def __init__(self, folder: Path, parameters: ParameterTree) -> None:
        self._parameters = parameters
        self._master = LogFile(folder / "master.log", max_bytes=PYTHON_LOG_BYTES, backups=PYTHON_LOG_BACKUPS)
        self._rosout: LogFile | None = None
        if os.environ.get("ROSOUT_DISABLE_FILE_LOGGING", "").lower() in _OFF:
            self._rosout = LogFile(folder / "rosout.log", max_bytes=ROSOUT_BYTES, backups=ROSOUT_BACKUPS)
            self._rosout.write(f"\n\n{time.time_ns() / 1e9:.9f}  Node Startup")

    def log_message(self, message: "rosgraph_msgs.Log") -> None:
        """Log a rosgraph_msgs/Log in the format of roscore's rosout node."""
        if self._rosout is not None:
            with_topics = not (
                self._parameters.has("/rosout/omit_topics") and self._parameters.get("/rosout/omit_topics")
            )
            self._rosout.write(rosout_line(message, with_topics=with_topics))

    def log_master(self, text: str) -> None:
        """Log a line of the master."""
        self._master.write(python_log_line("rosmaster.master", text))

    def log_call(self, method: str, arguments: Sequence[Any], answer: Answer) -> None:
        """Log a successful master call that changed the registry."""
        if answer[0] != 1:
            return
        if method in _WITH_ADDRESS:
            caller, name, *_, address = arguments
            self.log_master(f"{_WITH_ADDRESS[method]} [{resolve_name(name, caller)}] {caller} {address}")
        elif method in _BY_CALLER:
            caller = arguments[0]
            label, index = _BY_CALLER[method]
            self.log_master(f"{label} [{resolve_name(arguments[index], caller)}] by {caller}")

    def close(self) -> None:
        """Write queued lines and close."""
        self._master.close()
        if self._rosout is not None:
            self._rosout.close()


def rosout_line(message: "rosgraph_msgs.Log", *, with_topics: bool) -> str:
    """Format a rosgraph_msgs/Log: stamp, level, node, file:line(function), the node's topics if `with_topics`, text."""
    stamp = message.header.stamp
    topics = f"[topics: {', '.join(message.topics)}] " if with_topics else ""
    level = _LEVEL_NAMES.get(message.level, str(message.level))
    location = f"[{message.file}:{message.line}({message.function})]"
    return f"{stamp.sec}.{stamp.nanosec:09d} {level} {message.name} {location} {topics}{message.msg}"


def python_log_line(logger: str, text: str) -> str:
    """Format a line like Python's logging in rosmaster and roslaunch, stamped with local wall time."""
    now_ms = time.time_ns() // 1_000_000
    stamp = time.strftime("%Y-%m-%d %H:%M:%S", time.localtime(now_ms // 1000))
    return f"[{logger}][INFO] {stamp},{now_ms % 1000:03d}: {text}"
