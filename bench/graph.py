"""The graph against rospy, in alternation on one master: message rates, latency, and the time of `topic list`."""

import json
import os
import statistics
import subprocess
import sys
import sysconfig
import tempfile
import time
from collections.abc import Callable, Generator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

from bench.table import Row
from trundle.ros import Core, GraphLoop, Node

_END = Path(__file__).parent / "ros_end.py"
_TWIST, _IMAGE = "geometry_msgs/Twist", "sensor_msgs/Image"
_RUNS = 5
_ROSTOPIC = "/usr/bin/rostopic"
_DEBIAN_PYTHON = "/usr/bin/python3"
_VERSION = [sys.version_info.major, sys.version_info.minor]
_ROSPY = [_DEBIAN_PYTHON, "-W", "ignore", str(_END), "rospy"]
_BYTECODE = tempfile.TemporaryDirectory()
"""Folder of compiled modules for both sides: an installed program has byte code, a checkout may have none."""


def run() -> list[Row]:
    """Run pairs of processes, with the same interpreter if possible; without Debian's rospy there are no ratios.

    Both publish with the same queue_size. None is synchronous in rospy; with a queue size, only messages that arrive
    count, while the publisher continues.
    """
    return [
        *_throughput("", _trundle_command),
        _row(
            "Twist in one process",
            "messages/s",
            lambda end, is_trundle: flow(end, _TWIST, 30_000, one=is_trundle).rate,
        ),
        _row("Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: age(end)),
        *_throughput("rospy, ", _modules_command),
        _row("rospy, Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: age(end), trundle=_modules_command),
        _row(
            "rospy, start of a node to its first message",
            "s",
            lambda end, _: first_message(end),
            trundle=_modules_command,
        ),
        _row("topic list, start to exit", "s", lambda _, is_trundle: _topic_list(is_trundle), against="rostopic list"),
    ]


def _throughput(title: str, trundle: Callable[[], list[str]]) -> list[Row]:
    """Messages per second by queue_size, and the CPU time of both ends in the same runs."""
    rows: list[Row] = []
    for kind, name, count, queues in (
        (_TWIST, "Twist", 30_000, (None, 1, 10)),
        (_IMAGE, "Image 320x240", 3000, (None, 10)),
    ):
        for queue in queues:
            pairs = _pairs(lambda end, _, kind=kind, count=count, queue=queue: flow(end, kind, count, queue), trundle)
            for suffix, unit, values in (
                ("", "messages/s", [[one.rate for one in pair] for pair in pairs]),
                (", CPU of both ends", "µs", [[one.cpu_us for one in pair] for pair in pairs]),
            ):
                rows.append(as_row(f"{title}{name}, queue_size {queue}{suffix}", unit, values, "rospy, the same"))
    return rows


@contextmanager
def _fresh_master() -> Generator[dict[str, str]]:
    """Start a master; yield the environment of its nodes."""
    with GraphLoop() as loop:
        core = Core(loop, port=0)
        loop.run(core.start())
        yield {
            **{name: value for name, value in os.environ.items() if name != "PYTHONDONTWRITEBYTECODE"},
            "ROS_MASTER_URI": core.uri,
            "ROS_IP": "127.0.0.1",
            "BENCH_SITE": sysconfig.get_path("platlib"),
            "PYTHONWARNINGS": "ignore",
            "PYTHONPYCACHEPREFIX": _BYTECODE.name,
        }
        loop.run(core.stop())


@cache
def _trundle_command() -> list[str]:
    """Command of Trundle's end, with rospy's interpreter if its version is the same, to compare only the libraries."""
    if Path(_DEBIAN_PYTHON).exists():
        version = [_DEBIAN_PYTHON, "-c", "import sys; print(list(sys.version_info[:2]))"]
        if json.loads(subprocess.run(version, check=True, capture_output=True).stdout) == _VERSION:
            return [_DEBIAN_PYTHON, "-S", str(_END), "trundle"]
    return [sys.executable, str(_END), "trundle"]


def _modules_command() -> list[str]:
    """Command of an end with Trundle's rospy."""
    return [*_trundle_command()[:-1], "modules"]


def _row(
    name: str,
    unit: str,
    measure: Callable[[Sequence[str], bool], float],
    *,
    against: str = "rospy",
    trundle: Callable[[], list[str]] = _trundle_command,
) -> Row:
    return as_row(name, unit, _pairs(measure, trundle), against)


_T = TypeVar("_T")


def _pairs(measure: Callable[[Sequence[str], bool], _T], trundle: Callable[[], list[str]]) -> list[list[_T]]:
    """Measure Trundle and rospy in alternation; only Trundle if rospy is not installed."""
    ends = [(trundle(), True), (_ROSPY, False)] if Path(_ROSTOPIC).exists() else [(trundle(), True)]
    return [[measure(end, is_trundle) for end, is_trundle in ends] for _ in range(_RUNS)]


def as_row(name: str, unit: str, pairs: Sequence[Sequence[float]], against: str) -> Row:
    """Return the row of pairs of values: Trundle's, and the peer's if there is one."""
    value = statistics.median(pair[0] for pair in pairs)
    if len(pairs[0]) == 1:
        return Row(name, value, unit, "", None)
    return Row(name, value, unit, against, statistics.median(trundle / peer for trundle, peer in pairs))


@dataclass(frozen=True, slots=True)
class Flow:
    """Messages from a publisher to a subscriber, as fast as possible."""

    rate: float
    """Messages that arrive [1/s]."""
    cpu_us: float
    """CPU time of both processes per message that arrives [µs]."""


def flow(end: Sequence[str], kind: str, count: int, queue: int | None = None, *, one: bool = False) -> Flow:
    """Measure a flow from its first message to the last."""
    ends = _ends(end, ["both"] if one else ["sub", "pub"], kind, count, 0, queue)
    subscriber, publisher = ends[0], ends[-1]
    cpu_s = subscriber["sub_cpu"] + (0.0 if one else publisher["pub_cpu"])
    return Flow(count / (subscriber["end"] - publisher["start"]), 1e6 * cpu_s / count)


def age(end: Sequence[str]) -> float:
    """Return the 99th percentile of message ages at 1 kHz [ms]."""
    ages = sorted(_ends(end, ["sub", "pub"], _TWIST, 3000, 1000, None)[0]["ages"])
    return ages[len(ages) * 99 // 100] * 1e3


def first_message(end: Sequence[str]) -> float:
    """Return the time from a node's start to its first message at a waiting subscriber [s]."""
    with _fresh_master() as env, GraphLoop() as loop:
        arrived: list[float] = []
        subscriber = Node("bench_waiting", loop=loop, master_uri=env["ROS_MASTER_URI"])
        subscriber.subscribe("/bench", "*", lambda _: arrived.append(time.perf_counter()))
        loop.run(subscriber.wait_registered())
        command = [*end, "first", _TWIST, "1", "0", "None"]
        start = time.perf_counter()
        with subprocess.Popen(command, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            while not arrived:
                time.sleep(0.001)
            process.kill()
        return arrived[0] - start


def _ends(end: Sequence[str], roles: Sequence[str], *words: object) -> list[dict[str, Any]]:
    """Run one process for each role, subscribers first; return their results."""
    with _fresh_master() as env, ExitStack() as processes:
        started = [
            processes.enter_context(
                subprocess.Popen(
                    [*end, role, *map(str, words)], env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
                )
            )
            for role in roles
        ]
        try:
            results: list[dict[str, Any]] = []
            for process in started:  # the subscriber's result comes before the publisher's end
                assert process.stdin is not None
                assert process.stdout is not None
                if results:
                    process.stdin.close()
                results.append(json.loads(process.stdout.readline()))
            return results
        finally:
            for process in started:
                process.kill()


def _topic_list(is_trundle: bool) -> float:
    command = [sys.executable, "-m", "trundle", "topic", "list"] if is_trundle else [_ROSTOPIC, "list"]
    with _fresh_master() as env:
        start = time.perf_counter()
        subprocess.run(command, env=env, check=True, capture_output=True)
        return time.perf_counter() - start
