"""Table of results, and its Parquet files."""

import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Self

from trundle.base.extras import import_extra

from .plan import Plan
from .row_result import RowResult
from .rows import Row, Rows, column_type


class Table:
    """Table with the columns row, status, reason, seed, time, then varied quantities and measures."""

    def __init__(self, row: Callable[[int], Row], *, varied: Mapping[str, type], measured: Mapping[str, type]) -> None:
        """Declare the columns.

        Args:
            row: returns the row of a number.
            varied: varied quantity → bool, int, float or str; other values are written as text.
            measured: measure → type, as for `varied`.

        Raises:
            UsageError: pyarrow is not installed.
        """
        self._arrow, self._parquet = import_extra("pyarrow"), import_extra("pyarrow.parquet")
        self._row, self._varied, self._measured = row, varied, measured
        arrow = self._arrow
        types = {bool: arrow.bool_(), int: arrow.int64(), float: arrow.float64(), str: arrow.string()}
        self._schema = arrow.schema(
            [
                ("row", arrow.int64()),
                ("status", arrow.dictionary(arrow.int8(), arrow.string())),
                ("reason", arrow.string()),
                ("seed", arrow.int64()),
                ("time", arrow.float64()),
                *((name, types[kind]) for name, kind in {**varied, **measured}.items()),
            ]
        )

    @classmethod
    def of_plan(cls, plan: Plan, rows: Rows) -> Self:
        """Return the table of a plan.

        Raises:
            UsageError: pyarrow is not installed.
        """
        varied = {item.name: column_type(item) for item in plan.vary}
        return cls(rows.row, varied=varied, measured=dict.fromkeys((item.name for item in plan.measures), float))

    def _table(self, results: Sequence[RowResult]) -> Any:
        rows = [self._row(result.row) for result in results]
        columns: dict[str, list[Any]] = {
            "row": [result.row for result in results],
            "status": [result.status for result in results],
            "reason": [result.reason for result in results],
            "seed": [row.seed for row in rows],
            "time": [result.time for result in results],
        }
        for name, kind in self._varied.items():
            columns[name] = [kind(row.values[name]) for row in rows]
        for name in self._measured:
            columns[name] = [result.measures.get(name) for result in results]
        return self._arrow.table(columns, schema=self._schema)

    def write(self, path: Path, results: Sequence[RowResult]) -> None:
        """Write rows as one row group, atomically."""
        unfinished = path.with_name(f".{path.name}.part")
        self._parquet.write_table(
            self._table(results), unfinished, compression="zstd", row_group_size=max(len(results), 1)
        )
        os.replace(unfinished, path)

    def join(self, parts: Sequence[Path], path: Path) -> None:
        """Write the row groups of several files to one, atomically."""
        unfinished = path.with_name(f".{path.name}.part")
        with self._parquet.ParquetWriter(unfinished, self._schema, compression="zstd") as writer:
            for part in parts:
                writer.write_table(self._parquet.read_table(part, schema=self._schema))
        os.replace(unfinished, path)

    def statuses(self, path: Path) -> list[str]:
        """Return the status of each row of a file."""
        return self._parquet.read_table(path, columns=["status"])["status"].to_pylist()

    def read(self, paths: Sequence[Path], more: Sequence[RowResult] = ()) -> Any:
        """Return the rows of files, and further ones, as one table sorted by number."""
        parts = [self._parquet.read_table(path, schema=self._schema) for path in paths]
        if more or not parts:
            parts.append(self._table(more))
        return self._arrow.concat_tables(parts).sort_by("row").unify_dictionaries()
