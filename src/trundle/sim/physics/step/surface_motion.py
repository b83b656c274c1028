"""Moving and slipping surfaces: belts, tracks and wheels.

ODE has motion1, slip1 and slip2 for them; `cpp/contact/surface_motion.cc` and `cpp/contact/friction_slip.cc` act on
each contact of such a link.
"""

from typing import TypeAlias

from msgspec import Struct

from trundle.spatial import ZERO, Vector3

_DIRECTION, _TRACK, _WHEEL = 1.0, 2.0, 3.0


class SurfaceMotion(Struct, frozen=True, kw_only=True):
    """Surface motion of a link at all its contacts."""

    direction: Vector3
    """First friction direction, along which mu applies, world axes; its normal component is removed."""
    speed: float = 0.0
    """Speed of the surface relative to its link, along the first direction [m/s]."""
    slip: float = 0.0
    """Slip along the first direction per friction force, summed over the link's contacts [m/s/N]."""
    slip_across: float = 0.0
    """Slip across the first direction [m/s/N]."""

    @property
    def row(self) -> tuple[float, ...]:
        """Row of the motions table."""
        return (_DIRECTION, *self.direction, self.speed, self.slip, self.slip_across, 0.0, *ZERO)


class TrackMotion(Struct, frozen=True, kw_only=True):
    """Track: its belt runs around it and skids about the robot's centre of rotation."""

    axis: Vector3
    """Axis of the belt's rotation, to the robot's left; world axes."""
    speed: float
    """Belt speed [m/s]; positive is forwards."""
    centre: Vector3 | None = None
    """Centre of rotation in the world [m]; friction is largest across the direction to it. None: straight on."""

    @property
    def row(self) -> tuple[float, ...]:
        """Row of the motions table."""
        is_turning = self.centre is not None
        return (_TRACK, *self.axis, self.speed, 0.0, 0.0, float(is_turning), *(self.centre or ZERO))


class WheelGrip(Struct, frozen=True, kw_only=True):
    """Tyre whose slip grows with its speed."""

    axis: Vector3
    """Rotation axis in the link's frame, also the first friction direction."""
    slip: float
    """Slip along the axis per friction force and speed of rotation [m/s/N per rad/s], for all the link's contacts."""
    slip_across: float
    """Slip across the axis, along the rolling direction [m/s/N per rad/s]."""

    @property
    def row(self) -> tuple[float, ...]:
        """Row of the motions table."""
        return (_WHEEL, *self.axis, 0.0, self.slip, self.slip_across, 0.0, *ZERO)


LinkGrip: TypeAlias = SurfaceMotion | TrackMotion | WheelGrip
