"""Plotted values of a played state log: poses and velocities of its models and links, and its joints."""

from collections import deque
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from trundle.base.diagnostics import UsageError
from trundle.page import PageServer
from trundle.robots.model import World
from trundle.sim.comparison import first_links, slopes, velocities
from trundle.sim.simulation import StateLog
from trundle.spatial import rpy_from_quaternion

from ..world.streams import SeriesHead
from .series import joint_units, splits

_WINDOW_S = 120.0
"""Longest time that plots show."""
_MESSAGES = 32
"""Updates whose rows a message repeats: about a second, so that a slow page misses none."""
_AXES = "xyz"
_Array = NDArray[np.float64]
_Read: TypeAlias = Callable[[slice], _Array]


class _Column(Struct, frozen=True, eq=False):
    """Value over the samples of a log."""

    unit: str
    read: _Read
    """Returns the values of some samples."""


class LogSeries:
    """Sends the values that clients plot, as far as a log has been played."""

    def __init__(self, server: PageServer, log: StateLog, world: World) -> None:
        """Send nothing yet.

        Args:
            server: page server.
            log: log that is played.
            world: the log's world.
        """
        self._server = server
        self._log = log
        self._links = {link: at for at, link in enumerate(log.links)}
        self._firsts = first_links(log.links)
        self._joints = {joint: at for at, joint in enumerate(log.joints)}
        self._units = {
            f"{model.name}::{joint.name}": joint_units(joint.type.value)[0]
            for model in world.models
            for joint in model.joints
        }
        self._names: tuple[str, ...] = ()
        self._columns: list[_Column] = []
        self._faults: dict[str, str] = {}
        self._sent = -1
        """Newest sample that was sent."""
        self._count = 0
        """Rows sent so far."""
        self._rows: deque[_Array] = deque(maxlen=_MESSAGES)

    def put(self, sample: int, *, paused: bool) -> None:
        """Send the rows up to a sample; one that is earlier than the last, unless paused, begins the curves again."""
        names = self._server.plotted
        is_new = names != self._names
        if is_new:
            self._find(names)
        if not names:
            return
        rows = self._due(sample, again=is_new or (sample < self._sent and not paused))
        if rows.start < rows.stop:
            self._sent = sample
        times = self._log.times_s[rows]
        self._rows.append(np.column_stack([times, *(column.read(rows) for column in self._columns)]))
        self._count += len(times)
        head = SeriesHead(
            names=tuple(name for name in names if name not in self._faults),
            units=tuple(column.unit for column in self._columns),
            faults=self._faults,
        )
        sent = np.concatenate(self._rows)
        self._server.put_series(self._count - len(sent), head, sent)

    def _due(self, sample: int, *, again: bool) -> slice:
        """Return the samples to send; `again`: also those that were sent."""
        times = self._log.times_s
        first = int(np.searchsorted(times, times[sample] - _WINDOW_S))
        start = first if again else max(first, self._sent + 1)
        return slice(start, max(start, sample + 1))

    def _find(self, names: tuple[str, ...]) -> None:
        self._names, self._columns, self._faults = names, [], {}
        self._rows.clear()
        for name in names:
            try:
                self._columns.append(self._column(name))
            except UsageError as error:
                self._faults[name] = str(error)

    def _column(self, name: str) -> _Column:
        """Return a value by its name.

        Raises:
            UsageError: the log does not have it.
        """
        present: list[str] = []
        for owner, field in splits(name):
            values = self._values(owner)
            if field in values:
                return values[field]
            present += values
        if present:
            raise UsageError(f"no value {name} was recorded; there are: {', '.join(present)}")
        raise UsageError(f"no model, link or joint for {name}")

    def _values(self, owner: str) -> dict[str, _Column]:
        link = self._links.get(owner, self._firsts.get(owner))
        joint = self._joints.get(owner)
        return (self._of_link(link) if link is not None else {}) | (
            self._of_joint(joint, self._units.get(owner, "rad")) if joint is not None else {}
        )

    def _of_link(self, link: int) -> dict[str, _Column]:
        poses = self._log.poses[:, link]

        def angles(rows: slice, axis: int) -> _Array:
            return np.array([rpy_from_quaternion((w, x, y, z))[axis] for w, x, y, z in poses[rows, 3:].tolist()])

        def twist(rows: slice, axis: int) -> _Array:
            around, inner = _with_neighbors(rows)
            return velocities(self._log.times_s[around], poses[around, None])[inner, 0, axis]

        columns: dict[str, _Column] = {}
        for axis, letter in enumerate(_AXES):
            columns[f"pose.{letter}"] = _Column("m", lambda rows, a=axis: poses[rows, a])
        for axis, angle in enumerate(("roll", "pitch", "yaw")):
            columns[f"pose.{angle}"] = _Column("rad", lambda rows, a=axis: angles(rows, a))
        for axis, letter in enumerate(_AXES):
            columns[f"twist.linear.{letter}"] = _Column("m/s", lambda rows, a=axis: twist(rows, a))
        for axis, letter in enumerate(_AXES):
            columns[f"twist.angular.{letter}"] = _Column("rad/s", lambda rows, a=axis: twist(rows, 3 + a))
        return columns

    def _of_joint(self, joint: int, unit: str) -> dict[str, _Column]:
        positions = self._log.positions[:, joint]

        def velocity(rows: slice) -> _Array:
            around, inner = _with_neighbors(rows)
            return slopes(self._log.times_s[around], positions[around])[inner]

        return {
            "position": _Column(unit, lambda rows: positions[rows]),
            "velocity": _Column(f"{unit}/s", velocity),
        }


def _with_neighbors(rows: slice) -> tuple[slice, slice]:
    """Return some rows with one more at each end, and their place among those."""
    start = max(0, rows.start - 1)
    return slice(start, rows.stop + 1), slice(rows.start - start, rows.stop - start)
