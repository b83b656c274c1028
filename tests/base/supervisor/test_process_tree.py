"""Programs and their children end with the process that started them, even a killed one."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from trundle.base.supervisor import ProcessTree

TIMEOUT_S = 60.0
pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="needs /proc, which only Linux has")

PROGRAM = """
import os, subprocess, sys, time
sleep = [sys.executable, "-S", "-c", "import time; time.sleep(600)"]
child = subprocess.Popen(sleep)
own_session = subprocess.Popen(sleep, start_new_session=True)
print(os.getpid(), child.pid, own_session.pid, flush=True)
time.sleep(600 * (sys.argv[1] == "stay"))
"""
"""Starts a child, and one in its own session, like a nested launch or a shell in a window."""

STARTER = """
import asyncio, os, sys
from trundle.base.supervisor import ProcessCommand, ProcessJob, ProcessTree

async def main():
    argv = (sys.executable, "-S", "-c", sys.argv[1], "stay")
    command = ProcessCommand(name="a", argv=argv, env=dict(os.environ), output="screen")
    job = ProcessJob(command, lambda _, line: print(line, flush=True), tree=ProcessTree())
    await job.start()
    await job.wait()

asyncio.run(main())
"""


def is_alive(pid: int) -> bool:
    """Return True if a process is alive; a zombie counts as dead."""
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except (FileNotFoundError, ProcessLookupError):
        return False


def until(condition: Callable[[], object]) -> None:
    end = time.monotonic() + TIMEOUT_S
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.01)


def test_the_tree_ends_with_a_killed_starter() -> None:
    with subprocess.Popen(
        [sys.executable, "-c", STARTER, PROGRAM], stdout=subprocess.PIPE, text=True, start_new_session=True
    ) as starter:
        assert starter.stdout is not None
        pids = [int(word) for word in starter.stdout.readline().split()]
        assert len(pids) == 3
        os.killpg(starter.pid, signal.SIGKILL)
    until(lambda: not any(map(is_alive, pids)))


def test_orphans_end_when_the_tree_is_closed() -> None:
    with ProcessTree() as tree:
        tree.watch()
        program = [sys.executable, "-S", "-c", PROGRAM, "leave"]
        environment = tree.environment(os.environ)
        with subprocess.Popen(
            program, stdout=subprocess.PIPE, text=True, env=environment, start_new_session=True
        ) as process:
            tree.add(process.pid)
            assert process.stdout is not None
            _, *remaining = [int(word) for word in process.stdout.readline().split()]
            process.wait(TIMEOUT_S)
            tree.discard(process.pid)
        assert all(map(is_alive, remaining))
    until(lambda: not any(map(is_alive, remaining)))


def test_a_process_that_ignores_sigterm_is_killed() -> None:
    stubborn = "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print(flush=True); time.sleep(600)"
    with ProcessTree(terminate_s=0.1) as tree:
        tree.watch()
        with subprocess.Popen(
            [sys.executable, "-S", "-c", stubborn], stdout=subprocess.PIPE, env=tree.environment(os.environ)
        ) as process:
            assert process.stdout is not None
            process.stdout.readline()
            tree.close()
    assert process.returncode == -signal.SIGKILL


def test_other_processes_are_left_alone() -> None:
    with subprocess.Popen([sys.executable, "-S", "-c", "import time; time.sleep(600)"]) as other:
        with ProcessTree() as tree:
            tree.watch()
        assert other.poll() is None
        other.kill()
