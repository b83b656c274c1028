"""`trundle bag filter`, `compress`, `decompress` and `reindex`: rewrite bags."""

import argparse
import shutil
import sys
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import AbstractContextManager, contextmanager
from itertools import chain, islice
from pathlib import Path

from trundle.base.diagnostics import UsageError
from trundle.ros import (
    BagError,
    BagMessage,
    BagReader,
    Messages,
    MessageView,
    byte_text,
    open_bag,
    recover_messages,
    replaced_bag,
)

from ..expression import Expression, expression

_PERIOD_S = 1.0
_OTHER_COLUMNS = 37
"""Number of columns of the line besides the path."""


def filter_bag(args: argparse.Namespace) -> int:
    """Copy the messages for which an expression is true."""
    source, target = Path(args.inbag), Path(args.outbag)
    if not source.is_file():
        print(f"Cannot locate input bag file [{source}]", file=sys.stderr)
        return 2
    if source.resolve() == target.resolve():
        print(f"Cannot use same file as input and output [{source}]", file=sys.stderr)
        return 3
    condition, printed = Expression(args.expression), expression(args.print)
    messages = Messages(bare=True)
    with open_bag(source) as bag:
        meter = _ProgressMeter(args.outbag, _size(bag), is_quiet=printed is not None)
        with replaced_bag(target) as out:
            for message in bag.messages():
                connection = message.connection
                messages.add_definition(connection.type, connection.definition)
                names = {
                    "topic": connection.topic,
                    "m": MessageView(messages.deserialize(message.data, connection.type), messages),
                    "t": MessageView(messages.stamp(message.stamp_ns)),
                }
                is_match = bool(condition.value(**names))
                if printed is not None:
                    print("MATCH" if is_match else "NO MATCH", printed.value(**names))
                if is_match:
                    out.write(message)
                meter.step(len(message.data))
        meter.finish()
    return 0


def _size(bag: BagReader) -> int:
    """Return the uncompressed size of a bag [bytes]; the file's size if it has no chunks."""
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
"""Size [bytes] and number of messages of a bag."""
Opening = Callable[[Path], AbstractContextManager[Opened]]


@contextmanager
def _indexed(path: Path) -> Generator[Opened]:
    with open_bag(path) as bag:
        yield _size(bag), bag.messages()


@contextmanager
def _cut_off(path: Path) -> Generator[Opened]:
    messages = recover_messages(path)
    first = list(islice(messages, 1))  # opening raises for invalid files, before the meter starts
    yield path.stat().st_size, chain(first, messages)


def _rewrite(args: argparse.Namespace, compression: str, open_messages: Opening) -> int:
    """Rewrite each bag; a failure is printed, leaves its bag unchanged, and does not stop the others."""
    failures = 0
    for name in args.bags:
        try:
            _rewrite_one(Path(name), args, compression, open_messages)
        except (BagError, UsageError, OSError) as error:
            print(f"ERROR: {error}", file=sys.stderr)
            failures += 1
    return 1 if failures else 0


def _rewrite_one(path: Path, args: argparse.Namespace, compression: str, open_messages: Opening) -> None:
    target = path if args.output_dir is None else Path(args.output_dir) / path.name
    backup = path.with_name(f"{path.stem}.orig{path.suffix}")
    is_in_place = target.resolve() == path.resolve()
    if is_in_place and backup.exists() and not args.force:
        raise UsageError(f"Skipping {path}. Backup path {backup} already exists.")
    replaced = replaced_bag(target, compression=compression, backup=backup if is_in_place else None)
    with replaced as out, open_messages(path) as (size, messages):
        meter = _ProgressMeter(str(target), size, is_quiet=args.quiet)
        for message in messages:
            out.write(message)
            meter.step(len(message.data))
    meter.finish()


class _ProgressMeter:
    """Prints progress and remaining time on one line."""

    def __init__(self, path: str, total: int, *, is_quiet: bool = False) -> None:
        """Start; `total` [bytes]."""
        self._path = path
        self._total = total
        self._is_quiet = is_quiet
        self._done = 0
        self._start_s = self._printed_s = time.monotonic()
        self._print(0)

    def step(self, size: int) -> None:
        """Add processed bytes."""
        self._done += size
        if time.monotonic() - self._printed_s > _PERIOD_S:
            self._print(self._done)

    def finish(self) -> None:
        """Print 100% and a newline."""
        self._print(max(self._done, self._total))
        if not self._is_quiet:
            print()

    def _print(self, done: int) -> None:
        self._printed_s = time.monotonic()
        if not self._is_quiet:
            print(f"\r {self._line(done, self._printed_s - self._start_s)}", end="", flush=True)

    def _line(self, done: int, elapsed_s: float) -> str:
        width = max(4, shutil.get_terminal_size().columns - _OTHER_COLUMNS)
        path = self._path if len(self._path) <= width else f"...{self._path[3 - width :]}"
        total = byte_text(self._total)
        if done >= self._total:
            return f"{path:<{width}} 100% {total:>19} {_clock(elapsed_s)}    "
        remaining = _clock(elapsed_s * (self._total / done - 1.0)) if done else "--:--"
        return f"{path:<{width}} {100 * done // self._total:3}% {byte_text(done):>8} / {total:>8} {remaining} ETA"


def _clock(seconds: float) -> str:
    minutes = int(seconds / 60)
    return "--:--" if minutes > 99 else f"{minutes:02}:{int(seconds % 60):02}"
