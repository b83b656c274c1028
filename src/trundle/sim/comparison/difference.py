"""Difference of one value between a run and its reference."""

from collections.abc import Sequence
from typing import Literal, TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from .run_samples import Sums

_Array = NDArray[np.float64]
Quantity: TypeAlias = Literal["distance", "angle", "velocity", "angular velocity", "position", "value"]


class Difference(Struct, frozen=True, kw_only=True):
    """Difference of one value between a run and its reference: now, and over the time that both have had so far."""

    name: str
    """Model, `model::joint`, a frame in its parent, or the path of a message's number."""
    quantity: Quantity
    """Distance [m] and angle [rad] between poses, difference of velocities [m/s] or angular velocities [rad/s], of a
    joint's position [rad or m], or of a number."""
    now: float | None
    """None: the reference has no such time, or the run no such model."""
    maximum: float | None
    """None: there was no time that both have."""
    maximum_time: float | None
    """The run's time at the maximum [s]."""
    rms: float | None
    """Root mean square."""


def listed(names: Sequence[tuple[str, Quantity]], sums: Sums) -> list[Difference]:
    """Return the differences by name and quantity."""
    return [
        Difference(
            name=name,
            quantity=quantity,
            now=_number(sums.now[at]),
            maximum=_number(sums.maximum[at]),
            maximum_time=_number(sums.maximum_time[at]),
            rms=_number(sums.rms[at]),
        )
        for at, (name, quantity) in enumerate(names)
    ]


def differences(poses: _Array, positions: _Array, other_poses: _Array, other_positions: _Array) -> _Array:
    """Return (rows, 2 · models + joints): distances [m], angles [rad], and joints' differences [rad or m].

    Args:
        poses: (rows, models, 7) x y z, qw qx qy qz.
        positions: (rows, joints).
        other_poses: poses to compare with.
        other_positions: positions to compare with.
    """
    distances = np.linalg.norm(poses[..., :3] - other_poses[..., :3], axis=-1)
    joints = np.abs(positions - other_positions)
    return np.concatenate([distances, _angles(poses[..., 3:], other_poses[..., 3:]), joints], axis=-1)


def _angles(some: _Array, others: _Array) -> _Array:
    """Return the angles between orientations of any length, exact for small angles as well."""
    w, v, w_other, v_other = some[..., :1], some[..., 1:], others[..., :1], others[..., 1:]
    sine = np.linalg.norm(w * v_other - w_other * v - np.cross(v, v_other), axis=-1)
    return 2.0 * np.arctan2(sine, np.abs(np.sum(some * others, axis=-1)))


def _number(value: np.float64) -> float | None:
    return float(value) if np.isfinite(value) else None
