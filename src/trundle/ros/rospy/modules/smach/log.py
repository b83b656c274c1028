"""Log functions; smach_ros replaces them by rospy's."""

TYPE_CHECKING = False  # not from `typing`, whose import takes longer than this package's
if TYPE_CHECKING:
    from collections.abc import Callable

    _Log = Callable[[object], object]


def _printer(level: str) -> "_Log":
    def log(message: object) -> None:
        print(f"[{level:^7}] : {message}")

    return log


_functions = {
    "info": _printer("INFO"),
    "warn": _printer("WARN"),
    "debug": _printer("DEBUG"),
    "error": _printer("ERROR"),
}


def set_loggers(info: "_Log", warn: "_Log", debug: "_Log", error: "_Log") -> None:
    """Replace the functions."""
    _functions.update(info=info, warn=warn, debug=debug, error=error)


def loginfo(msg: object) -> None:
    """Log at level info."""
    _functions["info"](msg)


def logwarn(msg: object) -> None:
    """Log a warning."""
    _functions["warn"](msg)


def logdebug(msg: object) -> None:
    """Log for debugging."""
    _functions["debug"](msg)


def logerr(msg: object) -> None:
    """Log an error."""
    _functions["error"](msg)
