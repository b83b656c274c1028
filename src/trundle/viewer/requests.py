"""What a person at the page asks for.

The thread that owns the simulation or the graph polls `Viewer.requests` and obeys; the page itself changes nothing.
"""

from dataclasses import dataclass
from typing import TypeAlias


@dataclass(frozen=True, slots=True)
class Play:
    """Let time run."""


@dataclass(frozen=True, slots=True)
class Pause:
    """Hold time."""


@dataclass(frozen=True, slots=True)
class Step:
    """Pause, then take this many physics steps."""

    count: int = 1


@dataclass(frozen=True, slots=True)
class Reset:
    """Put time and poses back as loaded."""


@dataclass(frozen=True, slots=True)
class SetSpeed:
    """Pace time at this multiple of real time; infinity is flat out."""

    factor: float


@dataclass(frozen=True, slots=True)
class SetJoint:
    """A joint's slider was moved."""

    name: str
    position: float
    """[m] or [rad]"""


@dataclass(frozen=True, slots=True)
class Drive:
    """The velocity command that holds until the next one; both zero is stop."""

    linear: float
    """Forward [m/s]."""
    angular: float
    """To the left [rad/s]."""


@dataclass(frozen=True, slots=True)
class SetFixedFrame:
    """The page now draws in this frame; it has done so already."""

    name: str


@dataclass(frozen=True, slots=True)
class SetOption:
    """An option of a node was changed."""

    group: str
    name: str
    value: bool | int | float | str


@dataclass(frozen=True, slots=True)
class MoveJoystick:
    """Where a joystick is now, in the order of the usual pad's driver on Linux."""

    axes: tuple[float, ...]
    """−1 to 1; left and forwards are positive."""
    buttons: tuple[int, ...]


Request: TypeAlias = (
    Play | Pause | Step | Reset | SetSpeed | SetJoint | Drive | SetFixedFrame | SetOption | MoveJoystick
)
