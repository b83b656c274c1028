"""Jobs are started, watched, respawned and stopped."""

import asyncio
import os
import sys
import time
from collections.abc import Callable, Coroutine
from pathlib import Path
from typing import Any

import pytest

from trundle.base.diagnostics import UsageError
from trundle.base.supervisor import (
    Event,
    ProcessCommand,
    ProcessJob,
    ProcessTree,
    RespawnPolicy,
    StopTimeouts,
    Supervisor,
    TaskJob,
)

TIMEOUT_S = 60.0
posix_only = pytest.mark.skipif(os.name != "posix", reason="signals and process groups are POSIX")


class Recording:
    """Supervisor with recorded events and output lines."""

    def __init__(self, folder: Path, timeouts: StopTimeouts | None = None) -> None:
        self.events: list[Event] = []
        self.lines: list[tuple[str, str]] = []
        self.folder = folder
        self.has_output = asyncio.Event()
        self.supervisor = Supervisor(self.events.append, timeouts=timeouts)
        self.tree = ProcessTree()

    def show(self, name: str, line: str) -> None:
        self.lines.append((name, line))
        self.has_output.set()

    async def python(self, name: str, code: str, *, screen: bool = True, **policy: Any) -> bool:
        command = ProcessCommand(
            name=name,
            argv=(sys.executable, "-u", "-c", code),
            env=dict(os.environ),
            cwd=self.folder,
            output="screen" if screen else "log",
            log_file=self.folder / f"{name}.log",
        )
        return await self.supervisor.start(ProcessJob(command, self.show, tree=self.tree), RespawnPolicy(**policy))

    async def line(self, text: str) -> None:
        while text not in [line for _, line in self.lines]:
            self.has_output.clear()
            await asyncio.wait_for(self.has_output.wait(), TIMEOUT_S)

    def kinds(self, name: str) -> list[str]:
        return [event.kind for event in self.events if event.name == name]


def run_jobs(
    folder: Path, start_jobs: Callable[[Recording], Coroutine[Any, Any, None]], timeouts: StopTimeouts | None = None
) -> Recording:
    async def run() -> Recording:
        recording = Recording(folder, timeouts)
        try:
            await asyncio.wait_for(start_jobs(recording), TIMEOUT_S)
        finally:
            await recording.supervisor.stop()
            recording.tree.close()
        return recording

    return asyncio.run(run())


def test_lines_go_to_the_screen_with_the_jobs_name(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        await recording.python("a", "import os; print('out'); print(os.getcwd())")
        assert await recording.supervisor.wait() is None

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.lines == [("a", "out"), ("a", str(tmp_path.resolve()))]
    assert recording.kinds("a") == ["started", "finished"]
    assert recording.supervisor.exit_codes() == {"a": 0}


def test_only_errors_go_to_the_screen_when_output_is_log(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        await recording.python("a", "import sys; print('out'); print('err', file=sys.stderr)", screen=False)
        await recording.supervisor.wait()

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.lines == [("a", "err")]
    assert (tmp_path / "a.log").read_text() == "out\n"


def test_a_death_is_reported_with_exit_code_and_last_output(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        await recording.python("a", "print('going down'); raise SystemExit(3)")
        await recording.supervisor.wait()

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.events[-1].text == "has died [exit code 3]; its last output:\n    going down"


def test_a_missing_program_is_reported_and_other_jobs_run(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        command = ProcessCommand(name="a", argv=("/no/such/program",), env={})
        assert not await recording.supervisor.start(ProcessJob(command, recording.show, tree=recording.tree))
        assert await recording.python("b", "print('hi')")
        await recording.supervisor.wait()

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.events[0].text == "cannot be started: '/no/such/program' does not exist"
    assert recording.lines == [("b", "hi")]


def test_a_job_is_respawned_by_its_policy(tmp_path: Path) -> None:
    code = "import os\nn = len(os.listdir('.'))\nopen(str(n), 'w')\nprint(n)\nif n >= 2: import time; time.sleep(600)"

    async def start_jobs(recording: Recording) -> None:
        await recording.python("a", code, respawn=True)
        await recording.line("2")

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.kinds("a") == ["started", "finished", "respawning"] * 2 + ["started", "stopping"]


def test_wait_returns_at_once_without_jobs(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        assert await recording.supervisor.wait() is None

    run_jobs(tmp_path, start_jobs)


def test_a_required_job_ends_the_wait_even_with_exit_code_0(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        await recording.python("other", "import time; time.sleep(600)")
        await recording.python("main", "pass", required=True)
        assert await recording.supervisor.wait() == "main"

    recording = run_jobs(tmp_path, start_jobs)
    assert recording.kinds("main") == ["started", "finished", "required"]


@posix_only
def test_jobs_are_stopped_in_reverse_order_by_interrupt(tmp_path: Path) -> None:
    # In the try block, as the interrupt may arrive right after the print.
    code = "import time\ntry:\n    print('up')\n    time.sleep(600)\nexcept KeyboardInterrupt: print('bye')"

    async def start_jobs(recording: Recording) -> None:
        for name in ("a", "b"):
            await recording.python(name, code)
        while len(recording.lines) < 2:
            recording.has_output.clear()
            await asyncio.wait_for(recording.has_output.wait(), TIMEOUT_S)

    recording = run_jobs(tmp_path, start_jobs)
    assert [event.name for event in recording.events if event.kind == "stopping"] == ["b", "a"]
    assert sorted(recording.lines) == [("a", "bye"), ("a", "up"), ("b", "bye"), ("b", "up")]
    assert recording.supervisor.exit_codes() == {"a": 0, "b": 0}


@posix_only
def test_a_program_that_ignores_signals_is_killed_with_its_children(tmp_path: Path) -> None:
    code = (
        "import os, signal, subprocess, sys, time\n"
        "for s in (signal.SIGINT, signal.SIGTERM): signal.signal(s, signal.SIG_IGN)\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(600)'])\n"
        "print(child.pid)\ntime.sleep(600)"
    )

    async def start_jobs(recording: Recording) -> None:
        await recording.python("a", code)
        await asyncio.wait_for(recording.has_output.wait(), TIMEOUT_S)

    recording = run_jobs(tmp_path, start_jobs, StopTimeouts(interrupt_s=0.1, terminate_s=0.1))
    assert recording.supervisor.exit_codes() == {"a": -9}
    child = int(recording.lines[0][1])
    wait_for_end(Path(f"/proc/{child}/stat"))


def wait_for_end(status: Path) -> None:
    """Wait until a killed process has ended; a zombie counts as ended."""
    end = time.monotonic() + TIMEOUT_S
    while True:
        try:
            state = status.read_text().rpartition(")")[2].split()[0]
        except (FileNotFoundError, ProcessLookupError):
            return
        if state == "Z":
            return
        assert time.monotonic() < end, f"still alive: {state}"
        time.sleep(0.01)


def test_endless_lines_do_not_fill_the_memory(tmp_path: Path) -> None:
    async def start_jobs(recording: Recording) -> None:
        await recording.python(
            "a", "import sys; sys.stdout.write('x' * 300_000); sys.stdout.flush(); raise SystemExit(1)"
        )
        await recording.supervisor.wait()

    recording = run_jobs(tmp_path, start_jobs)
    assert len(recording.lines) > 1
    assert "".join(line for _, line in recording.lines) == "x" * 300_000


def test_tasks_report_the_same_events_as_processes(tmp_path: Path) -> None:
    async def fine() -> int:
        return 0

    async def refused() -> int:
        raise UsageError("no such port")

    async def start_jobs(recording: Recording) -> None:
        await recording.supervisor.start(TaskJob("fine", fine))
        await recording.supervisor.start(TaskJob("refused", refused))
        await recording.supervisor.wait()

    recording = run_jobs(tmp_path, start_jobs)
    assert [event.text for event in recording.events if event.kind in ("finished", "died")] == [
        "has finished cleanly",
        "has died [exit code 1]; its last output:\n    no such port",
    ]


def test_a_task_is_cancelled_on_stop(tmp_path: Path) -> None:
    cleaned: list[bool] = []

    async def endless() -> int:
        try:
            await asyncio.Event().wait()
        finally:
            cleaned.append(True)
        return 0

    async def start_jobs(recording: Recording) -> None:
        await recording.supervisor.start(TaskJob("a", endless))
        await asyncio.sleep(0)

    run_jobs(tmp_path, start_jobs)
    assert cleaned == [True]


@pytest.mark.slow
def test_a_task_that_ignores_its_cancellation_does_not_block_stop(tmp_path: Path) -> None:
    release = asyncio.Event()

    async def stubborn() -> int:
        while not release.is_set():
            try:
                await release.wait()
            except asyncio.CancelledError:
                continue
        return 0

    async def start_jobs(recording: Recording) -> None:
        await recording.supervisor.start(TaskJob("a", stubborn))
        await asyncio.sleep(0)
        await recording.supervisor.stop()
        release.set()

    run_jobs(tmp_path, start_jobs, StopTimeouts(terminate_s=0.05))
