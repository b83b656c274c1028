"""Log functions, which smach_ros replaces with rospy's."""


def _printer(level):
    return lambda message: print(f"[{level:^7}] : {message}")


_functions = {
    "info": _printer("INFO"),
    "warn": _printer("WARN"),
    "debug": _printer("DEBUG"),
    "error": _printer("ERROR"),
}


def set_loggers(info, warn, debug, error):
    """Replace the functions."""
    _functions.update(info=info, warn=warn, debug=debug, error=error)


def loginfo(msg):
    """Log at level info."""
    _functions["info"](msg)


def logwarn(msg):
    """Log a warning."""
    _functions["warn"](msg)


def logdebug(msg):
    """Log for debugging."""
    _functions["debug"](msg)


def logerr(msg):
    """Log an error."""
    _functions["error"](msg)
