"""Differences of a recorded run from another, as a table."""

import csv
import io
from collections.abc import Sequence

from msgspec import Struct

from trundle.base.diagnostics import printable
from trundle.sim.comparison import Difference


class TopicCounts(Struct, frozen=True, kw_only=True):
    """Numbers of messages of a topic in the two recordings."""

    topic: str
    type: str
    counts: tuple[int, int]
    rates: tuple[float | None, float | None]
    """Median rates [Hz]; None: fewer than two messages."""


class RunDifferences(Struct, frozen=True, kw_only=True):
    """Differences of a recorded run from another."""

    duration: float
    """Time that both recordings cover [s]."""
    rows: tuple[Difference, ...]
    """Differences: of poses first, the largest first."""
    unit: str
    """Unit of all differences, " [m, rad]"; empty: it depends on the row."""
    only: tuple[tuple[str, tuple[str, ...]], ...]
    """Name of a recording, and the models or topics that only this recording has."""
    topics: tuple[TopicCounts, ...] = ()
    """Topics that both recordings have."""
    notes: tuple[str, ...] = ()
    """Sentences about the comparison as a whole."""

    def exceed(self, tolerance: float) -> tuple[Difference, ...]:
        """Return the rows whose maximum is above a tolerance, in each row's unit."""
        return tuple(row for row in self.rows if (row.maximum or 0.0) > tolerance)

    @property
    def _header(self) -> tuple[str, ...]:
        return "name", "quantity", f"maximum{self.unit}", "at [s]", f"RMS{self.unit}", f"at the end{self.unit}"

    def table(self) -> str:
        """Return the topics and the rows as columns."""
        value = "{:.6f}" if self.unit else "{:.6g}"
        rows = _aligned([self._header, *(_cells(row, value, "{:.2f}") for row in self.rows)], left=2)
        if not self.topics:
            return rows
        head = ("topic", "type", "messages", "of the reference", "rate [Hz]", "of the reference")
        topics = [
            (printable(topic.topic), printable(topic.type), *map(str, topic.counts), *map(_rate, topic.rates))
            for topic in self.topics
        ]
        return f"{_aligned([head, *topics], left=2)}\n\n{rows}"

    def csv(self) -> str:
        """Return the rows as comma-separated values."""
        text = io.StringIO()
        rows = (self._header, *(_cells(row, "{}", "{}") for row in self.rows))
        csv.writer(text, lineterminator="\n").writerows(rows)
        return text.getvalue()


def file_names(run: str, reference: str, paths: tuple[str, str]) -> tuple[str, str]:
    """Return the names of two recordings, or their paths if the names are the same."""
    return paths if run == reference else (run, reference)


def _aligned(cells: Sequence[tuple[str, ...]], *, left: int) -> str:
    """Return rows as columns, the first `left` of them aligned to the left."""
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    form = "  ".join(f"{{:{'<' if at < left else '>'}{width}}}" for at, width in enumerate(widths))
    return "\n".join(form.format(*row).rstrip() for row in cells)


def _cells(row: Difference, value: str, time: str) -> tuple[str, ...]:
    numbers = ((value, row.maximum), (time, row.maximum_time), (value, row.rms), (value, row.now))
    return (
        printable(row.name),
        row.quantity,
        *("" if number is None else form.format(number) for form, number in numbers),
    )


def _rate(rate: float | None) -> str:
    return "" if rate is None else f"{rate:.1f}"
