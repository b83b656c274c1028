"""Programs run in a terminal of ours: keys reach them, their output is kept within bounds, their end is shown."""

import asyncio
import os
import signal
import sys
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest

from trundle.base.supervisor import (
    HAS_PSEUDO_TERMINALS,
    Event,
    JobError,
    ProcessCommand,
    ProcessJob,
    ProcessTree,
    Supervisor,
    Terminal,
)

pytestmark = pytest.mark.skipif(not HAS_PSEUDO_TERMINALS, reason="Windows has no pseudo-terminals")
TIMEOUT_S = 60.0
MAX_BYTES = 256 * 1024
READS_KEYS = "import sys, tty; tty.setcbreak(0); print('ready'); key = sys.stdin.read(1); print(f'<{key}>')"


class Stage:
    """A terminal with a program in it."""

    def __init__(self, folder: Path, argv: tuple[str, ...]) -> None:
        self.terminal = Terminal()
        self.events: list[Event] = []
        self.lines: list[str] = []
        self.tree = ProcessTree()
        self.supervisor = Supervisor(self.events.append)
        command = ProcessCommand(name="node", argv=argv, env=dict(os.environ), cwd=folder, output=self.terminal)
        self.job = ProcessJob(command, lambda _, line: self.lines.append(line), tree=self.tree)

    async def until(self, condition: Callable[[], object]) -> None:
        async with asyncio.timeout(TIMEOUT_S):
            while not condition():
                await asyncio.sleep(0.01)

    async def sees(self, text: bytes) -> None:
        await self.until(lambda: text in self.terminal.scrollback)


def run_in_terminal(folder: Path, argv: tuple[str, ...], play: Callable[[Stage], Coroutine[Any, Any, None]]) -> Stage:
    async def run() -> Stage:
        stage = Stage(folder, argv)
        try:
            await stage.supervisor.start(stage.job)
            await play(stage)
        finally:
            await stage.supervisor.stop()
            stage.tree.close()
        return stage

    return asyncio.run(run())


def python(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


def test_a_program_reads_keys_without_enter(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.sees(b"ready")
        stage.terminal.type("w")
        await stage.supervisor.wait()

    stage = run_in_terminal(tmp_path, python(READS_KEYS), play)

    assert stage.terminal.scrollback.endswith(b"ready\r\n<w>\r\n")
    assert stage.lines == []
    assert [event.kind for event in stage.events] == ["started", "finished"]


def test_ctrl_c_interrupts_the_program_alone(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.sees(b"ready")
        stage.terminal.type("\x03")
        await stage.supervisor.wait()

    stage = run_in_terminal(tmp_path, python("print('ready', flush=True); import time; time.sleep(1000)"), play)

    assert stage.supervisor.exit_codes() == {"node": -signal.SIGINT}
    assert stage.events[-1].text.startswith("has died [signal 2]; its last output:")
    assert "    KeyboardInterrupt" in stage.events[-1].text.splitlines()


def test_the_program_knows_the_size_and_its_changes(tmp_path: Path) -> None:
    code = """
import os, signal
def show(*_):
    print(*os.get_terminal_size(), flush=True)
signal.signal(signal.SIGWINCH, show)
show()
while True:
    signal.pause()
"""

    async def play(stage: Stage) -> None:
        await stage.sees(b"80 24")
        stage.terminal.resize(132, 43)
        await stage.sees(b"132 43")
        stage.terminal.resize(10**9, 0)
        await stage.sees(b"500 2")

    run_in_terminal(tmp_path, python(code), play)


def test_a_program_that_prints_without_end_fills_no_memory_and_stops_nobody(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.until(lambda: stage.terminal.first > 2 * MAX_BYTES)
        assert len(stage.terminal.scrollback) <= MAX_BYTES
        assert stage.terminal.scrollback.startswith(b"all work\r\n")
        stage.terminal.type("\x03")
        await stage.supervisor.wait()

    stage = run_in_terminal(tmp_path, ("yes", "all work"), play)

    assert stage.supervisor.exit_codes() == {"node": -signal.SIGINT}


def test_keys_that_nobody_reads_are_lost_in_the_end(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.sees(b"ready")
        for _ in range(100):
            stage.terminal.type("x" * 10_000)
        assert len(stage.terminal._keys) <= 64 * 1024  # pyright: ignore[reportPrivateUsage]

    code = "import tty, time; tty.setraw(0); print('ready', flush=True); time.sleep(1000)"
    run_in_terminal(tmp_path, python(code), play)


def test_a_program_started_again_prints_below_the_first(tmp_path: Path) -> None:
    async def run() -> Terminal:
        stage = Stage(tmp_path, python("print('once')"))
        for _ in range(2):
            await stage.job.start()
            assert await stage.job.wait() == 0
            stage.terminal.end("has finished cleanly")
        stage.tree.close()
        return stage.terminal

    terminal = asyncio.run(run())

    assert terminal.last_lines(9) == ["once", "has finished cleanly"] * 2
    assert terminal.scrollback.count(b"\x1b[?1049l") == 2


def test_signals_that_python_ignores_are_not_ignored_by_the_program(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.supervisor.wait()

    stage = run_in_terminal(tmp_path, ("grep", "SigIgn", "/proc/self/status"), play)

    ignored = int(stage.terminal.last_lines(1)[0].split()[1], 16)
    assert not ignored & (1 << (signal.SIGPIPE - 1))


def test_a_program_that_is_not_there_is_named(tmp_path: Path) -> None:
    async def run() -> None:
        stage = Stage(tmp_path, ("no_such_program",))
        try:
            with pytest.raises(JobError, match="'no_such_program' does not exist, or cannot be run"):
                await stage.job.start()
        finally:
            stage.tree.close()

    asyncio.run(run())


def test_last_lines_are_without_control_characters() -> None:
    terminal = Terminal()
    terminal.write("old\n\x1b]0;title\x07\x1b[1;31mred\x1b[0m\x08 text\n10 %\r20 %\n\n")

    assert terminal.last_lines(2) == ["red text", "20 %"]


def test_a_listener_gets_the_keys_and_no_process_is_needed() -> None:
    terminal = Terminal()
    keys: list[str] = []
    terminal.type("lost")
    terminal.listen(keys.append)
    terminal.type("i")

    assert keys == ["i"]
