"""A slow machine for a test: a program and its child processes get a fraction of one CPU core."""

import os
import signal
import subprocess
import threading
import time
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

_V1, _V2 = Path("/sys/fs/cgroup/cpu"), Path("/sys/fs/cgroup")
_PERIOD_US = 100_000
_SLICE_S = 0.02
"""Time that a program runs without interruption if there are no cgroups."""


@contextmanager
def slowed(
    words: Sequence[str], *, ratio: float, env: Mapping[str, str], log: IO[str]
) -> Generator["subprocess.Popen[bytes]"]:
    """Run a program with a fraction of one core, by a cgroup or by SIGSTOP and SIGCONT; kill it at the end."""
    group = _new_cgroup(ratio)
    if group is not None:
        words = ["/bin/sh", "-c", f'echo $$ > {group}/cgroup.procs; exec "$@"', "sh", *words]
    process = subprocess.Popen(words, env=env, stdout=log, stderr=log, start_new_session=True)
    ended = threading.Event()
    if group is None:
        threading.Thread(target=_throttle, args=(process.pid, ratio, ended), daemon=True).start()
    try:
        yield process
    finally:
        ended.set()
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        if group is not None:
            _remove(group)


def _new_cgroup(ratio: float) -> Path | None:
    """Create a cgroup with a quota; return None without permission."""
    name = f"trundle-test-{os.getpid()}-{time.monotonic_ns()}"
    quota_us = round(ratio * _PERIOD_US)
    for parent, limits in (
        (_V1, {"cpu.cfs_period_us": f"{_PERIOD_US}", "cpu.cfs_quota_us": f"{quota_us}"}),
        (_V2, {"cpu.max": f"{quota_us} {_PERIOD_US}"}),
    ):
        group = parent / name
        try:
            group.mkdir()
        except OSError:
            continue
        try:
            for file, value in limits.items():
                (group / file).write_text(value)
        except OSError:
            _remove(group)
            continue
        return group
    return None


def _remove(group: Path) -> None:
    for _ in range(100):  # processes of a killed group end with a delay
        with suppress(OSError):
            group.rmdir()
            return
        time.sleep(0.05)


def _throttle(group: int, ratio: float, ended: threading.Event) -> None:
    """Stop the processes of a group most of the time."""
    with suppress(ProcessLookupError):
        while not ended.is_set():
            os.killpg(group, signal.SIGCONT)
            time.sleep(_SLICE_S)
            os.killpg(group, signal.SIGSTOP)
            ended.wait(_SLICE_S * (1 / ratio - 1))
        os.killpg(group, signal.SIGCONT)
