"""Buffer of transforms, without ROS' communication."""

import contextlib
import math
import sys
import threading
from collections.abc import Callable, Generator
from typing import Any

from geometry_msgs.msg import TransformStamped

import genpy
import rospy
from trundle.ros.clients.transform_history import Transform
from trundle.ros.clients.transform_tree import TransformTree
from trundle.ros.errors import FrameNameError, TransformError, UnknownFrameError
from trundle.spatial import Pose

from .exceptions import LookupException, TransformException, of_error

_Arguments = tuple[tuple[str, str], ...]
"""Pairs (argument's name, frame)."""
_Statistics = tuple[str, str, str, float, float, float]
"""Frame, parent, authority, rate [Hz], newest stamp [s], oldest stamp [s]."""


class BufferCore:
    """Transforms of the last seconds, looked up by frame and time."""

    def __init__(self, cache_time: genpy.Duration | None = None) -> None:
        """Start empty; `cache_time` is a rospy.Duration, 10 s if None."""
        self._cache_ns = 10 * 10**9 if cache_time is None else _nanoseconds(cache_time)
        self._tree = TransformTree(self._cache_ns)
        self._authorities: dict[str, str] = {}
        self._lock = threading.RLock()

    def set_transform(self, transform: Any, authority: str) -> None:
        """Add a TransformStamped that node `authority` sent."""
        self._set(transform, authority, static=False)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """Add a TransformStamped that is valid at every time."""
        self._set(transform, authority, static=True)

    def lookup_transform_core(self, target_frame: str, source_frame: str, time: genpy.Time) -> Any:
        """TransformStamped of the source in the target frame; time 0 is the latest common time.

        Raises:
            TransformException: there is no such transform.
        """
        _check_types(target_frame, source_frame)
        stamp_ns = _nanoseconds(time)
        with self._lock, _tf2_exceptions():
            self._check(("target_frame", target_frame), ("source_frame", source_frame))
            stamp, pose = self._tree.lookup(target_frame, source_frame, stamp_ns)
        return _message(target_frame, source_frame, stamp, pose)

    def lookup_transform_full_core(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> Any:
        """TransformStamped of the source at one time in the target at another time, related by the fixed frame.

        Raises:
            TransformException: there is no such transform.
        """
        _check_types(target_frame, source_frame, fixed_frame)
        with self._lock, _tf2_exceptions():
            self._check(("target_frame", target_frame), ("source_frame", source_frame), ("fixed_frame", fixed_frame))
            _, fixed_from_source = self._tree.lookup(fixed_frame, source_frame, _nanoseconds(source_time))
            stamp, target_from_fixed = self._tree.lookup(target_frame, fixed_frame, _nanoseconds(target_time))
        pose = target_from_fixed @ fixed_from_source
        return _message(target_frame, source_frame, stamp, Pose(pose.position, _with_matrix_sign(pose.quaternion)))

    def can_transform_core(self, target_frame: str, source_frame: str, time: genpy.Time) -> tuple[int, str]:
        """(1, '') if the lookup would succeed, else (0, reason)."""
        _check_types(target_frame, source_frame)
        return self._try(
            (("target_frame", target_frame), ("source_frame", source_frame)),
            lambda: self._tree.lookup(target_frame, source_frame, _nanoseconds(time)),
        )

    def can_transform_full_core(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> tuple[int, str]:
        """(1, '') if the full lookup would succeed, else (0, reason)."""
        _check_types(target_frame, source_frame, fixed_frame)

        def lookup() -> None:
            self._tree.lookup(target_frame, fixed_frame, _nanoseconds(target_time))
            self._tree.lookup(fixed_frame, source_frame, _nanoseconds(source_time))

        return self._try(
            (("target_frame", target_frame), ("source_frame", source_frame), ("fixed_frame", fixed_frame)), lookup
        )

    def get_latest_common_time(self, source_frame: str, dest_frame: str) -> rospy.Time:
        """Newest rospy.Time at which the two are connected; 0 if all frames between them are static.

        Raises:
            LookupException: no such frame.
            TransformException: not connected.
        """
        with self._lock:
            for frame in (source_frame, dest_frame):
                if frame not in self._tree.names:
                    raise LookupException(f'"{frame}" passed to get_latest_common_time does not exist. ')
            try:
                return rospy.Time(0, self._tree.latest_common_time(source_frame, dest_frame))
            except TransformError as error:
                raise TransformException(str(error)) from None

    def clear(self) -> None:
        """Drop all but static transforms."""
        with self._lock:
            self._tree.clear()

    def all_frames_as_yaml(self) -> str:
        """Parent, broadcaster, rate and times of each frame, as YAML."""
        text = "".join(
            f"{frame}: \n  parent: '{parent}'\n  broadcaster: '{authority}'\n  rate: {rate:.3f}\n"
            f"  most_recent_transform: {newest:.3f}\n  oldest_transform: {oldest:.3f}\n"
            f"  buffer_length: {newest - oldest:.3f}\n"
            for frame, parent, authority, rate, newest, oldest in self._statistics()
        )
        return text or "{}"

    def all_frames_as_string(self) -> str:
        """Description of the tree, with a sentence for each frame."""
        return "".join(f"Frame {frame} exists with parent {parent}.\n" for frame, parent, *_ in self._statistics())

    def _allFramesAsDot(self, current_time: genpy.Time | None = None) -> str:
        """The tree as a graph for Graphviz; `current_time` is a rospy.Time."""
        rows = self._statistics()
        if not rows:
            return 'digraph G {\n"no tf data recieved"}'  # the word as tf2 misspells it
        lines: list[str] = []
        for frame, parent, authority, rate, newest, oldest in rows:
            label = f"Broadcaster: {authority}\\nAverage rate: {rate:.3f} Hz\\nMost recent transform: {newest:.3f} "
            if current_time is not None:
                label += f"( {current_time.to_sec() - newest:.3f} sec old)"
            lines.append(f'"{parent}" -> "{frame}"[label="{label}\\nBuffer length: {newest - oldest:.3f} sec\\n"];\n')
        if current_time is not None:
            children = {row[0] for row in rows}
            roots = dict.fromkeys(row[1] for row in rows if row[1] not in children)
            lines += [_legend(current_time, root) for root in roots]
        return "digraph G {\n" + "".join(lines) + "}"

    def _frameExists(self, frame_id: str) -> bool:
        """True if the frame is known, as child or parent."""
        return frame_id in self._tree.names

    def _getFrameStrings(self) -> list[str]:
        """Names of all frames."""
        with self._lock:
            return list(self._tree.names)

    def _chain(
        self, target_frame: str, target_time: genpy.Time, source_frame: str, source_time: genpy.Time, fixed_frame: str
    ) -> list[str]:
        """Frames from the source to the target, along the tree."""
        with self._lock, _tf2_exceptions():
            self._check(("target_frame", target_frame), ("source_frame", source_frame), ("fixed_frame", fixed_frame))
            to_fixed = self._tree.chain(fixed_frame, source_frame, _nanoseconds(source_time))
            return [*to_fixed, *self._tree.chain(target_frame, fixed_frame, _nanoseconds(target_time))[1:]]

    def _set(self, transform: Any, authority: str, *, static: bool) -> None:
        """Check a transform and add it to the frame's history; faults go to stderr."""
        parent, child = (name.removeprefix("/") for name in (transform.header.frame_id, transform.child_frame_id))
        t, q = transform.transform.translation, transform.transform.rotation
        stamp = transform.header.stamp.to_nsec()
        norm = math.hypot(q.x, q.y, q.z, q.w)
        fault = _fault(parent, child, norm, t)
        if fault:
            print(f"{fault}, sent by {authority}; ignored", file=sys.stderr)
            return
        clean = Transform(
            parent=parent,
            child=child,
            stamp_ns=stamp,
            translation=(t.x, t.y, t.z),
            rotation=(q.w / norm, q.x / norm, q.y / norm, q.z / norm),
        )
        with self._lock:
            if not self._tree.add(clean, static=static):
                newest = self._tree.histories[child].newest_stamp
                why = "TF_REPEATED_DATA: duplicate stamp" if newest - stamp <= self._cache_ns else "TF_OLD_DATA"
                print(
                    f"{why}: transform of '{child}' at {stamp / 1e9:f}, sent by {authority}; ignored", file=sys.stderr
                )
                return
            self._authorities[child] = authority

    def _check(self, *arguments: tuple[str, str]) -> None:
        for argument, frame in arguments:
            self._tree.check_frame(frame, "lookupTransform", argument)

    def _try(self, arguments: _Arguments, lookup: Callable[[], object]) -> tuple[int, str]:
        """(1, '') if the names are valid and `lookup` succeeds, else (0, reason)."""
        with self._lock:
            for argument, frame in arguments:
                try:
                    self._tree.check_frame(frame, "canTransform", argument)
                except FrameNameError as error:
                    print(error, file=sys.stderr)
                    return 0, ""
                except UnknownFrameError:
                    return 0, f"canTransform: {argument} {frame} does not exist."
            try:
                lookup()
            except TransformError as error:
                return 0, str(error)
        return 1, ""

    def _statistics(self) -> list[_Statistics]:
        """Statistics of each frame with data."""
        with self._lock:
            rows: list[_Statistics] = []
            for frame, history in self._tree.histories.items():
                if history.latest is None:
                    continue
                newest, oldest = history.newest_stamp, history.oldest_stamp
                rate = len(history) / max((newest - oldest) / 1e9, 0.0001)
                rows.append((frame, history.latest.parent, self._authorities[frame], rate, newest / 1e9, oldest / 1e9))
            return rows


def _legend(time: genpy.Time, root: str) -> str:
    return (
        'edge [style=invis];\n subgraph cluster_legend { style=bold; color=black; label ="view_frames Result";\n'
        f'"Recorded at time: {time.to_sec():.3f}"[ shape=plaintext ] ;\n }}->"{root}";\n'
    )


def _fault(parent: str, child: str, norm: float, translation: Any) -> str:
    """Fault that makes a transform unusable; '' if there is none."""
    if child == parent:
        return f"TF_SELF_TRANSFORM: frame_id and child_frame_id are both '{child}'"
    if not child:
        return "TF_NO_CHILD_FRAME_ID: a transform without child_frame_id"
    if not parent:
        return f"TF_NO_FRAME_ID: the transform of '{child}' has no frame_id"
    if not math.isfinite(norm + translation.x + translation.y + translation.z):
        return f"TF_NAN_INPUT: the transform of '{child}' is not finite"
    if abs(norm * norm - 1.0) > 1e-2:
        return f"TF_DENORMALIZED_QUATERNION: the rotation of '{child}' has length {norm:g}"
    return ""


def _check_types(*frames: object) -> None:
    for frame in frames:
        if not isinstance(frame, str):
            raise TypeError(f"a frame's name must be str, not {type(frame).__name__}")


def _nanoseconds(time: genpy.TVal) -> int:
    if not hasattr(time, "to_nsec"):
        raise TypeError("time must have a to_sec method, e.g. rospy.Time or rospy.Duration")
    return time.to_nsec()


def _message(target: str, source: str, stamp: int, pose: Pose) -> Any:
    message = TransformStamped()
    message.header.frame_id = target
    message.header.stamp = rospy.Time(stamp // 10**9, stamp % 10**9)
    message.child_frame_id = source
    t, q = message.transform.translation, message.transform.rotation
    # Adding 0.0 turns -0.0, which would be printed, into 0.0.
    t.x, t.y, t.z = (v + 0.0 for v in pose.position)
    q.w, q.x, q.y, q.z = (v + 0.0 for v in pose.quaternion)
    return message


def _with_matrix_sign(q: tuple[float, float, float, float]) -> tuple[float, float, float, float]:
    """Quaternion with the sign of a matrix conversion: w > 0 if the trace is positive, else its largest axis."""
    decisive = q[0] if abs(q[0]) > 0.5 else max(q[1:], key=abs)
    return (-q[0], -q[1], -q[2], -q[3]) if decisive < 0.0 else q


@contextlib.contextmanager
def _tf2_exceptions() -> Generator[None]:
    try:
        yield
    except TransformError as error:
        raise of_error(error) from None
