"""`trundle topic hz`, `bw` and `delay`: statistics of received messages, once a second."""

import argparse
import math
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import Clock, MessageView, RawMessage, WallClock, follow_time, to_nsec

from ..expression import Expression, expression
from ..graph_command import global_name, master, running_node
from ..wait_for_topic import wait_for_topic

_MAX_WINDOW = 50_000
"""Default window of averages [messages]; rostopic's number."""


def main(args: argparse.Namespace) -> int:
    """Measure until Ctrl-C."""
    is_rate, is_delay = args.command == "hz", args.command == "delay"
    with running_node("rostopic", args.words) as (loop, node):
        clock = loop.run(follow_time(node)) if is_delay or (is_rate and not args.wall_time) else WallClock()
        meters: dict[str, TopicHz | TopicBandwidth | TopicDelay] = {}
        for name in args.topics:
            field = wait_for_topic(master("rostopic"), global_name(name, "rostopic"), loop.messages)
            if is_rate:
                meter: TopicHz | TopicBandwidth | TopicDelay = TopicHz(clock, args.window)
                wanted = expression(args.filter)
                callback = meter.add_message if wanted is None else _filtered(meter.add_message, wanted, field.topic)
                kind = "*" if wanted is None else field.type
                if wanted is not None:  # warm up: a slow first read would cause a burst
                    loop.messages.deserialize(loop.messages.serialize(loop.messages.new(kind)), kind)
                node.subscribe(field.topic, kind, callback, queue_size=None, tcp_nodelay=args.tcpnodelay)
            elif is_delay:
                if "header" not in loop.messages.fields(field.type):
                    raise UsageError(f"{field.type} has no header, so its messages have no stamp")
                meter = TopicDelay(clock, args.window)
                node.subscribe(field.topic, field.type, meter.add_message, queue_size=None, tcp_nodelay=args.tcpnodelay)
            else:
                meter = TopicBandwidth(args.window)
                node.subscribe(field.topic, "*", meter.add_message, queue_size=None)
            meters[name] = meter
            print(f"subscribed to [{field.topic}]", flush=True)
        if not isinstance(clock, WallClock):
            print("WARNING: may be using simulated time", file=sys.stderr, flush=True)
        while True:
            try:
                time.sleep(1.0)
            finally:  # on Ctrl-C, report the last second, too
                text = report(meters)
                if text:
                    print(text, flush=True)


class TopicHz:
    """Intervals between messages of a topic."""

    def __init__(self, clock: Clock, window: int) -> None:
        self._clock = clock
        self._last = -1.0
        self._times: deque[float] = deque(maxlen=(window if window > 1 else _MAX_WINDOW) - 1)
        self._is_new = False
        self._lock = threading.Lock()

    def add_message(self, _: object) -> None:
        """Record an arrival."""
        now = self._clock.now_ns() / 1e9
        with self._lock:
            if now == 0.0:
                if self._times:
                    print("time has reset, resetting counters")
                self._times.clear()
                self._last = -1.0
                return
            if self._last < 0 or now < self._last:
                self._times.clear()
            else:
                self._times.append(now - self._last)
                self._is_new = True
            self._last = now

    def statistics(self) -> tuple[float, float, float, float, int] | None:
        """Rate [Hz], shortest and longest interval, standard deviation [s], window size; None without new messages."""
        with self._lock:
            if not self._times or not self._is_new:
                return None
            self._is_new = False
            count = len(self._times)
            mean = sum(self._times) / count
            deviation = math.sqrt(sum((t - mean) ** 2 for t in self._times) / count)
            return 1 / mean if mean > 0 else 0.0, min(self._times), max(self._times), deviation, count + 1


class TopicDelay:
    """Delays between header stamp and arrival of a topic's messages."""

    def __init__(self, clock: Clock, window: int) -> None:
        self._clock = clock
        self._last = -1.0
        self._delays: deque[float] = deque(maxlen=(window if window > 1 else _MAX_WINDOW) - 1)
        self._is_new = False
        self._lock = threading.Lock()

    def add_message(self, message: Any) -> None:
        """Record a message's delay; the first message only starts the measurement."""
        now = self._clock.now_ns() / 1e9
        with self._lock:
            if now == 0.0:
                if self._delays:
                    print("time has reset, resetting counters")
                self._delays.clear()
                return
            if self._last < 0 or self._last > now:
                self._delays.clear()
            else:
                self._delays.append(now - to_nsec(message.header.stamp) / 1e9)
                self._is_new = True
            self._last = now

    def text(self) -> str | None:
        """Statistics in rostopic's format; None before the first delay."""
        with self._lock:
            if not self._delays:
                return None
            if not self._is_new:
                return "no new messages"
            self._is_new = False
            count = len(self._delays)
            mean = sum(self._delays) / count
            deviation = math.sqrt(sum((d - mean) ** 2 for d in self._delays) / count)
            return (
                f"average delay: {mean:.3f}\n\tmin: {min(self._delays):.3f}s max: {max(self._delays):.3f}s "
                f"std dev: {deviation:.5f}s window: {count + 1}"
            )


class TopicBandwidth:
    """Sizes of a topic's messages."""

    def __init__(self, window: int) -> None:
        self._taken: deque[tuple[float, int]] = deque(maxlen=max(window, 2))
        self._lock = threading.Lock()

    def add_message(self, message: RawMessage) -> None:
        """Record a message's size."""
        with self._lock:
            self._taken.append((time.monotonic(), len(message.data)))

    def text(self) -> str | None:
        """Bytes per second and message sizes in rostopic's format; None before the second message."""
        with self._lock:
            if len(self._taken) < 2:
                return None
            sizes = [size for _, size in self._taken]
            rate = sum(sizes) / (time.monotonic() - self._taken[0][0])
        unit, factor = ("B", 1) if rate < 1e3 else ("KB", 1e3) if rate < 1e6 else ("MB", 1e6)
        total, mean, least, most = (
            f"{v / factor:.2f}{unit}" for v in (rate, sum(sizes) / len(sizes), min(sizes), max(sizes))
        )
        return f"average: {total}/s\n\tmean: {mean} min: {least} max: {most} window: {len(sizes)}"


def report(meters: "dict[str, TopicHz | TopicBandwidth | TopicDelay]") -> str | None:
    """Report of the last second."""
    rows: list[list[str]] = []
    for name, meter in meters.items():
        if not isinstance(meter, TopicHz):
            return meter.text()
        numbers = meter.statistics()
        if numbers is None:
            continue
        rate, least, most, deviation, window = numbers
        if len(meters) == 1:
            return (
                f"average rate: {rate:.3f}\n"
                f"\tmin: {least:.3f}s max: {most:.3f}s std dev: {deviation:.5f}s window: {window}"
            )
        rows.append([name, *(f"{v:.4}" for v in (rate, least, most, deviation)), str(window)])
    return _table(["topic", "rate", "min_delta", "max_delta", "std_dev", "window"], rows) if rows else "no new messages"


def _table(header: list[str], rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    lines = [
        "   ".join(title.center(width) for title, width in zip(header, widths, strict=True)),
        "=" * (sum(widths) + 3 * (len(widths) - 1)),
        *("   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows),
    ]
    return "\n".join(lines) + "\n"


def _filtered(take: Callable[[Any], None], wanted: Expression, topic: str) -> Callable[[Any], None]:
    def filtered(message: Any) -> None:
        if wanted.value(m=MessageView(message), topic=topic):
            take(message)

    return filtered
