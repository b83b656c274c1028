"""Interfaces of the driver's joints and controllers."""

from dataclasses import dataclass, field
from typing import Protocol


@dataclass(slots=True, kw_only=True)
class JointReading:
    """State of one joint, as published on joint_states."""

    name: str
    position: float = 0.0
    """Position [rad], [m] for linear joints."""
    velocity: float = 0.0
    """Velocity [rad/s], [m/s] for linear joints."""


@dataclass(frozen=True, slots=True, kw_only=True)
class DiagnosticStatus:
    """One entry of /diagnostics."""

    name: str
    message: str = "OK"
    values: tuple[tuple[str, str], ...] = field(default=())


class ArbotixJoint(Protocol):
    """A joint whose position follows commands."""

    reading: JointReading

    def interpolate(self, rate_hz: float) -> None:
        """Move by one cycle at `rate_hz`."""
        ...

    def status(self) -> DiagnosticStatus: ...


class ArbotixController(Protocol):
    """A controller updated in every cycle of the driver's loop."""

    readings: list[JointReading]

    def update(self) -> None: ...

    def status(self) -> DiagnosticStatus | None: ...
