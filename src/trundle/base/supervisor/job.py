"""Jobs of the supervisor: start, exit code, stop."""

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True, kw_only=True)
class StopTimeouts:
    """Timeouts of the steps of stopping a job [s]; defaults as in roslaunch."""

    interrupt_s: float = 15.0
    terminate_s: float = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RespawnPolicy:
    """Reaction to a job's end."""

    respawn: bool = False
    respawn_delay_s: float = 0.0
    required: bool = False
    """True: the job's end, even with exit code 0, ends the launch."""


class Job(Protocol):
    """A program or task, restarted after its end if respawned."""

    @property
    def name(self) -> str:
        """Name in messages; unique in a supervisor."""
        ...

    async def start(self) -> str:
        """Start, and return a description for messages: 'with pid [4711]'.

        Raises:
            JobError: the job cannot be started.
        """
        ...

    async def wait(self) -> int:
        """Wait for the end and return the exit code; negative: the signal that ended it."""
        ...

    async def stop(self, timeouts: StopTimeouts) -> None:
        """Stop with escalating signals until no process of the job is left. No-op if it is not running."""
        ...

    def last_output(self) -> list[str]:
        """Return the last lines of output, oldest first."""
        ...


class JobError(Exception):
    """A job cannot be started; the text gives the reason."""
