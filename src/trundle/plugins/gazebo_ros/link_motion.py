"""How a link moves, in its own axes, as plugins that are imus tell it."""

from dataclasses import dataclass

from trundle.simulation import LinkHandle
from trundle.spatial import Pose, Quaternion, Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionSample:
    """One moment of a link."""

    orientation: Quaternion
    """world_from_link, wxyz."""
    rate: Vector3
    """In the link's axes [rad/s]."""
    acceleration: Vector3
    """Of the link's origin, the mean since the last look, in the link's axes, without gravity [m/s²]."""

    def in_link(self, vector: Vector3) -> Vector3:
        """A vector of the world in the link's axes."""
        return Pose(quaternion=self.orientation).inverse().transform_vector(vector)


class LinkMotion:
    """Looks at a link now and then."""

    def __init__(self, link: LinkHandle) -> None:
        self._link = link
        self._before: tuple[int, Vector3] | None = None

    def sample(self, time_ns: int) -> MotionSample:
        """How it moves now; the first look knows no acceleration."""
        twist, orientation = self._link.twist, self._link.pose.quaternion
        before, self._before = self._before, (time_ns, twist.linear)
        ax = ay = az = 0.0
        if before is not None and time_ns > before[0]:
            elapsed = (time_ns - before[0]) / 1e9
            ax, ay, az = ((now - then) / elapsed for now, then in zip(twist.linear, before[1], strict=True))
        back = Pose(quaternion=orientation).inverse()
        return MotionSample(
            orientation=orientation,
            rate=back.transform_vector(twist.angular),
            acceleration=back.transform_vector((ax, ay, az)),
        )
