"""What the supervisor watches over: something that starts, ends with an exit code, and can be stopped."""

from dataclasses import dataclass
from typing import Protocol


@dataclass(frozen=True, slots=True, kw_only=True)
class StopTimeouts:
    """How long each way of asking a job to end may take [s]; the defaults are roslaunch's."""

    interrupt_s: float = 15.0
    terminate_s: float = 2.0


@dataclass(frozen=True, slots=True, kw_only=True)
class RespawnPolicy:
    """What a job's end means."""

    respawn: bool = False
    respawn_delay_s: float = 0.0
    required: bool = False
    """Its end, however clean, ends everything."""


class Job(Protocol):
    """One program or task; started again after its end where it is respawned."""

    @property
    def name(self) -> str:
        """How messages call it; unique among the jobs of a supervisor."""
        ...

    async def start(self) -> str:
        """Start, and return how to speak of what runs now: 'with pid [4711]'.

        Raises:
            JobError: it cannot be started.
        """
        ...

    async def wait(self) -> int:
        """Return the exit code once it has ended; negative: the signal that ended it."""
        ...

    async def stop(self, timeouts: StopTimeouts) -> None:
        """Ask it to end, ever more firmly; afterwards nothing of it is left. Harmless when it does not run."""
        ...

    def last_output(self) -> list[str]:
        """The last lines it wrote, oldest first."""
        ...


class JobError(Exception):
    """A job cannot be started; the text says why."""
