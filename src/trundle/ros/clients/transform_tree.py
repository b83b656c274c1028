"""The tree of frames, traversed from frame to frame at one time as in tf2's buffer."""

from collections.abc import Iterable

from trundle.spatial import Pose

from ..errors import ConnectivityError, ExtrapolationError, FrameNameError, TransformError, UnknownFrameError
from .transform_history import StaticTransform, Transform, TransformHistory

_MAX_DEPTH = 1000
"""Limit of a frame's ancestors, to detect loops; the same in tf2."""


class TransformTree:
    """Histories by frame name, and transforms between any two frames; error texts are tf2's."""

    def __init__(self, cache_ns: int) -> None:
        self._cache_ns = cache_ns
        self.histories: dict[str, TransformHistory | StaticTransform] = {}
        """Child → its history."""
        self.names: dict[str, None] = {}
        """Every known frame, in order of appearance."""

    def add(self, transform: Transform, *, static: bool) -> bool:
        """Add a transform; False if it is older than the cache, or its stamp is a duplicate."""
        history = self.histories.get(transform.child)
        if not isinstance(history, StaticTransform if static else TransformHistory):
            history = StaticTransform() if static else TransformHistory(self._cache_ns)
            self.histories[transform.child] = history
        self.names.setdefault(transform.child)
        self.names.setdefault(transform.parent)
        return history.add(transform)

    def clear(self) -> None:
        """Drop all but static transforms."""
        for history in self.histories.values():
            history.clear()

    def check_frame(self, name: str, function: str, argument: str) -> None:
        """Check the name of a frame passed to `function`, and that the frame exists.

        Raises:
            FrameNameError: the name is empty or starts with a slash.
            UnknownFrameError: no such frame.
        """
        check_frame_name(name, function, argument)
        if name not in self.names:
            raise UnknownFrameError(f'"{name}" passed to {function} argument {argument} does not exist. ')

    def lookup(self, target: str, source: str, stamp_ns: int) -> tuple[int, Pose]:
        """Stamp [ns] and pose `target_from_source`; time 0 is the latest common time.

        Raises:
            TransformError: not connected, or not at this time.
        """
        if target == source:
            return stamp_ns or self._newest_stamp(target), Pose()
        if stamp_ns == 0:
            stamp_ns = self.latest_common_time(target, source)
        if target not in self.histories and source not in self.histories:
            raise _unconnected(target, source)
        top, top_from_source, extrapolation = self._climb(source, target, stamp_ns)
        if top == target:
            return stamp_ns, top_from_source
        frame, frame_from_target = target, Pose()
        for _ in range(_MAX_DEPTH):
            if frame == top:
                return stamp_ns, frame_from_target.inverse() @ top_from_source
            try:
                step = self._transform_at(frame, stamp_ns)
            except ExtrapolationError as error:
                raise _between(error, target, source) from None
            if step is None:
                break
            frame, frame_from_target = step.parent, step.pose @ frame_from_target
            if frame == source:
                return stamp_ns, frame_from_target.inverse()
        else:
            raise _loop(target)
        raise _between(extrapolation, target, source) if extrapolation else _unconnected(target, source)

    def latest_common_time(self, target: str, source: str) -> int:
        """Newest time at which all frames between the two have data [ns]; 0 if all are static.

        Raises:
            ConnectivityError: the two are not connected.
        """
        if target == source:
            return self._newest_stamp(source)
        below_source = self._newest_stamps(source, target)
        below_target = self._newest_stamps(target, source)
        common = next((frame for frame in below_target if frame in below_source), None)
        if common is None:
            raise _unconnected(target, source)
        stamps = [*_below(below_source, common), *_below(below_target, common)]
        return min((stamp for stamp in stamps if stamp), default=0)

    def chain(self, target: str, source: str, stamp_ns: int) -> list[str]:
        """Frames from source to target, inclusive, at a time [ns]; 0 for the latest.

        Raises:
            TransformError: not connected, or not at this time.
        """
        self.lookup(target, source, stamp_ns)
        up_source, up_target = self._ancestors(source, stamp_ns), self._ancestors(target, stamp_ns)
        common = next(frame for frame in up_source if frame in up_target)
        return [*up_source[: up_source.index(common) + 1], *reversed(up_target[: up_target.index(common)])]

    def _climb(self, source: str, target: str, stamp_ns: int) -> tuple[str, Pose, ExtrapolationError | None]:
        """(frame, `frame_from_source`, error): up to the target, the root, or where the time is outside the history."""
        frame, frame_from_source = source, Pose()
        for _ in range(_MAX_DEPTH):
            if frame == target:
                return frame, frame_from_source, None
            try:
                step = self._transform_at(frame, stamp_ns)
            except ExtrapolationError as error:  # a common ancestor may be nearer to both frames
                return frame, frame_from_source, error
            if step is None:
                return frame, frame_from_source, None
            frame, frame_from_source = step.parent, step.pose @ frame_from_source
        raise _loop(source)

    def _transform_at(self, frame: str, stamp_ns: int) -> Transform | None:
        history = self.histories.get(frame)
        return None if history is None else history.transform_at(stamp_ns)

    def _newest_stamp(self, frame: str) -> int:
        history = self.histories.get(frame)
        return 0 if history is None else history.newest_stamp

    def _newest_stamps(self, frame: str, end: str) -> dict[str, int]:
        """Frame and its ancestors up to `end` or the root → newest stamp [ns]."""
        stamps: dict[str, int] = {}
        for _ in range(_MAX_DEPTH):
            history = self.histories.get(frame)
            latest = None if history is None else history.latest
            stamps[frame] = 0 if history is None else history.newest_stamp
            if latest is None or frame == end:
                return stamps
            frame = latest.parent
        raise _loop(frame)

    def _ancestors(self, frame: str, stamp_ns: int) -> list[str]:
        frames = [frame]
        while len(frames) < _MAX_DEPTH:
            try:
                step = self._transform_at(frames[-1], stamp_ns)
            except ExtrapolationError:
                break
            if step is None:
                break
            frames.append(step.parent)
        return frames


def check_frame_name(name: str, function: str, argument: str) -> None:
    """Check the name of a frame passed to `function`.

    Raises:
        FrameNameError: it is empty or starts with a slash.
    """
    if not name:
        raise FrameNameError(
            f"Invalid argument passed to {function} argument {argument} in tf2 frame_ids cannot be empty"
        )
    if name.startswith("/"):
        raise FrameNameError(
            f'Invalid argument "{name}" passed to {function} argument {argument} '
            "in tf2 frame_ids cannot start with a '/' like: "
        )


def _below(stamps: dict[str, int], ancestor: str) -> Iterable[int]:
    """Stamps of a chain below a frame."""
    names = list(stamps)
    return (stamps[name] for name in names[: names.index(ancestor)])


def _unconnected(target: str, source: str) -> ConnectivityError:
    return ConnectivityError(
        f"Could not find a connection between '{target}' and '{source}' because they are not part of the same tree."
        "Tf has two or more unconnected trees."
    )


def _between(error: ExtrapolationError, target: str, source: str) -> ExtrapolationError:
    return ExtrapolationError(f"{error}, when looking up transform from frame [{source}] to frame [{target}]")


def _loop(frame: str) -> TransformError:
    return TransformError(f"The tf tree is invalid because it contains a loop through '{frame}'.")
