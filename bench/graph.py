"""The graph against rospy, in turns on one master: messages a second, latency, and the wait for `topic list`."""

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
_DEBIANS = "/usr/bin/python3"
_VERSION = [sys.version_info.major, sys.version_info.minor]
_THEIRS = [_DEBIANS, "-W", "ignore", str(_END), "rospy"]
_BYTECODE = tempfile.TemporaryDirectory()
"""Folder of compiled modules for both sides: an installed program is compiled, a checkout need not be."""


def run() -> list[Row]:
    """Run pairs of processes, of one interpreter if possible; without Debian's rospy there are no ratios.

    Both publish with the same queue_size. None is synchronous in rospy; of a queue of a size the messages that arrive
    count, while the publisher goes on.
    """
    return [
        *_flat_out("", _ours),
        _row("Twist in one process", "messages/s", lambda end, own: _flow(end, _TWIST, 30_000, one=own).rate),
        _row("Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: _age(end)),
        *_flat_out("rospy, ", _modules),
        _row("rospy, Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: _age(end), own=_modules),
        _row("rospy, start of a node to its first message", "s", lambda end, _: _first_message(end), own=_modules),
        _row("topic list, start to exit", "s", lambda _, own: _topic_list(own), against="rostopic list"),
    ]


def _flat_out(title: str, own: Callable[[], list[str]]) -> list[Row]:
    """Messages a second by queue_size, and the processor time of both ends in the same runs."""
    rows: list[Row] = []
    for kind, name, count, queues in (
        (_TWIST, "Twist", 30_000, (None, 1, 10)),
        (_IMAGE, "Image 320x240", 3000, (None, 10)),
    ):
        for queue in queues:
            pairs = _pairs(lambda end, _, kind=kind, count=count, queue=queue: _flow(end, kind, count, queue), own)
            for what, unit, figures in (
                ("", "messages/s", [[flow.rate for flow in pair] for pair in pairs]),
                (", CPU of both ends", "µs", [[flow.cpu_us for flow in pair] for pair in pairs]),
            ):
                rows.append(_as_row(f"{title}{name}, queue_size {queue}{what}", unit, figures, "rospy, the same"))
    return rows


@contextmanager
def _fresh_master() -> Generator[dict[str, str]]:
    """Start a fresh master; yield the environment of its nodes."""
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
def _ours() -> list[str]:
    """Trundle's end, on rospy's interpreter if of the same version: libraries are compared, not builds of Python."""
    if Path(_DEBIANS).exists():
        asked = [_DEBIANS, "-c", "import sys; print(list(sys.version_info[:2]))"]
        if json.loads(subprocess.run(asked, check=True, capture_output=True).stdout) == _VERSION:
            return [_DEBIANS, "-S", str(_END), "trundle"]
    return [sys.executable, str(_END), "trundle"]


def _modules() -> list[str]:
    """End over Trundle's rospy."""
    return [*_ours()[:-1], "modules"]


def _row(
    name: str,
    unit: str,
    measure: Callable[[Sequence[str], bool], float],
    *,
    against: str = "rospy",
    own: Callable[[], list[str]] = _ours,
) -> Row:
    return _as_row(name, unit, _pairs(measure, own), against)


_T = TypeVar("_T")


def _pairs(measure: Callable[[Sequence[str], bool], _T], own: Callable[[], list[str]]) -> list[list[_T]]:
    """Measure ours and rospy's in alternation; ours alone where rospy is not installed."""
    ends = [(own(), True), (_THEIRS, False)] if Path(_ROSTOPIC).exists() else [(own(), True)]
    return [[measure(end, is_own) for end, is_own in ends] for _ in range(_RUNS)]


def _as_row(name: str, unit: str, pairs: Sequence[Sequence[float]], against: str) -> Row:
    value = statistics.median(pair[0] for pair in pairs)
    if len(pairs[0]) == 1:
        return Row(name, value, unit, "", None)
    return Row(name, value, unit, against, statistics.median(own / other for own, other in pairs))


@dataclass(frozen=True, slots=True)
class _Flow:
    """Messages from a publisher to a subscriber, as fast as possible."""

    rate: float
    """[messages/s] That arrive."""
    cpu_us: float
    """[µs] Of both processes for each message that arrives."""


def _flow(end: Sequence[str], kind: str, count: int, queue: int | None = None, *, one: bool = False) -> _Flow:
    """Measure a flow from its first message to its last."""
    ends = _ends(end, ["both"] if one else ["sub", "pub"], kind, count, 0, queue)
    heard, sent = ends[0], ends[-1]
    spent = heard["sub_cpu"] + (0.0 if one else sent["pub_cpu"])
    return _Flow(count / (heard["end"] - sent["start"]), 1e6 * spent / count)


def _age(end: Sequence[str]) -> float:
    """99th percentile of message ages at 1 kHz [ms]."""
    ages = sorted(_ends(end, ["sub", "pub"], _TWIST, 3000, 1000, None)[0]["ages"])
    return ages[len(ages) * 99 // 100] * 1e3


def _first_message(end: Sequence[str]) -> float:
    """Time from starting a node to its first message at a subscriber that waits [s]."""
    with _fresh_master() as env, GraphLoop() as loop:
        arrived: list[float] = []
        waiting = Node("bench_waiting", loop=loop, master_uri=env["ROS_MASTER_URI"])
        waiting.subscribe("/bench", "*", lambda _: arrived.append(time.perf_counter()))
        loop.run(waiting.wait_registered())
        command = [*end, "first", _TWIST, "1", "0", "None"]
        start = time.perf_counter()
        with subprocess.Popen(command, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            while not arrived:
                time.sleep(0.001)
            process.kill()
        return arrived[0] - start


def _ends(end: Sequence[str], roles: Sequence[str], *words: object) -> list[dict[str, Any]]:
    """Run one process for each role, subscribers first; return their outputs."""
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
            said: list[dict[str, Any]] = []
            for process in started:  # a publisher after its subscriber, which has all it waits for
                assert process.stdin is not None
                assert process.stdout is not None
                if said:
                    process.stdin.close()
                said.append(json.loads(process.stdout.readline()))
            return said
        finally:
            for process in started:
                process.kill()


def _topic_list(own: bool) -> float:
    command = [sys.executable, "-m", "trundle", "topic", "list"] if own else [_ROSTOPIC, "list"]
    with _fresh_master() as env:
        start = time.perf_counter()
        subprocess.run(command, env=env, check=True, capture_output=True)
        return time.perf_counter() - start
