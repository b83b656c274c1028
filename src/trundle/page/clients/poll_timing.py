"""Times at which the owner's mailboxes are polled: soon after each write, as every poll wakes a sleeping process."""

_PERIOD_S = 0.033
"""Period at which the owner writes, unless a stride of the simulation lasts longer."""
_MIN_PERIOD_S, _MAX_PERIOD_S = 0.025, 0.06
_EARLY_S = 0.001
"""Time that a poll comes before the next expected write, so that polls approach the time of the write."""
_RETRY_S = 0.005
_MAX_RETRIES = 3
"""Consecutive short waits after which the owner is taken to be idle."""
_SMOOTHING = 0.1
"""Weight of the newest interval in the period's moving average."""


class PollTiming:
    """Estimates the owner's period from the polls that returned new data."""

    def __init__(self) -> None:
        self._period_s = _PERIOD_S
        self._last_new_s = 0.0
        self._retries = 0

    def wait_s(self, polled_s: float, *, is_new: bool) -> float:
        """Return the time from a poll's start to the next poll [s].

        Args:
            polled_s: monotonic time at which the poll started [s].
            is_new: True if the poll returned new data.
        """
        if not is_new:
            self._retries = min(self._retries + 1, _MAX_RETRIES)
            return _RETRY_S if self._retries < _MAX_RETRIES else _PERIOD_S
        interval_s = min(max(polled_s - self._last_new_s, _MIN_PERIOD_S), _MAX_PERIOD_S)
        if self._last_new_s:
            self._period_s += _SMOOTHING * (interval_s - self._period_s)
        self._last_new_s = polled_s
        self._retries = 0
        return self._period_s - _EARLY_S
