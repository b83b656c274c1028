"""Show the log messages of nodes, as rqt_console does."""

import argparse
import json
import queue
import re
import sys
from typing import Any

from trundle.base.diagnostics import UsageError
from trundle.ros import LEVELS, colored

from .graph_command import ros_errors, running_node

EXAMPLES = """
  trundle log
  trundle log -l warn
  trundle log -n '/move_base.*' -g 'timed? out'
"""
_QUEUE_SIZE = 10_000
"""Queue size for slow terminals; the oldest lines are dropped."""
_POLL_S = 0.5
"""Longest single wait [s]: Linux may deliver Ctrl-C's signal to another thread, which does not end the wait."""


def configure(parser: argparse.ArgumentParser) -> None:
    """Declare the arguments."""
    parser.add_argument("-l", "--level", choices=LEVELS, default="debug", help="minimum level")
    parser.add_argument("-n", "--node", metavar="REGEX", help="nodes whose full name matches")
    parser.add_argument("-g", "--grep", metavar="REGEX", help="lines that match")
    parser.add_argument("-x", "--exclude", metavar="REGEX", help="without lines that match")
    parser.add_argument("-c", "--count", type=int, metavar="N", help="stop after N lines")
    parser.add_argument("-v", "--verbose", action="store_true", help="with file, line and function")
    parser.add_argument("--json", action="store_true", help="one JSON object a line")


@ros_errors
def main(args: argparse.Namespace) -> int:
    """Print until the count is reached, or Ctrl-C."""
    node_name, included, excluded = (_pattern(text) for text in (args.node, args.grep, args.exclude))
    min_level = LEVELS[args.level]
    inbox: queue.Queue[Any] = queue.Queue(_QUEUE_SIZE)

    def on_message(message: Any) -> None:
        if inbox.full():
            inbox.get_nowait()
        inbox.put_nowait(message)

    printed = 0
    with running_node("log") as (_, node):
        node.subscribe("/rosout_agg", "rosgraph_msgs/Log", on_message, queue_size=None)
        while args.count is None or printed < args.count:
            try:
                message = inbox.get(timeout=_POLL_S)
            except queue.Empty:
                continue
            if message.level < min_level or (node_name is not None and not node_name.fullmatch(message.name)):
                continue
            if included is not None and not included.search(message.msg):
                continue
            if excluded is not None and excluded.search(message.msg):
                continue
            print(_as_json(message) if args.json else _as_line(message, verbose=args.verbose), flush=True)
            printed += 1
    return 0


def _pattern(text: str | None) -> "re.Pattern[str] | None":
    try:
        return None if text is None else re.compile(text)
    except re.error as error:
        raise UsageError(f"not a regular expression: {text!r}: {error}") from None


def _as_line(message: Any, *, verbose: bool) -> str:
    stamp = f"{message.header.stamp.sec}.{message.header.stamp.nanosec:09d}"
    line = f"[{_name(message.level).upper():>5}] [{stamp}] [{message.name}]: {message.msg}"
    if verbose:
        line += f" ({message.file}:{message.line} {message.function})"
    return colored(line, _name(message.level), sys.stdout)


def _as_json(message: Any) -> str:
    return json.dumps(
        {
            "level": _name(message.level),
            "stamp": message.header.stamp.sec + message.header.stamp.nanosec / 1e9,
            "node": message.name,
            "text": message.msg,
            "file": message.file,
            "line": message.line,
            "function": message.function,
            "topics": message.topics,
        }
    )


def _name(level: int) -> str:
    return next((name for name, number in LEVELS.items() if number == level), str(level))
