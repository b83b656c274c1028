"""Surfaces that move under a contact, or give way to a force: belts, tracks, slipping wheels.

ODE has motion1, slip1 and slip2 for them; `cpp/surface_motion.cc` and `cpp/friction_slip.cc` act on each contact of a
link that has one.
"""

from typing import TypeAlias

from msgspec import Struct

from trundle.spatial import ZERO, Vector3

_DIRECTION, _TRACK, _WHEEL = 1.0, 2.0, 3.0


class SurfaceMotion(Struct, frozen=True, kw_only=True):
    """How a link's surface holds on, wherever it touches."""

    direction: Vector3
    """First friction direction, the one that mu counts along, world axes; what is normal to the surface is left out."""
    speed: float = 0.0
    """[m/s] At which the surface runs past its own link, along the first direction."""
    slip: float = 0.0
    """[m/s/N] Speed that a friction force of all the link's contacts causes, along the first direction."""
    slip_across: float = 0.0
    """[m/s/N] Across it."""

    @property
    def row(self) -> tuple[float, ...]:
        """As a row of the table of motions."""
        return (_DIRECTION, *self.direction, self.speed, self.slip, self.slip_across, 0.0, *ZERO)


class TrackMotion(Struct, frozen=True, kw_only=True):
    """How a track holds on: its belt runs around it, and skids about the point that the robot turns about."""

    axis: Vector3
    """About which the belt turns, to the robot's left; world axes."""
    speed: float
    """[m/s] Of the belt; above zero the robot goes forwards."""
    centre: Vector3 | None = None
    """Where in the world the robot turns about [m]: friction holds best across the way to it. None: straight on."""

    @property
    def row(self) -> tuple[float, ...]:
        """As a row of the table of motions."""
        is_turning = self.centre is not None
        return (_TRACK, *self.axis, self.speed, 0.0, 0.0, float(is_turning), *(self.centre or ZERO))


class WheelGrip(Struct, frozen=True, kw_only=True):
    """How a tyre holds on: the faster it turns, the more a force lets it slip."""

    axis: Vector3
    """It turns about, in the link's frame, and its first friction direction."""
    slip: float
    """[m/s/N per rad/s] Speed along the axis that a friction force of all the link's contacts causes."""
    slip_across: float
    """[m/s/N per rad/s] Across it, along the wheel's way."""

    @property
    def row(self) -> tuple[float, ...]:
        """As a row of the table of motions."""
        return (_WHEEL, *self.axis, 0.0, self.slip, self.slip_across, 0.0, *ZERO)


LinkGrip: TypeAlias = SurfaceMotion | TrackMotion | WheelGrip
