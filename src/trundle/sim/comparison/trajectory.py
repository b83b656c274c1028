"""Poses of models and positions of joints over time, between whose samples others are interpolated."""

from collections.abc import Iterable, Sequence
from typing import Self

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from trundle.sim.simulation import StateLog

_Array = NDArray[np.float64]
_SHORTEST_S = 1e-12


class Trajectory(Struct, frozen=True, eq=False, kw_only=True):
    """Poses of models, each by its first link, and positions of joints over time."""

    models: tuple[str, ...]
    joints: tuple[str, ...]
    """`model::joint`"""
    start: float
    """Time of the first sample [s]."""
    times: _Array
    """(samples,) ascending from 0: time since the start [s]."""
    poses: _Array
    """(samples, models, 7) x y z [m], qw qx qy qz, in the world."""
    positions: _Array
    """(samples, joints) [rad or m]"""

    @classmethod
    def of_log(cls, log: StateLog) -> Self:
        """Return the run in a log with at least one row; where its time goes back, the later rows count."""
        rows = ascending_rows(log.times_s)
        firsts = first_links(log.links)
        times = log.times_s[rows]
        return cls(
            models=tuple(firsts),
            joints=log.joints,
            start=float(times[0]),
            times=times - times[0],
            poses=log.poses[rows][:, list(firsts.values())],
            positions=log.positions[rows],
        )

    def only(self, models: Iterable[str], joints: Iterable[str]) -> Self:
        """Return these models and joints alone, where the trajectory has them."""
        models = tuple(model for model in models if model in self.models)
        joints = tuple(joint for joint in joints if joint in self.joints)
        return replace(
            self,
            models=models,
            joints=joints,
            poses=self.poses[:, [self.models.index(model) for model in models]],
            positions=self.positions[:, [self.joints.index(joint) for joint in joints]],
        )

    def at(self, times: _Array) -> tuple[_Array, _Array]:
        """Return poses and positions at times since the start, held before the first sample and after the last.

        Args:
            times: (rows,) [s]

        Returns:
            (rows, models, 7) and (rows, joints), as `poses` and `positions`.
        """
        before, after, ratio = interpolation(self.times, times)
        share = ratio[:, None]
        positions = self.positions[before] + share * (self.positions[after] - self.positions[before])
        share = share[:, :, None]
        start, end = self.poses[before], self.poses[after]
        same_side = np.sum(start[..., 3:] * end[..., 3:], axis=-1, keepdims=True) >= 0
        end = np.concatenate([end[..., :3], np.where(same_side, end[..., 3:], -end[..., 3:])], axis=-1)
        return start + share * (end - start), positions


def interpolation(samples: _Array, times: _Array) -> tuple[NDArray[np.intp], NDArray[np.intp], _Array]:
    """Return, for each time (rows,), the samples before and after it, and the ratio between them in [0, 1].

    Args:
        samples: ascending times of the samples [s], at least one.
        times: times to interpolate at [s].
    """
    last = len(samples) - 1
    before = np.clip(np.searchsorted(samples, times, side="right") - 1, 0, last)
    after = np.minimum(before + 1, last)
    span = np.maximum(samples[after] - samples[before], _SHORTEST_S)
    return before, after, np.clip((times - samples[before]) / span, 0.0, 1.0)


def first_links(links: Sequence[str]) -> dict[str, int]:
    """Return model → index of its first link, among links named `model::link`."""
    firsts: dict[str, int] = {}
    for index, link in enumerate(links):
        firsts.setdefault(link.partition("::")[0], index)
    return firsts


def ascending_rows(times: _Array) -> NDArray[np.intp]:
    """Return the rows that no later row's time precedes: what counts after resets and jumps back."""
    earliest_later = np.minimum.accumulate(times[::-1])[::-1]
    return np.flatnonzero(np.append(times[:-1] < earliest_later[1:], True))
