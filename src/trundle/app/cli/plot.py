"""Draw numbers of messages over time, as rqt_plot does."""

import argparse
import shutil
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError
from trundle.base.drawing import Curve, curves_svg, curves_text
from trundle.ros import (
    GraphLoop,
    Messages,
    TopicField,
    TopicSeries,
    follow_time,
    open_bag,
    recent_curves,
    split_topic,
    spread_fields,
    subscribe_series,
)

from .graph_command import global_name, master, ros_errors, running_node
from .wait_for_topic import wait_for_topic

EXAMPLES = """
  trundle plot /odom/twist/twist/linear/x              in the terminal, until Ctrl-C
  trundle plot /odom/pose/pose/position/x:y -o p.svg   as an image, of ten seconds
  trundle plot /joint_states/position -b run.bag       from a bag, one curve for each joint
"""
_SPAN_S, _REDRAW_S = 30.0, 0.2
"""Time span in the terminal, and redraw interval [s]."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("fields", nargs="+", metavar="FIELD", help="such as /odom/pose/pose/position/x, or …/x:y:z")
    parser.add_argument("-o", "--output", metavar="FILE.svg", help="write an image")
    parser.add_argument("-b", "--bag", metavar="BAG", help="plot from a bag")
    parser.add_argument("--duration", type=float, metavar="SEC", help="of ROS time; with -o 10, else until Ctrl-C")


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Record, then draw; in the terminal, draw while recording."""
    target = Path(args.output) if args.output else None
    if target is not None and target.suffix != ".svg":
        raise UsageError(f"{target} does not end in .svg")
    names = [name for text in args.fields for name in spread_fields(text)]
    curves = _from_bag(names, Path(args.bag)) if args.bag else _from_graph(names, args.duration, draws=target is None)
    if not any(curve.points for curve in curves):
        raise UsageError(f"no messages with {', '.join(names)}")
    if target is None:
        print(_terminal(curves))
        return 0
    write_atomically(target, curves_svg(curves))
    return 0


def _from_bag(names: Sequence[str], path: Path) -> list[Curve]:
    messages = Messages(bare=True)
    with open_bag(path) as bag:
        types = {connection.topic: connection.type for connection in bag.connections}
        traces: list[TopicSeries] = []
        for name in names:
            field = split_topic(global_name(name, "plot"), types)
            if field is None:
                raise UsageError(f"no topic of {name} in {path}; topics there: {', '.join(sorted(types))}")
            traces.append(TopicSeries(name, TopicField(topic=field[0], type=types[field[0]], path=field[1])))
        checked_names: set[str] = set()
        for message in bag.messages(lambda c: any(c.topic == trace.source.topic for trace in traces)):
            kind = message.connection.type
            messages.add_definition(kind, message.connection.definition)
            value = messages.deserialize(message.data, kind)
            for trace in traces:
                if trace.source.topic == message.connection.topic:
                    if trace.name not in checked_names:
                        trace.check(messages)
                        checked_names.add(trace.name)
                    trace.add_message(value, message.stamp_ns / 1e9)
    return recent_curves(traces)


def _from_graph(names: Sequence[str], duration_s: float | None, *, draws: bool) -> list[Curve]:
    with running_node("plot") as (loop, node):
        clock = loop.run(follow_time(node))
        traces = [
            TopicSeries(name, wait_for_topic(master("plot"), global_name(name, "plot"), loop.messages))
            for name in names
        ]
        for trace in traces:
            subscribe_series(trace, node, clock)
        until_s = duration_s if duration_s is not None else None if draws else 10.0
        try:
            for curves in _subscribed_series(loop, traces):
                end = max((curve.points[-1][0] for curve in curves), default=0.0)
                if until_s is not None and end >= until_s:
                    return curves
                if draws and curves and sys.stdout.isatty():
                    print(f"\033[2J\033[;H{_terminal(curves)}", flush=True)
        except KeyboardInterrupt:
            pass
        return loop.run(_snapshot(traces))


def _subscribed_series(loop: GraphLoop, traces: Sequence[TopicSeries]) -> Iterator[list[Curve]]:
    """Yield the current curves, at the redraw interval."""
    while True:
        time.sleep(_REDRAW_S)
        yield loop.run(_snapshot(traces))


async def _snapshot(traces: Sequence[TopicSeries]) -> list[Curve]:
    return recent_curves(traces)


def _terminal(curves: Sequence[Curve]) -> str:
    size = shutil.get_terminal_size((80, 24))
    end = max(curve.points[-1][0] for curve in curves)
    recent = [Curve(curve.name, [p for p in curve.points if p[0] >= end - _SPAN_S]) for curve in curves]
    return curves_text(recent, columns=size.columns, rows=size.lines - len(curves) - 3)
