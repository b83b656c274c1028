"""Time series of numeric message fields."""

import math
from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.base.drawing import Curve

from ..messages.field_paths import TopicField, field_type, value_at
from ..messages.message_library import Messages
from ..messages.raw_message import RawMessage
from ..node.clock import Clock
from ..node.graph_node import Node

_NUMBERS = ("int", "uint", "float", "bool", "byte", "char", "time", "duration")
_POINTS = 100_000
"""Maximum points per curve; the oldest are dropped."""


def spread_fields(text: str) -> list[str]:
    """Expand rqt_plot's short form: /a/x:y stands for /a/x and /a/y."""
    first, *others = text.split(":") if "[" not in text else [text]
    stem = first.rpartition("/")[0]
    return [first, *(f"{stem}/{other}" for other in others)]


@dataclass
class TopicSeries:
    """A field, and a curve for each number in it."""

    name: str
    source: TopicField
    curves: dict[str, "deque[tuple[float, float]]"] = field(default_factory=dict[str, "deque[tuple[float, float]]"])

    def check(self, messages: Messages) -> None:
        """Check that the field is numeric.

        Raises:
            UsageError: the field is not numeric; the text names its type.
        """
        kind = field_type(self.source.type, self.source.path, messages)
        base = kind.partition("[")[0]
        if not base.startswith(_NUMBERS) or base in messages.type_names():
            inner = messages.fields(base) if messages.has(base) else {}
            hint = f"; fields here: {', '.join(inner)}" if inner else ""
            raise UsageError(f"{self.name} is a {kind}, not a number{hint}")

    def add_message(self, message: Any, time_s: float) -> None:
        """Append a message's numbers; none if an array is too short."""
        try:
            value = value_at(message, self.source.steps)
        except IndexError:
            return
        if hasattr(value, "nanosec"):
            value = value.sec + value.nanosec / 1e9
        values = list(value) if hasattr(value, "__len__") else None
        for i, number in enumerate([value] if values is None else values):
            curve = self.name if values is None else f"{self.name}[{i}]"
            self.curves.setdefault(curve, deque(maxlen=_POINTS)).append((time_s, float(number)))


def recent_curves(traces: Sequence[TopicSeries], *, last_s: float = math.inf) -> list[Curve]:
    """Curves of the last `last_s` seconds; time starts at the first message."""
    curves = [(name, list(points)) for trace in traces for name, points in trace.curves.items()]
    start = min((points[0][0] for _, points in curves), default=0.0)
    since = max((points[-1][0] for _, points in curves), default=0.0) - last_s
    return [Curve(name, [(t - start, value) for t, value in points if t >= since]) for name, points in curves]


def subscribe_series(trace: TopicSeries, node: Node, clock: Clock) -> None:
    """Subscribe and record the field's numbers; call on the loop.

    Raises:
        UsageError: the field is not numeric.
    """
    messages = node.messages
    is_known = messages.has(trace.source.type)
    if is_known:
        trace.check(messages)

    def on_message(message: Any) -> None:
        if isinstance(message, RawMessage):
            messages.add_definition(message.type, message.definition)
            message = messages.deserialize(message.data, message.type)
        trace.add_message(message, clock.now_ns() / 1e9)

    node.subscribe(trace.source.topic, trace.source.type if is_known else "*", on_message, queue_size=None)
