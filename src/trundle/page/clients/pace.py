"""Pace of sending to one client, so that few data are in transit: in the kernel, the network and the client.

What waits there can neither be replaced by something newer nor overtaken. So marks are sent between the messages, and
the client echoes each: our page once it has handled what came before, any other client as RFC 6455 has it answer a
ping. Delays beyond the shortest mean that data wait; the smallest of a while tells a queue from a client that handles
messages now and then, as CoDel does (RFC 8289).
"""

import heapq
import math
from collections import deque
from typing import NamedTuple

_FIRST_BYTES = 24 * 1024
"""Bytes sent before the first echo."""
_PATIENCE_S = 5.0
"""Time after which a client without an echo is assumed never to echo; it is not paced."""
_MIN_RATE, _FIRST_RATE = 8e3, 64e3
"""Lowest rate, and rate assumed at first."""
_TARGET_S = 0.05
"""Queueing delay in transit above which the pace is reduced."""
_MIN_HOLD_S, _MAX_HOLD_S = 0.1, 0.8
"""Bounds of the time without an echo after which sending stops."""
_MARK_S, _LIMITED_MARK_S = 0.1, 0.02
"""Period of marks; the shorter one for many data, and while data wait for the pace."""
_BURST_S = 0.02
_MIN_BURST = 2048
_FIRST_GROWTH, _SLOW_GROWTH, _MAX_GROWTH = 2.0, 1.02, 1.2
"""Growth of the pace: until the first reduction, after a reduction, and later."""
_GROWTH_S = 0.25
_FIRST_JUMP, _JUMP = 2.5, 1.3
"""Limit of the pace as a multiple of the highest rate at which data have arrived, before the first reduction and later.
"""
_MIN_PAUSE_S = 0.05
"""Shortest pause between echoes that is remembered."""
_MIN_SAMPLE = 16 * 1024
"""Number of bytes whose arrival suffices to measure a rate."""
_TOGETHER_S = 0.01
"""Time within which echoes count as one: a busy client sends many at once."""
_MEMORY_S = 5.0
"""Time after which the shortest delay and pauses are forgotten."""


class _Mark(NamedTuple):
    number: int
    sent_s: float
    total: int
    """All bytes sent before it."""
    arrived: int
    """Bytes known to have arrived when it was sent."""
    arrived_s: float
    """Time at which their arrival was known; with no other data in transit, the time of the mark."""


class _Echo(NamedTuple):
    time_s: float
    delay_s: float
    total: int


class _Extreme:
    """Largest value of the last seconds."""

    def __init__(self) -> None:
        self._older = self._newer = -math.inf
        self._turn_s = 0.0

    def add(self, value: float, now_s: float) -> None:
        if now_s >= self._turn_s:
            self._older, self._newer = self._newer, -math.inf
            self._turn_s = now_s + _MEMORY_S
        self._newer = max(self._newer, value)

    @property
    def value(self) -> float:
        """Largest value; minus infinity before the first."""
        return max(self._older, self._newer)


class Pace:
    """Decides when bytes may be sent. All times are monotonic [s]."""

    def __init__(self) -> None:
        self.rate = _FIRST_RATE
        """Bytes per second."""
        self._budget = float(_FIRST_BYTES)
        """Bytes that may be sent now; negative after a long message."""
        self._budget_s = 0.0
        self._total = self._marked = 0
        self._number = 0
        self._marked_s = -math.inf
        self._marks: deque[_Mark] = deque()
        """Marks without an echo."""
        self._echoes: deque[_Echo] = deque()
        """Echoes of the last window, since the last reduction."""
        self._last = self._averaged = _Echo(0.0, 0.0, 0)
        """Newest echo, and the one from which the average rate of arrival is taken."""
        self._shortest, self._proven = _Extreme(), _Extreme()
        """Negative shortest delay, and highest rate at which data have arrived."""
        self._pauses: deque[tuple[float, float]] = deque()
        """Times of long pauses between echoes, and their lengths."""
        self._reduced_s = self._grown_s = -math.inf
        self._growth, self._max_growth, self._max_jump = _FIRST_GROWTH, _FIRST_GROWTH, _FIRST_JUMP
        self._is_limited = False
        self._echoes_nothing = False

    @property
    def is_known(self) -> bool:
        """True after the first echo."""
        return self._last.time_s > 0.0

    @property
    def awaits_echo(self) -> bool:
        """True if a mark has no echo yet."""
        return bool(self._marks)

    @property
    def sent(self) -> int:
        """Number of bytes sent so far."""
        return self._total

    @property
    def arrived(self) -> int:
        """Number of bytes known to have arrived."""
        return self._last.total

    def transfer_s(self, size: int) -> float:
        """Return the time in which that many bytes arrive [s], by what has arrived in the last seconds."""
        if self._echoes_nothing:
            return 0.0
        return size / min(self.rate, self._proven_rate)

    def wait_s(self, now_s: float) -> float:
        """Return the time until data may be sent [s]; infinite: until an echo. Call only if data wait."""
        if self._echoes_nothing:
            return 0.0
        if not self.is_known:
            self._echoes_nothing = bool(self._marks) and now_s - self._marks[0].sent_s > _PATIENCE_S
            return 0.0 if self._budget > 0 or self._echoes_nothing else math.inf
        wait_s = 0.0 if self.budget(now_s) > 0 else max(-self._budget / self.rate, 1e-3)
        if self._marks and now_s - self._marks[0].sent_s > self._base_s + self._hold_s:
            wait_s = math.inf
        self._is_limited |= wait_s > 0.0
        return wait_s

    def budget(self, now_s: float) -> float:
        """Return the number of bytes that may be sent now."""
        if self._echoes_nothing:
            return math.inf
        if self.is_known:
            burst = max(self.rate * _BURST_S, _MIN_BURST)
            self._budget = min(burst, self._budget + self.rate * (now_s - self._budget_s))
            self._budget_s = now_s
        return self._budget

    def add(self, size: int) -> None:
        """Count bytes that are sent."""
        self._budget -= size
        self._total += size

    def mark(self, now_s: float, *, is_limited: bool) -> int | None:
        """Return the number of a mark to send after the bytes counted so far, if one is due.

        Args:
            now_s: time.
            is_limited: True if more data wait.
        """
        if self._total == self._marked or self._echoes_nothing:
            return None
        is_busy = is_limited or not self.is_known or self._total - self._marked > _MIN_SAMPLE
        period_s = _LIMITED_MARK_S if is_busy else _MARK_S
        if self._marks and now_s - self._marked_s < period_s:
            return None
        return self.mark_now(now_s)

    def mark_now(self, now_s: float) -> int:
        """Return the number of a mark to send."""
        self._number += 1
        self._marked, self._marked_s = self._total, now_s
        arrived_s = self._last.time_s if self._marks else now_s
        self._marks.append(_Mark(self._number, now_s, self._total, self._last.total, arrived_s))
        return self._number

    def echo(self, number: int, now_s: float) -> None:
        """Receive the echo of a mark, and so of all before it; unknown ones are ignored."""
        if not self._marks or not self._marks[0].number <= number <= self._number:
            return
        first = mark = self._marks.popleft()
        while self._marks and self._marks[0].number <= number:
            mark = self._marks.popleft()
        echo = _Echo(now_s, now_s - mark.sent_s, mark.total)
        if self.is_known:
            self._add_pause(now_s - max(self._last.time_s, first.sent_s), now_s)
        else:
            self._budget_s = now_s
            self._proven.add(_FIRST_RATE, now_s)
        self._shortest.add(-echo.delay_s, now_s)
        self._raise(echo, mark)
        self._last = echo
        self._echoes_nothing = False
        if echo.total == self._total:
            self._budget = max(self._budget, 0.0)  # all has arrived
        if mark.sent_s >= self._reduced_s:
            self._adjust(echo)

    def _add_pause(self, pause_s: float, now_s: float) -> None:
        while self._pauses and self._pauses[0][0] < now_s - _MEMORY_S:
            self._pauses.popleft()
        if pause_s > _MIN_PAUSE_S:
            self._pauses.append((now_s, pause_s))

    def _raise(self, echo: _Echo, mark: _Mark) -> None:
        """Raise the rate to the measured rate of arrival since the last echo before the mark was sent."""
        span_s, size = echo.time_s - mark.arrived_s, echo.total - mark.arrived
        if size >= _MIN_SAMPLE:
            rate = size / max(span_s, 1e-4)
            self._proven.add(rate, echo.time_s)
            self.rate = max(self.rate, rate)
        average_s = echo.time_s - self._averaged.time_s
        if average_s >= self._window_s:
            self._proven.add((echo.total - self._averaged.total) / average_s, echo.time_s)
            self._averaged = echo

    def _adjust(self, echo: _Echo) -> None:
        """Reduce the rate if data wait in transit; raise it if data wait only here."""
        now_s = echo.time_s
        if self._echoes and now_s - self._echoes[-1].time_s < _TOGETHER_S:
            self._echoes[-1] = echo._replace(delay_s=min(echo.delay_s, self._echoes[-1].delay_s))
        else:
            self._echoes.append(echo)
        while len(self._echoes) > 2 and self._echoes[1].time_s <= now_s - self._window_s:
            self._echoes.popleft()
        first = self._echoes[0]
        wait_s = min(e.delay_s for e in self._echoes) - self._base_s
        span_s = now_s - first.time_s
        if wait_s > _TARGET_S and span_s >= self._window_s:
            arrived = (echo.total - first.total) / span_s
            self.rate = max(min(self.rate, 0.95 * arrived), _MIN_RATE)
            self._budget = float(echo.total - self._total)  # stop until these data have arrived
            self._budget_s = self._reduced_s = now_s
            self._echoes.clear()
            self._growth, self._max_growth, self._max_jump = _SLOW_GROWTH, _MAX_GROWTH, _JUMP
            self._is_limited = False
            self._proven = _Extreme()
            self._proven.add(self.rate, now_s)
        elif (
            self._is_limited
            and self._echoes[-1].delay_s - self._base_s < _TARGET_S / 2
            and now_s >= self._grown_s + min(_GROWTH_S, 2 * echo.delay_s + 0.01)
        ):
            self._grown_s, self._is_limited = now_s, False
            self.rate = max(self.rate, min(self._growth * self.rate, self._max_jump * self._proven_rate))
            self._growth = min(self._growth**2, self._max_growth)

    @property
    def _proven_rate(self) -> float:
        """Highest rate at which data have arrived in the last seconds; few data make it too low."""
        return max(self._proven.value, min(self.rate, _FIRST_RATE))

    @property
    def _base_s(self) -> float:
        """Shortest delay of the last seconds."""
        return -self._shortest.value

    @property
    def _pause_s(self) -> float:
        """Longest pause between echoes, without a single outlier."""
        longest = heapq.nlargest(2, (pause_s for _, pause_s in self._pauses))
        return longest[1] if len(longest) == 2 else 0.0

    @property
    def _window_s(self) -> float:
        """Time within which a client that handles messages now and then echoes at least one promptly."""
        return min(max(1.2 * self._pause_s, 0.1), _MAX_HOLD_S)

    @property
    def _hold_s(self) -> float:
        return min(max(1.5 * self._pause_s, _MIN_HOLD_S), _MAX_HOLD_S)
