"""Result of a run."""

from typing import Literal

from msgspec import Struct, field

Status = Literal["ok", "failed", "error", "timeout", "memory", "lost"]


class RowResult(Struct, frozen=True, omit_defaults=True):
    """Result of a run."""

    row: int
    status: Status = "ok"
    """"failed": a criterion is violated; "lost": the run's process ended twice."""
    reason: str = ""
    time: float | None = None
    """Simulation time at the end [s]."""
    measures: dict[str, float | str | None] = field(default_factory=dict[str, "float | str | None"])
