"""Differences of a bag or a graph from another bag: its topics' numbers, and the poses of its frames."""

import re
from collections.abc import Sequence

import numpy as np
from msgspec.structs import replace

from trundle.ros import FramePoses, Layout, RecordedNumbers, TopicNumbers
from trundle.sim.comparison import Comparison, Difference, NumberComparison, Numbers, Trajectory

_RESTING = 1e-12
"""Largest difference between two numbers that count as equal."""
_MAX_SHOWN_ELEMENTS = 8
"""Largest array of which all elements are shown; of a longer one, only the element with the largest difference is."""
_ELEMENT = re.compile(r"\[\d+\]$")
_POSITION = re.compile(r"\.(?:position|translation)\.[xyz]$|^/[^.]*\.position\[[^\]]*\]$")
"""Paths of positions: numbers of poses, or of joints."""


class BagComparison:
    """Samples of a run's topics, and their differences from a bag's at the same time since the start."""

    def __init__(self, reference: RecordedNumbers, *, start: float) -> None:
        """Begin without a sample.

        Args:
            reference: recording to compare with.
            start: the run's start [s], at which the reference starts.
        """
        self.reference = reference
        self.start = start
        self._topics: dict[str, list[_TopicComparison]] = {}
        seen: set[str] = set()
        for numbers in reference.numbers:
            topic = _TopicComparison(numbers, reference, start, seen)
            self._topics.setdefault(numbers.topic, []).append(topic)
        self._frames = {
            (frame.parent, frame.child): Comparison(frame_trajectory(frame, reference.start), start=start)
            for frame in reference.frames
        }
        self._static = {(frame.parent, frame.child) for frame in reference.frames if frame.is_static}
        for key in self._static:  # one pose for all times
            self._frames[key].duration = reference.duration

    @property
    def offset(self) -> float:
        """Time by which the reference starts after the run [s]."""
        return self._offset

    @offset.setter
    def offset(self, offset: float) -> None:
        self._offset = offset
        for samples in (*self._all_topics, *self._frames.values()):
            samples.offset = offset

    _offset = 0.0

    @property
    def _all_topics(self) -> list["_TopicComparison"]:
        return [topic for topics in self._topics.values() for topic in topics]

    def add_numbers(self, topic: str, time: float, layout: Layout, values: Sequence[float]) -> None:
        """Add a message's numbers at a time of the run [s]."""
        for numbers in self._topics.get(topic, ()):
            numbers.add_message(time, layout, values)

    def add_transform(self, parent: str, child: str, time: float, pose: Sequence[float]) -> None:
        """Add a pose x y z [m], qw qx qy qz of a frame in its parent at a time of the run [s]."""
        frame = self._frames.get((parent, child))
        if frame is not None:
            frame.add(time, np.array(pose))

    def add_run(self, run: RecordedNumbers) -> None:
        """Add all samples of a recorded run."""
        for numbers in run.numbers:
            for time, row in zip(numbers.times.tolist(), numbers.values, strict=True):
                self.add_numbers(numbers.topic, time, numbers.layout, row)
        for frame in run.frames:
            for time, pose in zip(frame.times.tolist(), frame.poses, strict=True):
                self.add_transform(frame.parent, frame.child, run.start if frame.is_static else time, pose)

    def differences(self, time: float, *, since_start: bool = False) -> list[Difference]:
        """Return frames that move or differ at a time of the run [s], then numbers that differ, the largest first.

        Numbers are sorted by the ratio of their difference to their range in the reference.

        Args:
            time: the run's time [s].
            since_start: True: times of maxima are since the run's start.
        """
        frames = [
            row
            for key, frame in self._frames.items()
            for row in frame.differences(time)
            if row.maximum is not None and (key not in self._static or _differs(row))
        ]
        farthest: dict[str, float] = {}
        for row in frames:
            farthest[row.name] = max(farthest.get(row.name, 0.0), row.maximum or 0.0)
        frames.sort(key=lambda row: (-farthest[row.name], row.name))
        numbers = [found for topic in self._all_topics for found in topic.rows(time)]
        numbers.sort(key=lambda found: -found[0])
        rows = [*frames, *(row for _, row in numbers)]
        if not since_start:
            return rows
        return [
            row if row.maximum_time is None else replace(row, maximum_time=row.maximum_time - self.start)
            for row in rows
        ]

    @property
    def equal(self) -> int:
        """Numbers that change in the reference and were equal when `differences` was called last."""
        return sum(topic.equal for topic in self._all_topics)

    def first_apart(self, tolerance: float) -> tuple[float, str] | None:
        """Return the run's first time [s] at which a pose or a joint differs by more than a tolerance, and its name."""
        frames = self._frames.values()
        times = [(frame.first_above(tolerance, (0, 1)), frame.reference.models[0]) for frame in frames]
        times += [(topic.first_above(tolerance, topic.positions), topic.topic) for topic in self._all_topics]
        return min(((time, name) for time, name in times if time is not None), default=None)


class _TopicComparison(NumberComparison):
    """Samples of a topic's numbers, of one layout of the reference."""

    def __init__(self, numbers: TopicNumbers, reference: RecordedNumbers, start: float, seen: set[str]) -> None:
        """Compare the numbers whose paths are not in `seen`, and add them to it."""
        self._paths = numbers.layout.paths
        names = [numbers.topic + path for path in self._paths]
        columns = [at for at, name in enumerate(names) if name not in seen]
        seen |= set(names)
        self._paths = tuple(self._paths[at] for at in columns)
        self.topic = numbers.topic
        self.positions = [at for at, column in enumerate(columns) if _POSITION.search(names[column])]
        """Columns of positions."""
        compared = Numbers(
            names=tuple(names[at] for at in columns),
            times=numbers.times - reference.start,
            values=numbers.values[:, columns],
            is_held=np.array([numbers.layout.is_held[at] for at in columns], dtype=np.bool_),
        )
        super().__init__(compared, start=start, duration=float(compared.times[-1]))
        with np.errstate(invalid="ignore"):
            self._ranges = np.ptp(compared.values, axis=0) if len(columns) else np.empty(0)
        self._columns: dict[Layout, list[int]] = {}
        self.equal = 0
        """Numbers that change and were equal when `rows` was called last."""

    def add_message(self, time: float, layout: Layout, values: Sequence[float]) -> None:
        """Add a message's numbers, NaN for those that it does not have; none if it has none of them."""
        columns = self._columns.get(layout)
        if columns is None:
            indices = {path: at for at, path in enumerate(layout.paths)}
            columns = self._columns[layout] = [indices.get(path, -1) for path in self._paths]
        if any(column >= 0 for column in columns):
            self.add(time, np.array([*values, np.nan])[columns])

    def rows(self, time: float) -> list[tuple[float, Difference]]:
        """Return the ratio of each difference to its range, and the difference; of long arrays only the largest."""
        arrays: dict[str, list[tuple[float, Difference]]] = {}
        self.equal = 0
        for extent, row in zip(self._ranges.tolist(), self.differences(time), strict=True):
            self.equal += row.maximum is not None and not _differs(row) and extent > _RESTING
            if row.maximum is not None and _differs(row):
                ratio = row.maximum / max(extent, _RESTING)
                arrays.setdefault(_ELEMENT.sub("", row.name), []).append((ratio, row))
        found: list[tuple[float, Difference]] = []
        for rows in arrays.values():
            found += rows if len(rows) <= _MAX_SHOWN_ELEMENTS else [max(rows, key=lambda pair: pair[1].maximum or 0.0)]
        return found


def frame_trajectory(frame: FramePoses, start: float) -> Trajectory:
    """Return the poses of a frame in its parent as those of one model.

    Args:
        frame: frame.
        start: the recording's start [s].
    """
    trajectory = Trajectory(
        models=(f"{frame.child} in {frame.parent}",),
        joints=(),
        start=start,
        times=frame.times - start,
        poses=frame.poses[:, None, :],
        positions=np.empty((len(frame.times), 0)),
    )
    return replace(trajectory, times=np.zeros(1), poses=trajectory.poses[-1:]) if frame.is_static else trajectory


def _differs(row: Difference) -> bool:
    return (row.maximum or 0.0) > _RESTING
