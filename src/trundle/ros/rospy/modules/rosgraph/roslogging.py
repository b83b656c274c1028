"""Python's logging, as rospy configures it: all records go to a file, those of `rosout` also to the terminal."""

import logging
import os
import sys
import threading
import time
from collections.abc import Mapping
from pathlib import Path
from types import FrameType
from typing import Any, TextIO

_FILE_BYTES, _FILES = 50_000_000, 4
_FILE_FORMAT = "[%(name)s][%(levelname)s] %(asctime)s: %(message)s"
_LEVELS = {
    "DEBUG": ("DEBUG", "\033[32m"),
    "INFO": ("INFO", None),
    "WARNING": ("WARN", "\033[33m"),
    "ERROR": ("ERROR", "\033[31m"),
    "CRITICAL": ("FATAL", "\033[31m"),
}
_DEFAULT_FORMAT = "[${severity}] [${time}]: ${message}"


class LoggingException(Exception):
    """Logging cannot be set up."""


class RospyLogger(logging.Logger):
    """Logger whose records name the program's function with its class, not rospy's function."""

    def findCaller(self, stack_info: bool = False, stacklevel: int = 1) -> tuple[str, int, str, str | None]:
        """File, line and function that called rospy's or logging's function."""
        del stack_info, stacklevel
        frame: FrameType | None = sys._getframe(1)
        while frame is not None and _is_of_logging(frame):
            frame = frame.f_back
        if frame is None:
            return "(unknown file)", 0, "(unknown function)", None
        owner = frame.f_locals.get("self")
        name = frame.f_code.co_name if owner is None else f"{type(owner).__name__}.{frame.f_code.co_name}"
        return frame.f_code.co_filename, frame.f_lineno, name, None


def _is_of_logging(frame: FrameType) -> bool:
    file = frame.f_code.co_filename
    return file == logging.__file__ or file.endswith(os.path.join("rospy", "log.py"))


logging.setLoggerClass(RospyLogger)


class _LazyFileHandler(logging.Handler):
    """Rotating file, opened with the first record: most nodes log nothing in their first milliseconds."""

    def __init__(self, path: str) -> None:
        super().__init__()
        self._path = path
        self._file: logging.Handler | None = None
        self._opening = threading.Lock()

    def emit(self, record: logging.LogRecord) -> None:
        with self._opening:
            if self._file is None:
                self._file = self._open()
        self._file.handle(record)

    def _open(self) -> logging.Handler:
        from logging.handlers import RotatingFileHandler

        try:
            Path(self._path).parent.mkdir(parents=True, exist_ok=True)
            opened: logging.Handler = RotatingFileHandler(self._path, "a", _FILE_BYTES, _FILES)
        except OSError as error:
            sys.stderr.write(f"WARNING: cannot log to {self._path}: {error.strerror}; set ROS_LOG_DIR\n")
            return logging.NullHandler()
        opened.setFormatter(logging.Formatter(_FILE_FORMAT))
        return opened


class RosStreamHandler(logging.Handler):
    """Lines on stdout (debug, info) and stderr, formatted by ROSCONSOLE_FORMAT."""

    def __init__(self, colorize: bool = True, stdout: TextIO | None = None, stderr: TextIO | None = None) -> None:
        super().__init__()
        self._stdout = stdout or sys.stdout
        self._stderr = stderr or sys.stderr
        self._colorize = colorize

    def emit(self, record: logging.LogRecord) -> None:
        """Write a record."""
        level, color = _LEVELS.get(record.levelname, (record.levelname, None))
        text = formatted(record, level)
        quiet = record.levelno < logging.WARNING
        stream = self._stdout if quiet else self._stderr
        if self._colorize and color and stream.isatty():
            text = f"{color}{text}\033[0m"
        stream.write(text + "\n")
        stream.flush()


def formatted(record: logging.LogRecord, level: str) -> str:
    """Text of a record, by ROSCONSOLE_FORMAT."""
    template = os.environ.get("ROSCONSOLE_FORMAT", _DEFAULT_FORMAT)
    values = {
        "severity": level,
        "message": _plain.format(record),
        "walltime": f"{time.time():f}",
        "thread": str(record.thread),
        "logger": record.name,
        "file": record.pathname,
        "line": str(record.lineno),
        "function": record.funcName or "",
        "node": _node_name(),
        "time": f"{time.time():f}{_sim_time()}",
    }
    parts = template.split("${")
    text = parts[0]
    for part in parts[1:]:
        name, end, rest = part.partition("}")
        kind, colon, style = name.partition(":")
        if colon and kind in ("walltime", "time"):
            value = time.strftime(style) + (_sim_time() if kind == "time" else "")
        else:
            value = values.get(name, f"${{{name}{end}")
        text += value + rest
    return text


_plain = logging.Formatter()


def _sim_time() -> str:
    """', ' and simulated time, if this node has one."""
    rostime: Any = sys.modules.get("rospy.rostime")
    return "" if rostime is None or rostime.is_wallclock() else f", {rostime.get_time():f}"


def _node_name() -> str:
    names: Any = sys.modules.get("rospy.names")
    return "<unknown_node_name>" if names is None else names.get_name()


def get_log_dir(env: Mapping[str, str] | None = None) -> str:
    """Folder of log files: ROS_LOG_DIR, else `log` in ROS_HOME or ~/.ros."""
    env = os.environ if env is None else env
    if env.get("ROS_LOG_DIR"):
        return env["ROS_LOG_DIR"]
    return os.path.join(env.get("ROS_HOME") or os.path.join(os.path.expanduser("~"), ".ros"), "log")


def configure_logging(
    logname: str, level: int = logging.INFO, filename: str | None = None, env: Mapping[str, str] | None = None
) -> str:
    """Log to a file of the log folder; returns its path."""
    name = filename or f"{logname or 'unknown'}-{os.getpid()}.log"
    path = os.path.join(get_log_dir(env), name)
    os.environ["ROS_LOG_FILENAME"] = path
    root, rosout = logging.getLogger(), logging.getLogger("rosout")
    for handler in [handler for handler in root.handlers if isinstance(handler, _LazyFileHandler)]:
        root.removeHandler(handler)
    root.setLevel(level)
    root.addHandler(_LazyFileHandler(path))
    if not any(isinstance(handler, RosStreamHandler) for handler in rosout.handlers):
        rosout.addHandler(RosStreamHandler())
    rosout.setLevel(logging.INFO)
    return path
