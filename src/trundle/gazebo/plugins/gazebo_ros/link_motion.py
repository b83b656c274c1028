"""Motion of a link in its own axes, for imu plugins."""

from dataclasses import dataclass

from trundle.sim.simulation import LinkHandle
from trundle.spatial import Pose, Quaternion, Vector3


@dataclass(frozen=True, slots=True, kw_only=True)
class MotionSample:
    """Motion of a link at one time."""

    orientation: Quaternion
    """world_from_link, wxyz."""
    rate: Vector3
    """Angular velocity in the link's axes [rad/s]."""
    acceleration: Vector3
    """Mean acceleration of the link's origin since the last sample, in the link's axes, without gravity [m/s²]."""

    def in_link(self, vector: Vector3) -> Vector3:
        """Rotate a vector from world axes to the link's."""
        return Pose(quaternion=self.orientation).inverse().transform_vector(vector)


class LinkMotion:
    """Sampler of a link's motion."""

    def __init__(self, link: LinkHandle) -> None:
        self._link = link
        self._last: tuple[int, Vector3] | None = None

    def sample(self, time_ns: int) -> MotionSample:
        """Sample the current motion; the first sample's acceleration is zero."""
        twist, orientation = self._link.twist, self._link.pose.quaternion
        last, self._last = self._last, (time_ns, twist.linear)
        ax = ay = az = 0.0
        if last is not None and time_ns > last[0]:
            elapsed = (time_ns - last[0]) / 1e9
            ax, ay, az = (
                (current - previous) / elapsed for current, previous in zip(twist.linear, last[1], strict=True)
            )
        link_from_world = Pose(quaternion=orientation).inverse()
        return MotionSample(
            orientation=orientation,
            rate=link_from_world.transform_vector(twist.angular),
            acceleration=link_from_world.transform_vector((ax, ay, az)),
        )
