"""Times along paths."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.planning import _planning
from trundle.planning.robot_model import RobotModel

from .trajectory import Trajectory

Method: TypeAlias = Literal["time_optimal", "iterative_parabolic"]
_METHODS: dict[str, Method] = {
    "time_optimal": "time_optimal",
    "time_optimal_trajectory_generation": "time_optimal",
    "totg": "time_optimal",
    "iterative_parabolic": "iterative_parabolic",
    "iterative_time_parameterization": "iterative_parabolic",
    "iptp": "iterative_parabolic",
}
_DEFAULT_LIMIT = 1.0
"""Velocity [rad/s, m/s] and acceleration [rad/s², m/s²] of variables without a limit, as in MoveIt."""


class MotionLimits(Struct, frozen=True, eq=False):
    """Limits of variables."""

    velocity: NDArray[np.float64]
    """(n,) [rad/s, m/s]"""
    acceleration: NDArray[np.float64]
    """(n,) [rad/s², m/s²]"""


def motion_limits(model: RobotModel, variables: Sequence[str]) -> MotionLimits:
    """Return the limits of a model's variables; 1 where there is none, as in MoveIt."""
    indices = model.indices(variables)
    velocity, acceleration = model.max_velocity[indices], model.max_acceleration[indices]
    return MotionLimits(
        np.where(np.isfinite(velocity) & (velocity > 0), velocity, _DEFAULT_LIMIT),
        np.where(np.isfinite(acceleration) & (acceleration > 0), acceleration, _DEFAULT_LIMIT),
    )


def find_method(name: str) -> tuple[Method, str]:
    """Return the method for a name, and a sentence if it is another one; "" if it is the same."""
    key = name.rpartition("/")[2]
    for prefix in ("Add",):
        key = key.removeprefix(prefix)
    snake = "".join(f"_{letter.lower()}" if letter.isupper() else letter for letter in key).strip("_")
    if snake in ("", "time_parameterization"):  # AddTimeParameterization: the iterative one
        return ("iterative_parabolic" if snake else "time_optimal"), ""
    snake = snake.removesuffix("_parameterization") if snake.startswith("time_optimal") else snake
    if snake in _METHODS:
        return _METHODS[snake], ""
    if "spline" in snake:
        return "iterative_parabolic", f"there is no {name!r}; iterative_parabolic made the times"
    known = ", ".join(sorted(set(_METHODS.values())))
    return "time_optimal", f"no time parameterization {name!r}; time_optimal made the times; there are: {known}"


def unwound(waypoints: NDArray[np.float64], turns: NDArray[np.bool_]) -> NDArray[np.float64]:
    """Return waypoints (N, n) whose angles that turn without end go the short way, beyond ±π if need be."""
    unwound = np.array(waypoints, dtype=np.float64)
    if len(unwound):
        unwound[:, turns] = np.unwrap(unwound[:, turns], axis=0)
    return unwound


def parameterize(
    waypoints: NDArray[np.float64],
    limits: MotionLimits,
    *,
    velocity_scaling: float = 1.0,
    acceleration_scaling: float = 1.0,
    method: Method = "time_optimal",
    path_tolerance: float = 0.1,
    resample_dt: float = 0.1,
    turns: NDArray[np.bool_] | None = None,
) -> Trajectory:
    """Return times along a path that is at rest at its ends.

    Every velocity and acceleration stays within its limit times the scaling. `time_optimal` is the fastest: straight
    lines with arcs at the corners, as MoveIt's TimeOptimalTrajectoryGeneration. `iterative_parabolic` keeps the
    waypoints.

    Args:
        waypoints: (N, n) [rad, m].
        limits: of the n variables.
        velocity_scaling: factor in (0, 1]; others are 1, as in MoveIt.
        acceleration_scaling: factor in (0, 1]; others are 1.
        method: way to make the times.
        path_tolerance: greatest distance of an arc from its corner [rad, m].
        resample_dt: time between states [s].
        turns: (n,) True for angles that turn without end, which are unwound; None: none does.

    Raises:
        UsageError: waypoints that are not finite, limits that are not above zero, or a tolerance or time step that is
            not.
    """
    path = np.ascontiguousarray(waypoints, dtype=np.float64)
    if path.ndim != 2 or not np.isfinite(path).all():
        raise UsageError("waypoints are (N, n) finite numbers")
    if turns is not None:
        path = unwound(path, turns)
    if not (path_tolerance >= 0 and np.isfinite(path_tolerance) and 1e-4 <= resample_dt <= 1e4):
        raise UsageError(
            f"a path tolerance is not negative, a time step at least 0.1 ms, got {path_tolerance}, {resample_dt}"
        )
    velocity = limits.velocity * (velocity_scaling if 0 < velocity_scaling <= 1 else 1.0)
    acceleration = limits.acceleration * (acceleration_scaling if 0 < acceleration_scaling <= 1 else 1.0)
    n = path.shape[1]
    for name, values in (("velocity", velocity), ("acceleration", acceleration)):
        if values.shape != (n,) or not (np.isfinite(values) & (values > 0)).all():
            raise UsageError(f"each of {n} variables needs a limit of {name} above zero, got {values.tolist()}")
    if len(path) < 2 or np.ptp(path, axis=0).max(initial=0.0) < 1e-9:
        still = path[:1]
        return Trajectory(
            times=np.zeros(len(still)), positions=still, velocities=still * 0.0, accelerations=still * 0.0
        )
    if method == "time_optimal":
        timed = _planning.time_optimal(path, velocity, acceleration, path_tolerance, resample_dt)
    else:
        timed = _planning.time_parabolic(path, velocity, acceleration)
    times, positions, velocities, accelerations = timed
    return Trajectory(times=times, positions=positions, velocities=velocities, accelerations=accelerations)
