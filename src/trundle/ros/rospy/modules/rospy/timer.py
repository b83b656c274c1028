"""Sleeping, rates and timers in ROS time."""

import threading
import time
from collections.abc import Callable
from typing import Any

import genpy

from . import core, rostime
from .exceptions import ROSInterruptException, ROSTimeMovedBackwardsException

_TICK_S = 0.5
_FIRST_TICK_S = 0.3


class Rate:
    """Sleeps so that a loop runs at a rate."""

    def __init__(self, hz: float, reset: bool = False) -> None:
        """Create; `reset`: start again when simulated time jumps back, instead of raising."""
        self.last_time: Any = rostime.get_rostime()
        self.sleep_dur = rostime.Duration(0, int(1e9 / hz))
        self._reset = reset

    def _remaining(self, curr_time: Any) -> Any:
        if self.last_time > curr_time:
            self.last_time = curr_time
        return self.sleep_dur - (curr_time - self.last_time)

    def remaining(self) -> Any:
        """Time left until the next cycle."""
        return self._remaining(rostime.get_rostime())

    def sleep(self) -> None:
        """Sleep until the next cycle.

        Raises:
            ROSInterruptException: shutdown while sleeping in simulated time.
            ROSTimeMovedBackwardsException: simulated time jumped back.
        """
        now = rostime.get_rostime()
        try:
            sleep(self._remaining(now))
        except ROSTimeMovedBackwardsException:
            if not self._reset:
                raise
            self.last_time = rostime.get_rostime()
            return
        self.last_time = self.last_time + self.sleep_dur
        if now - self.last_time > self.sleep_dur * 2:  # time jumped forward, or the loop is too slow
            self.last_time = now


def sleep(duration: Any) -> None:
    """Sleep in ROS time; not at all for a negative duration.

    Raises:
        ROSInterruptException: shutdown while sleeping in simulated time.
        ROSTimeMovedBackwardsException: simulated time jumped back.
    """
    if rostime.is_wallclock():
        seconds = duration.to_sec() if isinstance(duration, genpy.Duration) else duration
        if seconds < 0:
            return
        rostime.wallsleep(seconds)
        return
    if not isinstance(duration, genpy.Duration):
        duration = genpy.Duration.from_sec(duration)
    changed = rostime.get_rostime_cond()
    begin: Any = rostime.get_rostime()
    while begin == genpy.Time(0) and not core.is_shutdown():
        with changed:
            changed.wait(_FIRST_TICK_S)
        begin = rostime.get_rostime()
    end = begin + duration
    while begin <= rostime.get_rostime() < end and not core.is_shutdown():
        with changed:
            if begin <= rostime.get_rostime() < end:
                changed.wait(_TICK_S)
    now = rostime.get_rostime()
    if now < begin:
        raise ROSTimeMovedBackwardsException((begin - now).to_sec())
    if core.is_shutdown():
        raise ROSInterruptException("ROS shutdown request")


class TimerEvent:
    """Expected and real times of a timer's last and current call."""

    def __init__(
        self, last_expected: Any, last_real: Any, current_expected: Any, current_real: Any, last_duration: float | None
    ) -> None:
        self.last_expected = last_expected
        self.last_real = last_real
        self.current_expected = current_expected
        self.current_real = current_real
        self.last_duration = last_duration
        """Wall time [s] that the last call took."""


class Timer(threading.Thread):
    """Calls a function periodically, in a thread of its own."""

    def __init__(
        self, period: Any, callback: Callable[[TimerEvent], object], oneshot: bool = False, reset: bool = False
    ) -> None:
        """Start.

        Args:
            period: a Duration.
            callback: takes a TimerEvent.
            oneshot: call once.
            reset: go on when simulated time jumps back.
        """
        super().__init__(daemon=True)
        self._period = period
        self._callback = callback
        self._oneshot = oneshot
        self._reset = reset
        self._shutdown = False
        self.start()

    def shutdown(self) -> None:
        """Stop."""
        self._shutdown = True

    def run(self) -> None:
        """Call until shutdown."""
        rate = Rate(1.0 / self._period.to_sec(), reset=self._reset)
        expected = rostime.get_rostime() + self._period
        last_expected = last_real = last_duration = None
        while not core.is_shutdown() and not self._shutdown:
            try:
                rate.sleep()
            except ROSInterruptException:
                if core.is_shutdown():
                    break
                raise
            if self._shutdown:
                break
            now = rostime.get_rostime()
            begin = time.time()
            self._callback(TimerEvent(last_expected, last_real, expected, now, last_duration))
            if self._oneshot:
                break
            last_duration = time.time() - begin
            last_expected, last_real = expected, now
            expected += self._period
