"""What reading a description gives."""

from typing import TYPE_CHECKING, Literal

from msgspec import Struct

if TYPE_CHECKING:
    from trundle.model import World
    from trundle.robot import Robot


class LoadedDescription(Struct, frozen=True, kw_only=True):
    """Only what the file names: no added ground or sun."""

    kind: Literal["world", "model", "urdf"]
    world: "World"
    """A model alone is the one model of a world of default settings."""
    robot: "Robot | None" = None
    """The URDF's own tree, unconverted."""
    urdf: str | None = None
    """The expanded URDF text, what goes on the parameter robot_description."""
