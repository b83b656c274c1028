"""Result of reading a description."""

from typing import TYPE_CHECKING, Literal

from msgspec import Struct

if TYPE_CHECKING:
    from trundle.robots.model import World
    from trundle.robots.robot import Robot


class LoadedDescription(Struct, frozen=True, kw_only=True):
    """Description as read, without added ground or sun."""

    kind: Literal["world", "model", "urdf"]
    world: "World"
    """A model alone is the only model of a world with default settings."""
    robot: "Robot | None" = None
    """URDF tree, unconverted."""
    urdf: str | None = None
    """Expanded URDF text, for the parameter robot_description."""
