"""`trundle topic echo`: prints messages as they come."""

import argparse
import queue
import sys
from typing import Any

from trundle.diagnostics import UsageError
from trundle.ros import MessagePrinter, Messages, RawMessage, WallClock, follow_time, ns_of

from .graph import global_name, master, running_node
from .topic_field import field_type, value_at, wait_for_topic

_FIRST_S = 2.0
_WAITING = 1000
"""Messages kept for a terminal that is slower than the topic; the oldest go."""


def main(args: argparse.Namespace) -> int:
    """Print until enough messages came or Ctrl-C."""
    if args.width is not None and args.width < 2:
        raise UsageError("Fixed width for numeric values must be at least 2")
    if args.count is not None and args.count <= 0:
        return 0
    wanted = compiled(args.filter)
    with running_node("rostopic") as (loop, node):
        clock = loop.run(follow_time(node))
        field = wait_for_topic(master("rostopic"), global_name(args.topic, "rostopic"))
        messages = loop.messages
        inbox: queue.Queue[Any] = queue.Queue()
        known = messages.has(field.type)
        node.deliver = inbox.put
        arrived: list[Any] = []
        node.subscribe(field.topic, field.type if known else "*", arrived.append, queue_size=_WAITING)
        printed = 0
        if not isinstance(clock, WallClock):
            _wait_for_first(inbox)
        while args.count is None or printed < args.count:
            inbox.get()()
            for message in arrived:
                if isinstance(message, RawMessage):
                    message = _read(messages, message)
                if wanted is not None and not eval(wanted, {"m": message, "topic": field.topic}):
                    continue
                offset = clock.now_ns() if args.offset else None
                if args.count is None or printed < args.count:
                    _print(args, messages, message, field.type, field, offset, clock.now_ns(), first=printed == 0)
                    printed += 1
            arrived.clear()
    return 0


def _wait_for_first(inbox: "queue.Queue[Any]") -> None:
    """Say what the reason may be when no message comes at first: a simulation that stands still."""
    try:
        inbox.put(inbox.get(timeout=_FIRST_S))
    except queue.Empty:
        print(
            "WARNING: no messages received and simulated time is active.\nIs /clock being published?",
            file=sys.stderr,
            flush=True,
        )


def compiled(expression: str | None) -> Any:
    """Compile a filter, which is Python of the person at the keyboard.

    Raises:
        UsageError: it is no expression.
    """
    if expression is None:
        return None
    try:
        return compile(expression, "--filter", "eval")
    except SyntaxError as error:
        raise UsageError(f"--filter is no Python expression: {error}") from None


def _read(messages: Messages, raw: RawMessage) -> Any:
    """Read a message of a type unknown here by the definition its publisher sent along."""
    messages.add_definition(raw.type, raw.definition)
    return messages.deserialize(raw.data, raw.type)


def _print(
    args: argparse.Namespace,
    messages: Messages,
    message: Any,
    type_name: str,
    field: Any,
    offset_ns: int | None,
    now_ns: int,
    *,
    first: bool,
) -> None:
    printer = MessagePrinter(
        messages=messages, width=args.width, hide_strings=args.nostr, hide_arrays=args.noarr, offset_ns=offset_ns
    )
    try:
        value = value_at(message, field.steps)
    except (IndexError, AttributeError, TypeError) as error:
        print(f"{error}: {field.path}", file=sys.stderr)
        return
    kind = field_type(type_name, field.path) if field.path else type_name
    if args.plot:
        columns = list(printer.columns(value, kind))
        header = getattr(value, "header", None)
        stamp = ns_of(header.stamp) if header is not None else now_ns
        if first:
            print("%time," + ",".join(name for name, _ in columns))
        print(f"{stamp - (offset_ns or 0)}," + ",".join(text for _, text in columns), flush=True)
        return
    clear = "\033[2J\033[;H" if args.clear else ""
    print(f"{clear}{printer.text(value, kind)}\n---", flush=True)
