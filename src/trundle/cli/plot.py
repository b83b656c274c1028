"""Draw numbers of messages over time, as rqt_plot does."""

import argparse
import shutil
import sys
import time
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from trundle.diagnostics import UsageError
from trundle.ros import Clock, GraphLoop, Messages, Node, RawMessage, follow_time, open_bag

from .plot_picture import Curve, as_svg, as_text
from .running import global_name, master, original_errors, running_node
from .topic_field import Field, field_type, split_topic, value_at, wait_for_topic

EXAMPLES = """
  trundle plot /odom/twist/twist/linear/x              in the terminal, until Ctrl-C
  trundle plot /odom/pose/pose/position/x:y -o p.svg   as a picture, of ten seconds
  trundle plot /joint_states/position -b run.bag       from a bag, one curve for each joint
"""
_NUMBERS = ("int", "uint", "float", "bool", "byte", "char", "time", "duration")
_POINTS = 100_000
"""Kept for each curve; the oldest go."""
_SHOWN_S, _REDRAWN_S = 30.0, 0.2
"""The terminal shows this much, this often."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("fields", nargs="+", metavar="FIELD", help="such as /odom/pose/pose/position/x, or …/x:y:z")
    parser.add_argument("-o", "--output", metavar="FILE.svg", help="write a picture")
    parser.add_argument("-b", "--bag", metavar="BAG", help="what is in a bag")
    parser.add_argument("--duration", type=float, metavar="SEC", help="of ROS time; with -o 10, else until Ctrl-C")


@original_errors
def main(args: argparse.Namespace) -> int:
    """Gather, then draw; or both at once in the terminal."""
    target = Path(args.output) if args.output else None
    if target is not None and target.suffix != ".svg":
        raise UsageError(f"{target} does not end in .svg")
    names = [name for text in args.fields for name in _spread(text)]
    curves = _from_bag(names, Path(args.bag)) if args.bag else _from_graph(names, args.duration, draws=target is None)
    if not any(curve.points for curve in curves):
        raise UsageError(f"no messages with {', '.join(names)}")
    if target is None:
        print(_terminal(curves))
        return 0
    target.write_text(as_svg(curves), encoding="utf-8")
    return 0


def _spread(text: str) -> list[str]:
    """rqt_plot's short form: /a/x:y is /a/x and /a/y."""
    first, *others = text.split(":") if "[" not in text else [text]
    stem = first.rpartition("/")[0]
    return [first, *(f"{stem}/{other}" for other in others)]


@dataclass
class _Trace:
    """One field, and a curve for each number in it."""

    name: str
    where: Field
    curves: dict[str, "deque[tuple[float, float]]"] = field(default_factory=dict[str, "deque[tuple[float, float]]"])

    def check(self, messages: Messages) -> None:
        """Refuse what is not a number.

        Raises:
            UsageError: it is something else; names what it is.
        """
        kind = field_type(self.where.type, self.where.path, messages)
        base = kind.partition("[")[0]
        if not base.startswith(_NUMBERS) or base in messages.type_names():
            inner = messages.fields(base) if messages.has(base) else {}
            below = f"; fields here: {', '.join(inner)}" if inner else ""
            raise UsageError(f"{self.name} is a {kind}, not a number{below}")

    def take(self, message: Any, time_s: float) -> None:
        """Add a message's numbers; an array that is too short adds none."""
        try:
            value = value_at(message, self.where.steps)
        except IndexError:
            return
        if hasattr(value, "nanosec"):
            value = value.sec + value.nanosec / 1e9
        values = list(value) if hasattr(value, "__len__") else None
        for i, number in enumerate([value] if values is None else values):
            curve = self.name if values is None else f"{self.name}[{i}]"
            self.curves.setdefault(curve, deque(maxlen=_POINTS)).append((time_s, float(number)))


def _curves(traces: Sequence[_Trace]) -> list[Curve]:
    """What was gathered, from the first message on."""
    found = [(name, list(points)) for trace in traces for name, points in trace.curves.items()]
    start = min((points[0][0] for _, points in found), default=0.0)
    return [Curve(name, [(t - start, value) for t, value in points]) for name, points in found]


def _from_bag(names: Sequence[str], path: Path) -> list[Curve]:
    messages = Messages(bare=True)
    with open_bag(path) as bag:
        types = {connection.topic: connection.type for connection in bag.connections}
        traces: list[_Trace] = []
        for name in names:
            found = split_topic(global_name(name, "plot"), types)
            if found is None:
                raise UsageError(f"no topic of {name} in {path}; topics there: {', '.join(sorted(types))}")
            traces.append(_Trace(name, Field(topic=found[0], type=types[found[0]], path=found[1])))
        checked: set[str] = set()
        for message in bag.messages(lambda c: any(c.topic == trace.where.topic for trace in traces)):
            kind = message.connection.type
            messages.add_definition(kind, message.connection.definition)
            value = messages.deserialize(message.data, kind)
            for trace in traces:
                if trace.where.topic == message.connection.topic:
                    if trace.name not in checked:
                        trace.check(messages)
                        checked.add(trace.name)
                    trace.take(value, message.stamp_ns / 1e9)
    return _curves(traces)


def _from_graph(names: Sequence[str], duration_s: float | None, *, draws: bool) -> list[Curve]:
    with running_node("plot") as (loop, node):
        clock = loop.run(follow_time(node))
        traces = [_Trace(name, wait_for_topic(master("plot"), global_name(name, "plot"))) for name in names]
        for trace in traces:
            _follow(trace, node, clock, loop.messages)
        until_s = duration_s if duration_s is not None else None if draws else 10.0
        try:
            for curves in _gathering(loop, traces):
                end = max((curve.points[-1][0] for curve in curves), default=0.0)
                if until_s is not None and end >= until_s:
                    return curves
                if draws and curves and sys.stdout.isatty():
                    print(f"\033[2J\033[;H{_terminal(curves)}", flush=True)
        except KeyboardInterrupt:
            pass
        return loop.run(_snapshot(traces))


def _follow(trace: _Trace, node: Node, clock: Clock, messages: Messages) -> None:
    known = messages.has(trace.where.type)
    if known:
        trace.check(messages)

    def take(message: Any) -> None:
        if isinstance(message, RawMessage):
            messages.add_definition(message.type, message.definition)
            message = messages.deserialize(message.data, message.type)
        trace.take(message, clock.now_ns() / 1e9)

    node.subscribe(trace.where.topic, trace.where.type if known else "*", take, queue_size=None)


def _gathering(loop: GraphLoop, traces: Sequence[_Trace]) -> Iterator[list[Curve]]:
    """What there is, again and again."""
    while True:
        time.sleep(_REDRAWN_S)
        yield loop.run(_snapshot(traces))


async def _snapshot(traces: Sequence[_Trace]) -> list[Curve]:
    return _curves(traces)


def _terminal(curves: Sequence[Curve]) -> str:
    size = shutil.get_terminal_size((80, 24))
    end = max(curve.points[-1][0] for curve in curves)
    shown = [Curve(curve.name, [p for p in curve.points if p[0] >= end - _SHOWN_S]) for curve in curves]
    return as_text(shown, columns=size.columns, rows=size.lines - len(curves) - 3)
