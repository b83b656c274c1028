"""Positions of joints over time, as controllers take them."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import TrundleError
from trundle.ros import to_nsec
from trundle.spatial import NS_PER_S

if TYPE_CHECKING:
    from trundle.ros import Message

_MAX_POINTS = 1_000_000


class TrajectoryError(TrundleError):
    """A trajectory that cannot be executed, with the reason."""


class JointPath(Struct, frozen=True, kw_only=True, eq=False):
    """Trajectory of joints."""

    joints: tuple[str, ...]
    times_s: NDArray[np.float64]
    """(N,) since the start [s], ascending."""
    positions: NDArray[np.float64]
    """(N, joints) [rad] or [m]"""
    velocities: NDArray[np.float64] | None = None
    """(N, joints) per second; None: unknown."""
    accelerations: NDArray[np.float64] | None = None
    """(N, joints) per second²; None: unknown."""

    @property
    def duration_s(self) -> float:
        """Time of the last point [s]."""
        return float(self.times_s[-1]) if len(self.times_s) else 0.0

    def select(self, joints: Iterable[str]) -> "JointPath":
        """Return the path of those of some joints that it has."""
        wanted = set(joints)
        kept = [index for index, name in enumerate(self.joints) if name in wanted]
        return JointPath(
            joints=tuple(self.joints[index] for index in kept),
            times_s=self.times_s,
            positions=self.positions[:, kept],
            velocities=None if self.velocities is None else self.velocities[:, kept],
            accelerations=None if self.accelerations is None else self.accelerations[:, kept],
        )

    def scaled(self, speed: float) -> "JointPath":
        """Return the path at a factor of its speed."""
        return JointPath(
            joints=self.joints,
            times_s=self.times_s / speed,
            positions=self.positions,
            velocities=None if self.velocities is None else self.velocities * speed,
            accelerations=None if self.accelerations is None else self.accelerations * speed * speed,
        )

    def at(self, time_s: float) -> NDArray[np.float64]:
        """Return the positions (joints,) at a time, on straight lines between points."""
        index = int(np.searchsorted(self.times_s, time_s, side="right"))
        if index == 0 or index >= len(self.times_s):
            return self.positions[0 if index == 0 else -1]
        before, after = self.times_s[index - 1], self.times_s[index]
        share = (time_s - before) / (after - before) if after > before else 1.0
        return self.positions[index - 1] + share * (self.positions[index] - self.positions[index - 1])


def path_from_message(message: "Message") -> JointPath:
    """Read a trajectory_msgs/JointTrajectory.

    Raises:
        TrajectoryError: positions are missing or not finite, or times do not ascend.
    """
    joints = tuple(str(name) for name in message.joint_names)
    points = list(message.points)
    if len(points) > _MAX_POINTS:
        raise TrajectoryError(f"a trajectory of {len(points)} points; at most {_MAX_POINTS} are executed")
    for index, point in enumerate(points):
        if len(point.positions) != len(joints):
            raise TrajectoryError(
                f"point {index} of the trajectory has {len(point.positions)} positions for {len(joints)} joints"
            )
    times = np.array([to_nsec(point.time_from_start) / NS_PER_S for point in points], dtype=np.float64)
    positions = np.array([list(point.positions) for point in points], dtype=np.float64).reshape(
        len(points), len(joints)
    )
    if not np.all(np.isfinite(positions)):
        raise TrajectoryError("a position of the trajectory is not a finite number")
    if np.any(np.diff(times) < 0.0) or (len(times) and times[0] < 0.0):
        raise TrajectoryError("the times of the trajectory's points do not ascend")
    return JointPath(
        joints=joints,
        times_s=times,
        positions=positions,
        velocities=_column([list(point.velocities) for point in points], len(joints)),
        accelerations=_column([list(point.accelerations) for point in points], len(joints)),
    )


def _column(rows: list[list[float]], width: int) -> NDArray[np.float64] | None:
    if not rows or width == 0 or any(len(row) != width for row in rows):
        return None
    values = np.array(rows, dtype=np.float64)
    return values if np.all(np.isfinite(values)) else None


def path_message(path: JointPath, *, frame: str = "", stamp_ns: int = 0) -> dict[str, Any]:
    """Return the fields of a trajectory_msgs/JointTrajectory; the stamp 0 means at once."""
    points: list[dict[str, Any]] = []
    for index, time_s in enumerate(path.times_s):
        point: dict[str, Any] = {
            "positions": path.positions[index].tolist(),
            "time_from_start": round(float(time_s) * NS_PER_S),
        }
        if path.velocities is not None:
            point["velocities"] = path.velocities[index].tolist()
        if path.accelerations is not None:
            point["accelerations"] = path.accelerations[index].tolist()
        points.append(point)
    header = {"frame_id": frame, "stamp": stamp_ns}
    return {"header": header, "joint_names": list(path.joints), "points": points}
