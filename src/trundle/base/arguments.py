"""Arguments of public calls: numbers, vectors, poses, twists and wrenches, checked before they reach the engine."""

import math
import operator
from typing import TYPE_CHECKING, Any, TypeAlias

from trundle.spatial import ZERO, Pose, Twist, Vector3, Wrench, numbers_of

from .diagnostics import UsageError

if TYPE_CHECKING:  # commands that need no numbers do not import NumPy
    from numpy.typing import ArrayLike

    PoseLike: TypeAlias = Pose | ArrayLike
    """`Pose`, or (x, y, z) [m], (x, y, z [m], roll, pitch, yaw [rad]), (x, y, z [m], qw, qx, qy, qz)."""
    TwistLike: TypeAlias = Twist | ArrayLike
    """`Twist`, or linear (3) [m/s], or linear and angular (6) [m/s, rad/s]."""
    WrenchLike: TypeAlias = Wrench | ArrayLike
    """`Wrench`, or force (3) [N], or force and torque (6) [N, N·m]."""

_POSES = "a Pose, (x, y, z) [m], (x, y, z, roll, pitch, yaw) [m, rad] or (x, y, z, qw, qx, qy, qz)"
_TWISTS = "a Twist, or (vx, vy, vz) [m/s], or (vx, vy, vz, wx, wy, wz) [m/s, rad/s]"
_WRENCHES = "a Wrench, or (fx, fy, fz) [N], or (fx, fy, fz, tx, ty, tz) [N, N·m]"
_UNIT_TOLERANCE = 0.01
"""Tolerance of a quaternion's length: 0.7071 for √½ is well within."""
_LONGEST_TEXT = 60


def number_of(value: object, name: str, *, minimum: float = -math.inf) -> float:
    """Return a finite number.

    Args:
        value: argument.
        name: its name and unit, for the message.
        minimum: smallest allowed value.

    Raises:
        UsageError: the argument is no finite number, or too small.
    """
    number = value if type(value) is float else _float_of(value)
    if number is None or not math.isfinite(number) or number < minimum:
        least = "" if minimum == -math.inf else f" of {minimum:g} or more"
        raise UsageError(f"{name} must be a finite number{least}, got {described(value)}")
    return number


def count_of(value: object, name: str) -> int:
    """Return a whole number of zero or more.

    Raises:
        UsageError: the argument is anything else.
    """
    try:
        count = operator.index(value)  # pyright: ignore[reportArgumentType]
    except TypeError:
        count = -1
    if count < 0:
        raise UsageError(f"{name} must be a whole number of 0 or more, got {described(value)}")
    return count


def vector_of(value: object, name: str) -> Vector3:
    """Return three finite numbers.

    Raises:
        UsageError: the argument is something else; `name`, with its unit, begins the sentence.
    """
    x, y, z = _numbers(value, f"{name} must be 3 finite numbers (x, y, z)", (3,))
    return (x, y, z)


def pose_of(value: "PoseLike", name: str = "pose") -> Pose:
    """Return a pose with finite numbers and a unit quaternion.

    Raises:
        UsageError: the argument is no pose; `name` begins the sentence.
    """
    if isinstance(value, Pose):
        numbers = _numbers((*value.position, *value.quaternion), f"{name} must have finite numbers", (7,))
    else:
        numbers = _numbers(value, f"{name} must be {_POSES}", (3, 6, 7))
    if len(numbers) == 3:
        return Pose(numbers)
    if len(numbers) == 6:
        return Pose.from_rpy(*numbers)
    length = math.hypot(*numbers[3:])
    if abs(length - 1.0) > _UNIT_TOLERANCE:
        raise UsageError(f"{name}: the quaternion (w, x, y, z) must have length 1, got {numbers[3:]}")
    return value if isinstance(value, Pose) else Pose(numbers[:3], numbers[3:])


def twist_of(value: "TwistLike", name: str = "twist") -> Twist:
    """Return a twist of finite numbers.

    Raises:
        UsageError: the argument is no twist; `name` begins the sentence.
    """
    if isinstance(value, Twist):
        _numbers((*value.linear, *value.angular), f"{name} must have finite numbers", (6,))
        return value
    numbers = _numbers(value, f"{name} must be {_TWISTS}", (3, 6))
    return Twist(numbers[:3], numbers[3:] or ZERO)


def wrench_of(value: "WrenchLike", name: str = "wrench") -> Wrench:
    """Return a wrench of finite numbers.

    Raises:
        UsageError: the argument is no wrench; `name` begins the sentence.
    """
    if isinstance(value, Wrench):
        _numbers((*value.force, *value.torque), f"{name} must have finite numbers", (6,))
        return value
    numbers = _numbers(value, f"{name} must be {_WRENCHES}", (3, 6))
    return Wrench(numbers[:3], numbers[3:] or ZERO)


def described(value: object) -> str:
    """Return a short text about a wrong argument: an array's shape, or the value."""
    shape = getattr(value, "shape", ())
    if shape and shape != (3,):
        return f"an array of shape {shape}"
    text = repr(value)
    return text if len(text) <= _LONGEST_TEXT else f"{text[:_LONGEST_TEXT]}…"


def _numbers(value: object, problem: str, counts: tuple[int, ...]) -> Any:
    """Return the numbers of a sequence or array as a tuple of one of the given lengths."""
    try:
        numbers = numbers_of(value, counts, problem)
    except ValueError as error:
        raise UsageError(f"{problem}, got {described(value)}") from error.__cause__
    if not all(map(math.isfinite, numbers)):
        raise UsageError(f"{problem}, got {described(value)}")
    return numbers


def _float_of(value: object) -> float | None:
    try:
        return float(value + 0.0)  # pyright: ignore[reportOperatorIssue, reportUnknownArgumentType]
    except (TypeError, ValueError):
        return None
