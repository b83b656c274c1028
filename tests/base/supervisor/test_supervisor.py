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


class Stage:
    """A supervisor whose events and lines are kept."""

    def __init__(self, folder: Path, timeouts: StopTimeouts | None = None) -> None:
        self.events: list[Event] = []
        self.lines: list[tuple[str, str]] = []
        self.folder = folder
        self.seen = asyncio.Event()
        self.supervisor = Supervisor(self.events.append, timeouts=timeouts)
        self.tree = ProcessTree()

    def show(self, name: str, line: str) -> None:
        self.lines.append((name, line))
        self.seen.set()

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
            self.seen.clear()
            await asyncio.wait_for(self.seen.wait(), TIMEOUT_S)

    def kinds(self, name: str) -> list[str]:
        return [event.kind for event in self.events if event.name == name]


def on_stage(
    folder: Path, play: Callable[[Stage], Coroutine[Any, Any, None]], timeouts: StopTimeouts | None = None
) -> Stage:
    async def run() -> Stage:
        stage = Stage(folder, timeouts)
        try:
            await asyncio.wait_for(play(stage), TIMEOUT_S)
        finally:
            await stage.supervisor.stop()
            stage.tree.close()
        return stage

    return asyncio.run(run())


def test_lines_go_to_the_screen_with_the_jobs_name(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.python("a", "import os; print('out'); print(os.getcwd())")
        assert await stage.supervisor.wait() is None

    stage = on_stage(tmp_path, play)
    assert stage.lines == [("a", "out"), ("a", str(tmp_path.resolve()))]
    assert stage.kinds("a") == ["started", "finished"]
    assert stage.supervisor.exit_codes() == {"a": 0}


def test_only_errors_go_to_the_screen_when_output_is_log(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.python("a", "import sys; print('out'); print('err', file=sys.stderr)", screen=False)
        await stage.supervisor.wait()

    stage = on_stage(tmp_path, play)
    assert stage.lines == [("a", "err")]
    assert (tmp_path / "a.log").read_text() == "out\n"


def test_a_death_is_told_with_code_and_last_output(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.python("a", "print('going down'); raise SystemExit(3)")
        await stage.supervisor.wait()

    stage = on_stage(tmp_path, play)
    assert stage.events[-1].text == "has died [exit code 3]; its last output:\n    going down"


def test_a_program_that_is_not_there_is_told_and_the_rest_goes_on(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        command = ProcessCommand(name="a", argv=("/no/such/program",), env={})
        assert not await stage.supervisor.start(ProcessJob(command, stage.show, tree=stage.tree))
        assert await stage.python("b", "print('hi')")
        await stage.supervisor.wait()

    stage = on_stage(tmp_path, play)
    assert stage.events[0].text == "cannot be started: '/no/such/program' does not exist"
    assert stage.lines == [("b", "hi")]


def test_a_job_is_respawned_when_asked_for(tmp_path: Path) -> None:
    code = "import os\nn = len(os.listdir('.'))\nopen(str(n), 'w')\nprint(n)\nif n >= 2: import time; time.sleep(600)"

    async def play(stage: Stage) -> None:
        await stage.python("a", code, respawn=True)
        await stage.line("2")

    stage = on_stage(tmp_path, play)
    assert stage.kinds("a") == ["started", "finished", "respawning"] * 2 + ["started", "stopping"]


def test_without_jobs_there_is_nothing_to_wait_for(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        assert await stage.supervisor.wait() is None

    on_stage(tmp_path, play)


def test_a_required_job_ends_everything_however_cleanly_it_ends(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.python("other", "import time; time.sleep(600)")
        await stage.python("main", "pass", required=True)
        assert await stage.supervisor.wait() == "main"

    stage = on_stage(tmp_path, play)
    assert stage.kinds("main") == ["started", "finished", "required"]


@posix_only
def test_jobs_are_stopped_in_reverse_order_by_interrupt(tmp_path: Path) -> None:
    # Within the try: the interrupt may come right after the print.
    code = "import time\ntry:\n    print('up')\n    time.sleep(600)\nexcept KeyboardInterrupt: print('bye')"

    async def play(stage: Stage) -> None:
        for name in ("a", "b"):
            await stage.python(name, code)
        while len(stage.lines) < 2:
            stage.seen.clear()
            await asyncio.wait_for(stage.seen.wait(), TIMEOUT_S)

    stage = on_stage(tmp_path, play)
    assert [event.name for event in stage.events if event.kind == "stopping"] == ["b", "a"]
    assert sorted(stage.lines) == [("a", "bye"), ("a", "up"), ("b", "bye"), ("b", "up")]
    assert stage.supervisor.exit_codes() == {"a": 0, "b": 0}


@posix_only
def test_a_deaf_program_and_its_children_are_killed(tmp_path: Path) -> None:
    code = (
        "import os, signal, subprocess, sys, time\n"
        "for s in (signal.SIGINT, signal.SIGTERM): signal.signal(s, signal.SIG_IGN)\n"
        "child = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(600)'])\n"
        "print(child.pid)\ntime.sleep(600)"
    )

    async def play(stage: Stage) -> None:
        await stage.python("a", code)
        await asyncio.wait_for(stage.seen.wait(), TIMEOUT_S)

    stage = on_stage(tmp_path, play, StopTimeouts(interrupt_s=0.1, terminate_s=0.1))
    assert stage.supervisor.exit_codes() == {"a": -9}
    child = int(stage.lines[0][1])
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
        assert time.monotonic() < end, f"still there: {state}"
        time.sleep(0.01)


def test_endless_lines_do_not_fill_the_memory(tmp_path: Path) -> None:
    async def play(stage: Stage) -> None:
        await stage.python("a", "import sys; sys.stdout.write('x' * 300_000); sys.stdout.flush(); raise SystemExit(1)")
        await stage.supervisor.wait()

    stage = on_stage(tmp_path, play)
    assert len(stage.lines) > 1
    assert "".join(line for _, line in stage.lines) == "x" * 300_000


def test_a_task_ends_as_a_process_does(tmp_path: Path) -> None:
    async def fine() -> int:
        return 0

    async def refused() -> int:
        raise UsageError("no such port")

    async def play(stage: Stage) -> None:
        await stage.supervisor.start(TaskJob("fine", fine))
        await stage.supervisor.start(TaskJob("refused", refused))
        await stage.supervisor.wait()

    stage = on_stage(tmp_path, play)
    assert [event.text for event in stage.events if event.kind in ("finished", "died")] == [
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

    async def play(stage: Stage) -> None:
        await stage.supervisor.start(TaskJob("a", endless))
        await asyncio.sleep(0)

    on_stage(tmp_path, play)
    assert cleaned == [True]


@pytest.mark.slow
def test_a_task_that_ignores_its_cancellation_holds_up_nobody(tmp_path: Path) -> None:
    release = asyncio.Event()

    async def deaf() -> int:
        while not release.is_set():
            try:
                await release.wait()
            except asyncio.CancelledError:
                continue
        return 0

    async def play(stage: Stage) -> None:
        await stage.supervisor.start(TaskJob("a", deaf))
        await asyncio.sleep(0)
        await stage.supervisor.stop()
        release.set()

    on_stage(tmp_path, play, StopTimeouts(terminate_s=0.05))
