"""Sources of a filter: the parameters of each sensor, and measurements from its messages."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import to_nsec
from trundle.spatial import (
    IDENTITY_QUATERNION,
    Pose,
    Quaternion,
    conjugate,
    matrix_from_quaternion,
    quaternion_product,
    rotate,
)

from .kalman import SIZE, Array, Measurement

KINDS = {
    "odom": "nav_msgs/Odometry",
    "pose": "geometry_msgs/PoseWithCovarianceStamped",
    "twist": "geometry_msgs/TwistWithCovarianceStamped",
    "imu": "sensor_msgs/Imu",
}
"""Beginning of the parameter → type of its topic."""
_MAX_SOURCES = 100
_FLAT_VARIANCE = 1e-6
"""Variance of the elements that two_d_mode holds at zero."""
_FLAT = {2, 3, 4, 8, 9, 10, 14}
_SMALLEST_MASK = 1e-6


class FrameLookup(Protocol):
    """Finds the pose of a frame in another."""

    def __call__(self, target: str, source: str, stamp_ns: int, /) -> Pose | None:
        """`target_from_source`; None: it is not known."""
        ...


@dataclass(slots=True, kw_only=True)
class Source:
    """One sensor's topic."""

    name: str
    """odom0, imu1, …"""
    topic: str
    mask: Array
    """Used elements of the state: (15,) of 0 and 1."""
    differential: bool
    relative: bool
    max_pose_distance: float
    max_twist_distance: float
    max_acceleration_distance: float
    removes_gravity: bool
    previous: tuple[int, Pose, Array] | None = field(default=None)
    """Stamp, pose and its covariance (6, 6) of the last message, for differences."""
    first: Pose | None = field(default=None)

    @property
    def kind(self) -> str:
        """Beginning of its name: odom, pose, twist or imu."""
        return self.name.rstrip("0123456789")

    def reset(self) -> None:
        """Forget earlier messages."""
        self.previous = self.first = None


def read_sources(settings: RosParameters) -> list[Source]:
    """Read odom0, odom1, …, pose0, …, twist0, …, imu0, … with their options.

    Raises:
        ParamError: a parameter is invalid.
    """
    sources: list[Source] = []
    for kind in KINDS:
        for number in range(_MAX_SOURCES):
            name = f"{kind}{number}"
            if name not in settings:
                break
            rejection = settings.number(f"{name}_rejection_threshold", math.inf)
            sources.append(
                Source(
                    name=name,
                    topic=settings.text(name),
                    mask=np.array([float(value) for value in _config(settings, f"{name}_config")]),
                    differential=settings.flag(f"{name}_differential", default=False),
                    relative=settings.flag(f"{name}_relative", default=False),
                    max_pose_distance=settings.number(f"{name}_pose_rejection_threshold", rejection),
                    max_twist_distance=settings.number(f"{name}_twist_rejection_threshold", rejection),
                    max_acceleration_distance=settings.number(
                        f"{name}_linear_acceleration_rejection_threshold", math.inf
                    ),
                    removes_gravity=settings.flag(f"{name}_remove_gravitational_acceleration", default=False),
                )
            )
    return sources


def _config(settings: RosParameters, name: str) -> Sequence[bool]:
    values = settings.items(name)
    if len(values) != SIZE or not all(isinstance(value, bool | int) for value in values):
        raise ParamError(f"parameter {settings.where}/{name} must be {SIZE} truth values, got {values!r}")
    return [bool(value) for value in values]


@dataclass(frozen=True, slots=True, kw_only=True)
class MessageReader:
    """Converts messages to measurements in the filter's frames."""

    world: str
    base: str
    two_d: bool
    gravity: float
    """[m/s²]"""
    find: FrameLookup

    def read(self, source: Source, message: Any, orientation: Quaternion) -> list[Measurement]:
        """Return the measurements in a message; `orientation` is the filter's, for gravity without the imu's own."""
        match source.kind:
            case "odom":
                child = message.child_frame_id or self.base
                return [*self._pose(source, message, message.pose), *self._twist(source, message, message.twist, child)]
            case "pose":
                return self._pose(source, message, message.pose)
            case "twist":
                return self._twist(source, message, message.twist, message.header.frame_id or self.base)
            case _:
                return self._imu(source, message, orientation)

    def _pose(self, source: Source, message: Any, posed: Any) -> list[Measurement]:
        p, quaternion = posed.pose.position, _quaternion(posed.pose.orientation)
        (x, y, z), is_known = _finite([p.x, p.y, p.z])
        wanted = source.mask[:6] * [*is_known, 1.0, 1.0, 1.0]
        if quaternion is None:
            wanted[3:] = 0.0
        if not wanted.any():
            return []
        pose = Pose((x, y, z), quaternion or IDENTITY_QUATERNION)
        stamp_ns, frame = to_nsec(message.header.stamp), message.header.frame_id or self.world
        covariance = _square(posed.covariance, 6)
        if source.differential:
            is_whole = bool((wanted == source.mask[:6]).all())
            return self._difference(source, stamp_ns, pose, covariance) if is_whole else []
        if source.relative:
            source.first = source.first or pose
            pose = source.first.inverse() @ pose
        world_from_frame = self.find(self.world, frame, stamp_ns)
        if world_from_frame is None:
            return []
        pose = world_from_frame @ pose
        rotation = _blocks(matrix_from_quaternion(world_from_frame.quaternion), 2)
        values = np.array([*pose.position, *pose.rpy])
        mask = np.abs(rotation @ wanted) > _SMALLEST_MASK
        return self._measured(stamp_ns, 0, values, rotation @ covariance @ rotation.T, mask, source.max_pose_distance)

    def _difference(self, source: Source, stamp_ns: int, pose: Pose, covariance: Array) -> list[Measurement]:
        """Return the twist between a pose and the last one."""
        last, source.previous = source.previous, (stamp_ns, pose, covariance)
        if last is None or stamp_ns <= last[0]:
            return []
        dt = (stamp_ns - last[0]) / 1e9
        moved = last[1].inverse() @ pose
        values = np.array([*moved.position, *moved.rpy]) / dt
        spread = (covariance + last[2]) * dt
        return self._measured(stamp_ns, 6, values, spread, source.mask[:6] > 0.0, source.max_twist_distance)

    def _twist(self, source: Source, message: Any, twisted: Any, frame: str) -> list[Measurement]:
        linear, angular = twisted.twist.linear, twisted.twist.angular
        values = np.array([linear.x, linear.y, linear.z, angular.x, angular.y, angular.z])
        covariance = _square(twisted.covariance, 6)
        return self._body_twist(source, to_nsec(message.header.stamp), frame, values, covariance)

    def _body_twist(
        self, source: Source, stamp_ns: int, frame: str, values: Array, covariance: Array
    ) -> list[Measurement]:
        """Express a twist of a frame on the robot as the base's."""
        values, is_known = _finite(values)
        wanted = source.mask[6:12] * is_known
        base_from_frame = self.find(self.base, frame, stamp_ns) if wanted.any() else None
        if base_from_frame is None:
            return []
        rotation = _blocks(matrix_from_quaternion(base_from_frame.quaternion), 2)
        turned = rotation @ values
        turned[:3] += np.cross(np.array(base_from_frame.position), turned[3:])
        mask = np.abs(rotation @ wanted) > _SMALLEST_MASK
        spread = rotation @ covariance @ rotation.T
        return self._measured(stamp_ns, 6, turned, spread, mask, source.max_twist_distance)

    def _imu(self, source: Source, message: Any, orientation: Quaternion) -> list[Measurement]:
        """Read orientation, angular velocity and acceleration; covariances that begin with -1 mark absent ones."""
        stamp_ns, frame = to_nsec(message.header.stamp), message.header.frame_id or self.base
        base_from_imu = self.find(self.base, frame, stamp_ns)
        if base_from_imu is None:
            return []
        found: list[Measurement] = []
        own = _quaternion(message.orientation)
        if own is not None and message.orientation_covariance[0] != -1.0:
            orientation = quaternion_product(own, conjugate(base_from_imu.quaternion))
            if source.mask[3:6].any():
                found += self._orientation(source, stamp_ns, orientation, _square(message.orientation_covariance, 3))
        rate, rates = message.angular_velocity, np.zeros((6, 6))
        rates[3:, 3:] = _square(message.angular_velocity_covariance, 3)
        if rates[3, 3] != -1.0:
            turning = np.array([0.0, 0.0, 0.0, rate.x, rate.y, rate.z])
            found += self._body_twist(source, stamp_ns, frame, turning, rates)
        spread = _square(message.linear_acceleration_covariance, 3)
        if source.mask[12:].any() and spread[0, 0] != -1.0:
            acceleration = message.linear_acceleration
            rotation = matrix_from_quaternion(base_from_imu.quaternion)
            values = rotation @ np.array([acceleration.x, acceleration.y, acceleration.z])
            if source.removes_gravity:
                values = values - np.array(rotate(conjugate(orientation), (0.0, 0.0, self.gravity)))
            mask = np.abs(rotation @ source.mask[12:]) > _SMALLEST_MASK
            limit = source.max_acceleration_distance
            found += self._measured(stamp_ns, 12, values, rotation @ spread @ rotation.T, mask, limit)
        return found

    def _orientation(self, source: Source, stamp_ns: int, orientation: Quaternion, spread: Array) -> list[Measurement]:
        pose, covariance = Pose((0.0, 0.0, 0.0), orientation), np.zeros((6, 6))
        covariance[3:, 3:] = spread
        if source.differential:
            return self._difference(source, stamp_ns, pose, covariance)
        if source.relative:
            source.first = source.first or pose
            pose = source.first.inverse() @ pose
        mask = np.array([False] * 3 + [value > 0.0 for value in source.mask[3:6]])
        values = np.array([*pose.position, *pose.rpy])
        return self._measured(stamp_ns, 0, values, covariance, mask, source.max_pose_distance)

    def _measured(
        self, stamp_ns: int, start: int, values: Array, covariance: Array, mask: Any, limit: float
    ) -> list[Measurement]:
        """Make a measurement of the elements from `start` on that the mask has; two_d_mode adds zeros."""
        chosen = {number for number in range(len(values)) if mask[number] and math.isfinite(values[number])}
        if not chosen:
            return []
        flat = {number for number in range(len(values)) if start + number in _FLAT} if self.two_d else set[int]()
        values, covariance = values.copy(), covariance.copy()
        for number in flat:
            values[number] = covariance[number, :] = covariance[:, number] = 0.0
            covariance[number, number] = _FLAT_VARIANCE
        at = sorted(chosen | flat)
        measurement = Measurement(
            stamp_ns=stamp_ns,
            indices=tuple(start + number for number in at),
            values=values[at],
            covariance=covariance[np.ix_(at, at)],
            max_distance=limit,
        )
        return [measurement] if np.isfinite(measurement.covariance).all() else []


def _blocks(matrix: Array, count: int) -> Array:
    """Return a block-diagonal matrix."""
    return np.kron(np.eye(count), matrix).astype(np.float64)


def _finite(values: Any) -> tuple[Array, Array]:
    """Return values with 0 for what is no number, and 1 for each that is one."""
    known = np.isfinite(values)
    return np.where(known, values, 0.0), known.astype(np.float64)


def _square(values: Any, size: int) -> Array:
    return np.array(values, dtype=float).reshape(size, size)


def _quaternion(q: Any) -> Quaternion | None:
    """Return a unit quaternion; None for zeros, by which senders mean that there is none."""
    norm = math.hypot(q.w, q.x, q.y, q.z)
    return (q.w / norm, q.x / norm, q.y / norm, q.z / norm) if math.isfinite(norm) and norm > 0.0 else None
