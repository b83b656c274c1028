"""What the driver's joints and controllers have in common."""

from dataclasses import dataclass, field
from typing import Protocol


@dataclass(slots=True, kw_only=True)
class JointReading:
    """One joint as published on joint_states."""

    name: str
    position: float = 0.0
    """[rad], linear joints [m]."""
    velocity: float = 0.0
    """[rad/s], linear joints [m/s]."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagnosticStatus:
    """One entry of /diagnostics."""

    name: str
    message: str = "OK"
    values: tuple[tuple[str, str], ...] = field(default=())


class ArbotixJoint(Protocol):
    """Something with a position that follows commands."""

    reading: JointReading

    def interpolate(self, rate_hz: float) -> None:
        """Move by one cycle of `rate_hz`."""
        ...

    def status(self) -> DiagnosticStatus: ...


class ArbotixController(Protocol):
    """Something that is updated in every pass of the driver's loop."""

    readings: list[JointReading]

    def update(self) -> None: ...

    def status(self) -> DiagnosticStatus | None: ...
