"""Simulated time from /clock, where /use_sim_time is set."""

from typing import Any

from .. import core, rostime

_clock_sub: Any = None


def init_simtime() -> bool:
    """Subscribe to /clock if /use_sim_time is true."""
    global _clock_sub
    import rosgraph

    code, _, value = core.xmlrpcapi(rosgraph.get_master_uri()).getParam(core.get_caller_id(), "/use_sim_time")
    if code == 1 and value and _clock_sub is None:
        from rosgraph_msgs.msg import Clock

        from ..topics import Subscriber

        rostime._set_rostime(rostime.Time(0, 0))
        _clock_sub = Subscriber("/clock", Clock, _set_time, queue_size=1)
    rostime.set_rostime_initialized(True)
    return True


def _set_time(message: Any) -> None:
    rostime._set_rostime(message.clock)
