"""imu_filter_madgwick/imu_filter_node: orientation by gradient descent.

S. Madgwick, "An efficient orientation filter for inertial and inertial/magnetic sensor arrays", 2010.
"""

import math

from trundle.robots.parameters import ParamError, RosParameters
from trundle.ros import Node, Option, Options, ReconfigureServer
from trundle.spatial import (
    IDENTITY_QUATERNION,
    Quaternion,
    Vector3,
    add,
    conjugate,
    multiply,
    normalized,
    quaternion_from_rpy,
    quaternion_product,
    rotate,
    subtract,
)

from ..host import NodeHost
from .imu_node import ImuNode
from .orientation import UP, orientation_from_field, orientation_from_gravity

_GRAVITY = 9.80665


class MadgwickFilter:
    """Orientation of an imu, world_from_imu."""

    def __init__(self, frame: str, *, gain: float, drift_gain: float) -> None:
        """Start level.

        Args:
            frame: world frame: 'enu', 'ned' or 'nwu'.
            gain: rate at which gravity and the field correct the orientation [rad/s].
            drift_gain: rate at which they correct the drift of the angular velocity, zeta [rad/s].
        """
        self.frame = frame
        self.gain = gain
        self.drift_gain = drift_gain
        self.orientation: Quaternion = IDENTITY_QUATERNION
        self._drift: Vector3 = (0.0, 0.0, 0.0)

    def update(self, turn: Vector3, acceleration: Vector3, field: Vector3 | None, dt: float) -> None:
        """Predict over `dt` [s] by the angular velocity, and correct by gravity and the field, if there is one."""
        q, up = self.orientation, normalized(acceleration)
        step: Quaternion = (0.0, 0.0, 0.0, 0.0)
        if up is not None:
            pairs = [(UP[self.frame], up)]
            north = None if field is None else normalized(field)
            if north is not None:
                x, y, z = rotate(q, north)
                across = math.hypot(x, y)
                pairs.append(((0.0, across, z) if self.frame == "enu" else (across, 0.0, z), north))
            step = _descent(q, pairs)
            if north is not None:
                _, *error = quaternion_product(conjugate(q), step)
                self._drift = add(self._drift, multiply((error[0], error[1], error[2]), 2.0 * dt * self.drift_gain))
                turn = subtract(turn, self._drift)
        change = quaternion_product(q, (0.0, *turn))
        moved = [a + (0.5 * b - self.gain * c) * dt for a, b, c in zip(q, change, step, strict=True)]
        norm = math.hypot(*moved)
        if norm > 0.0 and math.isfinite(norm):
            w, x, y, z = (value / norm for value in moved)
            self.orientation = (w, x, y, z)


def _descent(q: Quaternion, pairs: list[tuple[Vector3, Vector3]]) -> Quaternion:
    """Return the unit direction, at right angles to `q`, in which the error of the pairs grows fastest.

    A pair is a direction in the world, and its measurement. With d, s and f = q̄ d q − s as pure quaternions, the
    gradient of |f|² is −4 d q f.
    """
    total = [0.0] * 4
    for world, measured in pairs:
        error = subtract(rotate(conjugate(q), world), measured)
        gradient = quaternion_product(quaternion_product((0.0, *world), q), (0.0, *error))
        total = [a - b for a, b in zip(total, gradient, strict=True)]
    along = sum(a * b for a, b in zip(total, q, strict=True))
    w, x, y, z = (a - along * b for a, b in zip(total, q, strict=True))
    norm = math.hypot(w, x, y, z)
    return (w / norm, x / norm, y / norm, z / norm) if norm > 0.0 else (0.0, 0.0, 0.0, 0.0)


class ImuFilterMadgwick(ImuNode):
    """Publishes `imu/data` and the transform of the imu from `imu/data_raw` and `imu/mag`.

    Parameters, with the original's names and defaults: use_mag true, publish_tf true, reverse_tf, fixed_frame odom,
    constant_dt 0, stateless, world_frame enu, remove_gravity_vector, yaw_offset, declination, publish_debug_topics,
    time_jump_threshold; gain 0.1, zeta, mag_bias_x, _y, _z and orientation_stddev, by dynamic_reconfigure too.
    """

    uses_mag_by_default = True
    publishes_tf_by_default = True

    def __init__(self, node: Node, arguments: list[str], host: NodeHost) -> None:
        super().__init__(node, arguments, host)
        self._bias: Vector3 = (0.0, 0.0, 0.0)

    def _read(self, settings: RosParameters) -> None:
        super()._read(settings)
        frame = settings.text("world_frame", "enu")
        if frame not in UP:
            raise ParamError(f"parameter {settings.namespace}/world_frame is {frame!r}; it is enu, ned or nwu")
        self._is_stateless = settings.flag("stateless", default=False)
        self._removes_gravity = settings.flag("remove_gravity_vector", default=False)
        turn = settings.number("yaw_offset", 0.0) - settings.number("declination", 0.0)
        self._offset = quaternion_from_rpy(0.0, 0.0, turn)
        self._madgwick = MadgwickFilter(frame, gain=0.0, drift_gain=0.0)
        limits = {"gain": (0.1, 0.0, 1.0), "zeta": (0.0, -1.0, 1.0)}
        limits |= {f"mag_bias_{axis}": (0.0, -10.0, 10.0) for axis in "xyz"}
        limits |= {"orientation_stddev": (0.0, 0.0, 100.0)}
        options: list[Option] = []
        for name, (default, lower, upper) in limits.items():
            value = settings.clamped(name, settings.number(name, default), lower, upper)
            options.append(Option(name=name, value=value, lower=lower, upper=upper))
        self._reconfigure({option.name: option.value for option in options})
        ReconfigureServer(self._node, options, self._reconfigure)

    def _reconfigure(self, values: Options) -> Options:
        self._madgwick.gain, self._madgwick.drift_gain = float(values["gain"]), float(values["zeta"])
        self._bias = (float(values["mag_bias_x"]), float(values["mag_bias_y"]), float(values["mag_bias_z"]))
        self._variance = float(values["orientation_stddev"]) ** 2
        return values

    def _filter(
        self, turn: Vector3, acceleration: Vector3, field: Vector3 | None, dt: float, *, is_first: bool
    ) -> bool:
        field = None if field is None else subtract(field, self._bias)
        if is_first or self._is_stateless:
            if self._uses_mag and field is None:
                return False
            frame = self._madgwick.frame
            start = (
                orientation_from_gravity(acceleration, frame)
                if field is None
                else orientation_from_field(acceleration, field, frame)
            )
            if start is None:
                self._warnings.warn("there is no orientation: the imu falls freely, or is near the magnetic pole")
                return False
            self._madgwick.orientation = start
        if not self._is_stateless:
            self._madgwick.update(turn, acceleration, field, dt)
        return True

    @property
    def _orientation(self) -> Quaternion:
        return quaternion_product(self._offset, self._madgwick.orientation)

    def _corrected(self, turn: Vector3, acceleration: Vector3) -> tuple[Vector3, Vector3]:
        if not self._removes_gravity:
            return turn, acceleration
        up = rotate(conjugate(self._madgwick.orientation), UP[self._madgwick.frame])
        return turn, subtract(acceleration, multiply(up, _GRAVITY))
