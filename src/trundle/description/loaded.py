"""What reading a description gives."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from trundle.model import World
    from trundle.robot import Robot


@dataclass(frozen=True, slots=True, kw_only=True)
class Loaded:
    """Only what the file names: no added ground or sun."""

    kind: Literal["world", "model", "urdf"]
    world: "World"
    """A model alone is the one model of a world of default settings."""
    robot: "Robot | None" = None
    """The URDF's own tree, unconverted."""
    urdf: str | None = None
    """The expanded URDF text, what goes on the parameter robot_description."""
