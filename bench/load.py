"""The graph under load: 200 topics at 100 Hz, 50 listening nodes, newcomers to a latched topic all the while.

usage: python -m bench.load [SECONDS]   (600; the tests take a few)

Says how many messages came, how old /clock was, whether a newcomer missed the latched message, and how memory grew.
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
_TWIST, _STRING = "geometry_msgs/Twist", "std_msgs/String"


@dataclass(frozen=True, slots=True, kw_only=True)
class Report:
    """What came of it."""

    published: int
    received: int
    newcomers: int
    missed_latched: int
    clock_backwards: int
    """Clock messages that came after a later one."""
    clock_p99_ms: float
    clock_most_ms: float
    grown_mb: dict[str, float]
    """Of the publishing and the listening process, from a fifth of the time to the end."""


def run_load(seconds: float) -> Report:
    """Publish here, listen in a process of its own."""
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        talker = Node("talker", loop=loop, master_uri=core.uri, rosout=False)
        publishers = [talker.advertise(f"/t{i}", _TWIST, queue_size=100) for i in range(_TOPICS)]
        clock = talker.advertise("/clock", "rosgraph_msgs/Clock", queue_size=100)
        talker.advertise("/latched", _STRING, latch=True).publish({"data": "here"})
        loop.run(talker.ready(), _PATIENCE_S)
        words = [sys.executable, "-m", "bench.load", "--listen", core.uri]
        pipes: dict[str, Any] = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        with subprocess.Popen(words, cwd=Path(__file__).parents[1], text=True, **pipes) as listener:
            try:
                while not all(publisher.subscribers for publisher in (*publishers, clock)):
                    time.sleep(0.05)
                message = talker.new(_TWIST)
                start = due = time.monotonic()
                rounds, early = 0, None
                while (now := time.monotonic()) < start + seconds:
                    clock.publish({"clock": time.monotonic_ns()})
                    for publisher in publishers:
                        publisher.publish(message)
                    rounds += 1
                    if early is None and now > start + seconds / 5:
                        early = _resident_mb()
                        _say(listener, "early")
                    due = max(due + 1 / _RATE_HZ, now)  # a machine too slow for it does what it can
                    time.sleep(max(0.0, due - time.monotonic()))
                _say(listener, "end")
                assert listener.stdout is not None
                heard = json.loads(listener.stdout.readline())
            finally:
                listener.kill()
        grown = {"publishing": _resident_mb() - (early or 0.0), "listening": heard.pop("grown_mb")}
        loop.run(core.stop())
    return Report(published=rounds * _TOPICS, grown_mb=grown, **heard)


def _say(process: "subprocess.Popen[str]", word: str) -> None:
    assert process.stdin is not None
    process.stdin.write(f"{word}\n")
    process.stdin.flush()


class _Ears:
    """Fifty nodes that listen, and newcomers."""

    def __init__(self, loop: GraphLoop, uri: str) -> None:
        self._loop, self._uri = loop, uri
        self._counts: Counter[str] = Counter()
        self._ages: Counter[int] = Counter()
        """Age of /clock [ms] → how often."""
        self._latest = 0
        for i in range(_LISTENERS):
            node = Node(f"ear{i}", loop=loop, master_uri=uri, rosout=False)
            for topic in range(i, _TOPICS, _LISTENERS):
                node.subscribe(f"/t{topic}", _TWIST, self._count, queue_size=100)
            if i == 0:
                node.subscribe("/clock", "rosgraph_msgs/Clock", self._look, queue_size=100)

    def _count(self, _: Any) -> None:
        self._counts["received"] += 1

    def _look(self, message: Any) -> None:
        stamp = message.clock.sec * 10**9 + message.clock.nanosec
        self._counts["clock_backwards"] += stamp < self._latest
        self._latest = stamp
        self._ages[(time.monotonic_ns() - stamp) // 10**6] += 1

    async def newcomers(self) -> None:
        """Join, wait for the latched message, leave."""
        while True:
            got = asyncio.Event()
            self._counts["newcomers"] += 1
            node = Node(f"newcomer{self._counts['newcomers']}", loop=self._loop, master_uri=self._uri, rosout=False)
            node.subscribe("/latched", _STRING, lambda _, got=got: got.set())
            try:
                await asyncio.wait_for(got.wait(), _PATIENCE_S)
            except TimeoutError:
                self._counts["missed_latched"] += 1
            await node.shutdown()
            await asyncio.sleep(1 / _NEWCOMERS_HZ)

    def heard(self) -> dict[str, float]:
        """All counts."""
        ages = sorted(self._ages.elements())
        counts = {name: self._counts[name] for name in ("received", "newcomers", "missed_latched", "clock_backwards")}
        return {**counts, "clock_p99_ms": ages[len(ages) * 99 // 100], "clock_most_ms": ages[-1]}


def _listen(uri: str) -> None:
    with GraphLoop() as loop:
        ears = _Ears(loop, uri)
        coming = loop.spawn(ears.newcomers())
        sys.stdin.readline()
        early = _resident_mb()
        sys.stdin.readline()
        coming.cancel()
        print(json.dumps({**ears.heard(), "grown_mb": _resident_mb() - early}), flush=True)


def _resident_mb() -> float:
    status = Path("/proc/self/status").read_text(encoding="utf-8")
    return int(status.partition("VmRSS:")[2].split()[0]) / 1e3


def main() -> None:
    """Run it, or be its listening half."""
    if sys.argv[1:2] == ["--listen"]:
        _listen(sys.argv[2])
        return
    print(json.dumps(asdict(run_load(float(sys.argv[1]) if sys.argv[1:] else 600.0)), indent=2))


if __name__ == "__main__":
    main()
