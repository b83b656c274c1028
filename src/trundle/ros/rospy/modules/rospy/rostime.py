"""ROS time: wall time, or simulated time from /clock."""

import threading
import time
from typing import Any

import genpy

from .exceptions import ROSInitException


class Duration(genpy.Duration):
    """A length of time: seconds and nanoseconds."""

    __slots__: Any = []

    def __repr__(self) -> str:
        return f"rospy.Duration[{self.to_nsec()}]"


class Time(genpy.Time):
    """A point in time: seconds and nanoseconds."""

    __slots__: Any = []

    def __repr__(self) -> str:
        return f"rospy.Time[{self.to_nsec()}]"

    @staticmethod
    def now() -> "Time":
        """Current ROS time.

        Raises:
            ROSInitException: before `init_node`.
        """
        return get_rostime()

    @classmethod
    def from_seconds(cls, float_secs: float) -> "Time":
        """Create from seconds."""
        return cls.from_sec(float_secs)


_rostime_initialized = False
_rostime_current: Time | None = None
"""Simulated time; None for wall time."""
_rostime_cond = threading.Condition()


def _set_rostime(t: genpy.Time) -> None:  # pyright: ignore[reportUnusedFunction]
    """Set simulated time and wake waiting threads."""
    if not isinstance(t, genpy.Time):  # pyright: ignore[reportUnnecessaryIsInstance]
        raise ValueError(f"must be Time instance: {type(t)}")
    global _rostime_current
    _rostime_current = Time(t.secs, t.nsecs)
    with _rostime_cond:
        _rostime_cond.notify_all()


def get_rostime() -> Time:
    """Current ROS time.

    Raises:
        ROSInitException: before `init_node`.
    """
    if not _rostime_initialized:
        raise ROSInitException("time is not initialized. Have you called init_node()?")
    if _rostime_current is not None:
        return _rostime_current
    now = time.time()
    return Time(int(now), int((now - int(now)) * 1_000_000_000))


def get_time() -> float:
    """Current ROS time [s]."""
    return Time.now().to_sec()


def set_rostime_initialized(val: bool) -> None:
    """Allow programs to read the time."""
    global _rostime_initialized
    _rostime_initialized = val


def is_rostime_initialized() -> bool:
    """True once the time can be read."""
    return _rostime_initialized


def get_rostime_cond() -> threading.Condition:
    """Condition that each tick of simulated time notifies."""
    return _rostime_cond


def is_wallclock() -> bool:
    """True if ROS time is wall time."""
    return _rostime_current is None


def switch_to_wallclock() -> None:
    """Use wall time from now on."""
    global _rostime_current
    _rostime_current = None
    with _rostime_cond:
        _rostime_cond.notify_all()


def wallsleep(duration: float) -> None:
    """Sleep [s] in wall time."""
    time.sleep(duration)
