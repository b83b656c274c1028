"""Log output of nodes: stderr in rospy's format, and /rosout."""

import contextlib
import inspect
import os
import sys
import threading
from typing import Literal, TextIO

Level = Literal["debug", "info", "warn", "error", "fatal"]
LEVELS: dict[str, int] = {"debug": 1, "info": 2, "warn": 4, "error": 8, "fatal": 16}
"""Level numbers of rosgraph_msgs/Log."""

_COLORS = {"debug": "\033[32m", "warn": "\033[33m", "error": "\033[31m", "fatal": "\033[31m"}
_WIDTHS = {"info": "[INFO]", "debug": "[DEBUG]", "warn": "[WARN]", "error": "[ERROR]", "fatal": "[FATAL]"}
_lock = threading.Lock()


def print_log(level: Level, text: str, *, wall_ns: int, sim_ns: int | None, quiet: TextIO | None = None) -> None:
    """Write a line like rospy's `[INFO] [wall time, simulated time]: text`; levels up to info go to `quiet`, if
    given.
    """
    stamp = f"{wall_ns / 1e9:.6f}" if sim_ns is None else f"{wall_ns / 1e9:.6f}, {sim_ns / 1e9:.6f}"
    line = f"{_WIDTHS[level]} [{stamp}]: {text}"
    stream = sys.stderr if quiet is None or LEVELS[level] > LEVELS["info"] else quiet
    # The reader may have closed the stream; logging never raises.
    with _lock, contextlib.suppress(OSError, ValueError):
        print(colored(line, level, stream), file=stream, flush=True)


def colored(line: str, level: str, stream: TextIO) -> str:
    """Color a line by its level if the stream is a terminal, unless NO_COLOR (https://no-color.org) is set."""
    color = _COLORS.get(level)
    return f"{color}{line}\033[0m" if color and stream.isatty() and not os.environ.get("NO_COLOR") else line


def caller(depth: int) -> tuple[str, str, int]:
    """Return file, function and line `depth` frames above this function's caller, for rosgraph_msgs/Log."""
    frame = inspect.currentframe()
    for _ in range(depth + 1):
        frame = frame.f_back if frame is not None else None
    if frame is None:
        return "", "", 0
    return frame.f_code.co_filename.rpartition("/")[2], frame.f_code.co_qualname, frame.f_lineno
