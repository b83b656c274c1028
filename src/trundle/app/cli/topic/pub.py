"""`trundle topic pub`: publishes messages given as YAML."""

import argparse
import sys
import time
from typing import Any, NoReturn

from trundle.base.diagnostics import UsageError
from trundle.ros import MessageError, MessagePrinter, Node, Publisher, WallClock, follow_time

from ..graph_command import global_name, running_node
from ..yaml_input import piped_documents, yaml_file, yaml_value

_ONCE_S = 3.0
_PIPED_HZ = 10.0
_SUBSCRIBER_S = 5.0
"""Time to wait for a first subscriber before messages from a file or standard input [s]."""


def main(args: argparse.Namespace) -> int:
    """Publish until done or Ctrl-C."""
    if args.rate is not None and args.once:
        args.refuse("You cannot select both -r and -1 (--once)")
    if args.rate is not None and not args.rate > 0:
        args.refuse("rate must be greater than zero")
    if args.values and args.file:
        args.refuse("args conflict with -f setting")
    try:
        values = [yaml_value(text) for text in args.values]
    except UsageError as error:
        return args.refuse(str(error))
    with running_node("rostopic", args.words) as (loop, node):
        takes_values = bool(loop.messages.fields(args.type))
        is_piped = not values and takes_values
        if is_piped and not args.file and sys.stdin.isatty():
            raise UsageError(
                f"Please specify message values; fields of {args.type}: {', '.join(loop.messages.fields(args.type))}"
            )
        if args.use_rostime:
            clock = loop.run(follow_time(node))
            while not isinstance(clock, WallClock) and clock.now_ns() == 0:
                time.sleep(0.01)
        publisher = node.advertise(
            global_name(args.topic, "rostopic"), args.type, latch=args.rate is None or args.latch, queue_size=100
        )
        loop.run(node.wait_registered(), timeout_s=None)
        if is_piped:
            _publish_documents(args, node, publisher)
        else:
            _publish_values(args, node, publisher, values)
    return 0


def _publish_values(args: argparse.Namespace, node: Node, publisher: Publisher, values: list[Any]) -> None:
    message = _message(node, args.type, values)
    if args.rate is not None:
        due_s = time.monotonic()
        while True:
            if args.substitute_keywords:
                message = _message(node, args.type, values)
            _print_verbose(args, node, message)
            publisher.publish(message)
            due_s = max(due_s + 1 / args.rate, time.monotonic() - 1 / args.rate)
            time.sleep(max(0.0, due_s - time.monotonic()))
    _announce(args, node, message, passes=args.once)
    publisher.publish(message)
    if args.once:
        time.sleep(_ONCE_S)
    else:
        _sleep_forever()


def _announce(args: argparse.Namespace, node: Node, message: Any, *, passes: bool) -> None:
    """Print what is published, in rostopic's format."""
    content = f"[{_text(node, args.type, message)}]" if args.verbose else "message"
    duration = f" for {_ONCE_S} seconds" if passes else ". Press ctrl-C to terminate"
    print(f"publishing and latching {content}{duration}", flush=True)


def _sleep_forever() -> NoReturn:
    while True:
        time.sleep(3600.0)


def _publish_documents(args: argparse.Namespace, node: Node, publisher: Publisher) -> None:
    """Publish each YAML document of a file or of standard input."""
    rate = args.rate or (None if args.latch or args.once else _PIPED_HZ)
    stays = rate is None and not args.once
    documents = list(yaml_file(args.file)) if args.file else piped_documents()
    deadline_s = time.monotonic() + _SUBSCRIBER_S
    while not publisher.has_subscribers and time.monotonic() < deadline_s:
        time.sleep(0.01)
    repeats = isinstance(documents, list) and len(documents) == 1 and rate is not None
    if repeats:
        print("Got one message and a rate, publishing repeatedly", flush=True)
    while True:
        for document in documents:
            message = _message(node, args.type, document if isinstance(document, list) else [document])
            if repeats:
                _print_verbose(args, node, message)
            else:
                _announce(args, node, message, passes=not stays)
            publisher.publish(message)
            if stays:  # -l alone: latch the first message
                _sleep_forever()
            time.sleep(1 / rate if rate else _ONCE_S)
            if args.once:
                return
        if not repeats:
            return


def _message(node: Node, type_name: str, values: list[Any]) -> Any:
    value = values[0] if len(values) == 1 and isinstance(values[0], dict) else values
    try:
        return node.new(type_name, value)
    except MessageError as error:
        fields = ", ".join(f"{kind} {name}" for name, kind in node.messages.fields(type_name).items())
        raise MessageError(f"{error}\n{type_name} is: {fields}") from None


def _print_verbose(args: argparse.Namespace, node: Node, message: Any) -> None:
    if args.verbose:
        print(f"publishing {_text(node, args.type, message)}", flush=True)


def _text(node: Node, type_name: str, message: Any) -> str:
    return MessagePrinter(messages=node.messages).text(message, type_name)
