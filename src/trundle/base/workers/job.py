"""Job: work on numbered rows, which are independent of each other."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, Literal, TypeAlias, TypeVar

T = TypeVar("T")
Failure: TypeAlias = Literal["timeout", "memory", "lost"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Job(Generic[T]):
    """Work on numbered rows."""

    make: Callable[[], Callable[[int], T]]
    """Makes the function of a row, once in each process; it and the function's values are pickled."""
    time_limit_s: float | None = None
    """Wall time limit of one row [s]."""
    memory_limit_bytes: int | None = None
    """Limit of the resident memory of the process that runs a row, with its child processes."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JobResult(Generic[T]):
    """Result of one row."""

    row: int
    value: T | None = None
    """Return value of the function; None after a failure."""
    failure: Failure | None = None
    """Exceeded limit; "lost": its process ended twice."""
    reason: str = ""
    """Sentence about the failure."""
