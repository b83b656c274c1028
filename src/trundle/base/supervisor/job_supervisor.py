"""Starts, watches and respawns jobs, and stops them in reverse order."""

import asyncio
import contextlib
import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal, TypeAlias

from .job import Job, JobError, RespawnPolicy, StopTimeouts

EventKind: TypeAlias = Literal["started", "failed", "finished", "died", "respawning", "stopping", "required"]

_MIN_RUN_S = 2.0
_MAX_BACK_OFF_S = 10.0
_LAST_OUTPUT_S = 5.0
"""Timeout for a stopped job's last output [s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Event:
    """An event of a job, with its message."""

    kind: EventKind
    name: str
    text: str
    code: int | None = None
    """Exit code, for 'finished' and 'died'."""


@dataclass(slots=True)
class _WatchedJob:
    job: Job
    policy: RespawnPolicy
    watch: asyncio.Task[None] | None = None
    code: int | None = None


class Supervisor:
    """Supervises jobs on the running asyncio loop."""

    def __init__(self, listener: Callable[[Event], None], *, timeouts: StopTimeouts | None = None) -> None:
        """`listener` is called with each event, on the loop's thread."""
        self._listener = listener
        self._timeouts = timeouts or StopTimeouts()
        self._watched: dict[str, _WatchedJob] = {}
        self._ended = asyncio.Event()
        """Set while no job runs, also initially."""
        self._ended.set()
        self._required: str | None = None
        self._stop = asyncio.Event()

    async def start(self, job: Job, policy: RespawnPolicy | None = None) -> bool:
        """Start a job; return True if it runs. A failure to start is reported as an event."""
        assert job.name not in self._watched, f"two jobs named {job.name!r}"
        watched = _WatchedJob(job, policy or RespawnPolicy())
        self._watched[job.name] = watched
        if self._required is None:
            self._ended.clear()
        runs = await self._start(watched)
        if runs:
            watched.watch = asyncio.create_task(self._watch(watched), name=f"watch {job.name}")
        else:
            self._end(watched, 1)
        return runs

    async def wait(self) -> str | None:
        """Wait until a required job has ended (return its name) or no job is left (return None)."""
        await self._ended.wait()
        return self._required

    async def stop(self) -> None:
        """Stop all jobs, the last one first."""
        self._stop.set()
        running = [w for w in reversed(self._watched.values()) if w.watch is not None and not w.watch.done()]
        for watched in running:
            self._notify("stopping", watched, "killing on exit")
        await asyncio.gather(*(watched.job.stop(self._timeouts) for watched in running))
        if watches := [watched.watch for watched in running if watched.watch is not None]:
            _, unresponsive = await asyncio.wait(watches, timeout=_LAST_OUTPUT_S)
            for watch in unresponsive:  # a task that ignores its cancellation is abandoned
                watch.cancel()
        self._ended.set()

    def exit_codes(self) -> dict[str, int | None]:
        """Last exit code of each job; None while it runs."""
        return {name: watched.code for name, watched in self._watched.items()}

    async def _start(self, watched: _WatchedJob) -> bool:
        try:
            description = await watched.job.start()
        except JobError as error:
            self._notify("failed", watched, f"cannot be started: {error}")
            return False
        watched.code = None
        self._notify("started", watched, f"started {description}")
        return True

    async def _watch(self, watched: _WatchedJob) -> None:
        quick_deaths = 0
        while True:
            since = time.monotonic()
            code = await watched.job.wait()
            if self._stop.is_set():
                watched.code = code
                return
            self._report_end(watched, code)
            if not watched.policy.respawn:
                self._end(watched, code)
                return
            # Back off: a program that dies at once would otherwise start hundreds of times a second.
            quick_deaths = quick_deaths + 1 if time.monotonic() - since < _MIN_RUN_S else 0
            back_off_s = min(0.1 * 2**quick_deaths, _MAX_BACK_OFF_S) if quick_deaths else 0.0
            delay_s = max(watched.policy.respawn_delay_s, back_off_s)
            self._notify("respawning", watched, f"respawning in {delay_s:.1f} s" if delay_s else "respawning")
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._stop.wait(), delay_s)
            if self._stop.is_set() or not await self._start(watched):
                self._end(watched, code)
                return
            if self._stop.is_set():  # stop() was called during the start
                await watched.job.stop(self._timeouts)

    def _report_end(self, watched: _WatchedJob, code: int) -> None:
        if code == 0:
            self._notify("finished", watched, "has finished cleanly", code)
            return
        cause = f"exit code {code}" if code > 0 else f"signal {-code}"
        last = watched.job.last_output()
        output = "; its last output:\n" + "\n".join(f"    {line}" for line in last) if last else ""
        self._notify("died", watched, f"has died [{cause}]{output}", code)

    def _end(self, watched: _WatchedJob, code: int) -> None:
        watched.code = code
        if watched.policy.required and self._required is None:
            self._required = watched.job.name
            self._notify("required", watched, "is required; everything stops")
            self._ended.set()
        if all(w.code is not None for w in self._watched.values()):
            self._ended.set()

    def _notify(self, kind: EventKind, watched: _WatchedJob, text: str, code: int | None = None) -> None:
        self._listener(Event(kind=kind, name=watched.job.name, text=text, code=code))
