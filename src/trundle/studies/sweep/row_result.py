"""Outcome of one run."""

from typing import Literal

from msgspec import Struct, field

Status = Literal["ok", "failed", "error", "timeout", "memory", "lost"]


class RowResult(Struct, frozen=True, omit_defaults=True):
    """Outcome of a run."""

    row: int
    status: Status = "ok"
    """"failed": a criterion is not met; "lost": its process ended twice."""
    reason: str = ""
    time: float | None = None
    """Simulation time at its end [s]."""
    measures: dict[str, float | str | None] = field(default_factory=dict[str, "float | str | None"])
