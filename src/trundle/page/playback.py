"""Playback of a recording: its time, speed and pause, as a person at the page sets them."""

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.spatial import NS_PER_S

from .requests.request import PageAction, Pause, Play, Reset, Seek, SetSpeed, Step
from .world.streams import ClockState, TimelineSpan

_FASTEST = 100.0
"""Speed of a playback as fast as possible."""


class Playback:
    """Time of a recording, which is played in a loop."""

    def __init__(self, times_ns: NDArray[np.int64], *, speed: float, paused: bool) -> None:
        """Start at the beginning.

        Args:
            times_ns: of the samples, ascending, at least one [ns].
            speed: recorded seconds per second of wall time.
            paused: do not play yet.
        """
        self._times_ns = times_ns
        self._speed: float | None = speed
        self._paused = paused
        self.time_ns = int(times_ns[0])

    @property
    def sample(self) -> int:
        """Index of the newest sample."""
        return max(0, int(np.searchsorted(self._times_ns, self.time_ns, side="right")) - 1)

    @property
    def state(self) -> ClockState:
        """The clock for the page."""
        return ClockState(
            time_ns=self.time_ns,
            paused=self._paused,
            real_time_factor=None if self._paused else self._factor,
            speed=self._speed,
            timeline=TimelineSpan(int(self._times_ns[0]), int(self._times_ns[-1])),
        )

    def advance(self, wall_s: float) -> None:
        """Play for a duration of wall time [s]; from the end it goes on at the beginning."""
        if self._paused:
            return
        span_ns = int(self._times_ns[-1] - self._times_ns[0])
        self.time_ns += round(min(wall_s * self._factor * NS_PER_S, span_ns + 1))
        if self.time_ns > self._times_ns[-1]:
            self.time_ns = int(self._times_ns[0])

    def handle(self, action: PageAction) -> None:
        """Do what a person asks for.

        Raises:
            UsageError: a recording cannot do it.
        """
        match action:
            case Play():
                self._paused = False
            case Pause():
                self._paused = True
            case Reset():
                self.time_ns = int(self._times_ns[0])
            case Seek(time_ns):
                self.time_ns = min(max(time_ns, int(self._times_ns[0])), int(self._times_ns[-1]))
            case Step(count):
                self._paused = True
                self.time_ns = int(self._times_ns[min(self.sample + count, len(self._times_ns) - 1)])
            case SetSpeed(factor):
                self._speed = factor
            case _:
                raise UsageError("a recording cannot do that")

    @property
    def _factor(self) -> float:
        return _FASTEST if self._speed is None else self._speed
