"""`trundle bag filter`, `compress`, `decompress` and `reindex`: bags made from bags."""

import argparse
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

from trundle.diagnostics import UsageError
from trundle.ros import BagError, BagMessage, Messages, MessageView, create_bag, open_bag, recovered

from .expression import Expression, expression


def filter_bag(args: argparse.Namespace) -> int:
    """Copy the messages for which an expression is true."""
    source, target = Path(args.inbag), Path(args.outbag)
    if not source.is_file():
        raise UsageError(f"Cannot locate input bag file [{source}]")
    if source.resolve() == target.resolve():
        raise UsageError(f"Cannot use same file as input and output [{source}]")
    wanted, printed = Expression(args.expression), expression(args.print)
    messages = Messages(bare=True)
    target.unlink(missing_ok=True)
    with open_bag(source) as bag, create_bag(target) as out:
        for message in bag.messages():
            connection = message.connection
            messages.add_definition(connection.type, connection.definition)
            names = {
                "topic": connection.topic,
                "m": MessageView(messages.deserialize(message.data, connection.type)),
                "t": MessageView(messages.stamp(message.stamp_ns)),
            }
            is_wanted = bool(wanted.value(**names))
            if printed is not None:
                print("MATCH" if is_wanted else "NO MATCH", printed.value(**names))
            if is_wanted:
                out.write(message)
    return 0


def compress(args: argparse.Namespace) -> int:
    """Write bags anew, compressed."""
    return _rewrite(args, args.compression, _indexed)


def decompress(args: argparse.Namespace) -> int:
    """Write bags anew, not compressed."""
    return _rewrite(args, "none", _indexed)


def reindex(args: argparse.Namespace) -> int:
    """Write bags anew from whatever whole messages are in them."""
    return _rewrite(args, "none", recovered)


def _indexed(path: Path) -> Iterable[BagMessage]:
    with open_bag(path) as bag:
        yield from bag.messages()


def _rewrite(args: argparse.Namespace, compression: str, read: Callable[[Path], Iterable[BagMessage]]) -> int:
    """Write each bag anew; one that cannot be is said, stays as it was, and the others follow."""
    failures = 0
    for name in args.bags:
        try:
            count, target = _rewrite_one(Path(name), args, compression, read)
        except (BagError, UsageError, OSError) as error:
            print(f"ERROR: {error}", file=sys.stderr)
            failures += 1
            continue
        if not args.quiet:
            print(f"{target}: {count} messages")
    return 1 if failures else 0


def _rewrite_one(
    path: Path, args: argparse.Namespace, compression: str, read: Callable[[Path], Iterable[BagMessage]]
) -> tuple[int, Path]:
    target = path if args.output_dir is None else Path(args.output_dir) / path.name
    backup = path.with_name(f"{path.stem}.orig{path.suffix}")
    is_in_place = target.resolve() == path.resolve()
    if is_in_place and backup.exists() and not args.force:
        raise UsageError(f"Skipping {path}. Backup path {backup} already exists.")
    working = target.with_name(f"{target.name}.part")
    working.unlink(missing_ok=True)
    count = 0
    try:
        with create_bag(working, compression=compression) as out:
            for message in read(path):
                out.write(message)
                count += 1
        if is_in_place:
            path.replace(backup)
        working.replace(target)
    finally:
        working.unlink(missing_ok=True)
    return count, target
