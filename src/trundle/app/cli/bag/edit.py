"""`trundle bag filter`, `compress`, `decompress` and `reindex`: rewrite bags."""

import argparse
import sys
from collections.abc import Callable, Generator, Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import chain, islice
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.ros import BagError, BagMessage, BagReader, Messages, MessageView, open_bag, recover_messages, replaced_bag

from ..expression import Expression, expression
from .progress_meter import ProgressMeter


def filter_bag(args: argparse.Namespace) -> int:
    """Copy the messages for which an expression is true."""
    source, target = Path(args.inbag), Path(args.outbag)
    if not source.is_file():
        print(f"Cannot locate input bag file [{source}]", file=sys.stderr)
        return 2
    if source.resolve() == target.resolve():
        print(f"Cannot use same file as input and output [{source}]", file=sys.stderr)
        return 3
    wanted, printed = Expression(args.expression), expression(args.print)
    messages = Messages(bare=True)
    with open_bag(source) as bag:
        meter = ProgressMeter(args.outbag, _size(bag), is_quiet=printed is not None)
        with replaced_bag(target) as out:
            for message in bag.messages():
                connection = message.connection
                messages.add_definition(connection.type, connection.definition)
                names = {
                    "topic": connection.topic,
                    "m": MessageView(messages.deserialize(message.data, connection.type), messages),
                    "t": MessageView(messages.stamp(message.stamp_ns)),
                }
                is_wanted = bool(wanted.value(**names))
                if printed is not None:
                    print("MATCH" if is_wanted else "NO MATCH", printed.value(**names))
                if is_wanted:
                    out.write(message)
                meter.step(len(message.data))
        meter.finish()
    return 0


def _size(bag: BagReader) -> int:
    """Uncompressed size of a bag [bytes]; the file's size if it has no chunks."""
    return sum(chunk.size for chunk in bag.chunks) or bag.path.stat().st_size


def compress(args: argparse.Namespace) -> int:
    """Rewrite bags compressed."""
    return _rewrite(args, args.compression, _indexed)


def decompress(args: argparse.Namespace) -> int:
    """Rewrite bags uncompressed."""
    return _rewrite(args, "none", _indexed)


def reindex(args: argparse.Namespace) -> int:
    """Rewrite bags with all complete messages, and an index."""
    return _rewrite(args, "none", _cut_off)


Opened = tuple[int, Iterator[BagMessage]]
"""Size [bytes] and messages."""
Opening = Callable[[Path], AbstractContextManager[Opened]]


@contextmanager
def _indexed(path: Path) -> Generator[Opened]:
    with open_bag(path) as bag:
        yield _size(bag), bag.messages()


@contextmanager
def _cut_off(path: Path) -> Generator[Opened]:
    messages = recover_messages(path)
    first = list(islice(messages, 1))  # raises for invalid files before the meter starts
    yield path.stat().st_size, chain(first, messages)


def _rewrite(args: argparse.Namespace, compression: str, opened: Opening) -> int:
    """Rewrite each bag; failures are printed, leave the bag unchanged, and do not stop the others."""
    failures = 0
    for name in args.bags:
        try:
            _rewrite_one(Path(name), args, compression, opened)
        except (BagError, UsageError, OSError) as error:
            print(f"ERROR: {error}", file=sys.stderr)
            failures += 1
    return 1 if failures else 0


def _rewrite_one(path: Path, args: argparse.Namespace, compression: str, opened: Opening) -> None:
    target = path if args.output_dir is None else Path(args.output_dir) / path.name
    backup = path.with_name(f"{path.stem}.orig{path.suffix}")
    is_in_place = target.resolve() == path.resolve()
    if is_in_place and backup.exists() and not args.force:
        raise UsageError(f"Skipping {path}. Backup path {backup} already exists.")
    replaced = replaced_bag(target, compression=compression, backup=backup if is_in_place else None)
    with replaced as out, opened(path) as (size, messages):
        meter = ProgressMeter(str(target), size, is_quiet=args.quiet)
        for message in messages:
            out.write(message)
            meter.step(len(message.data))
    meter.finish()
