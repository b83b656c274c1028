"""Playback of a recording: its time, speed and pause, controlled from the page."""

import numpy as np
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.spatial import NS_PER_S

from .requests.request import PageAction, Pause, Play, Reset, Seek, SetSpeed, Step
from .world.streams import ClockState, TimelineSpan

_MAX_SPEED = 100.0
"""Playback speed for "as fast as possible"."""


class Playback:
    """Time of a recording that is played in a loop."""

    def __init__(self, times_ns: NDArray[np.int64], *, speed: float, paused: bool) -> None:
        """Start at the first sample.

        Args:
            times_ns: ascending times of the samples, at least one [ns].
            speed: recorded seconds per second of wall time.
            paused: start paused.
        """
        self._times_ns = times_ns
        self._speed: float | None = speed
        self._paused = paused
        self.time_ns = int(times_ns[0])

    @property
    def paused(self) -> bool:
        """True while it is paused."""
        return self._paused

    @property
    def sample(self) -> int:
        """Index of the newest sample."""
        return max(0, int(np.searchsorted(self._times_ns, self.time_ns, side="right")) - 1)

    @property
    def state(self) -> ClockState:
        """Clock's state for the page."""
        return ClockState(
            time_ns=self.time_ns,
            paused=self._paused,
            real_time_factor=None if self._paused else self._factor,
            speed=self._speed,
            timeline=TimelineSpan(int(self._times_ns[0]), int(self._times_ns[-1])),
        )

    def advance(self, wall_s: float) -> None:
        """Play for a duration of wall time [s]; after the end, playback restarts."""
        if self._paused:
            return
        span_ns = int(self._times_ns[-1] - self._times_ns[0])
        self.time_ns += round(min(wall_s * self._factor * NS_PER_S, span_ns + 1))
        if self.time_ns > self._times_ns[-1]:
            self.time_ns = int(self._times_ns[0])

    def handle(self, action: PageAction) -> None:
        """Execute a request.

        Raises:
            UsageError: a recording does not support it.
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
                raise UsageError("a recording does not support this request")

    @property
    def _factor(self) -> float:
        return _MAX_SPEED if self._speed is None else self._speed
