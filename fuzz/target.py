"""Targets: readers and servers under test, with valid inputs."""

import itertools
import os
from collections.abc import Callable, Generator
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from pathlib import Path

from trundle.base.diagnostics import TrundleError

ROOT = Path(__file__).parents[1]
_CORPUS = ROOT.parent / "shared" / "corpus"
_MAX_SEED_BYTES = 20_000
_MAX_SEEDS = 60

Execute = Callable[[bytes], object]
"""Function of one input, which may only raise TrundleError."""
Open = Callable[[Path], AbstractContextManager[Execute]]
"""Function that prepares an `Execute` in an empty folder."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Target:
    """Reader or server under test."""

    open: Open
    seeds: Callable[[], list[bytes]]
    """Generates valid inputs."""
    words: tuple[bytes, ...] = ()
    """Words of the format for mutations."""
    corpus: tuple[str, ...] = ()
    """Patterns of further seeds in ../shared/corpus, if that folder exists."""

    def corpus_seeds(self) -> list[bytes]:
        """Return small files of the corpus."""
        files = sorted({file for pattern in self.corpus for file in _CORPUS.glob(pattern) if file.is_file()})
        small = [file for file in files if file.stat().st_size <= _MAX_SEED_BYTES]
        return [file.read_bytes() for file in small[:: max(1, len(small) // _MAX_SEEDS)]]


_times = itertools.count(10**18)


def write_file(file: Path, data: bytes) -> None:
    """Write a file with a later time than all files before: readers cache by time and size."""
    file.write_bytes(data)
    now = next(_times)
    os.utime(file, ns=(now, now))


def reads_file(name: str, read: Callable[[Path], object]) -> Open:
    """Return an `open` that writes each input to a file and reads it.

    Args:
        name: file's name.
        read: reader of the file.
    """

    @contextmanager
    def opened(folder: Path) -> Generator[Execute]:
        file = folder / name

        def execute(data: bytes) -> None:
            write_file(file, data)
            read(file)

        yield execute

    return opened


def call_all(*steps: Callable[[], object]) -> None:
    """Call functions, each of which may refuse the input."""
    for step in steps:
        try:
            step()
        except TrundleError:
            continue
