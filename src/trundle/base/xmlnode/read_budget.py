"""Budget of one description or launch with all included files.

A few files that include one another twice expand to billions. The largest of the published robots, worlds and launches
has 208 files, 0.85 MB (two worlds) and 23,000 nodes (the PR2), so the limits exceed them by factors of 24, 79 and
21; one test of macros has 270,000 nodes. Worlds take up to 0.7 s of the processor, that test 3 s.
"""

import time
from collections.abc import Iterable
from pathlib import Path

from trundle.base.diagnostics import DescriptionError, Source

_MAX_FILES = 5_000
_MAX_OCTETS = 64 * 1024 * 1024
_MAX_NODES = 500_000
_CPU_S = 4.0
_CPU_S_PER_OCTET = 10e-6
"""Processor time that each octet of a file adds to the limit [s], once per file."""
_NODES_BETWEEN_CHECKS = 256
_MAX_LISTED = 8


class ReadBudgetError(DescriptionError):
    """Exhausted budget; it ends reading."""

    id = "too-large"

    def through(self, files: Iterable[str]) -> "ReadBudgetError":
        """Return the error with the chain of including files, outermost first."""
        names = [*dict.fromkeys(files)]
        if len(names) == 1:
            return self
        chain = names if len(names) <= _MAX_LISTED else [*names[: _MAX_LISTED - 1], "…", names[-1]]
        return ReadBudgetError(self.at, f"{self.what}; included files: {' > '.join(chain)}")


class ReadBudget:
    """Remaining files, octets, nodes and processor time."""

    def __init__(
        self,
        *,
        files: int = _MAX_FILES,
        octets: int = _MAX_OCTETS,
        nodes: int = _MAX_NODES,
        cpu_s: float = _CPU_S,
    ) -> None:
        self._max_files, self._files = files, files
        self._max_octets, self._octets = octets, octets
        self._max_nodes, self._nodes = nodes, nodes
        self._unchecked = 0
        self._deadline_s = time.thread_time() + cpu_s
        self._seen_files: set[str] = set()

    def add_file(self, name: str | Path, octets: int, at: Source) -> None:
        """Count a file, each time it is read.

        Raises:
            ReadBudgetError: the budget is exhausted.
        """
        if str(name) not in self._seen_files:
            self._seen_files.add(str(name))
            self._deadline_s += octets * _CPU_S_PER_OCTET
        self._files -= 1
        if self._files < 0:
            raise _exhausted(at, f"{self._max_files} files")
        self.add_octets(octets, at)
        self.check(at)

    def add_octets(self, octets: int, at: Source) -> None:
        """Count text that is read or generated.

        Raises:
            ReadBudgetError: the budget is exhausted.
        """
        self._octets -= octets
        if self._octets < 0:
            raise _exhausted(at, f"{self._max_octets >> 20} MiB of text")

    def add_nodes(self, nodes: int, at: Source) -> None:
        """Count elements, attributes or values of YAML that are read or copied.

        Raises:
            ReadBudgetError: the budget is exhausted.
        """
        self._nodes -= nodes
        if self._nodes < 0:
            raise _exhausted(at, f"{self._max_nodes} elements and values")
        self._unchecked += nodes
        if self._unchecked > _NODES_BETWEEN_CHECKS:
            self.check(at)

    def check(self, at: Source) -> None:
        """Check the processor time.

        Raises:
            ReadBudgetError: the budget is exhausted.
        """
        self._unchecked = 0
        if time.thread_time() > self._deadline_s:
            raise _exhausted(at, "the time that files of their size take")


def _exhausted(at: Source, limit: str) -> ReadBudgetError:
    return ReadBudgetError(
        at,
        f"the file, with its included files and repeated macros, takes more than {limit}; "
        "check for includes or macros that multiply",
    )
