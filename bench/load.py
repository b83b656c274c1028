"""The graph under load: 200 topics at 100 Hz, 50 subscribing nodes, and new subscribers to a latched topic.

usage: python -m bench.load [SECONDS]   (default: 600; tests run a few seconds)

Prints progress twenty times, then the number of messages, the age of /clock, new subscribers that missed the latched
message, and the growth of memory; the exit code is 1 if there are faults.
"""

import asyncio
import json
import subprocess
import sys
import time
from collections import Counter
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from trundle.ros import Core, GraphLoop, Node

_TOPICS, _LISTENERS, _RATE_HZ = 200, 50, 100.0
_NEWCOMERS_HZ = 5.0
_PATIENCE_S = 60.0
_READINGS = 20
"""Number of progress lines and memory readings."""
_SETTLED = 4
"""Readings until all one-time allocations are done; growth counts from there."""
MAX_GROWTH_MB = 10.0
_LATE_MS = 100
"""Ten ticks of /clock."""
_TWIST, _STRING = "geometry_msgs/Twist", "std_msgs/String"


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """Result of the run."""

    published: int
    received: int
    newcomers: int
    missed_latched: int
    clock_backwards: int
    """Clock messages with an earlier time than the one before."""
    clock_p99_ms: float
    clock_max_ms: float
    clock_late: int
    """Clock messages older than ten ticks."""
    publishing_mb: list[float]
    """Memory of the publishing process at each reading [MB]."""
    listening_mb: list[float]

    @property
    def grown_mb(self) -> dict[str, float]:
        """Growth of both processes since `_SETTLED` [MB]."""
        readings = {"publishing": self.publishing_mb, "listening": self.listening_mb}
        return {name: mb[-1] - mb[min(_SETTLED, len(mb)) - 1] for name, mb in readings.items()}

    @property
    def faults(self) -> list[str]:
        """Faults, except late clock messages, which a busy machine causes."""
        grown = [f"the {name} process grew by {mb:.0f} MB" for name, mb in self.grown_mb.items() if mb > MAX_GROWTH_MB]
        missed = [f"{self.missed_latched} newcomers missed the latched message"] if self.missed_latched else []
        back = [f"/clock went back {self.clock_backwards} times"] if self.clock_backwards else []
        return [*grown, *missed, *back]


def run_load(seconds: float) -> Report:
    """Publish in this process, subscribe in another process."""
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        talker = Node("talker", loop=loop, master_uri=core.uri, rosout=False)
        publishers = [talker.advertise(f"/t{i}", _TWIST, queue_size=100) for i in range(_TOPICS)]
        clock = talker.advertise("/clock", "rosgraph_msgs/Clock", queue_size=100)
        talker.advertise("/latched", _STRING, latch=True).publish({"data": "here"})
        loop.run(talker.wait_registered(), _PATIENCE_S)
        words = [sys.executable, "-m", "bench.load", "--listen", core.uri]
        pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        with subprocess.Popen(words, cwd=Path(__file__).parents[1], text=True, **pipes) as listener:
            try:
                while not all(publisher.subscribers for publisher in (*publishers, clock)):
                    time.sleep(0.05)
                message = talker.new(_TWIST)
                start = due = time.monotonic()
                readings, rounds, resident, counts = 0, 0, list[float](), dict[str, Any]()
                while readings < _READINGS:
                    clock.publish({"clock": time.monotonic_ns()})
                    for publisher in publishers:
                        publisher.publish(message)
                    rounds += 1
                    now = time.monotonic()
                    if now > start + seconds * (readings + 1) / _READINGS:
                        readings += 1
                        resident.append(_resident_mb())
                        counts = _request_counts(listener)
                        print(_progress(now - start, rounds, resident, counts), file=sys.stderr, flush=True)
                    due = max(due + 1 / _RATE_HZ, now)  # a slow machine publishes at a lower rate
                    time.sleep(max(0.0, due - time.monotonic()))
            finally:
                listener.kill()
        loop.run(core.stop())
    return Report(published=rounds * _TOPICS, publishing_mb=resident, **counts)


def _request_counts(process: "subprocess.Popen[str]") -> dict[str, Any]:
    """Return the counts of the subscribing process so far."""
    assert process.stdin is not None
    assert process.stdout is not None
    process.stdin.write("\n")
    process.stdin.flush()
    return json.loads(process.stdout.readline())


def _progress(elapsed_s: float, rounds: int, resident: list[float], counts: dict[str, Any]) -> str:
    return (
        f"{elapsed_s:6.0f} s  {rounds / elapsed_s:5.1f} Hz  {counts['received']:,} of {rounds * _TOPICS:,} messages  "
        f"{resident[-1]:.0f} + {counts['listening_mb'][-1]:.0f} MB  /clock {counts['clock_max_ms']} ms at most"
    )


class _Subscribers:
    """Fifty subscribing nodes, and new subscribers."""

    def __init__(self, loop: GraphLoop, uri: str) -> None:
        self._loop, self._uri = loop, uri
        self._counts: Counter[str] = Counter()
        self._ages: Counter[int] = Counter()
        """Age of /clock [ms] → count."""
        self._latest = 0
        self._resident: list[float] = []
        for i in range(_LISTENERS):
            node = Node(f"subscriber{i}", loop=loop, master_uri=uri, rosout=False)
            for topic in range(i, _TOPICS, _LISTENERS):
                node.subscribe(f"/t{topic}", _TWIST, self._count, queue_size=100)
            if i == 0:
                node.subscribe("/clock", "rosgraph_msgs/Clock", self._on_clock, queue_size=100)

    def _count(self, _: Any) -> None:
        self._counts["received"] += 1

    def _on_clock(self, message: Any) -> None:
        stamp = message.clock.sec * 10**9 + message.clock.nanosec
        self._counts["clock_backwards"] += stamp < self._latest
        self._latest = stamp
        self._ages[(time.monotonic_ns() - stamp) // 10**6] += 1

    async def newcomers(self) -> None:
        """Join, wait for the latched message, leave."""
        while True:
            received = asyncio.Event()
            self._counts["newcomers"] += 1
            node = Node(f"newcomer{self._counts['newcomers']}", loop=self._loop, master_uri=self._uri, rosout=False)
            node.subscribe("/latched", _STRING, lambda _, received=received: received.set())
            try:
                await asyncio.wait_for(received.wait(), _PATIENCE_S)
            except TimeoutError:
                self._counts["missed_latched"] += 1
            await node.shutdown()
            await asyncio.sleep(1 / _NEWCOMERS_HZ)

    def counts(self) -> dict[str, Any]:
        """Return all counts and the memory."""
        self._resident.append(_resident_mb())
        ages = sorted(self._ages.elements()) or [0]
        counts = {name: self._counts[name] for name in ("received", "newcomers", "missed_latched", "clock_backwards")}
        return {
            **counts,
            "clock_p99_ms": ages[len(ages) * 99 // 100],
            "clock_max_ms": ages[-1],
            "clock_late": sum(count for age, count in self._ages.items() if age > _LATE_MS),
            "listening_mb": self._resident,
        }


def _listen(uri: str) -> None:
    with GraphLoop() as loop:
        subscribers = _Subscribers(loop, uri)
        newcomers = loop.spawn(subscribers.newcomers())
        for _ in sys.stdin:
            print(json.dumps(subscribers.counts()), flush=True)
        newcomers.cancel()


def _resident_mb() -> float:
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return int(status.partition("VmRSS:")[2].split()[0]) / 1e3


def main() -> None:
    """Run the load, or its subscribing process."""
    if sys.argv[1:2] == ["--listen"]:
        _listen(sys.argv[2])
        return
    report = run_load(float(sys.argv[1]) if sys.argv[1:] else 600.0)
    print(json.dumps(asdict(report) | {"grown_mb": report.grown_mb}, indent=2))
    sys.exit("; ".join(report.faults) if report.faults else 0)


if __name__ == "__main__":
    main()
