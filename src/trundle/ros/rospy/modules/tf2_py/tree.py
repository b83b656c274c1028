"""The tree of frames: walks from frame to frame, at one time."""

from .exceptions import (
    ConnectivityException,
    ExtrapolationException,
    InvalidArgumentException,
    LookupException,
    TransformException,
)
from .rigid import IDENTITY, compose, invert

_MAX_DEPTH = 1000
"""Limit of a frame's ancestors, to detect loops; the same in tf2."""


class FrameTree:
    """Histories by frame name, and transforms between any two frames."""

    def __init__(self):
        self.histories = {}
        """Child → its history."""
        self.names = {}
        """Every frame known, in order of appearance (values are unused)."""

    def check_name(self, name, function, argument):
        """Check a frame name of a caller.

        Raises:
            InvalidArgumentException: it is empty or starts with a slash.
            LookupException: no such frame.
        """
        if not name:
            raise InvalidArgumentException(
                f"Invalid argument passed to {function} argument {argument} in tf2 frame_ids cannot be empty"
            )
        if name.startswith("/"):
            raise InvalidArgumentException(
                f'Invalid argument "{name}" passed to {function} argument {argument} '
                "in tf2 frame_ids cannot start with a '/' like: "
            )
        if name not in self.names:
            raise LookupException(f'"{name}" passed to {function} argument {argument} does not exist. ')

    def transform(self, target, source, stamp):
        """Stamp [ns] and pose `target_from_source`; time 0 is the latest common time.

        Raises:
            TransformException: not connected, or not at this time.
        """
        if target == source:
            history = self.histories.get(target)
            return (stamp or (history.latest()[0] if history else 0)), IDENTITY
        if stamp == 0:
            stamp = self.latest_common_time(target, source)
        if target not in self.histories and self.histories.get(source) is None:
            raise _unconnected(target, source)
        top, top_from_source, gap = self._climb(source, target, stamp)
        if top == target:
            return stamp, top_from_source
        frame, frame_from_target = target, IDENTITY
        for _ in range(_MAX_DEPTH):
            if frame == top:
                return stamp, compose(invert(frame_from_target), top_from_source)
            try:
                sample = self._sample(frame, stamp)
            except ExtrapolationException as error:
                raise _between(error, target, source) from None
            if sample is None:
                break
            frame, frame_from_target = sample.parent, compose(sample.pose, frame_from_target)
            if frame == source:
                return stamp, invert(frame_from_target)
        else:
            raise _loop(target)
        raise _between(gap, target, source) if gap else _unconnected(target, source)

    def _climb(self, source, target, stamp):
        """(frame, `frame_from_source`, error): up to the target, the root, or where the time is outside the history."""
        frame, frame_from_source = source, IDENTITY
        for _ in range(_MAX_DEPTH):
            if frame == target:
                return frame, frame_from_source, None
            try:
                sample = self._sample(frame, stamp)
            except ExtrapolationException as error:  # a common ancestor may still be below
                return frame, frame_from_source, error
            if sample is None:
                return frame, frame_from_source, None
            frame, frame_from_source = sample.parent, compose(sample.pose, frame_from_source)
        raise _loop(source)

    def _sample(self, frame, stamp):
        history = self.histories.get(frame)
        return history.sample_at(stamp) if history else None

    def latest_common_time(self, target, source):
        """Newest time at which all frames between the two have data [ns]; 0 if all are static.

        Raises:
            ConnectivityException: the two are not connected.
        """
        if target == source:
            history = self.histories.get(source)
            return history.latest()[0] if history else 0
        below_source = self._newest_stamps(source, target)
        below_target = self._newest_stamps(target, source)
        common = next((frame for frame in below_target if frame in below_source), None)
        if common is None:
            raise _unconnected(target, source)
        stamps = [*_until(below_source, common), *_until(below_target, common)]
        return min((stamp for stamp in stamps if stamp), default=0)

    def _newest_stamps(self, frame, end):
        """Frame and its ancestors up to `end` or the root → newest stamp [ns]."""
        stamps = {}
        for _ in range(_MAX_DEPTH):
            history = self.histories.get(frame)
            stamps[frame], parent = history.latest() if history else (0, None)
            if parent is None or frame == end:
                return stamps
            frame = parent
        raise _loop(frame)

    def chain(self, target, source, stamp):
        """Frames from source to target, inclusive, at a time [ns].

        Raises:
            TransformException: not connected, or not at this time.
        """
        self.transform(target, source, stamp)
        up_source, up_target = self._ancestors(source, stamp), self._ancestors(target, stamp)
        common = next(frame for frame in up_source if frame in up_target)
        return [*up_source[: up_source.index(common) + 1], *reversed(up_target[: up_target.index(common)])]

    def _ancestors(self, frame, stamp):
        found = [frame]
        while len(found) < _MAX_DEPTH:
            try:
                sample = self._sample(found[-1], stamp)
            except ExtrapolationException:
                return found
            if sample is None:
                return found
            found.append(sample.parent)
        return found


def _until(stamps, frame):
    """Stamps of a chain below a frame."""
    names = list(stamps)
    return [stamps[name] for name in names[: names.index(frame)]]


def _unconnected(target, source):
    return ConnectivityException(
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the same tree."
        "Tf has two or more unconnected trees."
    )


def _between(error, target, source):
    return ExtrapolationException(f"{error}, when looking up transform from frame [{source}] to frame [{target}]")


def _loop(frame):
    return TransformException(f"The tf tree is invalid because it contains a loop through '{frame}'.")
