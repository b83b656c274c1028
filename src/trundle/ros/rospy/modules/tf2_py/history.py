"""Transforms of one frame over time."""

from bisect import bisect_left
from typing import NamedTuple

from .exceptions import ExtrapolationException
from .rigid import interpolate


class Sample(NamedTuple):
    """Pose of a frame in its parent at one time."""

    stamp: int
    """[ns]."""
    parent: str
    pose: tuple
    """`parent_from_child`, see `rigid`."""


def seconds(stamp_ns):
    """Text of a time, to the nanosecond."""
    sign = "-" if stamp_ns < 0 else ""
    return f"{sign}{abs(stamp_ns) // 10**9}.{abs(stamp_ns) % 10**9:09d}"


class History:
    """Samples of a moving frame, of the last `cache_ns`."""

    def __init__(self, cache_ns):
        self._cache_ns = cache_ns
        self._stamps = []
        self._samples = []

    def add(self, sample):
        """Insert a sample; False if it is older than the cache, or its stamp is there."""
        stamps, samples = self._stamps, self._samples
        if not stamps or sample.stamp > stamps[-1]:
            stamps.append(sample.stamp)
            samples.append(sample)
        else:
            at = bisect_left(stamps, sample.stamp)
            if sample.stamp + self._cache_ns < stamps[-1] or stamps[at] == sample.stamp:
                return False
            stamps.insert(at, sample.stamp)
            samples.insert(at, sample)
        expired = bisect_left(stamps, stamps[-1] - self._cache_ns)
        if expired:
            del stamps[:expired], samples[:expired]
        return True

    def sample_at(self, stamp):
        """Interpolated sample at a time [ns], 0 for the latest; None if the history is empty.

        Raises:
            ExtrapolationException: the time is outside the history.
        """
        stamps, samples = self._stamps, self._samples
        if not stamps:
            return None
        if stamp in (0, stamps[-1]):
            return samples[-1]
        if len(stamps) == 1:
            raise ExtrapolationException(
                f"Lookup would require extrapolation at time {seconds(stamp)}, "
                f"but only time {seconds(stamps[0])} is in the buffer"
            )
        if stamp > stamps[-1]:
            raise _outside(stamp, stamps[-1], "future", "latest")
        if stamp < stamps[0]:
            raise _outside(stamp, stamps[0], "past", "earliest")
        at = bisect_left(stamps, stamp)
        if stamps[at] == stamp:
            return samples[at]
        before, after = samples[at - 1], samples[at]
        if before.parent != after.parent:
            return before
        share = (stamp - before.stamp) / (after.stamp - before.stamp)
        return Sample(stamp, before.parent, interpolate(before.pose, after.pose, share))

    def latest(self):
        """(stamp [ns], parent) of the newest sample; (0, None) if there is none."""
        return (self._stamps[-1], self._samples[-1].parent) if self._stamps else (0, None)

    def oldest_stamp(self):
        """Stamp of the oldest sample [ns]; 0 if there is none."""
        return self._stamps[0] if self._stamps else 0

    def count(self):
        """Number of samples."""
        return len(self._stamps)

    def clear(self):
        """Drop all samples."""
        self._stamps.clear()
        self._samples.clear()


class FixedFrame:
    """A static frame: one sample, valid at every time."""

    def __init__(self):
        self._sample = None

    def add(self, sample):
        """Replace the sample; always True."""
        self._sample = sample
        return True

    def sample_at(self, stamp):
        """The sample, stamped as asked for."""
        return self._sample and self._sample._replace(stamp=stamp)

    def latest(self):
        """(0, parent): static frames do not bound a common time."""
        return 0, self._sample and self._sample.parent

    def oldest_stamp(self):
        """0."""
        return 0

    def count(self):
        """One, as soon as the frame is set."""
        return int(self._sample is not None)

    def clear(self):
        """Static transforms are sent only once: keep the sample."""


def _outside(stamp, nearest, where, which):
    return ExtrapolationException(
        f"Lookup would require extrapolation {seconds(abs(stamp - nearest))}s into the {where}.  "
        f"Requested time {seconds(stamp)} but the {which} data is at time {seconds(nearest)}"
    )
