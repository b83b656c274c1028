"""`trundle topic echo`: prints messages."""

import argparse
import queue
import sys
import time
from pathlib import Path
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import (
    MessagePrinter,
    Messages,
    MessageView,
    RawMessage,
    TopicField,
    WallClock,
    field_type,
    follow_time,
    open_bag,
    split_topic,
    to_nsec,
    value_at,
)

from ..expression import expression
from ..graph_command import global_name, master, running_node
from ..wait_for_topic import wait_for_topic

_FIRST_TIMEOUT_S = 2.0
_QUEUE_SIZE = 1000
"""Queue size for slow terminals; the oldest messages are dropped."""


def main(args: argparse.Namespace) -> int:
    """Print until the count is reached, or Ctrl-C."""
    if args.width is not None and args.width < 2:
        args.refuse("Fixed width for numeric values must be at least 2")
    if args.all and not args.bag:
        args.refuse("Display all option is only valid when echoing from bag files")
    if args.offset and args.bag:
        args.refuse("offset time option is not valid with bag files")
    if not args.topic and not args.all:
        args.refuse("topic must be specified")
    if args.count is not None and args.count <= 0:
        return 0
    if args.bag:
        return _echo_bag(args)
    with running_node("rostopic", args.words) as (loop, node):
        clock = loop.run(follow_time(node))
        field = wait_for_topic(master("rostopic"), global_name(str(args.topic), "rostopic"), loop.messages)
        messages = loop.messages
        echo = _MessageEcho(args, messages)
        inbox: queue.Queue[Any] = queue.Queue()
        known = messages.has(field.type)
        node.deliver = inbox.put
        arrived: list[Any] = []
        node.subscribe(field.topic, field.type if known else "*", arrived.append, queue_size=_QUEUE_SIZE)
        if not isinstance(clock, WallClock):
            _wait_for_first(inbox)
        while not echo.is_done:
            inbox.get()()
            for message in arrived:
                if isinstance(message, RawMessage):
                    message = _read(messages, message)
                echo.print_message(message, field, clock.now_ns())
            arrived.clear()
    return 0


def _echo_bag(args: argparse.Namespace) -> int:
    """Print messages of a bag; with -a, of all topics."""
    messages = Messages(bare=True)
    echo = _MessageEcho(args, messages)
    name = "" if args.all else global_name(args.topic, "rostopic")
    with open_bag(Path(args.bag)) as bag:
        types = {connection.topic: connection.type for connection in bag.connections}
        selection = (None, "") if args.all else split_topic(name, types)
        if selection is None:
            raise UsageError(f"no topic [{name}] in {args.bag}; topics there: {', '.join(sorted(types))}")
        for message in bag.messages(lambda c: selection[0] in (None, c.topic)):
            connection = message.connection
            messages.add_definition(connection.type, connection.definition)
            field = TopicField(topic=connection.topic, type=connection.type, path=selection[1])
            echo.print_message(messages.deserialize(message.data, connection.type), field, message.stamp_ns)
            if echo.is_done:
                break
    return 0


def list_bag(args: argparse.Namespace) -> int:
    """`topic list -b`: print the topics of a bag in order of first message, or one topic's message count."""
    with open_bag(Path(args.bag)) as bag:
        if not args.topic:
            print("\n".join(dict.fromkeys(message.connection.topic for message in bag.messages())))
            return 0
        name = global_name(args.topic, "rostopic")
        prefix = f"{name.rstrip('/')}/"
        stamps = [m.stamp_ns for m in bag.messages(lambda c: c.topic == name or c.topic.startswith(prefix))]
    if not stamps:
        raise UsageError(f"no messages of {name} in {args.bag}")
    first, last = (time.strftime("%d %b %Y %H:%M:%S", time.localtime(ns / 1e9)) for ns in (stamps[0], stamps[-1]))
    print(f"{len(stamps)} message(s) from {first} to {last}")
    return 0


class _MessageEcho:
    """Prints messages by the command's options, and counts them."""

    def __init__(self, args: argparse.Namespace, messages: Messages) -> None:
        self._args = args
        self._messages = messages
        self._filter = expression(args.filter)
        self._printed = 0

    @property
    def is_done(self) -> bool:
        """True once the count is reached."""
        return self._args.count is not None and self._printed >= self._args.count

    def print_message(self, message: Any, field: TopicField, now_ns: int) -> None:
        """Print a message, if it passes the filter."""
        if self.is_done:
            return
        if self._filter is not None and not self._filter.value(m=MessageView(message), topic=field.topic):
            return
        offset = now_ns if self._args.offset else None
        _print(self._args, self._messages, message, field.type, field, offset, now_ns, first=self._printed == 0)
        self._printed += 1


def _wait_for_first(inbox: "queue.Queue[Any]") -> None:
    """Warn if no message arrives under simulated time, which may have stopped."""
    try:
        inbox.put(inbox.get(timeout=_FIRST_TIMEOUT_S))
    except queue.Empty:
        print(
            "WARNING: no messages received and simulated time is active.\nIs /clock being published?",
            file=sys.stderr,
            flush=True,
        )


def _read(messages: Messages, raw: RawMessage) -> Any:
    """Deserialize a message of an unknown type with its publisher's definition."""
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
    kind = field_type(type_name, field.path, messages) if field.path else type_name
    if args.plot:
        columns = list(printer.columns(value, kind))
        header = getattr(value, "header", None)
        stamp = to_nsec(header.stamp) if header is not None else now_ns
        if first:
            print("%time," + ",".join(name for name, _ in columns))
        print(f"{stamp - (offset_ns or 0)}," + ",".join(text for _, text in columns), flush=True)
        return
    clear = "\033[2J\033[;H" if args.clear else ""
    print(f"{clear}{printer.text(value, kind)}\n---", flush=True)
