"""Results of a sweep on disk.

Each result is appended to `journal.jsonl`. Complete groups of consecutive rows become row groups, in a Parquet file
each; at the end the groups become `results.parquet`. A killed sweep resumes from any state of the folder, and the final
table does not depend on the order of the results.
"""

import json
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import IO, Any

from msgspec import json as msgspec_json

from trundle.base.atomic_write import write_atomically
from trundle.base.diagnostics import UsageError

from .row_result import RowResult
from .table import Table

GROUP_ROWS = 1000
"""Rows per row group."""
_JOURNAL, _GROUPS, _PLAN, RESULTS = "journal.jsonl", "groups", "plan.json", "results.parquet"


class Results:
    """Results of one plan in a folder."""

    def __init__(self, folder: Path, table: Table, *, rows: int, digest: str, text: str) -> None:
        """Open a folder, with existing results of the same plan.

        Args:
            folder: folder, created if missing.
            table: columns of the results.
            rows: number of rows.
            digest: digest of all inputs of the results.
            text: text of the plan, saved with the results.

        Raises:
            UsageError: the folder has the results of another plan, or cannot be written.
        """
        self.folder = folder
        self._table = table
        self._rows = rows
        try:
            (folder / _GROUPS).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UsageError(f"{folder}: {error.strerror}; give another folder with -o") from None
        self._check_plan(digest, text)
        self._waiting: dict[int, dict[int, RowResult]] = {}
        """Group → its rows in the journal."""
        self._full = {int(file.stem) for file in (folder / _GROUPS).glob("*.parquet")}
        self.counts: dict[str, int] = {}
        """Status → number of rows."""
        self.is_complete = (folder / RESULTS).exists()
        if self.is_complete:
            self._count(self._table.statuses(folder / RESULTS))
            self._remove_parts()
        else:
            for group in self._full:
                self._count(self._table.statuses(self._group_file(group)))
            self._read_journal()
        self._journal: IO[bytes] | None = None

    def _check_plan(self, digest: str, text: str) -> None:
        path, expected = self.folder / _PLAN, {"digest": digest, "rows": self._rows}
        if not path.exists():
            write_atomically(path, json.dumps({**expected, "text": text}))
            return
        saved = json.loads(path.read_text(encoding="utf-8"))
        if {key: value for key, value in saved.items() if key in expected} != expected:
            reason = "has the results of another plan, or the plan or its world has changed since"
            raise UsageError(f"{self.folder} {reason}; give another folder with -o, or delete this one")

    def _read_journal(self) -> None:
        """Read the journal; an incomplete last line is removed, and its row is run again."""
        path = self.folder / _JOURNAL
        data = path.read_bytes() if path.exists() else b""
        whole = data[: data.rfind(b"\n") + 1]
        if len(whole) != len(data):
            with path.open("r+b") as file:
                file.truncate(len(whole))
        for line in whole.splitlines():
            result = msgspec_json.decode(line, type=RowResult)
            group = result.row // GROUP_ROWS
            if group not in self._full and result.row not in self._waiting.setdefault(group, {}):
                self._waiting[group][result.row] = result
                self._count([result.status])
        for group in list(self._waiting):
            self._write_if_full(group)

    def _count(self, statuses: Sequence[str]) -> None:
        for status in statuses:
            self.counts[status] = self.counts.get(status, 0) + 1

    @property
    def done(self) -> int:
        """Number of rows with a result."""
        return sum(self.counts.values())

    def missing(self) -> Iterator[int]:
        """Yield the rows without a result."""
        if self.is_complete:
            return
        for row in range(self._rows):
            group = row // GROUP_ROWS
            if group not in self._full and row not in self._waiting.get(group, {}):
                yield row

    def add(self, result: RowResult) -> None:
        """Add a result; it is on disk when the call returns."""
        if self._journal is None:
            self._journal = (self.folder / _JOURNAL).open("ab", buffering=0)
        self._journal.write(msgspec_json.encode(result) + b"\n")
        group = result.row // GROUP_ROWS
        self._waiting.setdefault(group, {})[result.row] = result
        self._count([result.status])
        self._write_if_full(group)

    def _write_if_full(self, group: int) -> None:
        rows = self._waiting[group]
        if len(rows) < min(GROUP_ROWS, self._rows - group * GROUP_ROWS):
            return
        self._table.write(self._group_file(group), [rows[row] for row in sorted(rows)])
        self._full.add(group)
        del self._waiting[group]

    def _group_file(self, group: int) -> Path:
        return self.folder / _GROUPS / f"{group:06}.parquet"

    def close(self) -> None:
        """Close the journal; if all rows have results, join the groups into the final table and remove them."""
        if self._journal is not None:
            self._journal.close()
            self._journal = None
        if self.done < self._rows or self.is_complete:
            return
        self._table.join([self._group_file(group) for group in sorted(self._full)], self.folder / RESULTS)
        self.is_complete = True
        self._remove_parts()

    def _remove_parts(self) -> None:
        """Remove the journal and the groups."""
        (self.folder / _JOURNAL).unlink(missing_ok=True)
        shutil.rmtree(self.folder / _GROUPS, ignore_errors=True)

    def read(self) -> Any:
        """Return all rows so far as a `pyarrow.Table`, in the order of their numbers."""
        if self.is_complete:
            return self._table.read([self.folder / RESULTS])
        waiting = [result for group in self._waiting.values() for result in group.values()]
        return self._table.read([self._group_file(group) for group in sorted(self._full)], waiting)
