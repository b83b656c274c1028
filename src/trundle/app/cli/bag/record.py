"""`trundle bag record`: records topics until stopped."""

import argparse
import re
import signal
import sys
import time
from collections.abc import Generator
from contextlib import contextmanager
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.base.interrupts import ending_signals
from trundle.ros import BagError, Recorder, RecorderOptions, follow_time

from ..graph_command import running_node


def main(args: argparse.Namespace) -> int:
    """Record until a limit, Ctrl-C, SIGTERM or SIGHUP; the bag is closed and indexed in every case."""
    options = _options(args, tuple(_without_size(args)))
    if args.udp:
        print("--udp: UDPROS is not supported; using TCP", file=sys.stderr)
    if args.node and not args.quiet:
        print(f"Recording from: {args.node}", flush=True)
    with running_node("record", args.words) as (loop, node):
        loop.run(follow_time(node), None)
        recorder = Recorder(node, options, log=(lambda _: None) if args.quiet else _log)
        recorder.start()
        try:
            while not recorder.done.wait(0.5):
                pass
        finally:
            with _uninterrupted():
                recorder.stop()
        if recorder.error is not None:
            raise BagError(f"recording failed: {recorder.error}")
    return 0


def _without_size(args: argparse.Namespace) -> list[str]:
    """Return the topics to record, without the size in the deprecated `--split 1024`."""
    topics: list[str] = args.topics
    if args.split and topics and topics[0].isdigit():
        print(f"--split {topics[0]}: deprecated, use --split --size {topics[0]}", file=sys.stderr)
        args.size = int(topics[0])
        return topics[1:]
    return topics


def _options(args: argparse.Namespace, topics: tuple[str, ...]) -> RecorderOptions:
    if not topics and not args.all and not args.node:
        args.refuse("You must specify a topic name or else use the '-a' option.")
    if args.split and not (args.size or args.duration):
        args.refuse("Split specified without giving a maximum duration or size")
    for pattern in (*(topics if args.regex else ()), args.exclude):
        try:
            re.compile(pattern)
        except re.error as error:
            raise UsageError(f"not a regular expression: {pattern!r}: {error}") from None
    return RecorderOptions(
        topics=topics,
        is_regex=args.regex,
        all_topics=args.all,
        exclude=args.exclude,
        of_node=args.node,
        path=Path(args.output_name) if args.output_name else None,
        prefix=args.output_prefix or "",
        suffix=".mcap" if args.compression == "zstd" else ".bag",
        compression=args.compression,
        chunk_bytes=args.chunksize * 1024,
        buffer_bytes=args.buffsize * 1024 * 1024,
        limit=args.limit,
        splits=args.split,
        max_bytes=args.size * 1024 * 1024,
        max_ns=round(args.duration * 1e9),
        max_splits=args.max_splits,
        tcp_nodelay=args.tcpnodelay,
        repeats_latched=args.repeat_latched,
        announces=args.publish,
    )


def _log(text: str) -> None:
    """Print in roscpp's format."""
    print(f"[ INFO] [{time.time():.9f}]: {text}", flush=True)


@contextmanager
def _uninterrupted() -> Generator[None]:
    """Ignore signals while a bag is being closed, so that a second Ctrl-C does not leave it without an index."""
    old_handlers = {number: signal.signal(number, signal.SIG_IGN) for number in ending_signals()}
    try:
        yield
    finally:
        for number, handler in old_handlers.items():
            signal.signal(number, handler)
