"""Lines and circles of a link with a trapezoid of velocity."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from trundle.spatial import Pose, slerp

from ..error_codes import ErrorCode, RequestError
from ..requests import CartesianLimits

_SAMPLING_S = 0.1
"""Time between states, as in pilz_industrial_motion_planner [s]."""
_MIN_SAMPLES = 10
_COLLINEAR = 1e-6


def trapezoid(length: float, velocity: float, acceleration: float, deceleration: float) -> NDArray[np.float64]:
    """Return rows of time [s] and place from 0 to `length`, from rest to rest, every 0.1 s or less.

    Args:
        length: [m] or [rad].
        velocity: greatest one.
        acceleration: at the start.
        deceleration: at the end.
    """
    up, down = velocity**2 / (2 * acceleration), velocity**2 / (2 * deceleration)
    if up + down > length:  # no time at the greatest velocity
        velocity = float(np.sqrt(2 * length * acceleration * deceleration / (acceleration + deceleration)))
        up, down = velocity**2 / (2 * acceleration), velocity**2 / (2 * deceleration)
    t_up, t_down = velocity / acceleration, velocity / deceleration
    t_along = max(0.0, (length - up - down) / velocity)
    duration = t_up + t_along + t_down
    times = np.linspace(0.0, duration, max(_MIN_SAMPLES, int(np.ceil(duration / _SAMPLING_S))) + 1)
    places = np.where(
        times < t_up,
        acceleration * times**2 / 2,
        np.where(
            times < t_up + t_along,
            up + velocity * (times - t_up),
            length - deceleration * (duration - times) ** 2 / 2,
        ),
    )
    return np.column_stack([times, np.clip(places, 0.0, length)])


def timed_line(
    start: Pose, goal: Pose, limits: CartesianLimits, velocity_scaling: float, acceleration_scaling: float
) -> tuple[NDArray[np.float64], list[Pose]]:
    """Return times (N,) and poses on a straight line; the turn takes as long as the way."""
    length = float(np.linalg.norm(np.subtract(goal.position, start.position)))

    def position(t: float) -> NDArray[np.float64]:
        return np.array(start.position) + t * np.subtract(goal.position, start.position)

    return _timed(start, goal, length, position, limits, velocity_scaling, acceleration_scaling)


def timed_circle(
    start: Pose,
    goal: Pose,
    point: NDArray[np.float64],
    is_center: bool,
    limits: CartesianLimits,
    velocity_scaling: float,
    acceleration_scaling: float,
) -> tuple[NDArray[np.float64], list[Pose]]:
    """Return times (N,) and poses on an arc.

    Args:
        start: first pose.
        goal: last pose.
        point: (3,) center of the arc, whose shorter side is taken, or a point on the arc [m].
        is_center: True if it is the center.
        limits: of the link.
        velocity_scaling: factor of the velocities.
        acceleration_scaling: factor of the accelerations.

    Raises:
        RequestError: the points are on a line, or the center is not as far from the start as from the goal.
    """
    a, b = np.array(start.position), np.array(goal.position)
    if is_center:
        center, radius = point, float(np.linalg.norm(a - point))
        if abs(float(np.linalg.norm(b - point)) - radius) > 1e-3 * max(radius, 1.0):
            raise RequestError(
                ErrorCode.INVALID_MOTION_PLAN, "CIRC: the center is not as far from the start as from the goal"
            )
        normal = np.cross(a - center, b - center)
    else:
        u, v = point - a, b - a
        normal = np.cross(u, v)
        square = float(normal @ normal)
        if square < _COLLINEAR * float(u @ u) * float(v @ v) or square == 0.0:
            raise RequestError(ErrorCode.INVALID_MOTION_PLAN, "CIRC: start, interim point and goal are on a line")
        center = a + (np.cross(normal, u) * (v @ v) + np.cross(v, normal) * (u @ u)) / (2 * square)
        radius = float(np.linalg.norm(a - center))
    size = float(np.linalg.norm(normal))
    if size < _COLLINEAR * radius * radius:
        raise RequestError(ErrorCode.INVALID_MOTION_PLAN, "CIRC: start, goal and center are on a line")
    x = (a - center) / radius
    y = np.cross(normal / size, x)

    def angle_of(p: NDArray[np.float64]) -> float:
        return float(np.arctan2((p - center) @ y, (p - center) @ x)) % (2 * np.pi)

    sweep = angle_of(b)
    if not is_center and angle_of(point) > sweep:
        sweep -= 2 * np.pi

    def position(t: float) -> NDArray[np.float64]:
        angle = t * sweep
        return center + radius * (np.cos(angle) * x + np.sin(angle) * y)

    return _timed(start, goal, radius * abs(sweep), position, limits, velocity_scaling, acceleration_scaling)


def _timed(
    start: Pose,
    goal: Pose,
    length: float,
    position: Callable[[float], NDArray[np.float64]],
    limits: CartesianLimits,
    velocity_scaling: float,
    acceleration_scaling: float,
) -> tuple[NDArray[np.float64], list[Pose]]:
    turn = 2.0 * float(np.arccos(min(1.0, abs(float(np.dot(goal.quaternion, start.quaternion))))))
    # The path is as long as the way [m], or as the turn in metres of the same time at the greatest velocities.
    size = max(length, turn * limits.max_trans_vel / limits.max_rot_vel)
    if size < 1e-9:
        return np.zeros(1), [goal]
    profile = trapezoid(
        size,
        velocity_scaling * limits.max_trans_vel,
        acceleration_scaling * limits.max_trans_acc,
        acceleration_scaling * abs(limits.max_trans_dec),
    )
    poses: list[Pose] = []
    for place in profile[:, 1]:
        t = float(place) / size
        px, py, pz = position(t).tolist()
        poses.append(Pose((px, py, pz), slerp(start.quaternion, goal.quaternion, t)))
    return profile[:, 0], poses
