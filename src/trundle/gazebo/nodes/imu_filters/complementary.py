"""imu_complementary_filter/complementary_filter_node: orientation by integration and small corrections.

R. Valenti, I. Dryanovski and J. Xiao, "Keeping a Good Attitude: A Quaternion-Based Orientation Filter for IMUs and
MARGs", 2015.
"""

import math

from trundle.robots.parameters import RosParameters
from trundle.spatial import (
    IDENTITY_QUATERNION,
    Quaternion,
    Vector3,
    normalized,
    quaternion_product,
    rotate,
    slerp,
    subtract,
)

from .imu_node import ImuNode
from .orientation import orientation_from_field, rotation_to_z

_GRAVITY = 9.81
_MAX_RESTING_TURN, _MAX_RESTING_CHANGE = 0.2, 0.01
"""Limits for an imu at rest [rad/s]: of the angular velocity beyond the bias, and of its change per message."""
_MAX_RESTING_ACCELERATION = 0.1
"""Limit for an imu at rest [m/s²]: difference of the acceleration's length from gravity."""
_TRUSTED_ERROR, _IGNORED_ERROR = 0.1, 0.2
"""Relative differences from gravity: up to the first an acceleration counts fully, from the second on not at all."""


class ComplementaryFilter:
    """Orientation of an imu, world_from_imu; with a field, the world's x axis points north."""

    def __init__(
        self, *, gain_acc: float, gain_mag: float, bias_alpha: float, does_estimate_bias: bool, is_adaptive: bool
    ) -> None:
        """Start without an orientation.

        Args:
            gain_acc: ratio of gravity's correction in each update, 0 … 1.
            gain_mag: ratio of the magnetic field's correction in each update, 0 … 1.
            bias_alpha: ratio of the angular velocity at rest that is added to its bias in each update, 0 … 1.
            does_estimate_bias: True to estimate the bias.
            is_adaptive: True to reduce gain_acc while the imu accelerates.
        """
        self._gain_acc = gain_acc
        self._gain_mag = gain_mag
        self._bias_alpha = bias_alpha
        self._does_estimate_bias = does_estimate_bias
        self._is_adaptive = is_adaptive
        self.restart()

    def restart(self) -> None:
        """Forget the orientation and the bias."""
        self.orientation: Quaternion | None = None
        self.bias: Vector3 = (0.0, 0.0, 0.0)
        """Bias of the angular velocity [rad/s]."""
        self.is_steady = False
        self._last_turn: Vector3 = (0.0, 0.0, 0.0)

    def update(self, turn: Vector3, acceleration: Vector3, field: Vector3 | None, dt: float) -> None:
        """Use a measurement.

        Args:
            turn: angular velocity [rad/s].
            acceleration: [m/s²]
            field: magnetic field of any unit; None without.
            dt: time since the last measurement [s].
        """
        up = normalized(acceleration)
        if up is None:
            return
        if self.orientation is None:
            start = None if field is None else orientation_from_field(acceleration, field, "nwu")
            self.orientation = start or rotation_to_z(up)
            return
        if self._does_estimate_bias:
            self._estimate_bias(turn, acceleration)
        q = self.orientation
        change = quaternion_product(q, (0.0, *subtract(turn, self.bias)))
        q = _unit([a + 0.5 * dt * b for a, b in zip(q, change, strict=True)])
        gain = self._gain_acc * (_trust(acceleration) if self._is_adaptive else 1.0)
        q = quaternion_product(slerp(IDENTITY_QUATERNION, rotation_to_z(rotate(q, up)), gain), q)
        if field is not None:
            x, y, _ = rotate(q, field)
            if x or y:
                angle = -math.atan2(y, x) * self._gain_mag
                q = quaternion_product((math.cos(angle / 2.0), 0.0, 0.0, math.sin(angle / 2.0)), q)
        self.orientation = _unit(list(q))

    def _estimate_bias(self, turn: Vector3, acceleration: Vector3) -> None:
        rest = subtract(turn, self.bias)
        self.is_steady = (
            abs(math.hypot(*acceleration) - _GRAVITY) <= _MAX_RESTING_ACCELERATION
            and max(map(abs, subtract(turn, self._last_turn))) <= _MAX_RESTING_CHANGE
            and max(map(abs, rest)) <= _MAX_RESTING_TURN
        )
        if self.is_steady:
            x, y, z = (bias + self._bias_alpha * value for bias, value in zip(self.bias, rest, strict=True))
            self.bias = (x, y, z)
        self._last_turn = turn


def _trust(acceleration: Vector3) -> float:
    """Return 1 for an acceleration near gravity, which falls to 0 with the difference."""
    error = abs(math.hypot(*acceleration) - _GRAVITY) / _GRAVITY
    return min(max((_IGNORED_ERROR - error) / (_IGNORED_ERROR - _TRUSTED_ERROR), 0.0), 1.0)


def _unit(values: list[float]) -> Quaternion:
    norm = math.hypot(*values)
    if not (norm > 0.0 and math.isfinite(norm)):
        return IDENTITY_QUATERNION
    w, x, y, z = (value / norm for value in values)
    return (w, x, y, z)


class ImuComplementaryFilter(ImuNode):
    """Publishes `imu/data` from `imu/data_raw` and, with use_mag, `imu/mag`.

    Parameters, with the original's names and defaults: gain_acc 0.01, gain_mag 0.01, bias_alpha 0.01,
    do_bias_estimation true, do_adaptive_gain true, use_mag false, publish_tf false, reverse_tf, fixed_frame odom,
    constant_dt 0, orientation_stddev 0, publish_debug_topics, time_jump_threshold.
    """

    def _read(self, settings: RosParameters) -> None:
        super()._read(settings)

        def ratio(name: str) -> float:
            return settings.clamped(name, settings.number(name, 0.01), 0.0, 1.0)

        self._does_estimate_bias = settings.flag("do_bias_estimation", default=True)
        self._complementary = ComplementaryFilter(
            gain_acc=ratio("gain_acc"),
            gain_mag=ratio("gain_mag"),
            bias_alpha=ratio("bias_alpha"),
            does_estimate_bias=self._does_estimate_bias,
            is_adaptive=settings.flag("do_adaptive_gain", default=True),
        )
        has_state = settings.flag("publish_debug_topics", default=False) and self._does_estimate_bias
        topic = f"{self._node.resolve('imu')}/steady_state"
        self._steady = self._node.advertise(topic, "std_msgs/Bool", queue_size=5) if has_state else None

    def _filter(
        self, turn: Vector3, acceleration: Vector3, field: Vector3 | None, dt: float, *, is_first: bool
    ) -> bool:
        if is_first:
            self._complementary.restart()
        self._complementary.update(turn, acceleration, field, dt)
        if self._steady is not None:
            self._steady.publish({"data": self._complementary.is_steady})
        return self._complementary.orientation is not None

    @property
    def _orientation(self) -> Quaternion:
        return self._complementary.orientation or IDENTITY_QUATERNION

    def _corrected(self, turn: Vector3, acceleration: Vector3) -> tuple[Vector3, Vector3]:
        return subtract(turn, self._complementary.bias), acceleration
