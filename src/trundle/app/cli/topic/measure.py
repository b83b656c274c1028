"""`trundle topic hz`, `bw` and `delay`: statistics of received messages, once a second."""

import argparse
import sys
import time
from collections.abc import Callable
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import BandwidthMeter, DelayMeter, MessageView, RateMeter, WallClock, follow_time

from ..expression import Expression, expression
from ..graph_command import global_name, master, running_node
from ..wait_for_topic import wait_for_topic

_Meter = RateMeter | DelayMeter | BandwidthMeter


def main(args: argparse.Namespace) -> int:
    """Measure until Ctrl-C."""
    is_rate, is_delay = args.command == "hz", args.command == "delay"
    with running_node("rostopic", args.words) as (loop, node):
        clock = loop.run(follow_time(node)) if is_delay or (is_rate and not args.wall_time) else WallClock()
        meters: dict[str, _Meter] = {}
        for name in args.topics:
            field = wait_for_topic(master("rostopic"), global_name(name, "rostopic"), loop.messages)
            if is_rate:
                meter: _Meter = RateMeter(clock, args.window)
                condition = expression(args.filter)
                callback = (
                    meter.add_message if condition is None else _filtered(meter.add_message, condition, field.topic)
                )
                kind = "*" if condition is None else field.type
                if condition is not None:  # a first read, which is slow and would cause a burst later
                    loop.messages.deserialize(loop.messages.serialize(loop.messages.new(kind)), kind)
                node.subscribe(field.topic, kind, callback, queue_size=None, tcp_nodelay=args.tcpnodelay)
            elif is_delay:
                if "header" not in loop.messages.fields(field.type):
                    raise UsageError(f"{field.type} has no header, so its messages have no stamp")
                meter = DelayMeter(clock, args.window)
                node.subscribe(field.topic, field.type, meter.add_message, queue_size=None, tcp_nodelay=args.tcpnodelay)
            else:
                meter = BandwidthMeter(args.window)
                node.subscribe(field.topic, "*", lambda m, add=meter.add_bytes: add(len(m.data)), queue_size=None)
            meters[name] = meter
            print(f"subscribed to [{field.topic}]", flush=True)
        if not isinstance(clock, WallClock):
            print("WARNING: may be using simulated time", file=sys.stderr, flush=True)
        while True:
            try:
                time.sleep(1.0)
            finally:  # on Ctrl-C, the last second is reported, too
                text = report(meters)
                if text:
                    print(text, flush=True)


def report(meters: dict[str, _Meter]) -> str | None:
    """Return the report of the last second."""
    if len(meters) == 1:
        [meter] = meters.values()
        return meter.text()
    rows = [
        [
            name,
            *(f"{v:.4}" for v in (statistics.rate_hz, statistics.min, statistics.max, statistics.deviation)),
            str(statistics.window),
        ]
        for name, meter in meters.items()
        if isinstance(meter, RateMeter) and (statistics := meter.statistics()) is not None
    ]
    return _table(["topic", "rate", "min_delta", "max_delta", "std_dev", "window"], rows) if rows else "no new messages"


def _table(header: list[str], rows: list[list[str]]) -> str:
    widths = [max(map(len, column)) for column in zip(header, *rows, strict=True)]
    lines = [
        "   ".join(title.center(width) for title, width in zip(header, widths, strict=True)),
        "=" * (sum(widths) + 3 * (len(widths) - 1)),
        *("   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)) for row in rows),
    ]
    return "\n".join(lines) + "\n"


def _filtered(callback: Callable[[Any], None], condition: Expression, topic: str) -> Callable[[Any], None]:
    def filtered(message: Any) -> None:
        if condition.value(m=MessageView(message), topic=topic):
            callback(message)

    return filtered
