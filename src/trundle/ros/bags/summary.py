"""Summary of a bag in rosbag's format."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Any

from .bag import BagReader


@dataclass(frozen=True, slots=True)
class _Topic:
    name: str
    type: str
    messages: int
    connections: int
    rate_hz: float | None


class BagSummary:
    """Summary of one bag."""

    def __init__(self, bag: BagReader, name: str, *, with_rates: bool) -> None:
        self._bag = bag
        self._name = name
        self._size = bag.path.stat().st_size
        self._start, self._end = _seconds(bag.start_ns), _seconds(bag.end_ns)
        # rosbag always prints the rates of 1.2 bags
        rates = median_rates(bag) if with_rates or bag.version.startswith("1.2") else {}
        self._types = sorted({(c.type, c.md5sum) for c in bag.connections})
        self._topics: list[_Topic] = []
        for topic in sorted({c.topic for c in bag.connections}):
            of_topic = [(c, count) for c, count in zip(bag.connections, bag.counts, strict=True) if c.topic == topic]
            count = sum(count for _, count in of_topic)
            self._topics.append(_Topic(topic, of_topic[0][0].type, count, len(of_topic), rates.get(topic)))

    def text(self) -> str:
        """Summary as a table."""
        rows = [("path", self._name), ("version", self._bag.version)]
        if self._topics:
            rows += [
                ("duration", _duration(self._end - self._start)),
                ("start", _date(self._start)),
                ("end", _date(self._end)),
                ("size", byte_text(self._size)),
                ("messages", str(sum(self._bag.counts))),
                *self._compression_rows(),
                *_titled("types", self._type_lines()),
                *_titled("topics", self._topic_lines()),
            ]
        else:
            rows.append(("size", byte_text(self._size)))
        width = max(len(title) for title, _ in rows) + 1
        lines = [f"{title + ':' if title else '':<{width}} {value}" for title, value in rows]
        return "\n".join(lines).rstrip()

    def yaml(self) -> str:
        """Summary as YAML, with a trailing newline."""
        lines = [f"path: {self._name}", f"version: {self._bag.version}"]
        if not self._topics:
            return "\n".join([*lines, f"size: {self._size}", "indexed: False", ""])
        lines += [
            f"duration: {self._end - self._start:.6f}",
            f"start: {self._start:.6f}",
            f"end: {self._end:.6f}",
            f"size: {self._size}",
            f"messages: {sum(self._bag.counts)}",
            f"indexed: {not self._bag.version.endswith('(unindexed)')}",
            f"compression: {self._compressions()[0][0]}",
        ]
        if any(kind != "none" for kind, *_ in self._compressions()):
            lines += [
                f"uncompressed: {self._sum(lambda c: c.size)}",
                f"compressed: {self._sum(lambda c: c.compressed)}",
            ]
        lines.append("types:")
        for kind, md5sum in self._types:
            lines += [f"    - type: {kind}", f"      md5: {md5sum}"]
        lines.append("topics:")
        for topic in self._topics:
            lines += [f"    - topic: {topic.name}", f"      type: {topic.type}", f"      messages: {topic.messages}"]
            if topic.connections > 1:
                lines.append(f"      connections: {topic.connections}")
            if topic.rate_hz is not None:
                lines.append(f"      frequency: {topic.rate_hz:.4f}")
        return "\n".join([*lines, ""])

    def _sum(self, size: Callable[[Any], int]) -> int:
        return sum(size(chunk) for chunk in self._bag.chunks)

    def _compressions(self) -> list[tuple[str, int, int, int]]:
        """(name, chunks, size, compressed size) by number of chunks, descending."""
        totals: dict[str, tuple[int, int, int]] = {}
        for chunk in self._bag.chunks:
            count, size, compressed = totals.get(chunk.compression, (0, 0, 0))
            totals[chunk.compression] = (count + 1, size + chunk.size, compressed + chunk.compressed)
        rows = [(kind, *numbers) for kind, numbers in totals.items()]
        return sorted(rows, key=lambda row: (row[1], row[0]), reverse=True) or [("none", 0, 0, 0)]

    def _compression_rows(self) -> list[tuple[str, str]]:
        kinds, chunk_count = self._compressions(), len(self._bag.chunks)
        if not chunk_count:
            return [("compression", "none")]
        texts = [
            f"{kind} [{count}/{chunk_count} chunks"
            + ("]" if kind == "none" else f"; {100.0 * compressed / size:.2f}%]")
            for kind, count, size, compressed in kinds
        ]
        rows = [("compression", ", ".join(texts))]
        if all(kind == "none" for kind, *_ in kinds):
            return rows
        size, compressed = self._sum(lambda c: c.size), self._sum(lambda c: c.compressed)
        ratio = f" ({100.0 * compressed / size:.2f}%)"
        sizes = _aligned([byte_text(size), byte_text(compressed)])
        duration = self._end - self._start
        if duration > 0:
            rates = _aligned([byte_text(size / duration), byte_text(compressed / duration)])
            sizes = [f"{text} @ {rate}/s" for text, rate in zip(sizes, rates, strict=True)]
        else:
            ratio = ""
        return [*rows, ("uncompressed", sizes[0]), ("compressed", sizes[1] + ratio)]

    def _type_lines(self) -> list[str]:
        width = max(len(kind) for kind, _ in self._types)
        return [f"{kind:<{width}} [{md5sum}]" for kind, md5sum in self._types]

    def _topic_lines(self) -> list[str]:
        name = max(len(topic.name) for topic in self._topics)
        kind = max(len(type_) for type_, _ in self._types)
        count = max(len(str(topic.messages)) for topic in self._topics)
        rate = max((len(_hertz(topic.rate_hz)) for topic in self._topics if topic.rate_hz is not None), default=0)
        lines: list[str] = []
        for topic in self._topics:
            line = f"{topic.name:<{name}}   {topic.messages:>{count}} {'msgs' if topic.messages > 1 else 'msg '}"
            line += f"   {'':>{rate}}" if topic.rate_hz is None else f" @ {_hertz(topic.rate_hz):>{rate}}"
            line += f" : {topic.type:<{kind}}"
            lines.append(line + (f" ({topic.connections} connections)" if topic.connections > 1 else ""))
        return lines


def median_rates(bag: BagReader) -> dict[str, float]:
    """Median frequency of each topic [Hz]; topics with fewer than two times are left out."""
    stamps = {topic: [_seconds(stamp) for stamp in times] for topic, times in bag.stamps_ns().items()}
    periods = {topic: median([b - a for a, b in pairwise(times)]) for topic, times in stamps.items() if len(times) > 1}
    return {topic: 1.0 / period for topic, period in periods.items() if period > 0}


def _seconds(ns: int) -> float:
    """Seconds as computed by genpy's to_sec, whose rounding shows in the sixth decimal."""
    return float(ns // 10**9) + (ns % 10**9) / 1e9


def _titled(title: str, lines: list[str]) -> list[tuple[str, str]]:
    return [(title if i == 0 else "", line) for i, line in enumerate(lines)]


def _aligned(texts: list[str]) -> list[str]:
    width = max(map(len, texts))
    return [f"{text:>{width}}" for text in texts]


def _duration(seconds: float) -> str:
    minutes = int(seconds / 60)
    hours = minutes // 60
    if hours:
        return f"{hours}hr {minutes % 60}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    if minutes:
        return f"{minutes}:{int(seconds % 60):02d}s ({int(seconds)}s)"
    return f"{seconds:.1f}s"


def _date(seconds: float) -> str:
    fraction = f"{seconds - int(seconds):.2f}"[1:]
    return f"{time.strftime('%b %d %Y %H:%M:%S', time.localtime(seconds))}{fraction} ({seconds:.2f})"


def _hertz(rate: float) -> str:
    for suffix in ("Hz", "kHz", "MHz"):
        if rate < 1000.0:
            return f"{rate:.1f} {suffix}"
        rate /= 1000.0
    return f"{rate:.1f} GHz"


def byte_text(size: float) -> str:
    """Human-readable size: `3.9 KB`."""
    for suffix in ("KB", "MB", "GB"):
        size /= 1024.0
        if size < 1024.0:
            return f"{size:.1f} {suffix}"
    return f"{size / 1024.0:.1f} TB"
