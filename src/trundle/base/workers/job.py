"""Job: work on numbered rows, each of which any process can do by itself."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Literal, TypeAlias, TypeVar

T = TypeVar("T")
Failure: TypeAlias = Literal["timeout", "memory", "lost"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Job(Generic[T]):
    """Work on numbered rows."""

    make: Callable[[], Callable[[int], T]]
    """Makes the function of a row, once in each process; it is pickled, as is what the function returns."""
    time_limit_s: float | None = None
    """Wall time of one row."""
    memory_limit_bytes: int | None = None
    """Resident memory of the process that runs a row, and of the programs that it started."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JobResult(Generic[T]):
    """End of one row."""

    row: int
    value: T | None = None
    """Value that the function returned; None: it returned none."""
    failure: Failure | None = None
    """Limit that it exceeded; "lost": its process ended twice."""
    reason: str = ""
    """Sentence about the failure."""
