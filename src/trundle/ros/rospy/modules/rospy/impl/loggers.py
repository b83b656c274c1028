"""Services that show and set the levels of Python's loggers."""

import logging
from typing import Any

from ..service import Service

_NAMES = {
    logging.DEBUG: "DEBUG", logging.INFO: "INFO", logging.WARNING: "WARN", logging.ERROR: "ERROR",
    logging.CRITICAL: "FATAL",
}  # fmt: skip
_LEVELS = {name: level for level, name in _NAMES.items()}


def advertise() -> None:
    """Advertise `~get_loggers` and `~set_logger_level`."""
    from roscpp.srv import GetLoggers, SetLoggerLevel

    Service("~get_loggers", GetLoggers, _get_loggers)
    Service("~set_logger_level", SetLoggerLevel, _set_logger_level)


def _get_loggers(request: Any) -> Any:
    del request
    from roscpp.msg import Logger

    known = list(logging.Logger.manager.loggerDict)
    levels = [(name, _NAMES.get(logging.getLogger(name).getEffectiveLevel(), "INFO")) for name in known]
    return [[Logger(name, level) for name, level in levels]]


def _set_logger_level(request: Any) -> Any:
    level = _LEVELS.get(request.level.upper())
    if level is None:
        logging.getLogger("rospy").error("Bad logging level: %s", request.level)
    else:
        logging.getLogger(request.logger).setLevel(level)
    return []
