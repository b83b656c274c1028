"""Log functions: at each level, plain, throttled, throttled unless the text changes, and once."""

import logging
import sys
from collections.abc import Callable
from typing import Any

import genpy
from rosgraph import roslogging as roslogging

from . import rostime

_last_times: dict[tuple[str, int], Any] = {}
_last_texts: dict[tuple[str, int], str] = {}
_logged_once: set[tuple[str, int]] = set()


def _calling_line() -> tuple[str, int]:
    """File and line of the log call."""
    frame = sys._getframe(3)
    return frame.f_code.co_filename, frame.f_lineno


def _is_due(line: tuple[str, int], period: Any) -> bool:
    """True if the period [s] has passed since the last message from that line."""
    now: Any = rostime.get_rostime()
    last = _last_times.get(line)
    if last is not None and last > now:  # simulated time jumped back
        _last_times.clear()
    elif last is not None and now - last <= genpy.Duration(period):
        return False
    _last_times[line] = now
    return True


def _is_new(line: tuple[str, int], text: Any) -> bool:
    """True if the last message from that line differed."""
    if _last_texts.get(line) == text:
        return False
    _last_texts[line] = text
    return True


def _write(level: int, msg: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> None:
    name = kwargs.pop("logger_name", None)
    logger = logging.getLogger("rosout")
    (logger.getChild(name) if name else logger).log(level, msg, *args, **kwargs)


def _plain(level: int) -> Callable[..., None]:
    def log(msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log a message, with `%` formatting of the arguments; `logger_name` names a logger below rosout."""
        _write(level, msg, args, kwargs)

    return log


def _throttled(level: int) -> Callable[..., None]:
    def log(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log a message, at most once per period [s] from this line."""
        if _is_due_here(period):
            _write(level, msg, args, kwargs)

    return log


def _is_due_here(period: float) -> bool:
    return _is_due(_calling_line(), period)


def _identical(level: int) -> Callable[..., None]:
    def log(period: float, msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log a message, at most once per period [s] from this line unless its text changes."""
        if _is_new_or_due_here(period, msg):
            _write(level, msg, args, kwargs)

    return log


def _is_new_or_due_here(period: float, msg: Any) -> bool:
    line = _calling_line()
    is_due = _is_due(line, period)
    return _is_new(line, msg) or is_due


def _once(level: int) -> Callable[..., None]:
    def log(msg: Any, *args: Any, **kwargs: Any) -> None:
        """Log a message the first time this line runs."""
        if _is_first_here():
            _write(level, msg, args, kwargs)

    return log


def _is_first_here() -> bool:
    line = _calling_line()
    if line in _logged_once:
        return False
    _logged_once.add(line)
    return True


logdebug, loginfo, logwarn, logerr, logfatal = map(
    _plain, (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR, logging.CRITICAL)
)
logdebug_throttle, loginfo_throttle, logwarn_throttle, logerr_throttle, logfatal_throttle = map(
    _throttled, (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR, logging.CRITICAL)
)
(
    logdebug_throttle_identical,
    loginfo_throttle_identical,
    logwarn_throttle_identical,
    logerr_throttle_identical,
    logfatal_throttle_identical,
) = map(_identical, (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR, logging.CRITICAL))
logdebug_once, loginfo_once, logwarn_once, logerr_once, logfatal_once = map(
    _once, (logging.DEBUG, logging.INFO, logging.WARNING, logging.ERROR, logging.CRITICAL)
)
logout = loginfo
logerror = logerr

_internal = logging.getLogger("rospy.internal")
rospydebug, rospyinfo, rospywarn, rospyerr = _internal.debug, _internal.info, _internal.warning, _internal.error
