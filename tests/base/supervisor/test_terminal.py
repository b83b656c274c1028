"""Programs in a `Terminal`: they receive keys, their output is bounded, and their end is shown."""

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


class Session:
    """Terminal with a supervised program."""

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


def run_in_terminal(
    folder: Path, argv: tuple[str, ...], interact: Callable[[Session], Coroutine[Any, Any, None]]
) -> Session:
    async def run() -> Session:
        session = Session(folder, argv)
        try:
            await session.supervisor.start(session.job)
            await interact(session)
        finally:
            await session.supervisor.stop()
            session.tree.close()
        return session

    return asyncio.run(run())


def python(code: str) -> tuple[str, ...]:
    return (sys.executable, "-c", code)


def test_a_program_reads_keys_without_enter(tmp_path: Path) -> None:
    async def interact(session: Session) -> None:
        await session.sees(b"ready")
        session.terminal.type("w")
        await session.supervisor.wait()

    session = run_in_terminal(tmp_path, python(READS_KEYS), interact)

    assert session.terminal.scrollback.endswith(b"ready\r\n<w>\r\n")
    assert session.lines == []
    assert [event.kind for event in session.events] == ["started", "finished"]


def test_ctrl_c_interrupts_the_program_alone(tmp_path: Path) -> None:
    async def interact(session: Session) -> None:
        await session.sees(b"ready")
        session.terminal.type("\x03")
        await session.supervisor.wait()

    session = run_in_terminal(tmp_path, python("print('ready', flush=True); import time; time.sleep(1000)"), interact)

    assert session.supervisor.exit_codes() == {"node": -signal.SIGINT}
    assert session.events[-1].text.startswith("has died [signal 2]; its last output:")
    assert "    KeyboardInterrupt" in session.events[-1].text.splitlines()


def test_the_program_sees_the_terminal_size_and_its_changes(tmp_path: Path) -> None:
    code = """
import os, signal
def show(*_):
    print(*os.get_terminal_size(), flush=True)
signal.signal(signal.SIGWINCH, show)
show()
while True:
    signal.pause()
"""

    async def interact(session: Session) -> None:
        await session.sees(b"80 24")
        session.terminal.resize(132, 43)
        await session.sees(b"132 43")
        session.terminal.resize(10**9, 0)
        await session.sees(b"500 2")

    run_in_terminal(tmp_path, python(code), interact)


def test_endless_output_is_bounded_and_can_be_interrupted(tmp_path: Path) -> None:
    async def interact(session: Session) -> None:
        await session.until(lambda: session.terminal.first > 2 * MAX_BYTES)
        assert len(session.terminal.scrollback) <= MAX_BYTES
        assert session.terminal.scrollback.startswith(b"all work\r\n")
        session.terminal.type("\x03")
        await session.supervisor.wait()

    session = run_in_terminal(tmp_path, ("yes", "all work"), interact)

    assert session.supervisor.exit_codes() == {"node": -signal.SIGINT}


def test_unread_keys_are_bounded(tmp_path: Path) -> None:
    async def interact(session: Session) -> None:
        await session.sees(b"ready")
        for _ in range(100):
            session.terminal.type("x" * 10_000)
        assert len(session.terminal._keys) <= 64 * 1024

    code = "import tty, time; tty.setraw(0); print('ready', flush=True); time.sleep(1000)"
    run_in_terminal(tmp_path, python(code), interact)


def test_a_restarted_program_appends_its_output(tmp_path: Path) -> None:
    async def run() -> Terminal:
        session = Session(tmp_path, python("print('once')"))
        for _ in range(2):
            await session.job.start()
            assert await session.job.wait() == 0
            session.terminal.end("has finished cleanly")
        session.tree.close()
        return session.terminal

    terminal = asyncio.run(run())

    assert terminal.last_lines(9) == ["once", "has finished cleanly"] * 2
    assert terminal.scrollback.count(b"\x1b[?1049l") == 2


def test_the_program_does_not_inherit_pythons_ignored_signals(tmp_path: Path) -> None:
    async def interact(session: Session) -> None:
        await session.supervisor.wait()

    session = run_in_terminal(tmp_path, ("grep", "SigIgn", "/proc/self/status"), interact)

    ignored = int(session.terminal.last_lines(1)[0].split()[1], 16)
    assert not ignored & (1 << (signal.SIGPIPE - 1))


def test_a_missing_program_is_named(tmp_path: Path) -> None:
    async def run() -> None:
        session = Session(tmp_path, ("no_such_program",))
        try:
            with pytest.raises(JobError, match="'no_such_program' does not exist, or cannot be run"):
                await session.job.start()
        finally:
            session.tree.close()

    asyncio.run(run())


def test_last_lines_have_no_control_characters() -> None:
    terminal = Terminal()
    terminal.write("old\n\x1b]0;title\x07\x1b[1;31mred\x1b[0m\x08 text\n10 %\r20 %\n\n")

    assert terminal.last_lines(2) == ["red text", "20 %"]


def test_a_listener_receives_keys_without_a_process() -> None:
    terminal = Terminal()
    keys: list[str] = []
    terminal.type("lost")
    terminal.listen(keys.append)
    terminal.type("i")

    assert keys == ["i"]
