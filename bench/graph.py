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
from functools import cache
from pathlib import Path
from typing import Any

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
    """Run pairs of processes, of one interpreter if possible; without Debian's rospy there are no ratios."""
    return [
        _row("Twist, flat out", "messages/s", lambda end, _: _rate(end, _TWIST, 30_000)),
        _row("Twist in one process", "messages/s", lambda end, own: _rate(end, _TWIST, 30_000, one=own)),
        _row("Image 320x240, flat out", "messages/s", lambda end, _: _rate(end, _IMAGE, 3000)),
        _row("Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: _age(end)),
        *_rospy_rows(),
        _row("topic list, start to exit", "s", lambda _, own: _topic_list(own), against="rostopic list"),
    ]


def _rospy_rows() -> list[Row]:
    """Measure Trundle's rospy, with the same program."""
    return [
        _row("rospy, Twist, flat out", "messages/s", lambda end, _: _rate(end, _TWIST, 30_000), own=_modules),
        _row("rospy, Image 320x240, flat out", "messages/s", lambda end, _: _rate(end, _IMAGE, 3000), own=_modules),
        _row("rospy, Twist at 1 kHz, 99th percentile of ages", "ms", lambda end, _: _age(end), own=_modules),
        _row("rospy, start of a node to its first message", "s", lambda end, _: _first_message(end), own=_modules),
    ]


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
    """Measure both in alternation, if rospy is installed."""
    if not Path(_ROSTOPIC).exists():
        return Row(name, statistics.median(measure(own(), True) for _ in range(_RUNS)), unit, "", None)
    pairs = [(measure(own(), True), measure(_THEIRS, False)) for _ in range(_RUNS)]
    ratio = statistics.median(own / other for own, other in pairs)
    return Row(name, statistics.median(own for own, _ in pairs), unit, against, ratio)


def _rate(end: Sequence[str], kind: str, count: int, *, one: bool = False) -> float:
    """Rate from sending the first message to receiving the last [messages/s]."""
    if one:
        both = _ends(end, ["both"], kind, count, 0)[0]
        return count / (both["end"] - both["start"])
    heard, sent = _ends(end, ["sub", "pub"], kind, count, 0)
    return count / (heard["end"] - sent["start"])


def _age(end: Sequence[str]) -> float:
    """99th percentile of message ages at 1 kHz [ms]."""
    ages = sorted(_ends(end, ["sub", "pub"], _TWIST, 3000, 1000)[0]["ages"])
    return ages[len(ages) * 99 // 100] * 1e3


def _first_message(end: Sequence[str]) -> float:
    """Time from starting a node to its first message at a subscriber that waits [s]."""
    with _fresh_master() as env, GraphLoop() as loop:
        arrived: list[float] = []
        waiting = Node("bench_waiting", loop=loop, master_uri=env["ROS_MASTER_URI"])
        waiting.subscribe("/bench", "*", lambda _: arrived.append(time.perf_counter()))
        loop.run(waiting.wait_registered())
        command = [*end, "first", _TWIST, "1", "0"]
        start = time.perf_counter()
        with subprocess.Popen(command, env=env, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
            while not arrived:
                time.sleep(0.001)
            process.kill()
        return arrived[0] - start


def _ends(end: Sequence[str], roles: Sequence[str], *words: object) -> list[dict[str, Any]]:
    """Run one process for each role; return their outputs."""
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
            return [json.loads(process.stdout.readline()) for process in started if process.stdout is not None]
        finally:
            for process in started:
                process.kill()


def _topic_list(own: bool) -> float:
    command = [sys.executable, "-m", "trundle", "topic", "list"] if own else [_ROSTOPIC, "list"]
    with _fresh_master() as env:
        start = time.perf_counter()
        subprocess.run(command, env=env, check=True, capture_output=True)
        return time.perf_counter() - start
