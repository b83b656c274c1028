"""Times at which the owner's mailboxes are polled: soon after it wrote, as each poll wakes a sleeping process."""

_PERIOD_S = 0.033
"""The owner's own; it writes later where a stride of the simulation lasts longer."""
_MIN_PERIOD_S, _MAX_PERIOD_S = 0.025, 0.06
_EARLY_S = 0.001
"""Before the owner's period is over, so that polls move towards the moment when it writes."""
_RETRY_S = 0.005
_MAX_RETRIES = 3
"""Short waits in a row; an owner from which nothing came by then has nothing to say."""
_SHARE = 0.1
"""Weight of a newer interval in the period."""


class PollTiming:
    """Learns the owner's period from the polls that brought something."""

    def __init__(self) -> None:
        self._period_s = _PERIOD_S
        self._came_s = 0.0
        self._retries = 0

    def wait_s(self, polled_s: float, *, is_new: bool) -> float:
        """Return the wait from a poll's beginning to the next one [s].

        Args:
            polled_s: monotonic time at which the poll began [s].
            is_new: True if it brought something.
        """
        if not is_new:
            self._retries = min(self._retries + 1, _MAX_RETRIES)
            return _RETRY_S if self._retries < _MAX_RETRIES else _PERIOD_S
        interval_s = min(max(polled_s - self._came_s, _MIN_PERIOD_S), _MAX_PERIOD_S)
        if self._came_s:
            self._period_s += _SHARE * (interval_s - self._period_s)
        self._came_s = polled_s
        self._retries = 0
        return self._period_s - _EARLY_S
