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
"""Prefix of the parameter → type of its topic."""
_MAX_SOURCES = 100
_PLANAR_VARIANCE = 1e-6
"""Variance of the elements that two_d_mode holds at zero."""
_PLANAR_ZEROS = {2, 3, 4, 8, 9, 10, 14}
_MIN_MASK = 1e-6


class FrameLookup(Protocol):
    """Lookup of the pose of a frame in another."""

    def __call__(self, target: str, source: str, stamp_ns: int, /) -> Pose | None:
        """Return `target_from_source`; None: unknown."""
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
        """Prefix of the source's name: odom, pose, twist or imu."""
        return self.name.rstrip("0123456789")

    def reset(self) -> None:
        """Clear earlier messages."""
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
        raise ParamError(f"parameter {settings.namespace}/{name} must be {SIZE} truth values, got {values!r}")
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
        """Return a message's measurements; for an imu without orientation, `orientation` turns gravity."""
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

    def _pose(self, source: Source, message: Any, pose_with_covariance: Any) -> list[Measurement]:
        position, quaternion = pose_with_covariance.pose.position, _quaternion(pose_with_covariance.pose.orientation)
        (x, y, z), is_finite = _finite([position.x, position.y, position.z])
        mask_in_frame = source.mask[:6] * [*is_finite, 1.0, 1.0, 1.0]
        if quaternion is None:
            mask_in_frame[3:] = 0.0
        if not mask_in_frame.any():
            return []
        pose = Pose((x, y, z), quaternion or IDENTITY_QUATERNION)
        stamp_ns, frame = to_nsec(message.header.stamp), message.header.frame_id or self.world
        covariance = _square(pose_with_covariance.covariance, 6)
        if source.differential:
            is_whole = bool((mask_in_frame == source.mask[:6]).all())
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
        mask = np.abs(rotation @ mask_in_frame) > _MIN_MASK
        return self._measurement(
            stamp_ns, 0, values, rotation @ covariance @ rotation.T, mask, source.max_pose_distance
        )

    def _difference(self, source: Source, stamp_ns: int, pose: Pose, covariance: Array) -> list[Measurement]:
        """Return the twist between a pose and the last one."""
        last, source.previous = source.previous, (stamp_ns, pose, covariance)
        if last is None or stamp_ns <= last[0]:
            return []
        dt = (stamp_ns - last[0]) / 1e9
        displacement = last[1].inverse() @ pose
        values = np.array([*displacement.position, *displacement.rpy]) / dt
        sum_covariance = (covariance + last[2]) * dt
        return self._measurement(stamp_ns, 6, values, sum_covariance, source.mask[:6] > 0.0, source.max_twist_distance)

    def _twist(self, source: Source, message: Any, twist_with_covariance: Any, frame: str) -> list[Measurement]:
        linear, angular = twist_with_covariance.twist.linear, twist_with_covariance.twist.angular
        values = np.array([linear.x, linear.y, linear.z, angular.x, angular.y, angular.z])
        covariance = _square(twist_with_covariance.covariance, 6)
        return self._body_twist(source, to_nsec(message.header.stamp), frame, values, covariance)

    def _body_twist(
        self, source: Source, stamp_ns: int, frame: str, values: Array, covariance: Array
    ) -> list[Measurement]:
        """Convert the twist of a frame on the robot to that of the base."""
        values, is_finite = _finite(values)
        mask_in_frame = source.mask[6:12] * is_finite
        base_from_frame = self.find(self.base, frame, stamp_ns) if mask_in_frame.any() else None
        if base_from_frame is None:
            return []
        rotation = _blocks(matrix_from_quaternion(base_from_frame.quaternion), 2)
        base_values = rotation @ values
        base_values[:3] += np.cross(np.array(base_from_frame.position), base_values[3:])
        mask = np.abs(rotation @ mask_in_frame) > _MIN_MASK
        base_covariance = rotation @ covariance @ rotation.T
        return self._measurement(stamp_ns, 6, base_values, base_covariance, mask, source.max_twist_distance)

    def _imu(self, source: Source, message: Any, orientation: Quaternion) -> list[Measurement]:
        """Read orientation, angular velocity and acceleration; a covariance starting with -1 marks a missing value."""
        stamp_ns, frame = to_nsec(message.header.stamp), message.header.frame_id or self.base
        base_from_imu = self.find(self.base, frame, stamp_ns)
        if base_from_imu is None:
            return []
        measurements: list[Measurement] = []
        imu_orientation = _quaternion(message.orientation)
        if imu_orientation is not None and message.orientation_covariance[0] != -1.0:
            orientation = quaternion_product(imu_orientation, conjugate(base_from_imu.quaternion))
            if source.mask[3:6].any():
                measurements += self._orientation(
                    source, stamp_ns, orientation, _square(message.orientation_covariance, 3)
                )
        rate, rate_covariance = message.angular_velocity, np.zeros((6, 6))
        rate_covariance[3:, 3:] = _square(message.angular_velocity_covariance, 3)
        if rate_covariance[3, 3] != -1.0:
            twist = np.array([0.0, 0.0, 0.0, rate.x, rate.y, rate.z])
            measurements += self._body_twist(source, stamp_ns, frame, twist, rate_covariance)
        acceleration_covariance = _square(message.linear_acceleration_covariance, 3)
        if source.mask[12:].any() and acceleration_covariance[0, 0] != -1.0:
            acceleration = message.linear_acceleration
            rotation = matrix_from_quaternion(base_from_imu.quaternion)
            values = rotation @ np.array([acceleration.x, acceleration.y, acceleration.z])
            if source.removes_gravity:
                values = values - np.array(rotate(conjugate(orientation), (0.0, 0.0, self.gravity)))
            mask = np.abs(rotation @ source.mask[12:]) > _MIN_MASK
            limit = source.max_acceleration_distance
            measurements += self._measurement(
                stamp_ns, 12, values, rotation @ acceleration_covariance @ rotation.T, mask, limit
            )
        return measurements

    def _orientation(
        self, source: Source, stamp_ns: int, orientation: Quaternion, orientation_covariance: Array
    ) -> list[Measurement]:
        pose, covariance = Pose((0.0, 0.0, 0.0), orientation), np.zeros((6, 6))
        covariance[3:, 3:] = orientation_covariance
        if source.differential:
            return self._difference(source, stamp_ns, pose, covariance)
        if source.relative:
            source.first = source.first or pose
            pose = source.first.inverse() @ pose
        mask = np.array([False] * 3 + [value > 0.0 for value in source.mask[3:6]])
        values = np.array([*pose.position, *pose.rpy])
        return self._measurement(stamp_ns, 0, values, covariance, mask, source.max_pose_distance)

    def _measurement(
        self, stamp_ns: int, start: int, values: Array, covariance: Array, mask: Any, limit: float
    ) -> list[Measurement]:
        """Return a measurement of the masked elements from `start` on; two_d_mode adds zeros."""
        measured = {index for index in range(len(values)) if mask[index] and math.isfinite(values[index])}
        if not measured:
            return []
        planar = {index for index in range(len(values)) if start + index in _PLANAR_ZEROS} if self.two_d else set[int]()
        values, covariance = values.copy(), covariance.copy()
        for index in planar:
            values[index] = covariance[index, :] = covariance[:, index] = 0.0
            covariance[index, index] = _PLANAR_VARIANCE
        selected = sorted(measured | planar)
        measurement = Measurement(
            stamp_ns=stamp_ns,
            indices=tuple(start + index for index in selected),
            values=values[selected],
            covariance=covariance[np.ix_(selected, selected)],
            max_distance=limit,
        )
        return [measurement] if np.isfinite(measurement.covariance).all() else []


def _blocks(matrix: Array, count: int) -> Array:
    """Return a block-diagonal matrix."""
    return np.kron(np.eye(count), matrix).astype(np.float64)


def _finite(values: Any) -> tuple[Array, Array]:
    """Return the values with 0 for non-finite ones, and a mask: 1 for finite ones."""
    is_finite = np.isfinite(values)
    return np.where(is_finite, values, 0.0), is_finite.astype(np.float64)


def _square(values: Any, size: int) -> Array:
    return np.array(values, dtype=float).reshape(size, size)


def _quaternion(q: Any) -> Quaternion | None:
    """Return a unit quaternion; None for zeros, which mean no orientation."""
    norm = math.hypot(q.w, q.x, q.y, q.z)
    return (q.w / norm, q.x / norm, q.y / norm, q.z / norm) if math.isfinite(norm) and norm > 0.0 else None
